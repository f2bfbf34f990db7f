//! What the end-to-end tests share.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use setpiece::engine::environment::{Environment, EnvironmentOptions};

/// An environment of the scenario that a text holds.
///
/// # Panics
/// If the text doesn't compile.
pub fn environment(text: &str) -> Environment {
    let loaded = setpiece::compile_text(text, "<test>").unwrap_or_else(|error| panic!("{error}"));
    Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap()
}
