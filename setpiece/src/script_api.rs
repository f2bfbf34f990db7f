//! Checks scripts against the engine's hook API, the only thing that the compiler needs from the
//! engine.

use setpiece_dsl::problem::{Code, ScriptApi, ScriptProblem, ScriptSight};
use setpiece_dsl::source::Source;
use setpiece_engine::judge::{ScriptFaultKind, ScriptNames, check_script, script_imports};
use setpiece_scenario::ScriptModule;
use std::ops::Range;

/// The engine's implementation of [`ScriptApi`].
#[derive(Clone, Copy, Debug)]
pub struct EngineScripts;

impl ScriptApi for EngineScripts {
    fn imports(&self, text: &str) -> Vec<(String, Range<usize>)> {
        script_imports(text)
    }

    fn check(
        &self,
        script: &Source,
        modules: &[ScriptModule],
        hook: &str,
        sight: &ScriptSight<'_>,
    ) -> Vec<ScriptProblem> {
        let ScriptSight { params, named, others, terms } = sight;
        check_script(&script.text, modules, hook, &ScriptNames { params, named, others, terms })
            .into_iter()
            .map(|fault| ScriptProblem {
                code: match fault.kind {
                    ScriptFaultKind::Syntax => Code::ScriptSyntax,
                    ScriptFaultKind::Hook => Code::ScriptHook,
                    ScriptFaultKind::Name => Code::ScriptName,
                },
                module: fault.module,
                range: fault.range,
                message: fault.message,
                help: fault.help,
            })
            .collect()
    }
}
