//! Environments: one match, its judge, and the arrays an agent sees.

use crate::info::InfoWriter;
use crate::observation::{Kind, Observer};
use crate::params::bind;
use crate::scenario::Scenario;
use crate::{actions, errors};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use setpiece::Error;
use setpiece::engine::batch::EpisodeError;
use setpiece::engine::environment::{Environment as Engine, EnvironmentError, EnvironmentOptions, Scratch};
use setpiece::engine::state::PlayerId;
use setpiece::scenario::pitch::TEAM_MAX;
use setpiece::scenario::{Action, Team};

/// Who acts: an agent of an environment.
#[pyclass(frozen, module = "setpiece._native")]
pub(crate) struct AgentInfo {
    /// Its id: a player's name, `left_CM_1`, or `left_0` for one that changes players.
    #[pyo3(get)]
    id: String,
    /// Its team: 0 left, 1 right.
    #[pyo3(get)]
    team: usize,
}

/// One match of a scenario, judged and observed: what `setpiece.FootballEnv` is made of.
#[pyclass(module = "setpiece._native")]
pub(crate) struct Environment {
    engine: Engine,
    scratch: Scratch,
    observer: Observer,
    info: InfoWriter,
    actions: Vec<Action>,
}

#[pymethods]
impl Environment {
    #[new]
    #[pyo3(signature = (scenario, *, observation, rewards, events, copy))]
    fn new(
        py: Python<'_>,
        scenario: &Scenario,
        observation: &str,
        rewards: Option<Vec<String>>,
        events: bool,
        copy: bool,
    ) -> PyResult<Environment> {
        let options = EnvironmentOptions { rewards, ..EnvironmentOptions::default() };
        let engine = Engine::new(scenario.inner().clone(), options).map_err(|error| from_engine(py, error))?;
        if engine.n_agents() == 0 {
            let message = format!("scenario `{}` has no agents: nobody to act for", scenario.inner().name);
            return Err(errors::parameter(py, "scenario", &message));
        }
        let kind = Kind::from_name(observation)
            .ok_or_else(|| errors::parameter(py, "observation", &format!("no observation `{observation}`")))?;
        Ok(Environment {
            observer: {
                if matches!(kind, Kind::Vector) && engine.observed_names().is_empty() {
                    let name = &engine.scenario().name;
                    let message = format!("`{name}` declares no observation: it has no `observe vector {{ … }}`");
                    return Err(errors::parameter(py, "observation", &message));
                }
                Observer::new(py, kind, &engine, copy)
            },
            info: InfoWriter::new(py, &engine, events),
            actions: vec![Action::Idle; engine.n_agents()],
            scratch: Scratch::default(),
            engine,
        })
    }

    /// The agents, left before right.
    #[getter]
    fn agents(&self) -> Vec<AgentInfo> {
        let teams = self.engine.roster().agents.iter().map(|(team, _)| team.index());
        self.engine.agent_ids().iter().zip(teams).map(|(id, team)| AgentInfo { id: id.clone(), team }).collect()
    }

    /// The names of the numbers of the scenario's own observation, in order; empty without one.
    #[getter]
    fn observed(&self) -> Vec<String> {
        self.engine.observed_names()
    }

    /// Players of the left and the right team, as raw observations count them.
    #[getter]
    fn players(&self) -> (usize, usize) {
        let present = self.engine.roster().present;
        let count = |team: Team| (0..TEAM_MAX).filter(|&place| present[PlayerId::new(team, place).index()]).count();
        (count(Team::Left), count(Team::Right))
    }

    /// Goes on with another version of the scenario's scripts at once; False, and nothing done, where anything else is
    /// another.
    fn adopt_scripts(&mut self, py: Python<'_>, scenario: &Scenario) -> PyResult<bool> {
        self.engine.adopt_scripts(scenario.inner()).map_err(|error| from_engine(py, error))
    }

    /// Begins the episode of a seed and an index under parameters; returns observation and info.
    fn reset<'py>(
        &mut self,
        py: Python<'py>,
        seed: u64,
        episode: u64,
        params: &Bound<'py, PyDict>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>)> {
        let bindings = bind(py, &self.engine.scenario().params, params)?;
        self.engine.set_bindings(&bindings).map_err(|error| from_engine(py, error))?;
        let engine = &mut self.engine;
        py.detach(|| engine.reset(Some(seed), Some(episode))).map_err(|why| from_episode(py, why.into()))?;
        Ok((self.observer.observe(py, &mut self.engine)?, self.info.write(py, &self.engine)?))
    }

    /// Plays a step; returns observation, reward, terminated, truncated and info. Releases the interpreter meanwhile.
    fn step<'py>(&mut self, py: Python<'py>, action: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyTuple>> {
        actions::read(action, &mut self.actions)?;
        let (engine, scratch, actions) = (&mut self.engine, &mut self.scratch, &self.actions);
        let result = py.detach(|| engine.step(actions, scratch)).map_err(|why| from_episode(py, why.into()))?;
        let observation = self.observer.observe(py, &mut self.engine)?;
        let reward = match self.engine.rewards() {
            [one] => f64::from(*one).into_pyobject(py)?.into_any(),
            several => PyArray1::from_slice(py, several).into_any(),
        };
        let info = self.info.write(py, &self.engine)?;
        (observation, reward, result.terminated, result.truncated, info).into_pyobject(py)
    }

    /// 1 where an action can change something now, else 0: int8 `(19,)`, or `(n, 19)` for n agents.
    fn action_mask<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        crate::info::action_mask(py, &self.engine)
    }

    /// A drawing of the pitch in text.
    fn drawing(&self) -> String {
        setpiece::drawing::draw(self.engine.state())
    }
}

fn from_engine(py: Python<'_>, error: EnvironmentError) -> PyErr {
    errors::from_facade(py, &Error::Environment(error))
}

fn from_episode(py: Python<'_>, error: EpisodeError) -> PyErr {
    errors::from_facade(py, &Error::Episode(Box::new(error)))
}
