//! The Python module `setpiece._native`: conversions between Python and the facade, nothing else.

mod actions;
mod diagnostics;
mod environment;
mod errors;
mod info;
mod live;
mod observation;
mod params;
mod scenario;

/// Football scenarios from text files, and the engine that runs them.
#[pyo3::pymodule]
mod _native {
    use crate::actions::ActionSet;
    use pyo3::prelude::*;
    use pyo3::types::IntoPyDict;
    use setpiece::scenario::Action;

    #[pymodule_export]
    use crate::environment::{AgentInfo, Environment};
    #[pymodule_export]
    use crate::live::Live;
    #[pymodule_export]
    use crate::observation::simple115v2_bounds;
    #[pymodule_export]
    use crate::params::Param;
    #[pymodule_export]
    use crate::scenario::{Scenario, compile, library, load, restore};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        let actions: Vec<(&str, &str)> = Action::ALL.iter().map(|action| (action.name(), action.doc())).collect();
        module.add("ACTIONS", pyo3::types::PyTuple::new(module.py(), actions)?)?;
        let sets = ActionSet::NAMED.map(|(name, set)| (name, set.size));
        module.add("ACTION_SETS", sets.into_py_dict(module.py())?)?;
        module.add("SMM_SHAPE", crate::observation::SMM_SHAPE)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }

    /// Runs the command `setpiece` with arguments and returns its exit code: 0, 1 (input) or 2 (usage).
    #[pyfunction]
    fn run_command(py: Python<'_>, arguments: Vec<String>) -> u8 {
        let words = std::iter::once("setpiece".to_owned()).chain(arguments);
        py.detach(|| setpiece::cli::main(words.map(Into::into)))
    }
}
