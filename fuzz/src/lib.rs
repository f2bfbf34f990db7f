//! What the fuzz targets share: choices made from bytes, generated scenarios, seeds, and a game that is watched.

pub mod choice;
pub mod edit;
pub mod game;
pub mod generate;
pub mod seed;
