//! Whether the ball can meet anything hard within a tick. The check is cheap, and its "no" is
//! always right.

use super::Ball;
use super::constants::{BALL_RADIUS, NEAR, TICK_S};
use super::scene::goal_bounds;
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
