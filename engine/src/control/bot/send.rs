//! Where the goals are in a team's own frame, and how a player is sent to a point of it.

use super::view::TeamView;
use crate::state::player::Intent;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::pitch::HALF_LENGTH_M;

/// The middle of the attacked goal in the own frame, metres; the own goal is its negative.
pub const GOAL: Vec2 = Vec2::new(HALF_LENGTH_M as f32, 0.0);

/// Sends a player to a point of the own frame.
pub fn send(game: &mut Match, view: &TeamView, id: PlayerId, to: Vec2, speed: f32) {
    let to = to.clamp(Vec2::new(-54.5, -35.5), Vec2::new(54.5, 35.5)) * view.side;
    let body = &mut game.players[id.index()].body;
    body.dribble = Vec2::ZERO;
    body.intent = Intent::Go(to, speed);
}
