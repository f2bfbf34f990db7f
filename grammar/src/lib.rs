//! The grammar of the Setpiece language: text to pest pairs.
//!
//! The grammar itself is `setpiece.pest`. This crate knows pest only; trees, spans of files and reports are `dsl`'s.

mod noun;
mod rules;

pub use noun::{keyword, noun};
pub use rules::{PitchParser, Rule};
