//! The grammar of the Setpiece language: text to pest pairs.
//!
//! The grammar itself is `setpiece.pest`. This crate only knows pest; trees, spans of files and
//! reports are in `dsl`.

mod noun;
mod rules;

pub use noun::{keyword, noun};
pub use rules::{PitchParser, Rule};
