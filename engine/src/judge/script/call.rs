//! Calls a script's functions: as Rhai's bytecode if all of it can be lowered, else with Rhai's
//! tree walker.

use super::{budget, host};
use rhai::grain::{Compiler, Program, Vm};
use rhai::{AST, CallFnOptions, Dynamic, EvalAltResult, FuncArgs, Scope};
use std::cell::RefCell;

/// A callable script.
#[derive(Debug)]
pub(super) struct CompiledScript {
    ast: AST,
    /// Its bytecode; none if a part needs the tree walker.
    program: Option<Program<'static>>,
}

thread_local! {
    /// A machine caches what it found about the engine's functions, but not about scripts' own
    /// functions.
    static MACHINE: RefCell<Option<Vm<'static>>> = const { RefCell::new(None) };
}

impl CompiledScript {
    pub(super) fn of(ast: AST) -> CompiledScript {
        let program = Compiler::new().compile(&ast);
        // A closure outlives its machine's frame, and parts that aren't lowered are found by name.
        // Both need the tree walker.
        let whole = program.residual_count() == 0 && !program.makes_fn_pointers();
        CompiledScript { ast, program: whole.then_some(program) }
    }

    /// Forces the tree walker.
    #[cfg(test)]
    pub(super) fn walk(&mut self) {
        self.program = None;
    }

    #[cfg(test)]
    pub(super) fn is_lowered(&self) -> bool {
        self.program.is_some()
    }

    /// Calls a function; `this` is bound to it.
    pub(super) fn call(
        &self,
        name: &str,
        arguments: impl FuncArgs,
        this: &mut Dynamic,
    ) -> Result<Dynamic, Box<EvalAltResult>> {
        budget::begin();
        let options = CallFnOptions::new().eval_ast(false).rewind_scope(true).bind_this_ptr(this);
        let scope = &mut Scope::new();
        let Some(program) = &self.program else {
            return host::engine().call_fn_with_options(options, scope, &self.ast, name, arguments);
        };
        let kept = MACHINE.with(|machine| machine.borrow_mut().take());
        let mut machine = kept.unwrap_or_else(|| Vm::new(host::engine()));
        let value = machine.call_fn_with_options(options, scope, program, name, arguments);
        // A machine that failed isn't reused.
        if value.is_ok() {
            MACHINE.with(|kept| *kept.borrow_mut() = Some(machine));
        }
        value
    }
}
