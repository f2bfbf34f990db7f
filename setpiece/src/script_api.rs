//! Checks scripts against the engine's hook API, the only thing that the compiler needs from the
//! engine.

use setpiece_dsl::problem::{Code, ScriptApi, ScriptProblem};
use setpiece_dsl::source::Source;
use setpiece_engine::judge::{ScriptFaultKind, check_script};

/// The engine's implementation of [`ScriptApi`].
#[derive(Clone, Copy, Debug)]
pub struct EngineScripts;

impl ScriptApi for EngineScripts {
    fn check(&self, script: &Source, hook: &str, params: &[&str]) -> Vec<ScriptProblem> {
        check_script(&script.text, hook, params)
            .into_iter()
            .map(|fault| ScriptProblem {
                code: match fault.kind {
                    ScriptFaultKind::Syntax => Code::ScriptSyntax,
                    ScriptFaultKind::Hook => Code::ScriptHook,
                    ScriptFaultKind::Name => Code::ScriptName,
                },
                range: fault.range,
                message: fault.message,
                help: fault.help,
            })
            .collect()
    }
}
