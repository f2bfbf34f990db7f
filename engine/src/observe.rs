//! The match as agents see it, written into the caller's buffers.
//!
//! Decides the layouts: Google Research Football's, by its conventions. An agent always sees its
//! team attacking towards +x. For the right team everything is turned by 180°, and teams, score and
//! ownership are swapped. Lengths are normalised ([`setpiece_scenario::pitch`]), and directions are
//! the displacement of one step. Where GRF's documentation and behaviour differ, this follows the
//! documentation: a player who was sent off is shown as missing.

mod egocentric;
mod frame;
pub mod layout;
mod mask;
mod raw;
mod scaled;
mod simple115;
mod smm;

pub use egocentric::{egocentric, size as egocentric_size};
pub use mask::action_mask;
pub use raw::{Raw, RawTeam, raw, raw_of};
pub use scaled::scaled;
pub use simple115::{simple115, simple115v2, simple115v2_sticky};
pub use smm::{SMM_HEIGHT, SMM_WIDTH, smm, smm_size};

use crate::state::{AgentSlot, Match};

/// An observation that is an array of floats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Floats {
    /// GRF's first layout: players without gaps.
    Simple115,
    /// GRF's second layout.
    Simple115v2,
    /// GRF's second layout, plus the held keys.
    Simple115v2Sticky,
    /// What a player sees from their own place.
    Egocentric,
    /// The scenario's own: `observe vector { … }`.
    Vector,
    /// One of the above in other units: see [`Floats::scaled`].
    Scaled(Scaled),
}

/// An observation that has a scaled form: lengths in 50 m, heights in 10 m, velocities in 10 m/s, 0
/// for missing players. Flags and shares stay 0..1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scaled {
    /// [`Floats::Simple115v2`].
    Simple115v2,
    /// [`Floats::Simple115v2Sticky`].
    Simple115v2Sticky,
    /// [`Floats::Egocentric`].
    Egocentric,
}

impl Floats {
    /// The scaled form. `None` for `Simple115`, whose columns depend on the teams, and for
    /// `Vector`, whose units are the scenario's.
    pub fn scaled(self) -> Option<Floats> {
        Some(Floats::Scaled(match self {
            Floats::Simple115v2 => Scaled::Simple115v2,
            Floats::Simple115v2Sticky => Scaled::Simple115v2Sticky,
            Floats::Egocentric => Scaled::Egocentric,
            Floats::Scaled(scaled) => scaled,
            Floats::Simple115 | Floats::Vector => return None,
        }))
    }
}

impl Scaled {
    /// The observation that is scaled.
    pub fn plain(self) -> Floats {
        match self {
            Scaled::Simple115v2 => Floats::Simple115v2,
            Scaled::Simple115v2Sticky => Floats::Simple115v2Sticky,
            Scaled::Egocentric => Floats::Egocentric,
        }
    }
}

/// Why nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ObserveError {
    /// There is no such agent.
    #[error("no agent {agent}: there are {n_agents}")]
    Agent {
        /// The agent that was requested.
        agent: usize,
        /// The number of agents.
        n_agents: usize,
    },
    /// The buffer has another size.
    #[error("expected a buffer of {expected}, found {found}")]
    Size {
        /// The expected number of elements.
        expected: usize,
        /// The actual number of elements.
        found: usize,
    },
}

fn slot(game: &Match, agent: usize) -> Result<AgentSlot, ObserveError> {
    game.agents
        .get(agent)
        .copied()
        .ok_or(ObserveError::Agent { agent, n_agents: game.agents.len() })
}

fn check_size(found: usize, expected: usize) -> Result<(), ObserveError> {
    if found == expected { Ok(()) } else { Err(ObserveError::Size { expected, found }) }
}

#[cfg(test)]
mod tests;
