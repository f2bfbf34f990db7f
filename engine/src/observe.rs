//! The match as agents see it, written into the caller's buffers.
//!
//! Decides the layouts: Google Research Football's, by its conventions. An agent always believes that it attacks towards
//! +x: for the right team everything is turned by 180°, teams, score and ownership are swapped. Lengths are
//! normalised ([`setpiece_scenario::pitch`]), directions are the displacement of one step. What GRF documents and
//! does otherwise follows the documentation: a player who was sent off is shown as a missing one.

mod egocentric;
mod frame;
pub mod layout;
mod mask;
mod raw;
mod simple115;
mod smm;

pub use egocentric::{egocentric, size as egocentric_size};
pub use mask::action_mask;
pub use raw::{Raw, RawTeam, raw, raw_of};
pub use simple115::{simple115, simple115v2};
pub use smm::{SMM_HEIGHT, SMM_WIDTH, smm, smm_size};

use crate::state::{AgentSlot, Match};

/// An observation that is an array of floats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Floats {
    /// GRF's first one: players without gaps.
    Simple115,
    /// GRF's second one.
    Simple115v2,
    /// What a player sees from where he is.
    Egocentric,
    /// The scenario's own: `observe vector { … }`.
    Vector,
}

/// Why nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ObserveError {
    /// There is no such agent.
    #[error("no agent {agent}: there are {n_agents}")]
    Agent {
        /// Which was asked for.
        agent: usize,
        /// How many there are.
        n_agents: usize,
    },
    /// The buffer has another size.
    #[error("expected a buffer of {expected}, found {found}")]
    Size {
        /// Elements it should have.
        expected: usize,
        /// Elements it has.
        found: usize,
    },
}

fn slot(game: &Match, agent: usize) -> Result<AgentSlot, ObserveError> {
    game.agents.get(agent).copied().ok_or(ObserveError::Agent { agent, n_agents: game.agents.len() })
}

fn check_size(found: usize, expected: usize) -> Result<(), ObserveError> {
    if found == expected { Ok(()) } else { Err(ObserveError::Size { expected, found }) }
}

#[cfg(test)]
mod tests;
