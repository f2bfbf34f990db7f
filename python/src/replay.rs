//! Recorded episodes: the core of `setpiece.Replay`.

use crate::actions::ActionSet;
use crate::environment::{Environment, SMM_SIZE};
use crate::errors;
use crate::info::InfoOptions;
use crate::observation::{ObservationForm, Wanted};
use crate::scenario::Scenario;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use setpiece::files::read_file;
use setpiece::replay::{REPLAY_MAX_BYTES, Replay as Recording};
use setpiece::scenario::Action;
use setpiece::tracking::{Tracking, TrackingForm};
use std::path::PathBuf;

/// An agent's action in a step.
#[pyclass(frozen, get_all, module = "setpiece._native")]
pub(crate) struct RecordedAct {
    /// The action's number.
    action: usize,
    /// How it steered; None if it pressed keys.
    steer: Option<Py<RecordedSteer>>,
}

/// How an agent with continuous actions steered.
#[pyclass(frozen, get_all, module = "setpiece._native")]
pub(crate) struct RecordedSteer {
    /// The direction to run, x.
    x: f32,
    /// The direction to run, y.
    y: f32,
    /// The power of a kick.
    power: f32,
}

/// A recorded episode.
#[pyclass(frozen, module = "setpiece._native")]
pub(crate) struct Replay {
    inner: Recording,
}

impl Replay {
    pub(crate) fn inner(&self) -> &Recording {
        &self.inner
    }

    /// The smallest action set with all actions used.
    fn set(&self) -> ActionSet {
        if self.inner.acts().any(|(_, steer)| steer.is_some()) {
            return ActionSet::Continuous;
        }
        let most = self.inner.acts().map(|(action, _)| action.index()).max().unwrap_or_default();
        let sizes = [Action::DEFAULT_SET, Action::V2_SET, Action::FULL_SET];
        ActionSet::Keys(sizes.into_iter().find(|size| most < *size).unwrap_or(Action::FULL_SET))
    }
}

#[pymethods]
impl Replay {
    #[new]
    #[allow(clippy::needless_pass_by_value, reason = "what Python hands over is an owned path")]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Replay> {
        let read = || Recording::from_bytes(&read_file(&path, REPLAY_MAX_BYTES)?);
        Ok(Replay { inner: py.detach(read).map_err(|error| errors::from_facade(py, &error))? })
    }

    /// The scenario, bound to the parameters that it was played with.
    fn scenario(&self, py: Python<'_>) -> PyResult<Scenario> {
        let scenario = self.inner.scenario().map_err(|error| errors::from_facade(py, &error))?;
        Ok(Scenario::of(py, scenario))
    }

    #[getter]
    fn seed(&self) -> u64 {
        self.inner.seed
    }

    #[getter]
    fn index(&self) -> u64 {
        self.inner.index
    }

    /// Steps.
    #[getter]
    fn length(&self) -> u32 {
        self.inner.length
    }

    /// The fingerprint of its last state, 16 hexadecimal digits.
    #[getter]
    fn digest(&self) -> String {
        format!("{:016x}", self.inner.digest)
    }

    /// The snapshot that it began in; None if it began at the scenario's start.
    #[getter]
    fn snapshot<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyBytes>> {
        self.inner.from().map(|from| PyBytes::new(py, from))
    }

    /// The name of the smallest action set with all actions used.
    #[getter]
    fn action_set(&self) -> &'static str {
        let set = self.set();
        ActionSet::NAMED.iter().find(|(_, known)| *known == set).map_or("full", |(name, _)| name)
    }

    /// The agents' actions, agent by agent, step by step.
    #[getter]
    fn acts(&self, py: Python<'_>) -> PyResult<Vec<RecordedAct>> {
        let act = |(action, steer): (Action, Option<setpiece::engine::state::Steer>)| {
            let steer = steer.map(|steer| {
                Py::new(py, RecordedSteer { x: steer.way.x, y: steer.way.y, power: steer.power })
            });
            Ok(RecordedAct { action: action.index(), steer: steer.transpose()? })
        };
        self.inner.acts().map(act).collect()
    }

    /// Writes its tracking and event data into a folder; returns the paths of the files.
    #[allow(clippy::needless_pass_by_value, reason = "what Python hands over is an owned path")]
    fn export(&self, py: Python<'_>, folder: PathBuf, form: &str) -> PyResult<Vec<PathBuf>> {
        let form = match form {
            "cdf" => TrackingForm::Cdf,
            "csv" => TrackingForm::Csv,
            _ => {
                let message = format!("expected `cdf` or `csv`, found `{form}`");
                return Err(errors::parameter(py, "form", &message));
            }
        };
        py.detach(|| Tracking::of(&self.inner)?.save(&folder, form))
            .map_err(|error| errors::from_facade(py, &error))
    }

    /// An environment that can play it with `replayed`, before its start.
    fn environment(&self, py: Python<'_>, observation: &str) -> PyResult<Environment> {
        let engine = self.inner.environment().map_err(|error| errors::from_facade(py, &error))?;
        let kind = Wanted { name: observation, size: SMM_SIZE, scale: false }.of(py, &engine)?;
        let info = InfoOptions { actions: self.set(), events: true, bot_action: false };
        Environment::around(py, engine, kind, ObservationForm::FRESH, info)
    }
}
