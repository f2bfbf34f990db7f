//! How hard a dribbler pushes the ball on: it depends on pace and skill, and is harder with
//! opponents close by.

use crate::football::dribble;
use crate::football::pace::{RUN_MPS, SPRINT_MPS, SPRINTS_FROM_MPS, WALKS_FROM_MPS};
use crate::math;
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::PitchSize;
use setpiece_scenario::vocabulary::Stat;

/// The power that turns the way to the next touch into the speed of this one. (GRF's.)
const WAY_TO_PACE: f32 = 0.7;
/// How close a dribbler keeps the ball. `CLOSEST`: the divisor of a touch's way without any skill,
/// and what full skill adds (GRF's). `CLOSE`: the divisor for which the speeds here hold.
const CLOSEST: [f32; 2] = [0.38, 0.02];
const CLOSE: f32 = 0.394;
/// What that divisor is multiplied by: a touch is a little softer than the way asks for. (GRF's.)
const SOFTER: f32 = 1.1;
/// Opponents within these distances annoy a dribbler; the most annoyed sends the ball `ANNOYED_M`
/// further, metres. (GRF's.)
const ANNOYS_M: std::ops::Range<f32> = 0.5..1.5;
const ANNOYED_M: f32 = 3.0;
/// Where and when a runner meets the ball again. `FRONT_M`, `FRONT_S`: how far ahead, in metres and
/// in seconds of the runner's speed. `AGAIN_S`: after how many seconds at rest, and how many more
/// at a sprint. (GRF's.) `STEP_S`: how long the step of a touch lasts. `NEXT_S`: the time from its
/// end to the next touch.
const FRONT_M: f32 = 0.34;
const FRONT_S: f32 = 0.08;
const AGAIN_S: [f32; 2] = [0.25, 0.6];
const STEP_S: f32 = 0.12;
const NEXT_S: f32 = 0.08;
/// How fast whoever stands comes out of the step of a touch, and how long it then lasts; by how
/// much a runner speeds up in it, m/s. (GRF's motions.)
const OFF_MPS: f32 = 3.2;
const OFF_S: f32 = 0.2;
const SPEEDS_UP_MPS: f32 = 0.6;
/// How fast a ball that is pushed on rises: at least, and by a power of its speed in `HOPS_MPS`, at
/// most `HOP_MOST_MPS`, m/s. (GRF's.)
const HOP_LEAST_MPS: f32 = 0.1;
const HOP_MOST_MPS: f32 = 1.5;
const HOPS_MPS: f32 = 10.0;
const HOPS: f32 = 1.6;
/// A player slower than this has come to a stand, m/s. The share of their body's way, beside the
/// wanted one, in where the ball goes: of their own ball, and of another. (GRF's.)
const STANDS_MPS: f32 = 1.8;
const BY_BODY: [f32; 2] = [0.7, 0.9];
/// Who sets off is slower than this at the touch, m/s; chosen.
const SETS_OFF_MPS: f32 = 2.2;
/// How much faster than at the end of that step a walker and a sprinter want to be, m/s. (GRF's.)
const HASTE_MPS: [f32; 2] = [0.6, 1.2];
/// A sprinter pushes the ball harder by this share, in full from `FASTEST_MPS` on. (GRF's.)
const HARDER: f32 = 0.18;
const FASTEST_MPS: f32 = 7.2;

/// Adjusts the velocity of a touch to this dribbler's skill and to annoying opponents, at the run
/// `speed`.
pub(super) fn as_skilled(game: &Match, id: PlayerId, velocity: Vec2, speed: f32) -> Vec2 {
    let skill = game.player(id).skill(Stat::Dribble);
    let closer = libm::powf(CLOSE / (CLOSEST[0] + CLOSEST[1] * skill), WAY_TO_PACE);
    longer(velocity, annoyance_m(game, id, speed)) * closer
}

/// The velocity of a push straight on, after which the run meets the ball again a while later.
/// (GRF's.)
pub(super) fn straight_on(player: &Player, to_ball: Vec2, ahead: Vec2, speed: f32) -> Vec2 {
    let own = player.vel.dot(ahead).max(0.0);
    let wanted = speed.min(player.body.speed_top_mps);
    let (end, step_s) =
        if own < STANDS_MPS { (OFF_MPS, OFF_S) } else { (own + SPEEDS_UP_MPS, STEP_S) };
    let end = end.min(wanted);
    let pace = wanted.clamp(end, end + haste_mps(speed));
    let until_s = again_s(pace);
    let way =
        ahead * (0.5 * (own + end) * step_s + pace * until_s + FRONT_M + FRONT_S * pace) - to_ball;
    sent(way, step_s + until_s + NEXT_S, pace)
}

/// What a touch of a motion is for.
pub(super) struct Carry {
    /// The velocity that the player wanted when it began, world m/s.
    pub(super) wish: Vec2,
    /// The velocity with which they come out of it, world m/s.
    pub(super) to: Vec2,
    /// Ticks from the touch to its end.
    pub(super) rest: u8,
    /// Whether it is their first touch of this ball.
    pub(super) first: bool,
}

/// The velocity of the touch of a motion, after which its player meets the ball again. (GRF's.)
///
/// `owns`: whether the ball was theirs already. `lines`: the pitch that the ball is kept on.
pub(super) fn touched(
    player: &Player,
    to_ball: Vec2,
    carry: &Carry,
    owns: bool,
    lines: Option<&PitchSize>,
) -> Vec2 {
    let Carry { wish, to, rest, first } = *carry;
    let rest_s = f32::from(rest) * 0.01;
    let (end, wanted) = (to.length(), wish.length().min(player.body.speed_top_mps));
    let (way, out) = (wish.normalize_or(player.body.facing), to.normalize_or(player.body.facing));
    let stands = end < STANDS_MPS;
    // Who sets off from a standstill for another ball than their own doesn't hurry yet.
    let sets_off = first && player.vel.length_squared() < SETS_OFF_MPS * SETS_OFF_MPS;
    let over = if stands || sets_off { 0.0 } else { haste_mps(wanted) };
    let along = 0.5 + 0.5 * player.body.facing.dot(way);
    let pace = wanted.max(end).min(end + over * along);
    let by_body = if stands { 1.0 } else { BY_BODY[usize::from(!owns)] };
    let until_s = again_s(pace);
    let place = (player.vel + to) * (0.5 * rest_s)
        + (out * by_body + way * (1.0 - by_body)) * (pace * until_s)
        + way * (FRONT_M + FRONT_S * pace);
    let cut = lines.and_then(|pitch| dribble::within_lines(pitch, player.pos, place));
    if let Some(cut) = cut {
        return dribble::stops_at(cut - to_ball);
    }
    sent(place - to_ball, rest_s + until_s + NEXT_S, pace)
}

/// How much faster than at the end of a touch whoever wants this speed wants to be, m/s.
fn haste_mps(wanted: f32) -> f32 {
    if wanted > SPRINTS_FROM_MPS {
        HASTE_MPS[1]
    } else if wanted > WALKS_FROM_MPS {
        HASTE_MPS[0]
    } else {
        0.0
    }
}

/// How long a runner at this pace lets the ball run, from the end of one touch to the start of the
/// next, seconds.
fn again_s(pace: f32) -> f32 {
    let share = (pace / SPRINT_MPS).min(1.0);
    AGAIN_S[0] + AGAIN_S[1] * share * share
}

/// The velocity that takes the ball this way, metres, in this time for a runner at this pace.
fn sent(way: Vec2, time_s: f32, pace: f32) -> Vec2 {
    let harder = 1.0 + HARDER * ((pace - RUN_MPS) / (FASTEST_MPS - RUN_MPS)).clamp(0.0, 1.0);
    way.normalize_or_zero()
        * libm::powf(way.length() / (time_s * CLOSE * SOFTER), WAY_TO_PACE)
        * harder
}

/// How fast a ball that is pushed on at this velocity rises, m/s.
pub(super) fn hop_mps(velocity: Vec2) -> f32 {
    let share = math::pow(velocity.length() / HOPS_MPS, HOPS);
    (HOP_LEAST_MPS + HOP_MOST_MPS * share).min(HOP_MOST_MPS)
}

/// Lengthens a touch so that the ball goes this much further, metres. (GRF's: the speed of a touch
/// is a power of the way to the next touch.)
pub(super) fn longer(velocity: Vec2, further_m: f32) -> Vec2 {
    let speed = velocity.length();
    if further_m <= 0.0 || speed < dribble::STOPS_MPS {
        return velocity;
    }
    let until_s = 0.45 + 0.6 * (speed / 8.0).min(1.0) * (speed / 8.0).min(1.0);
    let way_m = 0.41 * until_s * libm::powf(speed, 1.0 / WAY_TO_PACE);
    velocity * libm::powf((way_m + further_m) / way_m, WAY_TO_PACE)
}

/// How much further a player at this speed sends the ball because an opponent is close, metres.
/// Calm and balanced players send it less far. (GRF's.)
fn annoyance_m(game: &Match, id: PlayerId, speed: f32) -> f32 {
    let player = game.player(id);
    let rivals = game.team(id.team().other());
    let near = rivals
        .fold(f32::MAX, |near, (_, rival)| near.min(rival.pos.distance_squared(player.pos)))
        .sqrt();
    let close = 1.0 - ((near - ANNOYS_M.start) / (ANNOYS_M.end - ANNOYS_M.start)).clamp(0.0, 1.0);
    let nervous = 1.0 - (0.5 * player.skill(Stat::Calmness) + 0.3 * player.skill(Stat::Balance));
    ANNOYED_M * close * nervous * math::smooth((speed / 8.0).min(1.0))
}
