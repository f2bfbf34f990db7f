//! Shared parts of the fuzz targets: choices from bytes, generated scenarios, seeds, and an
//! observed game.

pub mod choice;
pub mod edit;
pub mod game;
pub mod generate;
pub mod seed;
