//! How hard a dribbler pushes the ball on: by pace and skill, and harder with opponents close by.

use crate::football::dribble;
use crate::football::pace::{DRIBBLE_MPS, RUN_MPS, SPRINT_MPS, SPRINTS_FROM_MPS, WALKS_FROM_MPS};
use crate::math;
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::Stat;

/// With what power of the way to where it is to be met again a touch's pace goes. (GRF's.)
const WAY_TO_PACE: f32 = 0.7;
/// How close the ball is kept: the divisor of a touch's way without any skill, what all of it adds (GRF's), and the divisor
/// for which the paces here hold.
const CLOSEST: [f32; 2] = [0.38, 0.02];
const CLOSE: f32 = 0.394;
/// From how near opponents annoy a dribbler, and how much further the most annoyed sends the ball, metres. (GRF's.)
const ANNOYS_M: std::ops::Range<f32> = 0.5..1.5;
const ANNOYED_M: f32 = 3.0;
/// How far ahead of a runner's place the ball is to be met again, metres, and how much further for each m/s; in how many
/// seconds at no pace, and how many more at a sprint (GRF's); how long the step of a touch lasts, and from it to the next
/// touch, seconds.
const FRONT_M: f32 = 0.34;
const FRONT_S: f32 = 0.08;
const AGAIN_S: [f32; 2] = [0.25, 0.6];
const STEP_S: f32 = 0.12;
const TOUCH_S: f32 = 0.2;
/// How fast whoever stands comes out of the step of a touch, and how much less faster one does for each m/s of their run
/// below that; by how much a runner speeds up in it, m/s. (GRF's gaits.)
const OFF_MPS: f32 = DRIBBLE_MPS;
const GETS_OFF: f32 = 0.5;
const SPEEDS_UP_MPS: f32 = 1.0;
/// How much faster than at the end of that step a walker and a sprinter want to be, m/s. (GRF's.)
const HASTE_MPS: [f32; 2] = [0.6, 1.2];
/// How much harder a ball is pushed at a sprint, and from which pace on wholly, m/s. (GRF's.)
const HARDER: f32 = 0.18;
const FASTEST_MPS: f32 = 7.2;

/// The velocity of a touch by as skilled and as annoyed a dribbler as this one, who runs at `speed`.
pub(super) fn as_skilled(game: &Match, id: PlayerId, velocity: Vec2, speed: f32) -> Vec2 {
    let skill = game.player(id).skill(Stat::Dribble);
    let closer = libm::powf(CLOSE / (CLOSEST[0] + CLOSEST[1] * skill), WAY_TO_PACE);
    longer(velocity, annoyance_m(game, id, speed)) * closer
}

/// The velocity with which a ball is pushed straight on: it is to be met again where the run leads in a while. (GRF's.)
pub(super) fn straight_on(player: &Player, to_ball: Vec2, ahead: Vec2, speed: f32) -> Vec2 {
    let own = player.vel.dot(ahead).max(0.0);
    let wanted = speed.min(player.body.speed_top_mps);
    let end = (own + if own < OFF_MPS { OFF_MPS - GETS_OFF * own } else { SPEEDS_UP_MPS }).min(wanted);
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
    let way = ahead * (0.5 * (own + end) * STEP_S + pace * until_s + FRONT_M + FRONT_S * pace) - to_ball;
    let fast = 1.0 + HARDER * ((pace - RUN_MPS) / (FASTEST_MPS - RUN_MPS)).clamp(0.0, 1.0);
    way.normalize_or_zero() * libm::powf(way.length() / ((until_s + TOUCH_S) * CLOSE * 1.1), WAY_TO_PACE) * fast
}

/// The velocity of a touch that is to send the ball so much further, metres. (GRF's: a touch's pace goes with this power of
/// the way to where it is to be met again.)
pub(super) fn longer(velocity: Vec2, further_m: f32) -> Vec2 {
    let speed = velocity.length();
    if further_m <= 0.0 || speed < dribble::STOPS_MPS {
        return velocity;
    }
    let until_s = 0.45 + 0.6 * (speed / 8.0).min(1.0) * (speed / 8.0).min(1.0);
    let way_m = 0.41 * until_s * libm::powf(speed, 1.0 / WAY_TO_PACE);
    velocity * libm::powf((way_m + further_m) / way_m, WAY_TO_PACE)
}

/// How much further a player who runs at so many m/s sends the ball with an opponent close by, metres: the less, the calmer
/// and the better balanced they are. (GRF's.)
fn annoyance_m(game: &Match, id: PlayerId, speed: f32) -> f32 {
    let player = game.player(id);
    let rivals = game.team(id.team().other());
    let near = rivals.fold(f32::MAX, |near, (_, rival)| near.min(rival.pos.distance_squared(player.pos))).sqrt();
    let close = 1.0 - ((near - ANNOYS_M.start) / (ANNOYS_M.end - ANNOYS_M.start)).clamp(0.0, 1.0);
    let nervous = 1.0 - (0.5 * player.skill(Stat::Calmness) + 0.3 * player.skill(Stat::Balance));
    ANNOYED_M * close * nervous * math::smooth((speed / 8.0).min(1.0))
}
