//! The keeper's hands: saves, catches, holding the ball and letting it go.
//!
//! Decides whether the keeper reaches a ball and holds it. `control::bot::keeper` decides where the
//! keeper stands.

use crate::football::{contact, forecast, foul, noise, report, touch};
use crate::state::event::Events;
use crate::state::play::{Save, ticks_since};
use crate::state::player::Pose;
use crate::state::{Match, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::{
    EventKind, GameMode, PitchMeasure, Qualifier, Role, Rule, Stat,
};

/// How high the keeper's hands reach, metres.
const HANDS_M: f32 = 2.55;
/// A slow ball this near is picked up, metres.
const PICK_M: f32 = 1.0;
/// How often a keeper takes the ball off a dribbler's feet. Fitted to how many dribblers run past
/// keepers.
const BRAVE: f32 = 0.14;
/// How long a keeper may hold the ball, ticks. Laws.
const HOLD_TICKS: u32 = 600;
/// A ball that comes nearer to the keeper's middle than this hits the keeper, metres.
const BODY_M: f32 = 0.4;
/// Shares of the balls in reach that a keeper without skill saves: any, at once, and more per
/// second left. Fitted to how many goals agents' and bots' shots score.
const SAVES: [f32; 3] = [0.5, 0.45, 0.7];
/// A ball at least this easy can be held (`HOLDS_FROM`, GRF's); `HOLDS` is how often it then is.
/// `SLOWS_MPS2`: how a flying ball slows, m/s²; chosen.
const HOLDS_FROM: f32 = 0.3;
const HOLDS: f32 = 0.85;
const SLOWS_MPS2: f32 = 8.0;
/// Shortest time of a dive, seconds; chosen.
const DIVE_S: f32 = 0.1;
/// Slower balls are picked up, not saved, m/s.
const SHOT_MPS: f32 = 7.0;

/// Lets both keepers use their hands.
pub fn use_hands(game: &mut Match, events: &mut Events) {
    if game.dead || game.play.set_piece.is_some() {
        return;
    }
    if let Some((id, since)) = game.play.hands {
        hold(game, id);
        if game.tick.saturating_sub(since) >= HOLD_TICKS && game.rule(Rule::SixSeconds) {
            foul::held_too_long(game, events, id);
        }
        return;
    }
    for team in game.teams() {
        let side = team.side() as f32;
        // Only a ball in the keeper's own end matters.
        if game.ball.pos.x * side > -20.0 {
            continue;
        }
        let keeper = game.team(team).find(|(_, player)| player.role == Role::GK).map(|(id, _)| id);
        let Some(id) = keeper.filter(|&id| touch::may_handle(game, id)) else { continue };
        save(game, events, id);
        if game.play.hands.is_none() {
            pick_up(game, events, id);
        }
    }
}

/// Plans and makes a save.
fn save(game: &mut Match, events: &mut Events, id: PlayerId) {
    let team = id.team();
    let index = team.index();
    if game.play.save[index].is_none() {
        game.play.save[index] = plan(game, id);
    }
    let Some(save) = game.play.save[index] else { return };
    if save.at_tick == u32::MAX || game.tick < save.from_tick {
        return;
    }
    let player = game.player(id);
    if game.tick < save.at_tick {
        let left = (save.at_tick - game.tick) as f32 * 0.01;
        let way = save.point - player.pos;
        let most = if save.reaches { 8.0 } else { 5.0 };
        if player.body.pose == Pose::Up && way.length() > 0.5 {
            let ticks = ((save.at_tick - game.tick) + 35).min(120) as u8;
            game.players[id.index()].body.strike_pose(Pose::Diving, ticks);
        }
        game.players[id.index()].vel = (way / left.max(0.05)).clamp_length_max(most);
        return;
    }
    let near = player.pos.distance_squared(game.ball.pos.truncate()) < 2.9 * 2.9;
    game.play.save[index] = Some(Save { at_tick: u32::MAX, ..save });
    if save.reaches && near && game.ball.pos.z < HANDS_M + 0.3 {
        meet_shot(game, events, id, save.holds);
    }
}

/// Balls this far above the crossbar still count as dangerous, metres; chosen.
const OVER_BAR_M: f64 = 0.4;
/// The share of the keeper's own speed that a parried ball takes along, besides three tenths of its
/// own. (GRF's.)
const PARRIED: f32 = 2.5;

/// The plan of a keeper who has nothing to save.
const IDLE: Save = Save {
    at_tick: u32::MAX,
    from_tick: u32::MAX,
    point: Vec2::ZERO,
    reaches: false,
    holds: false,
};

/// Judges whether the ball goes into the goal and whether the keeper reaches it. None while it is
/// too far away to tell.
fn plan(game: &mut Match, id: PlayerId) -> Option<Save> {
    let team = id.team();
    let side = team.side() as f32;
    let speed = game.ball.vel.length();
    let ours = game.last_touch.is_some_and(|last| last == id)
        || game.play.kicked_by.is_some_and(|last| last.team() == team && game.rule(Rule::BackPass));
    if speed < SHOT_MPS || game.ball.vel.x * side > -3.0 || ours {
        return Some(IDLE);
    }
    let goal_x = -game.goal().x * side;
    let player = *game.player(id);
    // Balls this far beside the goal still count as dangerous; a keeper who reads them better
    // ignores more (GRF's).
    let reading = 0.6 * player.skill(Stat::DefensivePositioning) + 0.4 * player.skill(Stat::Vision);
    let panic = game.measure(PitchMeasure::GoalHalfWidth) * (1.02 + 0.5 * (1.0 - reading));
    let reaction = 0.15 + 0.12 * (1.0 - player.skill(Stat::Reaction));
    let since =
        game.last_touch.map_or(0, |last| ticks_since(game.tick, game.player(last).body.touched_at));
    let react_s = (reaction - since as f32 * 0.01).max(0.02);
    let path = || game.play.forecast.from(game.tick);
    let past = |point: Vec3| (point.x - goal_x) * side < 0.0;
    let above = (game.pitch.goal_height() + OVER_BAR_M) as f32;
    // A forecast that ends before the goal line can't tell yet.
    let goal = path().position(|(_, point)| past(point))?;
    let enters =
        path().nth(goal).is_some_and(|(_, point)| point.y.abs() < panic && point.z < above);
    if !enters {
        return Some(IDLE);
    }
    let mut best: Option<(f32, f32, Vec3)> = None;
    let mut weigh = |time_s: f32, point: Vec3| {
        if foul::in_box(&game.pitch, point.truncate(), team) {
            consider(&player, react_s, time_s, point, &mut best);
        }
    };
    let mut before: Option<Vec3> = None;
    for (time_s, point) in path().take(goal + 1) {
        if let Some(last) = before {
            weigh(time_s - 0.025, (last + point) * 0.5);
        }
        weigh(time_s, point);
        before = Some(point);
    }
    let Some((ratio, time_s, point)) = best else { return Some(IDLE) };
    let able = 0.5 * player.skill(Stat::Reaction) + 0.5 * player.skill(Stat::DefensivePositioning);
    let skill = SAVES[0] + (1.0 - SAVES[0]) * able;
    let spare = (time_s - react_s - DIVE_S).max(0.0);
    let timely = (SAVES[1] + SAVES[2] * spare).min(0.96);
    let chance = if point.truncate().distance(player.pos) < BODY_M {
        0.95
    } else if ratio < 1.0 {
        (1.0 - 0.15 * ratio * ratio) * timely * skill
    } else {
        0.0
    };
    let reaches = noise::happens(game, chance);
    // A ball that is fast at the hand, or was just struck, can't be held. (GRF's.)
    let at_hand = (game.ball.vel.length() - SLOWS_MPS2 * time_s).max(0.0);
    let window_s = 1.2 - 0.4 * player.skill(Stat::Reaction);
    let lately = (1.0 - (since as f32 * 0.01 + time_s) / window_s).clamp(0.0, 1.0);
    let easy = (1.0 - at_hand / 40.0).max(0.0) * (1.0 - libm::powf(lately, 0.6));
    let holds = noise::happens(game, if easy < HOLDS_FROM { 0.0 } else { HOLDS });
    Some(Save {
        at_tick: game.tick + ((time_s * 100.0) as u32).max(1),
        from_tick: game.tick + (react_s * 100.0) as u32,
        point: point.truncate(),
        reaches,
        holds,
    })
}

/// Weighs a point of the ball's path in the box: which share of the keeper's reach it takes.
fn consider(
    player: &crate::state::Player,
    react_s: f32,
    time_s: f32,
    point: Vec3,
    best: &mut Option<(f32, f32, Vec3)>,
) {
    if point.z > HANDS_M {
        return;
    }
    let spare = (time_s - react_s).max(0.0);
    let high = (point.z - 1.6).max(0.0) * 0.7;
    let reach = (0.9 + spare.min(0.5) * 4.5 + (spare - 0.5).max(0.0) * 4.0 - high).max(0.2);
    let ratio = point.truncate().distance(player.pos) / reach;
    if best.is_none_or(|(least, _, _)| ratio < least) {
        *best = Some((ratio, time_s, point));
    }
}

/// Meets the ball with the hands: holds it or pushes it away.
fn meet_shot(game: &mut Match, events: &mut Events, id: PlayerId, holds: bool) {
    let shot = game.play.shot.take();
    if let Some(shot) = shot.filter(|shot| shot.by.team() != id.team()) {
        events.push(contact::of_shot(game, EventKind::Shot, shot).qualified(Qualifier::OnTarget));
        report::did(game, events, EventKind::Save, id, Some(shot.by));
    }
    if holds && foul::in_box(&game.pitch, game.ball.pos.truncate(), id.team()) {
        take(game, events, id);
        return;
    }
    report::did(game, events, EventKind::Parry, id, shot.map(|shot| shot.by));
    contact::sprang(game, events, id);
    let side = id.team().side() as f32;
    let (speed, own) = (game.ball.vel.length(), game.player(id).vel);
    let aside = Vec2::new(0.0, (2.0 * noise::roll(game) - 1.0) * side);
    let way = game.ball.vel.truncate() * -0.1 + own * 2.0 + Vec2::new(4.0 * side, 0.0) + aside;
    let away = way.normalize_or_zero() * (0.3 * speed + PARRIED * own.length());
    game.ball.vel = away.extend(1.2);
    game.ball.spin = Vec3::ZERO;
    game.players[id.index()].body.ready_at = game.tick as i32 + 45;
    forecast::renew(game);
}

/// Picks up a near and slow ball.
fn pick_up(game: &mut Match, events: &mut Events, id: PlayerId) {
    let player = game.player(id);
    let ball = game.ball.pos;
    let flat = ball.truncate();
    let near = player.pos.distance_squared(flat);
    let team = id.team();
    if near > PICK_M * PICK_M
        || ball.z > HANDS_M - 0.2
        || player.body.pose == Pose::Down
        || !foul::in_box(&game.pitch, flat, team)
    {
        return;
    }
    if (game.tick as i32) < player.body.ready_at || game.last_touch == Some(id) {
        return;
    }
    let back_pass =
        game.rule(Rule::BackPass) && game.play.kicked_by.is_some_and(|last| last.team() == team);
    let mate = game.controller().is_some_and(|owner| owner.team() == team);
    if back_pass || mate {
        return;
    }
    let speed = (game.ball.vel - player.vel.extend(0.0)).length();
    let rival = game.controller().filter(|owner| owner.team() != team);
    let brave = if rival.is_some() { BRAVE } else { 1.0 };
    let chance = (1.25 - speed / 22.0).clamp(0.1, 1.0) * brave * (0.6 + 0.4 * player.body.level);
    if noise::happens(game, chance) {
        if let Some(shot) = game.play.shot.take().filter(|shot| shot.by.team() != team) {
            events
                .push(contact::of_shot(game, EventKind::Shot, shot).qualified(Qualifier::OnTarget));
            report::did(game, events, EventKind::Save, id, Some(shot.by));
        }
        take(game, events, id);
    } else {
        game.players[id.index()].body.ready_at = game.tick as i32 + 30;
    }
}

/// Takes the ball into the hands.
pub fn take(game: &mut Match, events: &mut Events, id: PlayerId) {
    if !contact::touched(game, events, id, false) {
        return;
    }
    report::did(game, events, EventKind::Catch, id, None);
    game.play.hands = Some((id, game.tick));
    game.play.offside = 0;
    let player = &mut game.players[id.index()];
    player.vel *= 0.2;
    player.body.kick = None;
    player.body.dribble = Vec2::ZERO;
    player.body.mind.decide_at_step = game.step + 8;
    game.mode = GameMode::Normal;
    hold(game, id);
}

/// Carries the ball in the hands.
fn hold(game: &mut Match, id: PlayerId) {
    let side = id.team().side() as f32;
    // The keeper stays in the box and looks up the pitch.
    let line = game.goal().x;
    let edge = game.measure(PitchMeasure::BoxDepth) - 1.0;
    let aside = (game.pitch.measure(PitchMeasure::BoxHalfWidth) - 1.15) as f32;
    let player = &mut game.players[id.index()];
    let x = (player.pos.x * side).clamp(-line + 0.6, -line + edge) * side;
    let inside = Vec2::new(x, player.pos.y.clamp(-aside, aside));
    player.pos += (inside - player.pos).clamp_length_max(0.08);
    player.body.facing = Vec2::new(side, 0.0);
    if player.body.pose == Pose::Diving {
        player.body.strike_pose(Pose::Down, 30);
    }
    let vel = player.vel;
    let mut at = player.pos + player.body.facing * 0.35;
    // The keeper doesn't carry a ball over the line that was caught in front of it.
    at.x = (at.x * side).max(-line) * side;
    game.ball.pos = at.extend(1.0);
    game.ball.vel = vel.extend(0.0);
    game.ball.spin = Vec3::ZERO;
}
