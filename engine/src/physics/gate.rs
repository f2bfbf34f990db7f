//! Whether the ball can meet anything hard within a tick. The check is cheap, and its "no" is
//! always right.

use super::Ball;
use super::BallObstacle;
use super::constants::{BALL_RADIUS, BODY_RADIUS, NEAR, TICK_S};
use super::scene::{BODIES_MAX, goal_bounds};
use arrayvec::ArrayVec;
use glam::Vec2;
use setpiece_scenario::PitchSize;

/// Whether the ball, carried along its velocity for a tick, comes near the frame or net of a goal.
pub(super) fn near_goal(ball: &Ball, pitch: &PitchSize) -> bool {
    const MARGIN: f32 = BALL_RADIUS + NEAR;
    let [low, high] = goal_bounds(pitch);
    let to = ball.pos + ball.vel * TICK_S;
    // Both goals at once: what matters is the distance from the middle.
    let x_far = ball.pos.x.abs().max(to.x.abs());
    let x_close = ball.pos.x.abs().min(to.x.abs());
    x_far > low.x - MARGIN
        && x_close < high.x + MARGIN
        && ball.pos.y.min(to.y) < high.y + MARGIN
        && ball.pos.y.max(to.y) > low.y - MARGIN
        && ball.pos.z.min(to.z) < high.z + MARGIN
}

/// The bodies that the ball can meet within a tick, nearest first, at most [`BODIES_MAX`].
pub(super) fn near_bodies(
    ball: &Ball,
    bodies: &[BallObstacle],
) -> ArrayVec<BallObstacle, BODIES_MAX> {
    const REACH: f32 = BALL_RADIUS + BODY_RADIUS + NEAR;
    let mut found: ArrayVec<(f32, BallObstacle), BODIES_MAX> = ArrayVec::new();
    for body in bodies {
        let lowest = ball.pos.z.min(ball.pos.z + ball.vel.z * TICK_S);
        if lowest > body.height_m + BALL_RADIUS + NEAR {
            continue;
        }
        let from = ball.pos.truncate() - body.pos;
        let distance = closest_approach(from, (ball.vel.truncate() - body.vel) * TICK_S);
        if distance > REACH {
            continue;
        }
        let place = found.iter().position(|(other, _)| distance < *other).unwrap_or(found.len());
        if found.is_full() {
            found.pop();
        }
        if place <= found.len() {
            found.insert(place, (distance, *body));
        }
    }
    found.into_iter().map(|(_, body)| body).collect()
}

/// The least distance from the origin of a point that moves from `from` by `by`.
fn closest_approach(from: Vec2, by: Vec2) -> f32 {
    let length_squared = by.length_squared();
    let share =
        if length_squared > 0.0 { (-from.dot(by) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
    (from + by * share).length()
}
