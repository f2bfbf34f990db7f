//! The keeper's hands: reaching for the ball, catches, holding it and letting it go.
//!
//! A keeper tries every few ticks whether some motion of the hands meets the ball where it will be
//! (`save_motion`), and then commits to it. `control::bot::keeper` decides where they stand.

use crate::football::pace::DT;
use crate::football::{
    contact, forecast, foul, leg, noise, possession, reach, report, save_motion, touch,
};
use crate::math;
use crate::state::event::Events;
use crate::state::play::{Save, ticks_since};
use crate::state::player::Pose;
use crate::state::{Match, Player, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::{
    EventKind, GameMode, PitchMeasure, Qualifier, Role, Rule, Stat,
};

/// How long a keeper may hold the ball, ticks. Laws.
const HOLD_TICKS: u32 = 600;
/// The keeper reaches for a ball that will be in the box `BOX_TICKS` ahead, and within `FAR_M` and
/// `NEAR_M` of them `FAR_TICKS` and `NEAR_TICKS` ahead, metres. (GRF's.)
const BOX_TICKS: u32 = 16;
const FAR_TICKS: u32 = 40;
const FAR_M: f32 = 20.0;
const NEAR_TICKS: u32 = 20;
const NEAR_M: f32 = 10.0;
/// They don't reach for one that gets away from them within `AWAY_TICKS` and is further than
/// `AWAY_M`. (GRF's.)
const AWAY_TICKS: u32 = 8;
const AWAY_M: f32 = 2.0;
/// Up to how many times the keeper's own time to the ball a rival's time lets them push it away
/// that doesn't go for goal, and lets them use their hands at all once they have it. A time counts
/// as `LATE_S` longer. (GRF's.)
const PUSHES_TO: f32 = 1.3;
const HANDLES_TO: f32 = 3.4;
const LATE_S: f32 = 0.2;
/// Within these distances of the ball a keeper who isn't first at it tries again after so many
/// ticks, metres. (GRF's.)
const TRIES: [(f32, u32); 2] = [(5.0, 5), (10.0, 8)];
/// The same for one who is first at a ball this near, at one further off, and for the first of
/// their team. (GRF's.)
const FIRST_M: f32 = 3.0;
const FIRST_TICKS: [u32; 3] = [2, 3, 4];
/// The ticks of a stride, after which everybody may try. (GRF's.)
const STRIDE_TICKS: u32 = 25;
/// A ball can be held that is at least this easy, 0..1. One as fast as `HARD_MPS` relative to the
/// keeper is as hard as can be; so is one just touched by a rival, for so many seconds without and
/// with full reaction, by this power. (GRF's.)
const HOLDS_FROM: f32 = 0.3;
const HARD_MPS: f32 = 40.0;
const SUDDEN_S: [f32; 2] = [1.2, 0.8];
const SUDDEN: f32 = 0.6;
/// How far above or below the hands a ball may be that they touch, metres. (GRF's.)
const HIGH_OFF_M: f32 = 1.0;
/// The way of a ball that is pushed away: against its own, along the keeper's, out of the goal, and
/// at random to a side. (GRF's.)
const AGAINST: f32 = 0.1;
const ALONG: f32 = 2.0;
const OUT_MPS: f32 = 4.0;
/// Its speed: shares of its own and of the keeper's; and up, m/s. How much of its spin it loses.
/// (GRF's.)
const KEPT: f32 = 0.3;
const TAKEN: f32 = 2.5;
const UP_MPS: f32 = 1.2;
const SPIN_LOST: f32 = 0.2;
/// How long a keeper takes to get up from the ground, ticks. Measured of GRF's motions.
const RISE_TICKS: i32 = 76;
/// Balls bound for goal: the ticks within which the ball must cross the line, the ticks over which
/// its course is read, and the distance from which it worries a keeper, metres. (GRF's.)
const BOUND_TICKS: u32 = 400;
const COURSE_TICKS: u32 = 80;
const SEEN_TICKS: u32 = 25;
const BOUND_M: f32 = 32.0;

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
        let keeper = game.team(team).find(|(_, player)| player.role == Role::GK).map(|(id, _)| id);
        let Some(id) = keeper.filter(|&id| touch::may_handle(game, id)) else {
            game.play.save[team.index()] = None;
            continue;
        };
        match game.play.save[team.index()] {
            Some(save) => go_on(game, events, id, save),
            None if tries(game, id) => begin(game, id),
            None => {}
        }
    }
}

/// Whether a keeper reaches for the ball now if their hands meet it.
fn tries(game: &Match, id: PlayerId) -> bool {
    let (player, team) = (game.player(id), id.team());
    let free = player.is_up()
        && player.body.lunge.is_none()
        && !player.body.swings()
        && game.tick as i32 >= player.body.ready_at;
    let at = |ticks: u32| game.play.forecast.at(game.tick + ticks).truncate();
    if !free
        || !foul::in_box(&game.pitch, at(BOX_TICKS), team)
        || at(FAR_TICKS).distance(player.pos) > FAR_M
        || !game.tick.is_multiple_of(every(game, id))
        || comes_from_mate(game, id)
    {
        return false;
    }
    let expected = |ticks: u32| reach::expected(game, id, ticks).truncate();
    let soon = player.pos + player.vel * (AWAY_TICKS as f32 * 0.01);
    let away = expected(AWAY_TICKS).distance(player.pos) > AWAY_M
        && expected(AWAY_TICKS).distance(soon) > expected(0).distance(player.pos);
    expected(NEAR_TICKS).distance(player.pos) <= NEAR_M && !away
}

/// Whether a teammate has the ball, or played it to the keeper on purpose.
fn comes_from_mate(game: &Match, id: PlayerId) -> bool {
    let mate = |other: Option<PlayerId>| {
        other.is_some_and(|other| other != id && other.team() == id.team())
    };
    mate(game.controller())
        || game.rule(Rule::BackPass) && mate(game.last_touch) && mate(game.play.kicked_by)
}

/// Ticks between two attempts of a keeper. They try their hands before they kick.
fn every(game: &Match, id: PlayerId) -> u32 {
    let player = game.player(id);
    if player.body.kick.is_some() {
        return 1;
    }
    let ball = game.play.forecast.at(game.tick + 10).truncate();
    let away_m = (player.pos + player.vel * 0.1).distance(ball);
    let [near, far, of_team] = FIRST_TICKS;
    if game.owner.or_else(|| reach::first(game)) == Some(id) {
        return if away_m < FIRST_M { near } else { far };
    }
    if game.play.chaser[id.team().index()] == Some(id) {
        return of_team;
    }
    TRIES.iter().find(|(metres, _)| away_m < *metres).map_or(STRIDE_TICKS, |(_, ticks)| *ticks)
}

/// Commits a keeper to the motion whose hands meet the ball, if there is one.
fn begin(game: &mut Match, id: PlayerId) {
    let rival = game.play.chaser[id.team().other().index()];
    let rival_s = rival.map_or(f32::MAX, |rival| game.player(rival).body.meet_s);
    let calm = (rival_s + LATE_S) / (game.player(id).body.meet_s + LATE_S);
    if calm >= HANDLES_TO && possession::has_ball(game, id) {
        return;
    }
    let only_holds = calm > PUSHES_TO && bound_for_goal(game, id).is_none();
    let Some(chosen) = save_motion::find(game, id, only_holds) else { return };
    let motion = chosen.motion;
    let lies = if motion.falls { motion.lasts - motion.ticks + RISE_TICKS } else { 0 };
    let save = Save {
        from: game.tick,
        saw: reach::seen_until(game, id),
        at: game.tick + motion.ticks as u32,
        place: chosen.place,
        hands: chosen.hands,
        high_m: chosen.high_m,
        spot: chosen.spot,
        vel: chosen.vel,
        holds: motion.holds,
        lies: lies as u8,
    };
    game.play.save[id.team().index()] = Some(save);
    let now = game.tick as i32;
    let player = &mut game.players[id.index()];
    player.body.strike_pose(Pose::Diving, motion.lasts as u8);
    player.body.kick = None;
    player.body.ready_at = now + motion.lasts;
    go_to(player, &save, motion.ticks as u32);
}

/// Moves a keeper's body so that it is at its place when the hands meet the ball.
fn go_to(player: &mut Player, save: &Save, ticks: u32) {
    player.vel = (save.spot - player.pos) / (ticks as f32 * DT);
}

/// Goes on with a motion, until the hands meet the ball.
fn go_on(game: &mut Match, events: &mut Events, id: PlayerId, save: Save) {
    let left = save.at.saturating_sub(game.tick);
    let player = &mut game.players[id.index()];
    if left > 0 && player.body.pose == Pose::Diving {
        go_to(player, &save, left);
        return;
    }
    game.play.save[id.team().index()] = None;
    if player.body.pose != Pose::Diving {
        return;
    }
    player.vel = save.vel;
    if save.lies > 0 {
        player.body.strike_pose(Pose::Down, save.lies);
    }
    let ball = game.ball.pos;
    let level = (ball.z - save.high_m).abs() < HIGH_OFF_M;
    let missed = leg::missed_by(ball.distance(save.place));
    if let Some(missed) =
        missed.filter(|_| level && foul::in_box(&game.pitch, ball.truncate(), id.team()))
    {
        meet(game, events, id, save.holds, missed);
    }
}

/// Meets the ball with the hands: holds it or pushes it away. `missed`: how much of its own way the
/// ball keeps.
fn meet(game: &mut Match, events: &mut Events, id: PlayerId, holds: bool, missed: f32) {
    let shot = game.play.shot.take_if(|shot| shot.by.team() != id.team());
    if let Some(shot) = shot {
        events.push(contact::of_shot(game, EventKind::Shot, shot).qualified(Qualifier::OnTarget));
        report::did(game, events, EventKind::Save, id, Some(shot.by));
    }
    if holds && can_hold(game, id) {
        take(game, events, id);
        return;
    }
    report::did(game, events, EventKind::Parry, id, shot.map(|shot| shot.by));
    contact::sprang(game, events, id);
    let side = id.team().side() as f32;
    let own = game.player(id).vel;
    let (before, flat) = (game.ball.vel, game.ball.vel.truncate());
    let aside = Vec2::new(0.0, (2.0 * noise::roll(game) - 1.0) * side);
    let way = flat * -AGAINST + own * ALONG + Vec2::new(OUT_MPS * side, 0.0) + aside;
    let away = way.normalize_or_zero() * (KEPT * flat.length() + TAKEN * own.length());
    game.ball.vel = away.extend(UP_MPS).lerp(before, missed);
    game.ball.spin *= 1.0 - SPIN_LOST * (1.0 - missed);
    forecast::renew(game);
}

/// Whether a keeper can hold the ball that their hands meet: it isn't too fast, and a rival hasn't
/// just touched it. (GRF's.)
fn can_hold(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    let mps = (game.ball.vel - player.vel.extend(0.0)).length();
    let slow = 1.0 - (mps / HARD_MPS).min(1.0);
    let rivals = game.team(id.team().other());
    let since = rivals.map(|(_, rival)| ticks_since(game.tick, rival.body.touched_at)).min();
    let window_s = math::mix(SUDDEN_S[0], SUDDEN_S[1], player.skill(Stat::Reaction));
    let sudden = 1.0 - since.map_or(1.0, |ticks| (ticks as f32 * DT / window_s).min(1.0));
    slow * (1.0 - math::pow(sudden, SUDDEN)) >= HOLDS_FROM
}

/// Where a ball that is bound for the keeper's goal crosses the line, own frame y, metres. A ball
/// dribbled towards the goal counts too. A keeper who reads the game better minds fewer balls that
/// go beside it. (GRF's.)
pub fn bound_for_goal(game: &Match, id: PlayerId) -> Option<f32> {
    let (player, line) = (game.player(id), game.goal().x);
    let side = id.team().side() as f32;
    let at = |ticks: u32| game.play.forecast.at(game.tick + ticks).truncate() * side;
    let (ball, soon) = (at(0), at(COURSE_TICKS));
    let way = soon - ball;
    let rolls_in = at(BOUND_TICKS).x < -line && way.x < 0.0;
    if !rolls_in || (player.pos * side).distance(at(SEEN_TICKS)) > BOUND_M {
        return None;
    }
    let y = ball.y + way.y * (-line - ball.x) / way.x;
    let reads = 0.6 * player.skill(Stat::DefensivePositioning) + 0.4 * player.skill(Stat::Vision);
    let minds_m = game.measure(PitchMeasure::GoalHalfWidth) * (1.02 + 0.5 * (1.0 - reads));
    (y.abs() <= minds_m).then_some(y)
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
    let vel = player.vel;
    let mut at = player.pos + player.body.facing * 0.35;
    // The keeper doesn't carry a ball over the line that was caught in front of it.
    at.x = (at.x * side).max(-line) * side;
    game.ball.pos = at.extend(1.0);
    game.ball.vel = vel.extend(0.0);
    game.ball.spin = Vec3::ZERO;
}
