//! The touches of a dribble that no motion leads to: a ball beside the player, or one that stops.
//!
//! `dribble_motion` has the others.

use crate::football::pace::SPRINTS_FROM_MPS;
use crate::football::{carry, contact};
use crate::state::event::Events;
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::PitchSize;

/// A dribbling touch needs the ball this near to the foot, metres.
const FOOT_M: f32 = 0.65;
/// The sole can stop a ball this far away, metres; chosen.
pub(super) const SOLE_M: f32 = 1.0;
/// A player who wants to be slower than this stops the ball, m/s.
pub(super) const STOPS_MPS: f32 = 0.3;
/// How far ahead of a runner the ball is at a touch (`CARRIED_M`), walking at `WALKS_MPS` and
/// sprinting at `FAST_MPS`. Measured.
const WALKS_MPS: f32 = 5.1;
const FAST_MPS: f32 = 7.5;
const CARRIED_M: [f32; 2] = [0.36, 0.7];
/// How near to a line a dribbler will push the ball, metres.
const LINE_CARE_M: f32 = 0.3;
/// Agent-driven players keep the ball on the pitch until they are this close to a line, metres;
/// chosen.
const AT_LINE_M: f32 = 0.65;
/// How much of what the ball is beside a dribbler's line stays in a touch; chosen.
const BESIDE: f32 = 0.8;
/// A slower ball counts as lying still, m/s; chosen.
pub(super) const LIES_MPS: f32 = 1.0;
/// A standing player lays the ball this far ahead, metres. Measured.
pub(super) const LAID_M: f32 = 0.4;
/// Braking of a player who turns with the ball, m/s²; chosen.
const TURN_MPS2: f32 = 14.0;
/// A change of direction with a smaller cosine is a turn; others are run through; chosen.
const SHARP: f32 = 0.6;
/// A turn with a smaller cosine is an about-turn; chosen.
const ABOUT: f32 = -0.5;
/// Ticks after a turning touch before anything else. Fitted to how soon kicks leave after such a
/// touch.
const TURNING_TICKS: i32 = 40;
/// From this cosine on, the ball already rolls the way the player runs.
const ALONG: f32 = 0.94;
/// Deceleration of a stopping player (`STOP_MPS2`) and of a slow ball (`ROLL_MPS2`), m/s².
const STOP_MPS2: f32 = 12.0;
const ROLL_MPS2: f32 = 1.75;

/// How near the ball must be for a touch without a motion, metres. A player who stops reaches far
/// with the sole.
pub(super) fn foot_m(player: &Player) -> f32 {
    let (own, wish) = (player.vel, player.body.dribble);
    let stops = wish.length_squared() < STOPS_MPS * STOPS_MPS
        && own.length_squared() < SPRINTS_FROM_MPS * SPRINTS_FROM_MPS;
    if stops { SOLE_M } else { FOOT_M }
}

/// How far ahead of a runner at this speed the ball is at a touch, metres. Measured.
fn carried_m(speed: f32) -> f32 {
    let sprints = ((speed - WALKS_MPS) / (FAST_MPS - WALKS_MPS)).clamp(0.0, 1.0);
    CARRIED_M[0] + (CARRIED_M[1] - CARRIED_M[0]) * sprints
}

/// The pitch that a player keeps the ball on. Agent-driven players do so until they are at the line
/// themselves.
pub(super) fn minds_lines(game: &Match, id: PlayerId) -> Option<&PitchSize> {
    let pos = game.player(id).pos.abs();
    let minds = !game.is_driven(id) || pos.cmplt(game.half() - AT_LINE_M).all();
    minds.then_some(&game.pitch)
}

/// Pushes the ball the way its player wants to run. False if it already rolls that way.
pub(super) fn touch(game: &mut Match, events: &mut Events, id: PlayerId) -> bool {
    let player = *game.player(id);
    let ball_vel = game.ball.vel.truncate();
    let wish = player.body.dribble;
    let speed = wish.length();
    let to_ball = game.ball.pos.truncate() - player.pos;
    if speed < STOPS_MPS {
        return rest(game, events, id);
    }
    let ahead = wish / speed;
    let rolling = ball_vel.length();
    let rolls_on = ball_vel.dot(ahead) > ALONG * rolling
        && to_ball.dot(ahead) > 0.15
        && ball_vel.dot(ahead) > player.vel.dot(ahead) + 0.2;
    if rolling > 1.0 && rolls_on {
        return false;
    }
    let care = Care { lines: minds_lines(game, id), lies: rolling < LIES_MPS };
    let velocity = self::ahead(&player, to_ball, ahead, speed, &care);
    push_on(game, events, id, velocity, speed);
    if player.body.kick.is_none() {
        note_turn(game, id, ahead);
    }
    true
}

/// Pushes the ball on as the player's skill allows. A fast one hops.
fn push_on(game: &mut Match, events: &mut Events, id: PlayerId, velocity: Vec2, speed: f32) {
    let velocity = carry::as_skilled(game, id, velocity, speed);
    contact::push(game, events, id, velocity, carry::hop_mps(velocity));
}

/// Lays the ball where the player will come to a stand, a little ahead; false where it comes to
/// rest there anyway.
fn rest(game: &mut Match, events: &mut Events, id: PlayerId) -> bool {
    let player = *game.player(id);
    let speed = player.vel.length();
    let stop = player.vel * (0.5 * speed / STOP_MPS2) + player.body.facing * LAID_M;
    let way = stop - (game.ball.pos.truncate() - player.pos);
    let wanted = way.normalize_or_zero() * libm::sqrtf(2.0 * ROLL_MPS2 * way.length());
    if (game.ball.vel.truncate() - wanted).length_squared() < 0.8 * 0.8 {
        return false;
    }
    contact::push(game, events, id, wanted, 0.0);
    true
}

/// What a dribbler takes care of.
pub(super) struct Care<'a> {
    /// The pitch to keep the ball on, if they do.
    pub(super) lines: Option<&'a PitchSize>,
    /// Whether the ball lies still.
    pub(super) lies: bool,
}

/// Whether a touch along `ahead` turns a player's run.
fn turns(player: &Player, ahead: Vec2) -> bool {
    player.vel.dot(ahead) < SHARP * player.vel.length()
}

/// Records that a player has touched the ball along `ahead`.
///
/// A player who turns with the ball finishes the turn before anything else. An about-turn is the
/// exception: it can be cut short.
pub(super) fn note_turn(game: &mut Match, id: PlayerId, ahead: Vec2) {
    let player = &mut game.players[id.index()];
    if turns(player, ahead) && player.vel.dot(ahead) > ABOUT * player.vel.length() {
        player.body.ready_at = player.body.ready_at.max(game.tick as i32 + TURNING_TICKS);
    }
}

/// The velocity of a touch after which the player, running at `speed` along `ahead`, meets the ball
/// again.
pub(super) fn ahead(
    player: &Player,
    to_ball: Vec2,
    ahead: Vec2,
    speed: f32,
    care: &Care<'_>,
) -> Vec2 {
    let own = player.vel.dot(ahead).max(0.0);
    // Uses the stride at the next touch, not the wanted one.
    let pace = player.vel.length();
    let under_way = (pace / WALKS_MPS).min(1.0);
    let gait = (speed + 0.3 * (pace - speed) * under_way) / 8.0;
    // A turning player keeps their old run until they have braked it.
    let turns = turns(player, ahead);
    let rest = if turns { player.vel - ahead * own } else { Vec2::ZERO };
    let brakes = rest.length() / TURN_MPS2;
    let time = (0.12 + 0.6 * gait * gait * gait * gait).max(brakes);
    let mean = own + ((speed.min(player.body.speed_top_mps) - own) * 0.5).clamp(-1.5, 2.0 * time);
    let free = ahead * (mean * (time - brakes) + carried_m(own)) + rest * (0.5 * brakes);
    let cut = care.lines.and_then(|pitch| within_lines(pitch, player.pos, free));
    if (care.lies || !turns) && cut.is_none() {
        // Whoever does not turn comes to the ball's line rather than the ball to theirs.
        let beside = (to_ball - ahead * to_ball.dot(ahead)) * BESIDE;
        return carry::straight_on(player, to_ball - beside, ahead, speed);
    }
    if let Some(cut) = cut {
        return stops_at(cut - to_ball);
    }
    let way = free - to_ball;
    let distance = way.length();
    let average = distance / time;
    let start = average + 0.5 * (1.7 + 0.06 * average * average) * time;
    if distance > 0.01 { way * (start / distance) } else { Vec2::ZERO }
}

/// The velocity of a ball that rolls this way and stops at its end.
pub(super) fn stops_at(way: Vec2) -> Vec2 {
    way.normalize_or_zero() * libm::sqrtf(2.0 * ROLL_MPS2 * way.length())
}

/// Shortens the way of a touch to stay on the pitch. None if it stays on the pitch, or leaves it
/// only into a goal.
pub(super) fn within_lines(pitch: &PitchSize, pos: Vec2, way: Vec2) -> Option<Vec2> {
    let [x, y] = [pitch.half_length(), pitch.half_width()].map(|half| half as f32 - LINE_CARE_M);
    let to = pos + way;
    let x = if to.y.abs() < pitch.goal_half_width() as f32 { x + 3.0 } else { x };
    let cut = to.clamp(Vec2::new(-x, -y), Vec2::new(x, y));
    (cut != to).then(|| cut - pos)
}
