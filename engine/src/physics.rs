//! The ball, and the ground, woodwork and nets that it meets.
//!
//! Decides how the ball flies, bounces, rolls and rebounds. `football` decides how it meets
//! players, and what that means.

mod ball;
mod conditions;
pub mod constants;
pub mod flight;
pub mod forecast;
mod gate;
pub mod lines;
pub mod predict;
mod scene;
mod scratch;

pub use ball::Ball;
pub use conditions::Conditions;
pub use forecast::Forecast;
pub use lines::{Line, crossed_goal_line, left_pitch};
pub use scratch::Scratch;

use constants::{BALL_RADIUS, ROLL_DRAG, TICK_S};
use glam::Vec3;
use setpiece_scenario::PitchSize;

/// What the ball touched in a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// A post or the crossbar.
    Woodwork,
    /// A net, from either side.
    Net,
}

/// Moves the ball by one tick of 10 ms: flight, bounce, roll, and rigid contact with woodwork and
/// nets.
///
/// `full` always runs rapier. Otherwise rapier runs only if the swept ball comes near a goal.
pub fn advance_ball(
    ball: &mut Ball,
    pitch: &PitchSize,
    conditions: &Conditions,
    full: bool,
    scratch: &mut Scratch,
) -> Option<Contact> {
    if flight::lies_still(ball) {
        return None;
    }
    let before = *ball;
    flight::push(ball, conditions);
    if !full && !gate::near_goal(ball, pitch) {
        ball.pos += ball.vel * TICK_S;
        flight::land(ball, conditions);
        return None;
    }
    let touch = scratch.meet(ball, pitch);
    flight::land(ball, conditions);
    let touch = touch?;
    settle(ball, &before, touch.held_up, conditions);
    Some(touch.contact)
}

/// Brakes a ball that rolls along the top of a goal. Brings a slow ball to exact rest if it leans
/// on something and stands on the ground or on something.
fn settle(ball: &mut Ball, before: &Ball, held_up: bool, conditions: &Conditions) {
    let on_ground = ball.pos.z <= BALL_RADIUS;
    if !held_up && !on_ground {
        return;
    }
    let speed = ball.vel.length();
    if speed < conditions.rest_speed() {
        if before.vel == Vec3::ZERO {
            // It already lay here: gravity and the contact were in balance.
            *ball = *before;
        }
        ball.vel = Vec3::ZERO;
        ball.spin = Vec3::ZERO;
    } else if !on_ground {
        let kept = 1.0 - ROLL_DRAG * TICK_S / speed;
        ball.vel *= kept;
        ball.spin *= kept;
    }
}
