//! Writing events.

use crate::event::{Event, Events};
use crate::state::{Match, PlayerId};
use glam::Vec3;
use setpiece_scenario::pitch::{HALF_LENGTH_M, HALF_WIDTH_M};
use setpiece_scenario::vocabulary::{EventKind, Qualifier, Team};

/// An event of now, at the ball; where it has left the pitch, on the line it crossed.
pub fn event(game: &Match, kind: EventKind) -> Event {
    let (x, y) = (HALF_LENGTH_M as f32, HALF_WIDTH_M as f32);
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

impl Event {
    /// Done by a player.
    #[must_use]
    pub fn by(self, id: PlayerId) -> Event {
        Event { by: Some(id), team: self.team.or(Some(id.team())), ..self }
    }

    /// Reaching or hurting a player.
    #[must_use]
    pub fn to(self, id: Option<PlayerId>) -> Event {
        Event { to: id, ..self }
    }

    /// Of or for a team.
    #[must_use]
    pub fn team(self, team: Team) -> Event {
        Event { team: Some(team), ..self }
    }

    /// Refined.
    #[must_use]
    pub fn qualified(self, qualifier: Qualifier) -> Event {
        Event { qualifier: Some(qualifier), ..self }
    }

    /// Over a way of so many metres.
    #[must_use]
    pub fn length(self, length_m: f32) -> Event {
        Event { length_m, ..self }
    }

    /// At a place.
    #[must_use]
    pub fn at(self, at: Vec3) -> Event {
        Event { at, ..self }
    }
}

/// Pushes a player's event at the ball.
pub fn did(game: &Match, events: &mut Events, kind: EventKind, by: PlayerId, to: Option<PlayerId>) {
    events.push(event(game, kind).by(by).to(to));
}
