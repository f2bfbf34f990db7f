//! The football game that runs a compiled scenario: everything with a tick.
//!
//! - [`draw`]: turns a scenario, its parameters and a seed into one concrete [`start::Drawn`].
//! - [`state::Match`]: one simulation, plain data, and its events. [`physics`], [`football`] and
//!   [`control`] move it, in the order of [`step`].
//! - [`judge`]: rewards and endings, from the state and its events.
//! - [`observe`]: writes the state into the caller's buffers.
//! - [`environment`]: one match and its judge, as an agent sees them; [`batch`]: many.
//! - [`snapshot`]: an episode as bytes, and back.
//! - [`statistics`], [`digest`]: figures of a match, and a fingerprint of its state; [`laps`]:
//!   where the time goes.

pub mod batch;
pub mod control;
pub mod digest;
pub mod draw;
pub mod environment;
mod floats;
pub mod football;
mod in_place;
pub mod judge;
pub mod laps;
pub mod math;
pub mod observe;
pub mod physics;
pub mod random;
mod rows;
pub mod snapshot;
pub mod start;
pub mod state;
pub mod statistics;
pub mod step;
#[cfg(test)]
mod testing;
