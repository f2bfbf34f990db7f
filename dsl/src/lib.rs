//! The compiler: everything with a span.
//!
//! `parse` → `resolve` → `check` → `lower`: no stage stops at the first problem. Types are checked
//! while a tree is lowered, as a typed value is its registers and its type; see [`compile()`].

pub mod ast;
mod cast;
mod check;
pub mod compile;
pub mod format;
mod habit;
pub mod index;
mod lower;
mod origins;
mod outline;
pub mod parse;
pub mod problem;
pub mod report;
mod resolve;
pub mod source;

pub use cast::{CAST_NAME, Cast, CastTarget};
pub use compile::{CompileOptions, CompileOutcome, compile, parts};
pub use origins::{Origins, RegionOrigin, RequireOrigin};
pub use outline::Outline;
pub use resolve::Prelude;
