//! How a player is sent to a point of their team's own frame.

use super::view::TeamView;
use crate::state::player::Intent;
use crate::state::{Match, PlayerId};
use glam::Vec2;

/// Nobody is sent nearer to a line than this, metres.
const INSIDE_M: f32 = 0.5;

/// Sends a player to a point of the own frame.
pub fn send(game: &mut Match, view: &TeamView, id: PlayerId, to: Vec2, speed: f32) {
    let most = game.half() - INSIDE_M;
    let to = to.clamp(-most, most) * view.side;
    let body = &mut game.players[id.index()].body;
    body.dribble = Vec2::ZERO;
    body.intent = Intent::Go(to, speed);
}
