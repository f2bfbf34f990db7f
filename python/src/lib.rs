//! The Python module `setpiece._native`: only conversions between Python and the facade.

mod actions;
mod batch;
mod diagnostics;
mod environment;
mod errors;
mod given;
mod grf;
mod info;
mod level;
mod levels;
mod live;
mod log;
mod observation;
mod options;
mod params;
mod patience;
mod picture;
mod replay;
mod scenario;
mod seats;
mod studio;
mod suite;
mod video;
mod write;

/// Football scenarios from text files, and the engine that runs them.
#[pyo3::pymodule]
mod _native {
    use crate::actions::ActionSet;
    use pyo3::prelude::*;
    use pyo3::types::IntoPyDict;
    use setpiece::engine::control::continuous;
    use setpiece::scenario::Action;
    use setpiece::scenario::plan::EPISODES_MAX;
    use setpiece::scenario::vocabulary::AGENTS;
    use std::ffi::OsString;

    #[pymodule_export]
    use crate::batch::{Arrays, Batch};
    #[pymodule_export]
    use crate::environment::{AgentInfo, Environment, EpisodeKey, agents};
    #[pymodule_export]
    use crate::grf::{grf_name, grf_text};
    #[pymodule_export]
    use crate::level::{level, level_text};
    #[pymodule_export]
    use crate::levels::Levels;
    #[pymodule_export]
    use crate::live::Live;
    #[pymodule_export]
    use crate::observation::{BlockInfo, Bounds};
    #[pymodule_export]
    use crate::params::Param;
    #[pymodule_export]
    use crate::replay::{RecordedAct, RecordedSteer, Replay};
    #[pymodule_export]
    use crate::scenario::{
        LibraryEntry, Scenario, compile, compile_cast, library, load, load_cast, restore,
    };
    #[pymodule_export]
    use crate::studio::Studio;
    #[pymodule_export]
    use crate::suite::{Suite, SuiteRow, library_suites, suite_text};
    #[pymodule_export]
    use crate::video::{Moment, moments_video, replay_video};
    #[pymodule_export]
    use crate::write::{write, write_new};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        crate::log::install();
        let actions: Vec<(&str, &str)> =
            Action::ALL.iter().map(|action| (action.name(), action.doc())).collect();
        module.add("ACTIONS", pyo3::types::PyTuple::new(module.py(), actions)?)?;
        let sets = ActionSet::NAMED.map(|(name, set)| (name, set.masked().len()));
        let baselines: Vec<&str> = setpiece::baseline::baselines().collect();
        module.add("BASELINES", pyo3::types::PyTuple::new(module.py(), baselines)?)?;
        module.add("AGENTS", pyo3::types::PyTuple::new(module.py(), AGENTS)?)?;
        module.add("EPISODES_MAX", EPISODES_MAX)?;
        module.add("GRF_LIMIT_MAX", setpiece::grf::LIMIT_MAX)?;
        module.add("ACTION_SETS", sets.into_py_dict(module.py())?)?;
        module.add("CONTINUOUS", (continuous::LOW.to_vec(), continuous::HIGH.to_vec()))?;
        let kinds: Vec<&str> = continuous::KINDS.iter().map(|kind| kind.name()).collect();
        module.add("KINDS", pyo3::types::PyTuple::new(module.py(), kinds)?)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }

    /// The policy that a scenario comes with: the library's scenario that it belongs to, and its
    /// ONNX file.
    #[pyfunction]
    fn baseline_file(
        py: Python<'_>,
        scenario: &Scenario,
    ) -> PyResult<(&'static str, &'static [u8])> {
        let file = setpiece::baseline::baseline_file(scenario.inner());
        let file = file.map_err(|error| crate::errors::from_facade(py, &error))?;
        Ok((file.scenario, file.bytes))
    }

    /// Runs the command `setpiece` with arguments and returns its exit code: 0, 1 (input) or 2
    /// (usage).
    #[pyfunction]
    fn run_command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
        let words = std::iter::once(OsString::from("setpiece")).chain(arguments);
        py.detach(|| setpiece::cli::main(words))
    }
}
