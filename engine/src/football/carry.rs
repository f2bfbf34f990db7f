//! How hard a dribbler pushes the ball on: it depends on pace and skill, and is harder with
//! opponents close by.

use crate::football::dribble;
use crate::football::pace::{DRIBBLE_MPS, RUN_MPS, SPRINT_MPS, SPRINTS_FROM_MPS, WALKS_FROM_MPS};
use crate::math;
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::Stat;

/// The power that turns the way to the next touch into the speed of this one. (GRF's.)
const WAY_TO_PACE: f32 = 0.7;
/// How close a dribbler keeps the ball. `CLOSEST`: the divisor of a touch's way without any skill,
/// and what full skill adds (GRF's). `CLOSE`: the divisor for which the speeds here hold.
const CLOSEST: [f32; 2] = [0.38, 0.02];
const CLOSE: f32 = 0.394;
/// Opponents within these distances annoy a dribbler; the most annoyed sends the ball `ANNOYED_M`
/// further, metres. (GRF's.)
const ANNOYS_M: std::ops::Range<f32> = 0.5..1.5;
const ANNOYED_M: f32 = 3.0;
/// Where and when a runner meets the ball again. `FRONT_M`, `FRONT_S`: how far ahead, in metres and
/// in seconds of the runner's speed. `AGAIN_S`: after how many seconds at rest, and how many more
/// at a sprint. (GRF's.) `STEP_S`: how long the step of a touch lasts. `TOUCH_S`: the time from it
/// to the next touch.
const FRONT_M: f32 = 0.34;
const FRONT_S: f32 = 0.08;
const AGAIN_S: [f32; 2] = [0.25, 0.6];
const STEP_S: f32 = 0.12;
const TOUCH_S: f32 = 0.2;
/// How fast whoever stands comes out of the step of a touch, and how much less faster one does for
/// each m/s of their run below that; by how much a runner speeds up in it, m/s. (GRF's gaits.)
const OFF_MPS: f32 = DRIBBLE_MPS;
const GETS_OFF: f32 = 0.5;
const SPEEDS_UP_MPS: f32 = 1.0;
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
    let end =
        (own + if own < OFF_MPS { OFF_MPS - GETS_OFF * own } else { SPEEDS_UP_MPS }).min(wanted);
    let over = if speed > SPRINTS_FROM_MPS {
        HASTE_MPS[1]
    } else if speed > WALKS_FROM_MPS {
        HASTE_MPS[0]
    } else {
        0.0
    };
    let pace = wanted.clamp(end, end + over);
    let share = (pace / SPRINT_MPS).min(1.0);
    let until_s = AGAIN_S[0] + AGAIN_S[1] * share * share;
    let way =
        ahead * (0.5 * (own + end) * STEP_S + pace * until_s + FRONT_M + FRONT_S * pace) - to_ball;
    let fast = 1.0 + HARDER * ((pace - RUN_MPS) / (FASTEST_MPS - RUN_MPS)).clamp(0.0, 1.0);
    way.normalize_or_zero()
        * libm::powf(way.length() / ((until_s + TOUCH_S) * CLOSE * 1.1), WAY_TO_PACE)
        * fast
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
