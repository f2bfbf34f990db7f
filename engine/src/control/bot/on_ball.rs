//! With the ball: shoot, pass, clear or run on.
//!
//! Every choice is rated on one scale, about the chance that it leads to a goal; the best one is taken, with a little
//! whim and more of it at a low level.

use crate::control::bot::formation::mindset;
use crate::control::bot::{GOAL, View};
use crate::football::body::{Intent, KickKind, KickPlan};
use crate::football::movement::SPRINT_MPS;
use crate::football::{kick, noise, pass_target};
use crate::math;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::pitch::{GOAL_HALF_WIDTH_M, HALF_WIDTH_M};
use setpiece_scenario::vocabulary::{Role, Rule, Stat};

/// A choice and what it is worth.
#[derive(Clone, Copy, Debug)]
struct Choice {
    worth: f32,
    act: Act,
}

/// What to do.
#[derive(Clone, Copy, Debug)]
enum Act {
    Shoot(Vec2),
    Pass(PlayerId, KickKind, Option<Vec2>),
    Clear,
    Run(Vec2, f32),
}

/// How far beside the middle of the goal a shot is aimed, metres.
const PLACED_M: f32 = 2.9;
/// What a pass must be better than running on.
const PASS_COST: f32 = 0.008;
/// Ticks after which a kick that did not come off is thought over.
const MIND_TICKS: i32 = 80;
/// How near to goal defenders are in a hurry to clear, metres. (GRF's.)
const PANIC_M: std::ops::Range<f32> = 2.0..16.0;
/// Steps between two thoughts.
const PAUSE_STEPS: u32 = 2;

/// Decides for the player on the ball.
pub fn decide(game: &mut Match, view: &View, id: PlayerId) {
    let now = game.step;
    if let Some((keeper, since)) = game.play.hands
        && keeper == id
    {
        release(game, view, id, since);
        return;
    }
    let player = *game.player(id);
    game.players[id.index()].body.intent = Intent::Ball(SPRINT_MPS);
    if player.body.kick.is_some() || now < player.body.mind.decide_at_step {
        return;
    }
    game.players[id.index()].body.mind.decide_at_step = now + PAUSE_STEPS;
    let choice = best(game, view, id, true);
    perform(game, view, id, choice);
}

/// A first-time kick: he decides just before the ball comes.
pub fn before_touch(game: &mut Match, view: &View, id: PlayerId) {
    let player = *game.player(id);
    if player.body.kick.is_some() || game.play.led[view.team.index()] {
        return;
    }
    let own = player.body.meet * view.side;
    let crowded = nearest_rival(game, id, player.body.meet) < 2.5;
    let close = own.distance(Vec2::new(54.0, 0.0)) < 15.0;
    let danger = own.x < -38.0 && crowded;
    if !close && !danger {
        return;
    }
    let choice = best(game, view, id, false);
    if matches!(choice.act, Act::Shoot(_) | Act::Clear) {
        perform(game, view, id, choice);
    }
}

/// The best of all choices.
fn best(game: &mut Match, view: &View, id: PlayerId, with_run: bool) -> Choice {
    let player = *game.player(id);
    let fickle = 0.003 + 0.008 * (1.0 - player.body.level);
    let fickle = fickle * (1.6 - 0.8 * player.body.stats[Stat::Vision.index()]);
    let mut best = Choice { worth: f32::MIN, act: Act::Clear };
    let mut offer = |game: &mut Match, worth: f32, act: Act| {
        let worth = worth + (noise::whim(game) - 0.5) * 2.0 * fickle;
        if worth > best.worth {
            best = Choice { worth, act };
        }
    };
    let own = player.pos * view.side;
    let (chance, target) = shot_chance(game, view, id);
    if chance > 0.035 {
        offer(game, chance * 2.0, Act::Shoot(target));
    }
    let mates: arrayvec::ArrayVec<PlayerId, 11> =
        game.team(view.team).map(|(mate, _)| mate).filter(|mate| *mate != id).collect();
    for mate in mates {
        let (worth, kind, point) = pass_worth(game, view, id, mate);
        offer(game, worth - PASS_COST, Act::Pass(mate, kind, point));
    }
    if with_run {
        for step in 0..8u8 {
            let angle = f32::from(step) * std::f32::consts::FRAC_PI_4;
            let way = math::unit(angle);
            let (worth, speed) = run_worth(game, view, id, way);
            offer(game, worth, Act::Run(way, speed));
        }
    }
    if own.x < -30.0 && must_clear(game, view, id) {
        offer(game, value(own) + 0.012, Act::Clear);
    }
    best
}

/// Whether a defender had better kick the ball away: a rival will have it as soon, the nearer to goal the less soon
/// suffices. (GRF's.)
fn must_clear(game: &Match, view: &View, id: PlayerId) -> bool {
    let player = game.player(id);
    let rivals = game.team(view.team.other());
    let rival_s = rivals.map(|(_, rival)| rival.body.meet_s).fold(f32::MAX, f32::min);
    let close = 1.0 - ((player.pos * view.side).distance(-GOAL) - PANIC_M.start) / (PANIC_M.end - PANIC_M.start);
    (rival_s + 0.2) / (player.body.meet_s + 0.2) < 0.9 + 0.8 * close.clamp(0.0, 1.0)
}

/// Turns the choice into an intent or a kick.
fn perform(game: &mut Match, view: &View, id: PlayerId, choice: Choice) {
    let until = game.tick as i32 + MIND_TICKS;
    let plan = |kind: KickKind| KickPlan { until, ..kick::planned(kind, game.tick) };
    let (shot, clearance) = (plan(KickKind::Shot), plan(KickKind::Clear));
    let body = &mut game.players[id.index()].body;
    body.intent = Intent::Ball(SPRINT_MPS);
    match choice.act {
        Act::Shoot(point) => {
            let luck = noise::whim(game);
            let plan = KickPlan { point: Some(point * view.side), power: 0.62 + 0.38 * luck, ..shot };
            game.players[id.index()].body.kick = Some(plan);
        }
        Act::Pass(mate, kind, point) => {
            body.dribble = Vec2::ZERO;
            body.kick = Some(KickPlan { until, mate: Some(mate), point, ..kick::planned(kind, game.tick) });
        }
        Act::Clear => {
            let own = body.meet * view.side;
            let wide = if own.y < 0.0 { -0.1 } else { 0.1 };
            let dir = Vec2::new(1.0, wide).normalize_or_zero() * view.side;
            body.kick = Some(KickPlan { dir: Some(dir), ..clearance });
        }
        Act::Run(way, speed) => body.dribble = way * (speed * view.side),
    }
}

/// The keeper lets the ball go: soon if a mate is free, in any case after four seconds.
fn release(game: &mut Match, view: &View, id: PlayerId, since: u32) {
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
        let free = lane(game, view, player.pos, pass_target::lead(other, distance), 15.0);
        let room = nearest_rival(game, mate, other.pos).min(10.0) / 10.0;
        let worth = free * room - (distance - 15.0).max(0.0) * 0.012;
        if best.is_none_or(|(most, _)| worth > most) {
            best = Some((worth, mate));
        }
    }
    let tick = game.tick;
    let choice = match best {
        Some((worth, mate)) if worth > 0.45 => KickPlan { mate: Some(mate), ..kick::planned(KickKind::Short, tick) },
        _ if held_ticks > 250 => {
            let y = (noise::whim(game) * 2.0 - 1.0) * 20.0;
            let point = Vec2::new(2.0, y) * view.side;
            KickPlan { point: Some(point), ..kick::planned(KickKind::High, tick) }
        }
        _ => return,
    };
    game.players[id.index()].body.kick = Some(choice);
}

/// What getting the ball to a place by a pass is worth: the chance of a goal from there, roughly. Own frame, metres.
fn value(own: Vec2) -> f32 {
    ground(own) + 0.15 * nearness(own)
}

/// What dribbling the ball to a place is worth.
///
/// The nearer to goal, the less: GRF's dribblers are pushed back from the goal line, more than they are drawn
/// to goal from about 30 m on, so that they look for a mate or a shot there.
fn dribbled(own: Vec2) -> f32 {
    ground(own) - 0.1 * nearness(own)
}

/// What ground gained is worth, without what the goal's nearness adds.
fn ground(own: Vec2) -> f32 {
    let forward = ((own.x + GOAL.x) / (2.0 * GOAL.x)).clamp(0.0, 1.0);
    let wing = (own.y.abs() / HALF_WIDTH_M as f32).powi(2) * 0.012;
    0.008 + 0.03 * forward + 0.2 * forward * forward - wing
}

/// How near the goal is, 0 from 42 m on, 1 in it.
fn nearness(own: Vec2) -> f32 {
    let near = (1.0 - own.distance(Vec2::new(54.0, 0.0)) / 42.0).max(0.0);
    near * near
}

/// The chance that a shot from here goes in, and the point it should aim at (own frame).
fn shot_chance(game: &Match, view: &View, id: PlayerId) -> (f32, Vec2) {
    let player = game.player(id);
    let own = player.pos * view.side;
    let goal = GOAL;
    let distance = own.distance(goal);
    if distance > 30.0 || own.x > 54.0 {
        return (0.0, goal);
    }
    let keeper = game
        .team(view.team.other())
        .find(|(_, rival)| rival.role == Role::GK)
        .map(|(_, rival)| rival.pos * view.side)
        .filter(|keeper| (keeper - own).dot(goal - own) > 0.0);
    let ways = [-PLACED_M, PLACED_M].map(|y| Vec2::new(GOAL.x, y));
    let open = |post: Vec2| {
        let line = (post - own).normalize_or_zero();
        let off = keeper.map_or(4.0, |keeper| line.perp_dot(keeper - own).abs());
        (off, post)
    };
    let (first, second) = (open(ways[0]), open(ways[1]));
    let (off, target) = if first.0 >= second.0 { first } else { second };
    let target = if keeper.is_some() { target } else { goal };
    // How wide the goal looks from here, radians.
    let post = |y: f64| math::heading(Vec2::new(GOAL.x, y as f32) - own);
    let wide = math::wrap(post(GOAL_HALF_WIDTH_M) - post(-GOAL_HALF_WIDTH_M)).abs();
    let mut chance = (wide / 0.6).min(1.0) * (1.0 - distance / 34.0).max(0.0) * (0.30 + 0.16 * off.min(3.0));
    let way = (goal - own).normalize_or_zero();
    for (_, rival) in game.team(view.team.other()) {
        let to = rival.pos * view.side - own;
        let along = to.dot(way);
        let aside = way.perp_dot(to).abs();
        if rival.role != Role::GK && along > 0.3 && along < distance && aside < 0.5 + 0.06 * along {
            chance *= 0.6;
        }
    }
    (chance * (0.5 + 0.5 * player.skill(Stat::Shot)), target)
}

/// How free the lane of a pass is, 0..1: the time that rivals miss to cut it out. World points.
fn lane(game: &Match, view: &View, from: Vec2, to: Vec2, speed: f32) -> f32 {
    let way = to - from;
    let length = way.length().max(0.5);
    let along = way / length;
    let mut free = 1.0f32;
    for (_, rival) in game.team(view.team.other()) {
        let place = rival.pos + rival.vel * 0.2;
        let t = (place - from).dot(along);
        if t < -1.0 || t > length + 4.0 {
            continue;
        }
        let t = t.clamp(0.0, length);
        let off = (from + along * t).distance(place);
        let time = t / speed + 0.12;
        let reach = 0.8 + 5.0 * (time - 0.1).max(0.0);
        let spare = off / reach.max(0.6);
        free = free.min(((spare - 0.45) / 0.9).clamp(0.0, 1.0));
        if free <= 0.0 {
            return 0.0;
        }
    }
    free
}

/// What a pass to a mate is worth, and which kind is best.
fn pass_worth(game: &Match, view: &View, id: PlayerId, mate: PlayerId) -> (f32, KickKind, Option<Vec2>) {
    let (player, other) = (game.player(id), game.player(mate));
    let distance = other.pos.distance(player.pos);
    let nothing = (f32::MIN, KickKind::Short, None);
    if !(4.0..48.0).contains(&distance) {
        return nothing;
    }
    let own_mate = other.pos * view.side;
    if game.rule(Rule::Offside) && own_mate.x > view.line_x {
        return nothing;
    }
    let own = player.pos * view.side;
    let target = pass_target::lead(other, distance);
    let loss = loss(own);
    let rate = |free: f32, room: f32, at: Vec2, skill: f32, hard: f32| {
        let odds = (0.12 + 0.86 * free) * (0.55 + 0.45 * room) * (1.0 - hard * (1.1 - skill));
        odds * (value(at) + 0.012 * room) - (1.0 - odds) * loss
    };
    let rivals = nearest_rival(game, mate, target);
    let room = (rivals / 5.0).min(1.0);
    let ground_speed = (12.0 + distance * 0.4).min(20.0);
    let short = rate(
        lane(game, view, player.pos, target, ground_speed),
        room,
        target * view.side,
        player.skill(Stat::ShortPass),
        0.1 + distance * 0.006,
    ) - (distance - 28.0).max(0.0) * 0.01;
    let keeper = if other.role == Role::GK { 0.02 } else { 0.0 };
    let mut best = (short - keeper, KickKind::Short, None);
    // Into the space ahead of a forward mate.
    if mindset(other.role) >= 0.5 && own_mate.x > own.x - 6.0 && distance < 30.0 {
        for ahead_m in [8.0, 15.0] {
            let (worth, point) = through(game, view, id, mate, ahead_m);
            if worth > best.0 {
                best = (worth, KickKind::Long, Some(point));
            }
        }
    }
    if distance > 18.0 {
        let odds = 0.2 + 0.4 * (rivals / 8.0).min(1.0);
        let at = target * view.side;
        let cross = if own.y.abs() > 16.0 && own.x > 32.0 && at.x > 40.0 && at.y.abs() < 12.0 { 0.03 } else { 0.0 };
        let worth = odds * player.skill(Stat::HighPass) * (value(at) + 0.01) - (1.0 - odds) * loss + cross;
        if worth > best.0 {
            best = (worth - keeper, KickKind::High, None);
        }
    }
    best
}

/// What losing the ball at a place costs.
fn loss(own: Vec2) -> f32 {
    let back = 1.0 - ((own.x + GOAL.x) / (2.0 * GOAL.x)).clamp(0.0, 1.0);
    0.004 + 0.055 * back * back
}

/// What a ball played into space ahead of a mate is worth, and where to: a race between him and the others.
fn through(game: &Match, view: &View, id: PlayerId, mate: PlayerId, ahead_m: f32) -> (f32, Vec2) {
    let (player, other) = (game.player(id), game.player(mate));
    let goal = Vec2::new(50.0 * view.side, other.pos.y * 0.4);
    let point = other.pos + (goal - other.pos).normalize_or_zero() * ahead_m;
    let at = point * view.side;
    let pace = (other.vel.dot(goal - other.pos) / (goal - other.pos).length().max(1.0)).clamp(0.0, 7.5);
    let mate_s = ahead_m / 7.4 + 0.55 * (1.0 - pace / 7.5);
    let rival_s = game
        .team(view.team.other())
        .fold(9.0f32, |least, (_, rival)| least.min((rival.pos + rival.vel * 0.25).distance(point) / 7.6 + 0.2));
    let distance = point.distance(player.pos);
    let speed = (12.0 + distance * 0.3).min(19.0);
    let free = lane(game, view, player.pos, point, speed);
    let skill = player.skill(Stat::ShortPass);
    let race = (0.45 + 0.55 * (rival_s - mate_s)).clamp(0.0, 0.92);
    let odds = race * (0.25 + 0.75 * free) * (1.0 - (0.1 + distance * 0.006) * (1.15 - skill));
    (odds * value(at) - (1.0 - odds) * loss(own_of(player.pos, view)), point)
}

/// A world point in the own frame.
fn own_of(point: Vec2, view: &View) -> Vec2 {
    point * view.side
}

/// What running on in a direction of the own frame is worth, and how fast to run.
fn run_worth(game: &Match, view: &View, id: PlayerId, way: Vec2) -> (f32, f32) {
    let player = game.player(id);
    let own = player.pos * view.side;
    let to = own + way * 6.0;
    if to.x.abs() > 53.5 || to.y.abs() > 35.0 {
        return (f32::MIN, 0.0);
    }
    let mut free = 1.0f32;
    let mut ahead_m = 20.0f32;
    for (_, rival) in game.team(view.team.other()) {
        let place = (rival.pos + rival.vel * 0.25) * view.side;
        let to_rival = place - own;
        let distance = to_rival.length();
        if distance > 14.0 {
            continue;
        }
        let cos = if distance > 0.1 { to_rival.dot(way) / distance } else { 1.0 };
        let threat = if cos > 0.0 {
            (1.0 - distance / (2.5 + 7.0 * cos)).max(0.0)
        } else {
            (1.0 - distance / 2.5).max(0.0) * 0.5
        };
        free = free.min(1.0 - threat);
        if cos > 0.75 {
            ahead_m = ahead_m.min(distance);
        }
    }
    let dribble = player.skill(Stat::Dribble);
    let keep = (0.50 + 0.48 * free) * (0.93 + 0.05 * dribble);
    let loss = loss(own);
    // Turning back costs the time that the others use.
    let turn = if player.vel.length_squared() > 9.0 {
        (1.0 - player.vel.normalize_or_zero().dot(way * view.side)) * 0.004
    } else {
        0.0
    };
    let worth = keep * dribbled(to) - (1.0 - keep) * loss - turn;
    // In his own third with nobody near there is time to build up.
    let speed = if own.x < -16.0 && ahead_m > 12.0 {
        4.1
    } else if ahead_m > 6.0 && way.x > -0.2 {
        SPRINT_MPS
    } else if ahead_m > 2.5 {
        5.2
    } else {
        4.2
    };
    (worth, speed)
}

/// Distance of the nearest opponent of a player from a world point, metres.
pub fn nearest_rival(game: &Match, id: PlayerId, point: Vec2) -> f32 {
    let least =
        game.team(id.team().other()).fold(f32::MAX, |least, (_, rival)| least.min(rival.pos.distance_squared(point)));
    libm::sqrtf(least)
}
