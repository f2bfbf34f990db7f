//! What the engine says of scripts, which the compiler does not read itself.

use super::Code;
use crate::source::Source;
use setpiece_scenario::{NamedKind, ScriptModule};
use std::ops::Range;

/// Checks scripts against the engine's hook API, which the compiler does not know.
pub trait ScriptApi {
    /// The paths of the modules that a script or module imports, and their byte ranges in it.
    fn imports(&self, text: &str) -> Vec<(String, Range<usize>)>;

    /// Says everything that is wrong with a script that must have the hook `hook` (`reward`, `done`
    /// or `act`), and with its modules.
    fn check(
        &self,
        script: &Source,
        modules: &[ScriptModule],
        hook: &str,
        sight: &ScriptSight<'_>,
    ) -> Vec<ScriptProblem>;
}

/// The names that a script may read.
#[derive(Clone, Debug, Default)]
pub struct ScriptSight<'a> {
    /// Those in `ctx.params`.
    pub params: Vec<&'a str>,
    /// Those in `named` that the script mentions.
    pub named: Vec<(&'a str, NamedKind)>,
    /// Every name that it might have meant instead.
    pub others: Vec<&'a str>,
    /// The keys of the map that a `reward` hook returns; none if it returns a number.
    pub terms: Vec<&'a str>,
}

/// A fault of a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptProblem {
    /// Which code.
    pub code: Code,
    /// In which of its modules; none if in the script itself.
    pub module: Option<usize>,
    /// Byte range in the text.
    pub range: Range<usize>,
    /// One clause.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
}
