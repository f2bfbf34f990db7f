//! Building events.

use crate::state::event::{Event, Events};
use crate::state::{Match, PlayerId};
use glam::Vec3;
use setpiece_scenario::vocabulary::EventKind;

/// An event that happens now, at the ball. If the ball has left the pitch, its place is on the line
/// it crossed.
pub fn event(game: &Match, kind: EventKind) -> Event {
    let (x, y) = game.half().into();
    Event {
        tick: game.tick,
        kind,
        qualifier: None,
        team: None,
        by: None,
        to: None,
        at: game.ball.pos.clamp(Vec3::new(-x, -y, 0.0), Vec3::new(x, y, f32::INFINITY)),
        length_m: 0.0,
        speed_mps: game.ball.vel.length(),
    }
}

/// Pushes a player's event at the ball.
pub fn did(game: &Match, events: &mut Events, kind: EventKind, by: PlayerId, to: Option<PlayerId>) {
    events.push(event(game, kind).by(by).to(to));
}
