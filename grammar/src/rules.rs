//! The generated parser.
#![allow(missing_docs, reason = "the rules' documentation is the grammar file")]
#![allow(clippy::pedantic, reason = "generated code")]

use pest_derive::Parser;

/// The parser that pest derives from `setpiece.pest`.
#[derive(Parser)]
#[grammar = "setpiece.pest"]
pub struct PitchParser;
