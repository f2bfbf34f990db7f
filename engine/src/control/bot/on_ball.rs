//! With the ball: pass, shoot, clear or run on. (The figures are GRF's unless they say otherwise.)

use crate::control::bot::formation::mindset;
use crate::control::bot::{TeamView, dribbling, odds};
use crate::football::pace::SPRINT_MPS;
use crate::football::{kick, noise};
use crate::math::{self, ease, share};
use crate::state::player::{Intent, KickKind, KickPlan};
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{Role, Stat};

/// What to do.
#[derive(Clone, Copy, Debug)]
enum OnBallChoice {
    Shoot(Vec2),
    Pass(PlayerId, KickKind),
    Clear,
}

/// How far from the middle of the usual goal a shot is aimed, and where a way for it is looked for,
/// metres; chosen.
const PLACED_M: f64 = 2.9;
const CORNER_M: f64 = 3.6;
/// The distance from the goal at which shots pay best, metres, and how far from there they are
/// tried.
const SHOOTS_FROM_M: f32 = 7.0;
const SHOOTS_WITHIN_M: f32 = 16.0;
/// How much faster than a pass a shot is assumed to be.
const SHOT_SPEED: f32 = 3.0;
/// The weights in rating a player with the ball, or a teammate who could get it: free space ahead,
/// free space around, and nearness to the goal, which counts more for attacking roles.
const SPACE_AHEAD: f32 = 0.4;
const SPACE_AROUND: f32 = 0.3;
const NEARNESS: [f32; 2] = [2.0, 6.0];
/// Factor on the value of a pass back to the keeper.
const TO_KEEPER: f32 = 0.7;
/// The least value of a pass.
const PASS_LEAST: f32 = 0.1;
/// After this many seconds with the ball, the least value of a pass is lowest.
const LONG_S: f32 = 5.0;
/// Such a player minds opponents less by this factor, so that two players don't wait for each other
/// forever; chosen.
const DARES: f32 = 0.6;
/// After this many seconds with the ball, they pass to the best receiver; chosen.
const MUST_S: f32 = 8.0;
/// Within these distances of the goal, defenders hurry to clear, metres.
const PANIC_M: std::ops::Range<f32> = 2.0..16.0;
/// A keeper clears the ball if a rival's time to it is less than this many times their own.
const KEEPER_CALM: f32 = 3.0;
/// A player decides what to do with the ball this many seconds before it arrives.
const AHEAD_S: f32 = 1.0;
/// Ticks after which a kick that did not come off is thought over; chosen.
const MIND_TICKS: i32 = 80;

/// Decides for the player on the ball.
pub fn decide(game: &mut Match, view: &TeamView, id: PlayerId) {
    if let Some((keeper, since)) = game.play.hands
        && keeper == id
    {
        release(game, view, id, since);
        return;
    }
    game.players[id.index()].body.intent = Intent::Ball(SPRINT_MPS);
    game.players[id.index()].body.dribble =
        dribbling::way(game, view, id, 1.0 - DARES * long(game, id));
    match choose(game, view, id) {
        Some(act) => perform(game, view, id, act),
        None => game.players[id.index()].body.kick = None,
    }
}

/// Decides for the player who will have the ball soon.
pub fn before_touch(game: &mut Match, view: &TeamView, id: PlayerId) {
    if game.play.led[view.team.index()] || game.player(id).body.meet_s > AHEAD_S {
        return;
    }
    match choose(game, view, id) {
        Some(act) => perform(game, view, id, act),
        None => game.players[id.index()].body.kick = None,
    }
}

/// Chooses what to do instead of running on: defenders in a hurry clear, then a player with a
/// better placed teammate passes, then a player near the goal shoots.
fn choose(game: &mut Match, view: &TeamView, id: PlayerId) -> Option<OnBallChoice> {
    let pass = best_pass(game, view, id);
    if must_clear(game, view, id, pass.map_or(0.0, |(odds, ..)| odds)) {
        return Some(OnBallChoice::Clear);
    }
    if let Some((_, mate, kind)) = pass {
        return Some(OnBallChoice::Pass(mate, kind));
    }
    shot(game, view, id).map(OnBallChoice::Shoot)
}

/// How well a player is placed for the ball, with this weight on nearness to the goal.
fn placed(game: &Match, view: &TeamView, id: PlayerId, nearness: f32) -> f32 {
    let player = game.player(id);
    let ahead = player.pos + Vec2::new(0.5 * SPRINT_MPS * view.side, 0.0);
    let goal = game.goal();
    let away = (goal - player.pos * view.side).length() / (2.0 * goal.x);
    let near = 1.0 - away.min(1.0);
    let sum = odds::free_space(game, view.team, ahead, 0.5) * SPACE_AHEAD
        + odds::free_space(game, view.team, player.pos + player.vel * 0.1, 0.1) * SPACE_AROUND
        + near * near.sqrt() * nearness;
    sum / (SPACE_AHEAD + SPACE_AROUND + nearness)
}

/// How long a player has had the ball, 0..1; 1 from [`LONG_S`] on.
fn long(game: &Match, id: PlayerId) -> f32 {
    let long = (had_s(game, id) / LONG_S).min(1.0);
    long * long
}

/// How long a player has had the ball, seconds.
fn had_s(game: &Match, id: PlayerId) -> f32 {
    let ticks =
        if game.owner == Some(id) { game.tick.saturating_sub(game.play.owned_since) } else { 0 };
    ticks as f32 * 0.01
}

/// The best pass: its odds, receiver and kind. None if running on is better.
fn best_pass(game: &Match, view: &TeamView, id: PlayerId) -> Option<(f32, PlayerId, KickKind)> {
    let player = game.player(id);
    let mind = mindset(game.player(player.body.mind.fills).role);
    let nearness = NEARNESS[0] + NEARNESS[1] * mind;
    let own = placed(game, view, id, nearness);
    let better = own + 0.06 * (1.0 - mind);
    let tactics = 1.0 + 10.0 * mind * mind;
    let apart = (game.ball.vel.truncate() - player.vel).length();
    let hard = (apart / 10.0).min(1.0) * (1.0 - 0.8 * player.skill(Stat::ShortPass));
    // A player who has had the ball for long accepts a worse pass.
    let long = long(game, id);
    let must = had_s(game, id) > MUST_S;
    let mut best = None;
    let mut most = if must { f32::MIN } else { PASS_LEAST * (1.0 - 0.5 * long) };
    for (mate, other) in game.team(view.team) {
        if mate == id {
            continue;
        }
        let keeper = if other.role == Role::GK { TO_KEEPER } else { 1.0 };
        let gains = placed(game, view, mate, nearness) * keeper;
        if gains <= better && !must {
            continue;
        }
        let mut odds = (0.0, KickKind::High);
        for kind in [KickKind::High, KickKind::Long, KickKind::Short] {
            let chance = odds::of_pass(game, view, id, mate, kind);
            if chance >= odds.0 {
                odds = (chance, kind);
            }
        }
        let worth = ((gains - own) * tactics + odds.0 - hard) / (tactics + 1.0);
        if worth > most && (must || odds.0 > 0.2 * (1.0 - mind) - 0.1 * long) {
            most = worth;
            best = Some((odds.0, mate, odds.1));
        }
    }
    best
}

/// Whether a defender should clear the ball, given the odds of their best pass: a rival reaches it
/// about as soon as they do. Nearer to the goal, a later rival is enough.
fn must_clear(game: &Match, view: &TeamView, id: PlayerId, pass: f32) -> bool {
    let player = game.player(id);
    let filled = game.player(player.body.mind.fills);
    if mindset(filled.role) >= 0.25 {
        return false;
    }
    let rivals = game.team(view.team.other());
    let rival_s = rivals.map(|(_, rival)| rival.body.meet_s).fold(f32::MAX, f32::min);
    let ahead = (rival_s + 0.2) / (player.body.meet_s + 0.2);
    if player.role == Role::GK {
        return ahead < KEEPER_CALM;
    }
    let close =
        1.0 - share((player.pos * view.side).distance(-game.goal()), PANIC_M.start, PANIC_M.end);
    (pass == 0.0 || pass < close) && ahead < 0.9 + 0.8 * close
}

/// Where to shoot at, own frame. None from places where nobody would shoot.
fn shot(game: &mut Match, view: &TeamView, id: PlayerId) -> Option<Vec2> {
    let player = *game.player(id);
    let own = player.pos * view.side;
    let goal = game.goal();
    let from = Vec2::new(goal.x - SHOOTS_FROM_M, 0.0).distance(own);
    if ease(1.0 - share(from, 0.0, SHOOTS_WITHIN_M)) <= 0.1 {
        return None;
    }
    let at = |y: f32| Vec2::new(goal.x + 1.0, y);
    let chance = |y: f32| odds::of_way(game, view, id, at(y), KickKind::Shot, SHOT_SPEED);
    let middle = (chance(0.0), 0.0);
    let [corner, placed] = [CORNER_M, PLACED_M].map(|from| game.pitch.in_goal(from) as f32);
    let best = [(chance(-corner), -placed), (chance(corner), placed)];
    let (odds, y) =
        best.into_iter().fold(middle, |best, next| if next.0 > best.0 { next } else { best });
    let luck = noise::bot_roll(game);
    if odds.sqrt() + 0.5 * luck <= 0.5 {
        return None;
    }
    let stray = (noise::bot_roll(game) * 2.0 - 1.0) * (1.0 - player.skill(Stat::Shot));
    Some(at(y + stray))
}

/// Turns the choice into a kick.
fn perform(game: &mut Match, view: &TeamView, id: PlayerId, act: OnBallChoice) {
    let (kind, mate) = match act {
        OnBallChoice::Shoot(_) => (KickKind::Shot, None),
        OnBallChoice::Pass(mate, kind) => (kind, Some(mate)),
        OnBallChoice::Clear => (KickKind::Clear, None),
    };
    if game.player(id).body.kick.is_some_and(|plan| plan.kind == kind && plan.mate == mate) {
        return;
    }
    let until = game.tick as i32 + MIND_TICKS;
    let plan = KickPlan { until, ..kick::planned(kind, game.tick) };
    let goal = game.goal();
    let body = &mut game.players[id.index()].body;
    body.intent = Intent::Ball(SPRINT_MPS);
    match act {
        OnBallChoice::Shoot(point) => {
            let far = share((goal - body.meet * view.side).length(), 0.0, 32.0);
            let most = 0.6 + 0.4 * far;
            let luck = noise::bot_roll(game);
            let plan = KickPlan {
                point: Some(point * view.side),
                power: (0.7 + 0.3 * luck) * most,
                ..plan
            };
            game.players[id.index()].body.kick = Some(plan);
        }
        OnBallChoice::Pass(mate, _) => {
            body.kick = Some(KickPlan { mate: Some(mate), ..plan });
        }
        OnBallChoice::Clear => {
            let facing = body.facing * view.side;
            let wide = math::sign_or(facing.y, 1.0);
            let away = Vec2::new(0.8 * facing.x, facing.y).normalize_or_zero()
                + Vec2::new(0.7, 0.5 * wide);
            let dir = away.normalize_or(Vec2::X) * view.side;
            body.kick = Some(KickPlan { dir: Some(dir), ..plan });
        }
    }
}

/// Lets the keeper release the ball: soon if a teammate is free, at the latest after four seconds.
fn release(game: &mut Match, view: &TeamView, id: PlayerId, since: u32) {
    game.players[id.index()].body.intent = Intent::Stand;
    let held_ticks = game.tick.saturating_sub(since);
    if held_ticks < 120 || game.player(id).body.kick.is_some() {
        return;
    }
    let player = *game.player(id);
    let mut best: Option<(f32, PlayerId)> = None;
    for (mate, other) in game.team(view.team) {
        let distance = other.pos.distance(player.pos);
        if mate == id || !(8.0..45.0).contains(&distance) {
            continue;
        }
        let free = odds::of_pass(game, view, id, mate, KickKind::Short);
        let room = nearest_rival(game, mate, other.pos).min(10.0) / 10.0;
        let worth = free * room - (distance - 15.0).max(0.0) * 0.012;
        if best.is_none_or(|(most, _)| worth > most) {
            best = Some((worth, mate));
        }
    }
    let tick = game.tick;
    let choice = match best {
        Some((worth, mate)) if worth > 0.45 => {
            KickPlan { mate: Some(mate), ..kick::planned(KickKind::Short, tick) }
        }
        _ if held_ticks > 250 => {
            let y = (noise::bot_roll(game) * 2.0 - 1.0) * 20.0;
            let point = Vec2::new(2.0, y) * view.side;
            KickPlan { point: Some(point), ..kick::planned(KickKind::High, tick) }
        }
        _ => return,
    };
    game.players[id.index()].body.kick = Some(choice);
}

/// The distance of the nearest opponent of a player from a world point, metres.
pub fn nearest_rival(game: &Match, id: PlayerId, point: Vec2) -> f32 {
    let least = game
        .team(id.team().other())
        .fold(f32::MAX, |least, (_, rival)| least.min(rival.pos.distance_squared(point)));
    libm::sqrtf(least)
}
