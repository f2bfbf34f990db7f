//! The compiler: everything with a span.
//!
//! `parse` → `resolve` → `check` → `lower`: no stage stops at the first problem, lowering a checked scenario is total.

pub mod ast;
pub mod parse;
pub mod problem;
pub mod source;
