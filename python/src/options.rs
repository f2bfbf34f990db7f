//! The options of an environment, passed as one value.

use crate::observation::{ObservationForm, Wanted};
use crate::seats::Seats;
use pyo3::prelude::*;

/// The attributes of the package's `EnvOptions` that the native module reads. The package has
/// validated them; what depends on the scenario is validated here.
#[derive(FromPyObject)]
pub(crate) struct EnvOptions<'py> {
    observation: String,
    size: (usize, usize),
    scale: bool,
    stack: usize,
    copy: bool,
    /// Names of the scenario's rewards; none for its own choice.
    #[pyo3(attribute("reward_names"))]
    pub(crate) rewards: Option<Vec<String>>,
    /// Whether `info` lists events: for the caller, or for a reward or ending in Python.
    #[pyo3(attribute("needs_events"))]
    pub(crate) events: bool,
    /// The action set of all agents.
    #[pyo3(attribute("native_action_set"))]
    pub(crate) action_set: String,
    pub(crate) bot_action: bool,
    left: Option<Bound<'py, PyAny>>,
    right: Option<Bound<'py, PyAny>>,
    switching: Option<Bound<'py, PyAny>>,
}

impl<'py> EnvOptions<'py> {
    /// The observation of an agent.
    pub(crate) fn wanted(&self) -> Wanted<'_> {
        Wanted { name: &self.observation, size: self.size, scale: self.scale }
    }

    /// How it is returned.
    pub(crate) fn shown(&self) -> ObservationForm {
        ObservationForm { stack: self.stack, copy: self.copy }
    }

    /// The agents.
    pub(crate) fn seats(&self) -> Seats<'_, 'py> {
        Seats {
            left: self.left.as_ref(),
            right: self.right.as_ref(),
            switching: self.switching.as_ref(),
        }
    }
}
