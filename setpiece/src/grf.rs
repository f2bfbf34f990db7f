//! Scenario scripts of Google Research Football (GRF), and the texts that say the same.
//!
//! A script is a Python file whose `build_scenario(builder)` places the ball and the players.
//! [`GrfScenario`] is what one sets; [`to_pitch`] writes it as a text. The Python package runs
//! scripts and records what they set. [`GrfScript`] reads straight lines of a script without
//! running it.

mod kickoff;
mod player;
mod recorded;
mod script;
mod translate;

pub use recorded::{FIXED_SEED, GrfPlayer, GrfScenario, LIMIT_MAX};
pub use script::{GrfFault, GrfScript, scripts};
pub use translate::{TranslationError, identifier, to_pitch};
