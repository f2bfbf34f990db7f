//! What the engine says of scripts, which the compiler does not read itself.

use super::Code;
use crate::source::Source;

/// Checks scripts against the engine's hook API, which the compiler does not know.
pub trait ScriptApi {
    /// Says everything that is wrong with a script that must have the hook `hook` (`reward`, `done`
    /// or `act`) and finds these names in `ctx.params`.
    fn check(&self, script: &Source, hook: &str, params: &[&str]) -> Vec<ScriptProblem>;
}

/// A fault of a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptProblem {
    /// Which code.
    pub code: Code,
    /// Byte range in the script's text.
    pub range: std::ops::Range<usize>,
    /// One clause.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
}
