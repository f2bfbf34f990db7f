//! Many matches in one: the core of `setpiece.FootballVectorEnv`.
//!
//! Everything that an agent sees is in arrays with a row per environment. They are written in
//! place, on a few threads, without the interpreter.

mod lane;
mod levels;
mod stage;

use crate::actions::{self, ActionSet, GivenAction};
use crate::environment::{
    AgentInfo, Prepared, SMM_SIZE, agents_of, from_episode, players_of, prepare,
};
use crate::errors;
use crate::info::records;
use crate::level;
use crate::observation::{self, BlockInfo, ObservationForm, ObservationKind, Observer, Wanted};
use crate::options::EnvOptions;
use crate::params::bind;
use crate::picture::Frames;
use crate::scenario::Scenario;
use lane::{BatchLane, BatchRow, LaneFailure, NewestObservations, Rows};
use levels::{BatchStages, GivenLevel, LevelsArgument, LevelsOfBatch, from_unfit};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use setpiece::engine::batch::{Batch as Lanes, EpisodeSummary};
use setpiece::engine::environment::Scratch;
use setpiece::scenario::{Action, Bindings, Verdict};
use stage::Upcoming;
use std::sync::PoisonError;

/// Several matches of one scenario that are stepped together.
#[pyclass(module = "setpiece._native")]
pub(crate) struct Batch {
    lanes: Lanes<BatchLane>,
    stages: BatchStages,
    source: Option<LevelsOfBatch>,
    kind: ObservationKind,
    stack: usize,
    action_set: ActionSet,
    /// Whether a step begins the next episode after one has ended.
    next_step: bool,
    acts: Vec<GivenAction>,
    frames: Frames,
    /// The process that owns the threads.
    process: u32,
}

/// The arrays of a batch, with a row per environment: rewards (n, agents), terms (n, agents,
/// terms), masks (n, agents, actions), score (n, 2), terminated, truncated, begun (n).
#[pyclass(module = "setpiece._native", frozen)]
pub(crate) struct Arrays {
    #[pyo3(get)]
    observations: Py<PyAny>,
    #[pyo3(get)]
    rewards: Py<PyArray2<f64>>,
    #[pyo3(get)]
    terms: Py<PyArrayDyn<f64>>,
    #[pyo3(get)]
    masks: Py<PyArrayDyn<i8>>,
    #[pyo3(get)]
    score: Py<PyArray2<i64>>,
    #[pyo3(get)]
    terminated: Py<PyArray1<bool>>,
    #[pyo3(get)]
    truncated: Py<PyArray1<bool>>,
    #[pyo3(get)]
    begun: Py<PyArray1<bool>>,
}

#[pymethods]
impl Batch {
    #[new]
    #[pyo3(signature = (scenario, n, options, *, threads, next_step, levels = None))]
    fn new(
        py: Python<'_>,
        scenario: &Scenario,
        n: usize,
        options: &Bound<'_, PyAny>,
        threads: usize,
        next_step: bool,
        levels: Option<LevelsArgument<'_>>,
    ) -> PyResult<Batch> {
        let given: EnvOptions<'_> = options.extract()?;
        let Prepared { engine, kind, action_set } = prepare(py, scenario.inner(), &given)?;
        let shown = given.shown();
        let (stages, source) = BatchStages::new(py, engine.clone(), kind, options, levels)?;
        let acts = vec![GivenAction::IDLE; n * engine.n_agents()];
        let lane = || {
            let film = NewestObservations::new(py, kind, &engine, shown)?.ok_or_else(|| {
                let message =
                    "raw observations are dicts, which a vector environment doesn't stack";
                errors::parameter(py, "observation", message)
            })?;
            let engine = engine.clone();
            let played = engine.bindings().clone();
            let stage = stages.first().clone();
            let (upcoming, chosen, failure) = (None, None, None);
            Ok(BatchLane {
                engine,
                stage,
                upcoming,
                chosen,
                film,
                played,
                over: true,
                rests: false,
                failure,
            })
        };
        let all: PyResult<Vec<BatchLane>> = (0..n).map(|_| lane()).collect();
        let lanes = Lanes::new(all?, threads)
            .map_err(|why| errors::raise_plain(py, "SetpieceError", &why.to_string()))?;
        Ok(Batch {
            lanes,
            stages,
            source,
            kind,
            stack: shown.stack,
            action_set,
            next_step,
            acts,
            frames: Frames::default(),
            process: std::process::id(),
        })
    }

    /// The agents of each environment, left before right.
    #[getter]
    fn agents(&self) -> Vec<AgentInfo> {
        self.lanes.lanes().first().map(|lane| agents_of(&lane.engine)).unwrap_or_default()
    }

    /// Players of the left and the right team.
    #[getter]
    fn players(&self) -> (usize, usize) {
        self.lanes.lanes().first().map(|lane| players_of(&lane.engine)).unwrap_or_default()
    }

    /// The number of held actions in raw observations.
    #[getter]
    fn held_actions(&self) -> usize {
        self.action_set.held()
    }

    /// The shape of one agent's observation.
    #[getter]
    fn observation_shape(&self) -> Vec<usize> {
        self.lanes
            .lanes()
            .first()
            .map(|lane| self.kind.shape(&lane.engine, self.stack))
            .unwrap_or_default()
    }

    /// The blocks of an observation of floats.
    #[getter]
    fn blocks(&self) -> Vec<BlockInfo> {
        self.lanes
            .lanes()
            .first()
            .map(|lane| observation::blocks(self.kind, &lane.engine))
            .unwrap_or_default()
    }

    /// Bounds of every number of one observation of floats; none for others.
    #[getter]
    fn bounds(&self, py: Python<'_>) -> Option<observation::Bounds> {
        let (ObservationKind::Floats(floats), Some(lane)) = (self.kind, self.lanes.lanes().first())
        else {
            return None;
        };
        Some(observation::bounds(py, floats, &lane.engine))
    }

    /// The names of the reward terms, in the order of the arrays.
    #[getter]
    fn terms(&self) -> Vec<String> {
        self.stages.terms().to_vec()
    }

    /// New arrays for this batch.
    fn arrays(&self, py: Python<'_>) -> PyResult<Arrays> {
        let n = self.lanes.lanes().len();
        let Some(lane) = self.lanes.lanes().first() else {
            return Err(errors::parameter(py, "num_envs", "a batch has at least one environment"));
        };
        let agents = lane.engine.n_agents();
        let shape: Vec<usize> =
            [n, agents].into_iter().chain(self.kind.shape(&lane.engine, self.stack)).collect();
        let observations = match self.kind {
            ObservationKind::Floats(_) => PyArrayDyn::<f32>::zeros(py, shape, false).into_any(),
            _ => PyArrayDyn::<u8>::zeros(py, shape, false).into_any(),
        };
        let terms = self.stages.terms().len();
        Ok(Arrays {
            observations: observations.unbind(),
            rewards: PyArray2::zeros(py, [n, agents], false).unbind(),
            terms: PyArrayDyn::zeros(py, vec![n, agents, terms], false).unbind(),
            masks: PyArrayDyn::zeros(py, vec![n, agents, self.action_set.masked().len()], false)
                .unbind(),
            score: PyArray2::zeros(py, [n, 2], false).unbind(),
            terminated: PyArray1::zeros(py, n, false).unbind(),
            truncated: PyArray1::zeros(py, n, false).unbind(),
            begun: PyArray1::zeros(py, n, false).unbind(),
        })
    }

    /// Binds parameters of each environment that has some, from its next episode on; of all or, if
    /// it fails, of none.
    fn bind(&mut self, py: Python<'_>, params: Vec<Option<Bound<'_, PyDict>>>) -> PyResult<()> {
        let mut earlier: Vec<(usize, Bindings)> = Vec::new();
        let lanes = self.lanes.lanes_mut();
        for (at, params) in params.iter().enumerate() {
            let (Some(lane), Some(params)) = (lanes.get_mut(at), params) else { continue };
            let bound = bind(py, &lane.engine.scenario().params, params).and_then(|bindings| {
                earlier.push((at, lane.engine.bindings().clone()));
                let set = lane.engine.set_bindings(&bindings);
                set.map_err(|error| crate::environment::from_engine(py, error))
            });
            if let Err(error) = bound {
                for (at, bindings) in &earlier {
                    // They were bound before, so they still can be.
                    let _ = lanes[*at].engine.set_bindings(bindings);
                }
                return Err(error);
            }
        }
        Ok(())
    }

    /// The scenarios that have been named so far; the first is the one that it was made of.
    #[getter]
    fn scenarios(&self, py: Python<'_>) -> Vec<Scenario> {
        self.stages.scenarios(py)
    }

    /// The levels that are played, as text.
    #[getter]
    fn levels(&self) -> Vec<String> {
        let text = |lane: &BatchLane| level::of_episode(&lane.engine, &lane.played);
        self.lanes.lanes().iter().map(text).collect()
    }

    /// How many steps of each environment's episode have been played.
    #[getter]
    fn steps(&self) -> Vec<u32> {
        self.lanes.lanes().iter().map(|lane| lane.engine.steps()).collect()
    }

    /// The scenario and the parameters of an environment's episode.
    fn played<'py>(
        &self,
        py: Python<'py>,
        at: usize,
    ) -> PyResult<Option<(Scenario, Bound<'py, PyDict>)>> {
        self.lanes.lanes().get(at).map(|lane| lane.played(py)).transpose()
    }

    /// Sets the levels that environments begin next; of all or, if it fails, of none.
    fn assign(&mut self, py: Python<'_>, levels: Vec<Option<GivenLevel<'_>>>) -> PyResult<()> {
        let mut upcoming = Vec::with_capacity(levels.len());
        for given in &levels {
            let level = given.as_ref().map(|given| self.stages.upcoming(py, given)).transpose()?;
            if let Some(level) = &level {
                let mut engine = level.stage.engine.clone();
                let bound = level.stage.bind(&mut engine, &level.bindings);
                bound.map_err(|why| from_unfit(py, &engine, why))?;
            }
            upcoming.push(level);
        }
        for (lane, level) in self.lanes.lanes_mut().iter_mut().zip(upcoming) {
            if level.is_some() {
                lane.upcoming = level;
            }
        }
        Ok(())
    }

    /// Begins episodes of the environments that `which` marks, each with its level if one is set,
    /// with its seed, with the next level of the source, or with its next index. With `keep` the
    /// arrays still show how the last episode ended, next to the first observation of the new one.
    fn reset(
        &mut self,
        py: Python<'_>,
        arrays: &Arrays,
        which: Vec<bool>,
        seeds: Vec<Option<u64>>,
        episodes: Vec<Option<u64>>,
        keep: bool,
    ) -> PyResult<()> {
        let order: Vec<(bool, Option<u64>, Option<u64>)> = which
            .into_iter()
            .zip(seeds)
            .zip(episodes)
            .map(|((which, seed), index)| (which, seed, index))
            .collect();
        if order.len() != self.lanes.lanes().len() {
            return Err(errors::parameter(
                py,
                "reset_mask",
                &format!("expected {} entries", self.lanes.lanes().len()),
            ));
        }
        let action_set = self.action_set;
        self.ask(py, |at, _| matches!(order[at], (true, None, None)))?;
        self.each(py, arrays, |at, lane, row, _| {
            let (which, seed, index) = order[at];
            if which {
                lane.begin(seed, index, action_set, keep, row);
            }
        })?;
        self.raise_failure(py)
    }

    /// Plays a step of every environment. Those whose episode has ended begin the next, according
    /// to their mode.
    fn step(&mut self, py: Python<'_>, arrays: &Arrays, action: &Bound<'_, PyAny>) -> PyResult<()> {
        self.read(action)?;
        let agents = self.acts.len() / self.lanes.lanes().len().max(1);
        let (action_set, next_step) = (self.action_set, self.next_step);
        if !next_step && let Some(at) = self.lanes.lanes().iter().position(|lane| lane.over) {
            let message = format!(
                "the episode of environment {at} has ended: call `reset` with a `reset_mask` that names it"
            );
            return Err(errors::raise_plain(py, "SetpieceError", &message));
        }
        if next_step {
            self.ask(py, |_, lane| lane.over)?;
        }
        let acts = std::mem::take(&mut self.acts);
        let played = self.each(py, arrays, |at, lane, row, scratch| {
            lane.step(&acts[at * agents..(at + 1) * agents], next_step, action_set, row, scratch);
        });
        self.acts = acts;
        played?;
        self.report();
        self.raise_failure(py)
    }

    /// The summary of an environment's ended episode: outcome, records, success, length, seed,
    /// index, level, digest, faults, return by term and agent.
    fn summary<'py>(&self, py: Python<'py>, at: usize) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(lane) = self.lanes.lanes().get(at) else { return Ok(None) };
        let engine = &lane.engine;
        let Some(outcome) = engine.outcome() else { return Ok(None) };
        let dict = PyDict::new(py);
        dict.set_item("outcome", &*outcome.label)?;
        dict.set_item("records", records(py, engine)?)?;
        dict.set_item("success", outcome.verdict == Some(Verdict::Success))?;
        dict.set_item("length", engine.steps())?;
        dict.set_item("seed", engine.seed())?;
        dict.set_item("index", engine.index())?;
        dict.set_item("level", level::of_episode(engine, &lane.played))?;
        dict.set_item("scenario", format!("{:016x}", engine.scenario_digest()))?;
        dict.set_item("digest", format!("{:016x}", engine.digest()))?;
        dict.set_item("faults", engine.faults())?;
        let sums = |agent| {
            let mut row = vec![0.0; self.stages.terms().len()];
            lane.stage.enter(engine.term_sums(agent), &mut row);
            PyList::new(py, row)
        };
        let sums: PyResult<Vec<_>> = (0..engine.n_agents()).map(sums).collect();
        dict.set_item("return", PyList::new(py, sums?)?)?;
        Ok(Some(dict))
    }

    /// The current observations of all agents of each environment, of any kind. Looking changes
    /// nothing.
    #[pyo3(signature = (observation, scale = false))]
    fn look<'py>(
        &mut self,
        py: Python<'py>,
        observation: &str,
        scale: bool,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let wanted = Wanted { name: observation, size: SMM_SIZE, scale };
        let held = self.action_set.held();
        let look = |lane: &mut BatchLane| {
            let kind = wanted.of(py, &lane.engine)?;
            Observer::new(py, kind, &lane.engine, ObservationForm::FRESH, held)?.observe(
                py,
                &mut lane.engine,
                true,
            )
        };
        self.lanes.lanes_mut().iter_mut().map(look).collect()
    }

    /// The current frame of an environment for people: uint8 `(height, width, 3)`.
    fn frame<'py>(
        &mut self,
        py: Python<'py>,
        at: usize,
        size: (usize, usize),
        camera: &str,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let Some(lane) = self.lanes.lanes().get(at) else {
            return Err(errors::parameter(py, "at", &format!("no environment {at}")));
        };
        self.frames.frame(py, &lane.engine, size, camera, false)
    }

    /// A drawing of an environment's pitch in text.
    fn drawing(&self, at: usize) -> String {
        self.lanes
            .lanes()
            .get(at)
            .map(|lane| setpiece::drawing::draw(lane.engine.state()))
            .unwrap_or_default()
    }
}

impl Batch {
    /// Reads everyone's actions: integers `(n,)` or `(n, agents)`; with continuous actions a last
    /// axis of four.
    fn read(&mut self, given: &Bound<'_, PyAny>) -> PyResult<()> {
        let py = given.py();
        let flat = given.call_method1("reshape", (-1,)).ok();
        if let (ActionSet::Keys(size), Some(array)) = (self.action_set, flat)
            && let Ok(array) = array.cast::<PyArray1<i64>>()
        {
            let numbers = array.readonly();
            let numbers = numbers.as_array();
            if numbers.len() == self.acts.len() {
                for (at, (act, &number)) in self.acts.iter_mut().zip(numbers.iter()).enumerate() {
                    let known = usize::try_from(number).ok().filter(|&number| number < size);
                    let Some(action) = known.and_then(Action::from_index) else {
                        let message =
                            format!("expected actions 0..{}, found {number} at {at}", size - 1);
                        return Err(errors::raise_plain(py, "ActionError", &message));
                    };
                    *act = GivenAction { action, steer: None };
                }
                return Ok(());
            }
        }
        let numpy = py.import("numpy")?;
        let given = numpy.call_method1("asarray", (given,))?;
        let rows = match self.action_set {
            ActionSet::Keys(_) => given.call_method1("reshape", (self.acts.len(),)),
            ActionSet::Continuous => given.call_method1("reshape", (self.acts.len(), 4)),
        };
        match rows {
            Ok(rows) if self.acts.len() == 1 && self.action_set != ActionSet::Continuous => {
                actions::read(&rows.get_item(0)?, self.action_set, &mut self.acts)
            }
            Ok(rows) => actions::read(&rows, self.action_set, &mut self.acts),
            Err(_) => actions::read(&given, self.action_set, &mut self.acts),
        }
    }

    /// Runs a function on every match and its row, on the threads.
    fn each(
        &mut self,
        py: Python<'_>,
        arrays: &Arrays,
        work: impl Fn(usize, &mut BatchLane, BatchRow<'_>, &mut Scratch) + Sync,
    ) -> PyResult<()> {
        let n = self.lanes.lanes().len();
        let lost = || {
            errors::raise_plain(py, "SetpieceError", "an array of the batch is in use or read-only")
        };
        macro_rules! write {
            ($guard:ident, $values:ident, $array:expr) => {
                let mut $guard = $array.bind(py).try_readwrite().map_err(|_| lost())?;
                let $values = $guard.as_slice_mut().map_err(|_| lost())?;
            };
        }
        write!(a, rewards, arrays.rewards);
        write!(b, terms, arrays.terms);
        write!(c, masks, arrays.masks);
        write!(d, score, arrays.score);
        write!(e, terminated, arrays.terminated);
        write!(f, truncated, arrays.truncated);
        write!(g, begun, arrays.begun);
        let observations = arrays.observations.bind(py);
        let (mut floats, mut bytes);
        let mut shown: Vec<Rows<'_>> = if let Ok(array) = observations.cast::<PyArrayDyn<f32>>() {
            floats = array.try_readwrite().map_err(|_| lost())?;
            chunks(floats.as_slice_mut().map_err(|_| lost())?, n)
                .into_iter()
                .map(Rows::Floats)
                .collect()
        } else {
            let array = observations.cast::<PyArrayDyn<u8>>().map_err(|_| lost())?;
            bytes = array.try_readwrite().map_err(|_| lost())?;
            chunks(bytes.as_slice_mut().map_err(|_| lost())?, n)
                .into_iter()
                .map(Rows::Bytes)
                .collect()
        };
        let mut rows = Vec::with_capacity(n);
        let flags = terminated.iter_mut().zip(truncated).zip(begun);
        let numbers = chunks(rewards, n)
            .into_iter()
            .zip(chunks(terms, n))
            .zip(chunks(masks, n))
            .zip(chunks(score, n));
        for ((((rewards, terms), mask), score), (((terminated, truncated), begun), observation)) in
            numbers.zip(flags.zip(shown.drain(..)))
        {
            rows.push(BatchRow {
                observation,
                rewards,
                terms,
                mask,
                score,
                terminated,
                truncated,
                begun,
            });
        }
        if self.process != std::process::id() {
            // A fork has inherited it.
            self.lanes
                .restart_threads()
                .map_err(|why| errors::raise_plain(py, "SetpieceError", &why.to_string()))?;
            self.process = std::process::id();
        }
        let lanes = &mut self.lanes;
        py.detach(|| lanes.each(rows, &work));
        Ok(())
    }

    /// Asks the source for the levels of some environments that have none yet.
    fn ask(&mut self, py: Python<'_>, which: impl Fn(usize, &BatchLane) -> bool) -> PyResult<()> {
        let Some(source) = self.source.take() else { return Ok(()) };
        let lanes = self.lanes.lanes().iter().enumerate();
        let begin: Vec<usize> = lanes
            .filter(|(at, lane)| lane.upcoming.is_none() && which(*at, lane))
            .map(|(at, _)| at)
            .collect();
        let results: PyResult<Vec<Py<PyAny>>> = match &source {
            LevelsOfBatch::Ours(..) => Ok(Vec::new()),
            LevelsOfBatch::Function(_) => begin.iter().map(|&at| self.result(py, at)).collect(),
        };
        let lanes = self.lanes.lanes_mut();
        let asked = results.and_then(|results| {
            let begun = |at: usize, level: Option<Upcoming>| {
                lanes[at].rests = level.is_none();
                lanes[at].upcoming = level;
            };
            source.ask(py, &mut self.stages, &begin, &results, begun)
        });
        self.source = Some(source);
        asked
    }

    /// How an environment's episode has ended, None before it has.
    fn result(&self, py: Python<'_>, at: usize) -> PyResult<Py<PyAny>> {
        Ok(self.summary(py, at)?.map_or_else(|| py.None(), |dict| dict.into_any().unbind()))
    }

    /// Tells the source how levels have ended, in the order of the environments.
    fn report(&mut self) {
        let Some(LevelsOfBatch::Ours(source, _)) = &self.source else { return };
        let ended = self.lanes.lanes_mut().iter_mut().filter(|lane| lane.over);
        let mut source = source.lock().unwrap_or_else(PoisonError::into_inner);
        for lane in ended {
            // An episode that has failed has no outcome, and says nothing.
            if let (Some(chosen), Some(_)) = (lane.chosen.take(), lane.engine.outcome()) {
                let episode = EpisodeSummary::of(&lane.engine);
                source.report(&chosen, &episode, lane.engine.term_names());
            }
        }
    }

    /// Raises the failure of the first environment that failed in a step. Its episode has ended;
    /// the others have been played.
    fn raise_failure(&mut self, py: Python<'_>) -> PyResult<()> {
        let mut first = None;
        for (at, lane) in self.lanes.lanes_mut().iter_mut().enumerate() {
            let failure = lane.failure.take().map(|why| match why {
                LaneFailure::Step(why) => from_episode(py, why.into()),
                LaneFailure::Draw(why) => from_episode(py, why.into()),
                LaneFailure::Level(why) => from_unfit(py, &lane.engine, why),
            });
            first = first.or_else(|| failure.map(|failure| (at, failure)));
        }
        let Some((at, failure)) = first else { return Ok(()) };
        failure.value(py).setattr("environment", at)?;
        Err(failure)
    }
}

/// A slice in n equal parts.
fn chunks<T>(values: &mut [T], n: usize) -> Vec<&mut [T]> {
    let one = values.len() / n.max(1);
    let mut rest = values;
    let mut parts = Vec::with_capacity(n);
    for _ in 0..n {
        let (part, more) = rest.split_at_mut(one);
        parts.push(part);
        rest = more;
    }
    parts
}
