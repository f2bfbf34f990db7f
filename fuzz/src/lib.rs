//! Shared parts of the fuzz targets: choices from bytes, generated scenarios, what is said about
//! many episodes, seeds, and an observed game.

pub mod choice;
pub mod edit;
pub mod game;
pub mod generate;
pub mod levels;
pub mod seed;
