//! The studio of a running program.

use crate::actions::ActionSet;
use crate::errors;
use crate::observation::{ObservationForm, Observer, Wanted};
use crate::patience::interruptible;
use crate::scenario::Scenario;
use pyo3::prelude::*;
use setpiece::engine::batch::Policy;
use setpiece::engine::environment::Environment as Engine;
use setpiece::engine::observe::{SMM_HEIGHT, SMM_WIDTH};
use setpiece::replay::Replay as Recording;
use setpiece::scenario::Action;
use setpiece::studio::{Guest, Guests, OpenOptions, Running, ServeOptions, Session, start};
use setpiece::{LoadOptions, Loaded};
use std::ffi::OsString;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// A policy of the program: what it sees, and the function that is given it.
#[derive(FromPyObject)]
struct PolicyForm {
    #[pyo3(item)]
    name: String,
    #[pyo3(item)]
    observation: String,
    #[pyo3(item)]
    scale: bool,
    /// How many steps a decision lasts.
    #[pyo3(item)]
    repeat: u32,
    /// A function of observations and the agents' ids that returns a list of action numbers.
    #[pyo3(item)]
    play: Py<PyAny>,
}

/// What is opened.
#[derive(FromPyObject)]
struct OpenedForm {
    /// A path, a name of the library, or the name of a text in reports.
    #[pyo3(item)]
    path: OsString,
    /// The text, if it is one.
    #[pyo3(item)]
    text: Option<String>,
    /// The compiled scenario, if it is one.
    #[pyo3(item)]
    scenario: Option<Py<Scenario>>,
    /// The scenario whose parameters hold.
    #[pyo3(item)]
    bound: Option<Py<Scenario>>,
    /// Whether imports and scripts may be anywhere.
    #[pyo3(item)]
    allow_outside: bool,
}

/// The policies of the program.
struct PythonGuests {
    policies: Vec<PolicyForm>,
    /// Set when the studio ends: from then on Python is no longer called.
    is_closed: Arc<AtomicBool>,
}

impl Guests for PythonGuests {
    fn names(&self) -> Vec<String> {
        self.policies.iter().map(|policy| policy.name.clone()).collect()
    }

    fn policy(&self, name: &str) -> Option<Box<dyn Guest + Send>> {
        let policy = self.policies.iter().find(|policy| policy.name == name)?;
        Some(Box::new(PythonPolicy {
            observation: policy.observation.clone(),
            scale: policy.scale,
            repeat: policy.repeat.max(1),
            play: Python::attach(|py| policy.play.clone_ref(py)),
            engine: None,
            chosen: Vec::new(),
            step: None,
            fault: None,
            is_closed: self.is_closed.clone(),
        }))
    }
}

/// A policy of the program that plays episodes.
struct PythonPolicy {
    observation: String,
    scale: bool,
    repeat: u32,
    play: Py<PyAny>,
    /// A copy of the match, because looking at one may move its scratch memory.
    engine: Option<Engine>,
    /// The actions that are pressed.
    chosen: Vec<Action>,
    step: Option<u32>,
    fault: Option<String>,
    is_closed: Arc<AtomicBool>,
}

impl PythonPolicy {
    fn choose(&mut self, py: Python<'_>) -> PyResult<Vec<Action>> {
        let Some(engine) = &mut self.engine else { return Ok(Vec::new()) };
        let wanted =
            Wanted { name: &self.observation, size: (SMM_WIDTH, SMM_HEIGHT), scale: self.scale };
        let kind = wanted.of(py, engine)?;
        let held = ActionSet::Keys(Action::DEFAULT_SET).held();
        let mut observer = Observer::new(py, kind, engine, ObservationForm::FRESH, held)?;
        let seen = observer.observe(py, engine, true)?;
        let ids = engine.agent_ids().to_vec();
        let numbers: Vec<usize> = self.play.call1(py, (seen, ids))?.extract(py)?;
        let actions = numbers.into_iter().map(|number| {
            let wrong = || errors::raise_plain(py, "ActionError", &format!("no action {number}"));
            Action::from_index(number).ok_or_else(wrong)
        });
        actions.collect()
    }
}

impl Policy for PythonPolicy {
    fn begin(&mut self, _environment: &Engine) {
        (self.step, self.fault) = (None, None);
        self.chosen.clear();
    }

    fn act(&mut self, environment: &Engine, agent: usize) -> Action {
        if self.is_closed.load(Ordering::Acquire) {
            return Action::Idle;
        }
        let step = environment.steps();
        let is_due = self.chosen.is_empty() || step.is_multiple_of(self.repeat);
        if is_due && self.step != Some(step) && self.fault.is_none() {
            self.step = Some(step);
            match &mut self.engine {
                Some(engine) => engine.clone_from(environment),
                none => *none = Some(environment.clone()),
            }
            match Python::attach(|py| self.choose(py).map_err(|why| why.to_string())) {
                Ok(chosen) => self.chosen = chosen,
                Err(why) => (self.chosen, self.fault) = (Vec::new(), Some(why)),
            }
        }
        self.chosen.get(agent).copied().unwrap_or(Action::Idle)
    }
}

impl Guest for PythonPolicy {
    fn fault(&mut self) -> Option<String> {
        self.fault.take()
    }
}

/// A studio that runs beside the program.
#[pyclass(frozen, module = "setpiece._native")]
pub(crate) struct Studio {
    /// The address to open, with its token.
    #[pyo3(get)]
    address: String,
    /// The port.
    #[pyo3(get)]
    port: u16,
    is_closed: Arc<AtomicBool>,
    running: Mutex<Option<Running>>,
}

#[pymethods]
impl Studio {
    /// Serves what is opened, with the policies that pages can choose.
    #[new]
    #[pyo3(signature = (opened, policies, *, port))]
    fn new(
        py: Python<'_>,
        opened: OpenedForm,
        policies: Vec<PolicyForm>,
        port: u16,
    ) -> PyResult<Studio> {
        let OpenedForm { path, text, scenario, bound, allow_outside } = opened;
        let compiled = scenario.map(|scenario| scenario.get().inner().clone());
        let bound = bound.map(|scenario| scenario.get().inner().clone());
        let params = bound.iter().flat_map(|scenario| &scenario.params);
        let is_closed = Arc::new(AtomicBool::new(false));
        let options = OpenOptions {
            allow_outside,
            agents: Vec::new(),
            guests: Some(Box::new(PythonGuests { policies, is_closed: is_closed.clone() })),
            params: params.map(|param| (param.name.clone(), param.default)).collect(),
        };
        let opened = interruptible(py, move || {
            let loading = LoadOptions { allow_outside, regions: true, ..LoadOptions::default() };
            let name = path.to_string_lossy();
            match (compiled, text) {
                (Some(scenario), _) => {
                    Ok(Session::of(&path, Loaded::without_text(scenario), options))
                }
                (None, Some(text)) => setpiece::compile_text_with(&text, &name, &loading)
                    .map(|loaded| Session::of(&path, loaded, options)),
                (None, None) => Session::open(&path, None, options),
            }
        })?;
        let session = opened.map_err(|error| errors::from_facade(py, &error))?;
        let serving = ServeOptions { port, framed: true };
        let running = py.detach(|| start(session, serving)).map_err(|why| {
            errors::parameter(py, "port", &format!("the studio can't be served: {why}"))
        })?;
        let (address, port) = (running.address.clone(), running.port);
        Ok(Studio { address, port, is_closed, running: Mutex::new(Some(running)) })
    }

    /// Shows an episode, the bytes of a replay, in every page. False if the studio has ended.
    fn watch(&self, py: Python<'_>, replay: &[u8]) -> PyResult<bool> {
        let replay = Recording::from_bytes(replay);
        let replay = replay.map_err(|error| errors::from_facade(py, &error))?;
        Ok(py.detach(|| {
            let running = self.running.lock().unwrap_or_else(PoisonError::into_inner);
            running.as_ref().is_some_and(|running| running.watch(replay))
        }))
    }

    /// Ends it; the port is free afterwards.
    fn close(&self, py: Python<'_>) {
        self.is_closed.store(true, Ordering::Release);
        py.detach(|| {
            let running = self.running.lock().unwrap_or_else(PoisonError::into_inner).take();
            drop(running);
        });
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        self.is_closed.store(true, Ordering::Release);
    }
}
