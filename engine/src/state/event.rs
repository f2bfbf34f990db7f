//! Events: what happened during a step, in order.

use super::PlayerId;
use crate::in_place::clone_in_place;
use glam::Vec3;
use setpiece_scenario::vocabulary::{EventKind, Qualifier, Team};

/// The most events of one step; further ones are dropped and counted (a step has ten ticks).
pub use setpiece_scenario::bounds::EVENTS_MAX;

/// Something that happened.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Event {
    /// Ticks since the episode's start.
    pub tick: u32,
    /// What.
    pub kind: EventKind,
    /// A refinement; `pass` is always attempted, completed or intercepted.
    pub qualifier: Option<Qualifier>,
    /// The team of the player who did it, or that it is awarded to.
    pub team: Option<Team>,
    /// Who did it.
    pub by: Option<PlayerId>,
    /// The player who received it or was hurt.
    pub to: Option<PlayerId>,
    /// Where, world metres, before any restart moved things.
    pub at: Vec3,
    /// How far the ball travelled, metres; 0 if that has no meaning.
    pub length_m: f32,
    /// The ball's speed, m/s.
    pub speed_mps: f32,
}

impl Event {
    /// Sets the player who did it.
    #[must_use]
    pub fn by(self, id: PlayerId) -> Event {
        Event { by: Some(id), team: self.team.or(Some(id.team())), ..self }
    }

    /// Sets the player who received it or was hurt.
    #[must_use]
    pub fn to(self, id: Option<PlayerId>) -> Event {
        Event { to: id, ..self }
    }

    /// Sets the team.
    #[must_use]
    pub fn team(self, team: Team) -> Event {
        Event { team: Some(team), ..self }
    }

    /// Sets the refinement.
    #[must_use]
    pub fn qualified(self, qualifier: Qualifier) -> Event {
        Event { qualifier: Some(qualifier), ..self }
    }

    /// Sets the length, metres.
    #[must_use]
    pub fn length(self, length_m: f32) -> Event {
        Event { length_m, ..self }
    }

    /// Sets the place.
    #[must_use]
    pub fn at(self, at: Vec3) -> Event {
        Event { at, ..self }
    }
}

/// The events of a step, in a reusable buffer.
#[derive(Debug, Default, serde::Serialize, serde::Deserialize)]
pub struct Events {
    list: Vec<Event>,
    dropped: u32,
}

clone_in_place! {
    Events { list, dropped }
}

impl Events {
    /// An empty buffer with room for a step.
    pub fn new() -> Events {
        Events { list: Vec::with_capacity(EVENTS_MAX), dropped: 0 }
    }

    /// Forgets the events of the last step.
    pub fn clear(&mut self) {
        self.list.clear();
        self.dropped = 0;
    }

    /// Forgets the first `n` events, which were judged. Events that a restart added after them
    /// belong to the next step.
    pub fn forget(&mut self, n: usize) {
        self.list.drain(..n.min(self.list.len()));
        self.dropped = 0;
    }

    /// Adds an event; never allocates beyond [`EVENTS_MAX`].
    pub fn push(&mut self, event: Event) {
        if self.list.len() < EVENTS_MAX {
            self.list.push(event);
        } else {
            self.dropped += 1;
        }
    }

    /// The events in order.
    pub fn as_slice(&self) -> &[Event] {
        &self.list
    }

    /// How many events did not fit.
    pub fn dropped(&self) -> u32 {
        self.dropped
    }
}
