//! Environments: one match, its judge, and the arrays that an agent sees.

use crate::actions::{self, ActionSet, GivenAction};
use crate::errors;
use crate::info::{InfoOptions, InfoWriter};
use crate::level;
use crate::observation::{self, BlockInfo, ObservationForm, ObservationKind, Observer, Wanted};
use crate::options::EnvOptions;
use crate::params::{bind, to_python};
use crate::picture::Frames;
use crate::replay::Replay;
use crate::scenario::Scenario;
use crate::seats::read as read_seats;
use crate::video::Moment;

use numpy::{PyArray1, PyArray3};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};
use setpiece::Error;
use setpiece::engine::batch::EpisodeError;
use setpiece::engine::environment::{
    Environment as Engine, EnvironmentError, EnvironmentOptions, ResetError, Scratch,
};
use setpiece::engine::judge::Outcome;
use setpiece::engine::observe::{SMM_HEIGHT, SMM_WIDTH};
use setpiece::engine::snapshot::SnapshotError;
use setpiece::engine::state::PlayerId;
use setpiece::replay::{Recorder, Replay as Recording};
use setpiece::scenario::pitch::TEAM_MAX;
use setpiece::scenario::{self as compiled, Action, Team, Verdict};
use std::sync::Arc;

/// Width and height of GRF's super mini map.
pub(crate) const SMM_SIZE: (usize, usize) = (SMM_WIDTH, SMM_HEIGHT);

/// An agent of an environment.
#[pyclass(frozen, module = "setpiece._native")]
pub(crate) struct AgentInfo {
    /// Its id: a player's name, `left_CM_1`, or `left_0` for one that changes players.
    #[pyo3(get)]
    id: String,
    /// Its team: 0 left, 1 right.
    #[pyo3(get)]
    team: usize,
    /// The index in its team of the player it keeps; `None` if it changes players.
    #[pyo3(get)]
    place: Option<usize>,
}

/// The key of an episode of a scenario.
#[pyclass(frozen, get_all, module = "setpiece._native")]
pub(crate) struct EpisodeKey {
    /// The seed of its series.
    seed: u64,
    /// Its index in the series.
    index: u64,
}

/// One match of a scenario, judged and observed: the core of `setpiece.FootballEnv`.
#[pyclass(module = "setpiece._native")]
pub(crate) struct Environment {
    engine: Engine,
    scratch: Scratch,
    observer: Observer,
    info: InfoWriter,
    action_set: ActionSet,
    kind: ObservationKind,
    stack: usize,
    acts: Vec<GivenAction>,
    actions: Vec<Action>,
    recorder: Recorder,
    frames: Frames,
}

#[pymethods]
impl Environment {
    #[new]
    fn new(py: Python<'_>, scenario: &Scenario, options: EnvOptions<'_>) -> PyResult<Environment> {
        let Prepared { engine, kind, action_set } = prepare(py, scenario.inner(), &options)?;
        let info = InfoOptions {
            actions: action_set,
            events: options.events,
            bot_action: options.bot_action,
        };
        Environment::around(py, engine, kind, options.shown(), info)
    }

    /// The agents, left before right.
    #[getter]
    fn agents(&self) -> Vec<AgentInfo> {
        agents_of(&self.engine)
    }

    /// The names of the numbers of the scenario's own observation, in order; empty without one.
    #[getter]
    fn observed(&self) -> Vec<String> {
        self.engine.observed_names()
    }

    /// The number of held actions in raw observations.
    #[getter]
    fn held_actions(&self) -> usize {
        self.action_set.held()
    }

    /// The shape of one agent's observation; empty for a dict.
    #[getter]
    fn observation_shape(&self) -> Vec<usize> {
        self.kind.shape(&self.engine, self.stack)
    }

    /// The blocks of an observation of floats.
    #[getter]
    fn blocks(&self) -> Vec<BlockInfo> {
        observation::blocks(self.kind, &self.engine)
    }

    /// Bounds of every number of one observation of floats: two float32 `(n,)`; none for others.
    #[getter]
    fn bounds(&self, py: Python<'_>) -> Option<observation::Bounds> {
        let ObservationKind::Floats(floats) = self.kind else { return None };
        Some(observation::bounds(py, floats, &self.engine))
    }

    /// The current observations of all agents, of any kind. Looking changes nothing.
    #[pyo3(signature = (observation, scale = false))]
    fn look<'py>(
        &mut self,
        py: Python<'py>,
        observation: &str,
        scale: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let kind = Wanted { name: observation, size: SMM_SIZE, scale }.of(py, &self.engine)?;
        let held = self.action_set.held();
        let mut observer = Observer::new(py, kind, &self.engine, ObservationForm::FRESH, held)?;
        observer.observe(py, &mut self.engine, true)
    }

    /// The content of a stack of observations, as bytes.
    fn frames<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.observer.frames())
    }

    /// Restores the content of a stack of observations.
    fn set_frames(&mut self, frames: &[u8]) {
        self.observer.set_frames(frames);
    }

    /// Players of the left and the right team, as raw observations count them.
    #[getter]
    fn players(&self) -> (usize, usize) {
        players_of(&self.engine)
    }

    /// Replaces the scripts by those of another version of the scenario, at once. False, without
    /// any effect, if anything else differs.
    fn adopt_scripts(&mut self, py: Python<'_>, scenario: &Scenario) -> PyResult<bool> {
        let adopted =
            self.engine.adopt_scripts(scenario.inner()).map_err(|error| from_engine(py, error))?;
        if adopted {
            // The recording began with other scripts.
            self.recorder.invalidate();
        }
        Ok(adopted)
    }

    /// Begins the episode of a seed and an index with parameters, optionally in the state of a
    /// snapshot. Returns observation and info.
    #[pyo3(signature = (seed, episode, params, snapshot = None))]
    fn reset<'py>(
        &mut self,
        py: Python<'py>,
        seed: u64,
        episode: u64,
        params: &Bound<'py, PyDict>,
        snapshot: Option<&[u8]>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>)> {
        let bindings = bind(py, &self.engine.scenario().params, params)?;
        self.recorder.invalidate();
        self.engine.set_bindings(&bindings).map_err(|error| from_engine(py, error))?;
        let engine = &mut self.engine;
        py.detach(|| match snapshot {
            Some(snapshot) => engine.reset_from(snapshot, Some(seed), Some(episode)),
            None => Ok(engine.reset(Some(seed), Some(episode))?),
        })
        .map_err(|why| match why {
            ResetError::Snapshot(why) => from_snapshot(py, why),
            ResetError::Draw(why) => from_episode(py, why.into()),
        })?;
        self.recorder.begin(snapshot);
        self.frames.begin();
        self.seen(py)
    }

    /// The episode as bytes.
    fn snapshot<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = py.detach(|| self.engine.snapshot()).map_err(|why| from_snapshot(py, why))?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Continues from a snapshot; returns the observation and info of its step.
    fn restore<'py>(
        &mut self,
        py: Python<'py>,
        snapshot: &[u8],
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>)> {
        let engine = &mut self.engine;
        py.detach(|| engine.restore(snapshot)).map_err(|why| from_snapshot(py, why))?;
        self.recorder.invalidate();
        self.frames.begin();
        self.seen(py)
    }

    /// Seed and index of the episode; None before the first.
    #[getter]
    fn episode(&self) -> Option<EpisodeKey> {
        let engine = &self.engine;
        engine.has_begun().then(|| EpisodeKey { seed: engine.seed(), index: engine.index() })
    }

    /// The level of the episode as text; None before the first.
    #[getter]
    fn level(&self) -> Option<String> {
        let engine = &self.engine;
        engine.has_begun().then(|| level::of_episode(engine, engine.bindings()))
    }

    /// Whether each agent's player was sent off, leaving it nobody to control.
    #[getter]
    fn gone(&self) -> Vec<bool> {
        let game = self.engine.state();
        let left = |player: PlayerId| game.player(player).active;
        self.engine.agents().iter().map(|slot| !slot.player.is_some_and(left)).collect()
    }

    /// How many steps of the episode have been played.
    #[getter]
    fn steps(&self) -> u32 {
        self.engine.steps()
    }

    /// Whether it can be stepped.
    #[getter]
    fn running(&self) -> bool {
        self.engine.is_running()
    }

    /// The parameters' values, by name.
    #[getter]
    fn params<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let params = PyDict::new(py);
        for (param, &value) in self.engine.scenario().params.iter().zip(&self.engine.bindings().0) {
            params.set_item(&param.name, to_python(py, param, value)?)?;
        }
        Ok(params)
    }

    /// Plays a step; returns observation, reward, terminated, truncated and info. Releases the
    /// interpreter lock while playing.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        action: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        actions::read(action, self.action_set, &mut self.acts)?;
        for agent in 0..self.acts.len() {
            self.press(agent, self.acts[agent]);
        }
        self.play(py, None)
    }

    /// Ends the episode now for a reason of the caller's; returns outcome, records and summary.
    fn end<'py>(
        &mut self,
        py: Python<'py>,
        label: &str,
        success: bool,
        truncated: bool,
    ) -> PyResult<Bound<'py, PyDict>> {
        let verdict = success.then_some(Verdict::Success);
        self.engine.end(Outcome { label: label.into(), verdict, truncated });
        let summary = PyDict::new(py);
        self.info.sum_up(py, &self.engine, &summary)?;
        Ok(summary)
    }

    /// Plays the step of a recorded episode: like `step`, with the recorded actions.
    fn replayed<'py>(&mut self, py: Python<'py>, replay: &Replay) -> PyResult<Bound<'py, PyTuple>> {
        let n_agents = self.actions.len();
        let acts =
            replay.inner().acts().skip(self.engine.steps() as usize * n_agents).take(n_agents);
        for (agent, (action, steer)) in acts.enumerate() {
            self.press(agent, GivenAction { action, steer });
        }
        self.play(py, Some(replay.inner()))
    }

    /// The fingerprint of the state, 16 hexadecimal digits.
    #[getter]
    fn digest(&self) -> String {
        format!("{:016x}", self.engine.digest())
    }

    /// The episode as far as it has been played, as the bytes of a replay.
    fn replay<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes =
            Recording::of(&self.engine, &self.recorder).and_then(|replay| replay.to_bytes());
        Ok(PyBytes::new(py, &bytes.map_err(|why| errors::from_facade(py, &why))?))
    }

    /// What every player pressed in the last step, by name.
    fn played<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.info.played(py, &self.engine)
    }

    /// 1 for actions with an effect now, else 0: int8 `(19,)`, or `(n, 19)` for n agents; 20 with
    /// `v2`, 33 with `full`, the 6 kinds with `continuous`.
    fn action_mask<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.info.action_mask(py, &self.engine)
    }

    /// The current frame for people: uint8 `(height, width, 3)`. Without `news` it depends on the
    /// state alone.
    #[pyo3(signature = (size, camera, news = true))]
    fn frame<'py>(
        &mut self,
        py: Python<'py>,
        size: (usize, usize),
        camera: &str,
        news: bool,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        self.frames.frame(py, &self.engine, size, camera, news)
    }

    /// The moments that the last step led to: where play was stopped, if it was, and the present.
    fn moments(&self) -> Vec<Moment> {
        let stopped = !std::ptr::eq(self.engine.judged_state(), self.engine.state());
        let mut now = self.frames.moment(&self.engine, false);
        now.placed = stopped || self.engine.steps() == 0;
        let before = stopped.then(|| self.frames.moment(&self.engine, true));
        before.into_iter().chain([now]).map(Moment::of).collect()
    }

    /// A drawing of the pitch in text.
    fn drawing(&self) -> String {
        setpiece::drawing::draw(self.engine.state())
    }
}

impl Environment {
    /// Wraps an engine with its observer and info writer.
    pub(crate) fn around(
        py: Python<'_>,
        engine: Engine,
        kind: ObservationKind,
        shown: ObservationForm,
        info: InfoOptions,
    ) -> PyResult<Environment> {
        let action_set = info.actions;
        Ok(Environment {
            kind,
            stack: shown.stack,
            action_set,
            observer: Observer::new(py, kind, &engine, shown, action_set.held())?,
            info: InfoWriter::new(py, &engine, info),
            acts: vec![GivenAction::IDLE; engine.n_agents()],
            actions: vec![Action::Idle; engine.n_agents()],
            scratch: Scratch::default(),
            recorder: Recorder::default(),
            frames: Frames::default(),
            engine,
        })
    }

    /// Sets an agent's action of the next step.
    fn press(&mut self, agent: usize, act: GivenAction) {
        self.actions[agent] = act.action;
        if act.steer.is_some() {
            self.engine.steer(agent, act.steer);
        }
        self.recorder.note(act.action, act.steer);
    }

    /// Plays the step, with the actions of a recorded episode if given.
    fn play<'py>(
        &mut self,
        py: Python<'py>,
        recorded: Option<&Recording>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let (engine, scratch, actions) = (&mut self.engine, &mut self.scratch, &self.actions);
        let played = py.detach(|| engine.step(actions, scratch));
        played.map_err(|why| {
            self.recorder.keep(self.engine.steps(), self.actions.len());
            from_episode(py, why.into())
        })?;
        if let Some(recorded) = recorded {
            recorded.end(&mut self.engine);
        }
        self.frames.note(&self.engine);
        let observation = self.observer.observe(py, &mut self.engine, false)?;
        let reward = match self.engine.rewards() {
            [one] => f64::from(*one).into_pyobject(py)?.into_any(),
            several => PyArray1::from_slice(py, several).into_any(),
        };
        let info = self.info.write(py, &self.engine)?;
        let truncated = self.engine.outcome().is_some_and(|outcome| outcome.truncated);
        let terminated = self.engine.outcome().is_some_and(|outcome| !outcome.truncated);
        (observation, reward, terminated, truncated, info).into_pyobject(py)
    }

    /// The observation and the info.
    fn seen<'py>(&mut self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>)> {
        Ok((self.observer.observe(py, &mut self.engine, true)?, self.info.write(py, &self.engine)?))
    }
}

/// The agents of an engine, left before right.
pub(crate) fn agents_of(engine: &Engine) -> Vec<AgentInfo> {
    let agents = engine.agent_ids().iter().zip(&engine.roster().agents);
    agents
        .map(|(id, (team, player))| AgentInfo {
            id: id.clone(),
            team: team.index(),
            place: player.map(|player| player.index() % TEAM_MAX),
        })
        .collect()
}

/// The agents that a scenario would have, left before right.
#[pyfunction]
pub(crate) fn agents(
    py: Python<'_>,
    scenario: &Scenario,
    options: EnvOptions<'_>,
) -> PyResult<Vec<AgentInfo>> {
    let agents = read_seats(py, &options.seats())?;
    let options = EnvironmentOptions { agents, ..EnvironmentOptions::default() };
    let engine =
        Engine::new(scenario.inner().clone(), options).map_err(|error| from_engine(py, error))?;
    Ok(agents_of(&engine))
}

/// Players of the left and the right team, as raw observations count them.
pub(crate) fn players_of(engine: &Engine) -> (usize, usize) {
    let present = engine.roster().present;
    let count = |team: Team| {
        (0..TEAM_MAX).filter(|&place| present[PlayerId::new(team, place).index()]).count()
    };
    (count(Team::Left), count(Team::Right))
}

/// An engine with its observation and action set.
pub(crate) struct Prepared {
    pub(crate) engine: Engine,
    pub(crate) kind: ObservationKind,
    pub(crate) action_set: ActionSet,
}

/// Creates the validated engine of a scenario with its agents, observation and action set.
pub(crate) fn prepare(
    py: Python<'_>,
    scenario: &Arc<compiled::Scenario>,
    options: &EnvOptions<'_>,
) -> PyResult<Prepared> {
    let (rewards, agents) = (options.rewards.clone(), read_seats(py, &options.seats())?);
    let engine = Engine::new(
        scenario.clone(),
        EnvironmentOptions { rewards, agents, ..EnvironmentOptions::default() },
    )
    .map_err(|error| from_engine(py, error))?;
    let kind = options.wanted().of(py, &engine)?;
    let action_set = ActionSet::from_name(&options.action_set).ok_or_else(|| {
        errors::parameter(py, "action_set", &format!("no action set `{}`", options.action_set))
    })?;
    Ok(Prepared { engine, kind, action_set })
}

pub(crate) fn from_snapshot(py: Python<'_>, why: SnapshotError) -> PyErr {
    errors::from_facade(py, &Error::Snapshot(why))
}

pub(crate) fn from_engine(py: Python<'_>, error: EnvironmentError) -> PyErr {
    errors::from_facade(py, &Error::Environment(error))
}

pub(crate) fn from_episode(py: Python<'_>, error: EpisodeError) -> PyErr {
    errors::from_facade(py, &Error::Episode(Box::new(error)))
}
