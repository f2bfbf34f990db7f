//! Many matches in one: the core of `setpiece.FootballVectorEnv`.
//!
//! Everything that an agent sees is in arrays with a row per environment. They are written in
//! place, on a few threads, without the interpreter.

use crate::actions::{self, ActionSet, GivenAction};
use crate::environment::{
    AgentInfo, Prepared, SMM_SIZE, agents_of, from_episode, players_of, prepare,
};
use crate::errors;
use crate::info::{records, write_mask};
use crate::observation::{
    self, BlockInfo, ObservationForm, ObservationKind, Observer, Stack, Wanted, write_floats,
    write_map,
};
use crate::options::EnvOptions;
use crate::params::bind;
use crate::scenario::Scenario;
use numpy::{PyArray1, PyArray2, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use setpiece::engine::batch::Batch as Lanes;
use setpiece::engine::environment::{Environment as Engine, ResetError, Scratch, StepError};
use setpiece::engine::observe::ObserveError;
use setpiece::scenario::{Action, Verdict};

/// One of the matches.
struct BatchLane {
    engine: Engine,
    film: NewestObservations,
    /// Whether the episode has ended and no other has begun.
    over: bool,
    /// The failure of the last step.
    fault: Option<ResetError>,
    broken: Option<StepError>,
}

/// The latest observations of a match.
enum NewestObservations {
    Floats(Stack<f32>),
    Map(Stack<u8>),
}

/// The row that a match writes into in a step.
struct BatchRow<'a> {
    observation: Rows<'a>,
    rewards: &'a mut [f64],
    terms: &'a mut [f64],
    mask: &'a mut [i8],
    score: &'a mut [i64],
    terminated: &'a mut bool,
    truncated: &'a mut bool,
    /// Whether the row shows the first moment of an episode that this step has begun.
    begun: &'a mut bool,
}

/// The options of writing a row.
#[derive(Clone, Copy)]
struct RowView {
    kind: ObservationKind,
    action_set: ActionSet,
}

enum Rows<'a> {
    Floats(&'a mut [f32]),
    Map(&'a mut [u8]),
}

/// Several matches of one scenario that are stepped together.
#[pyclass(module = "setpiece._native")]
pub(crate) struct Batch {
    lanes: Lanes<BatchLane>,
    kind: ObservationKind,
    stack: usize,
    action_set: ActionSet,
    /// Whether a step begins the next episode after one has ended.
    next_step: bool,
    acts: Vec<GivenAction>,
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
    #[pyo3(signature = (scenario, n, options, *, threads, next_step))]
    fn new(
        py: Python<'_>,
        scenario: &Scenario,
        n: usize,
        options: EnvOptions<'_>,
        threads: usize,
        next_step: bool,
    ) -> PyResult<Batch> {
        let Prepared { engine, kind, action_set } = prepare(py, scenario, &options)?;
        let ObservationForm { stack, .. } = options.shown();
        if kind == ObservationKind::Raw {
            let message = "raw observations are dicts, which a vector environment doesn't stack";
            return Err(errors::parameter(py, "observation", message));
        }
        let (planes, one) = (kind.planes(&engine), kind.shape(&engine, 1).iter().product());
        let film = || match kind {
            ObservationKind::Smm { .. } => NewestObservations::Map(Stack::new(stack, planes, one)),
            _ => NewestObservations::Floats(Stack::new(stack, planes, one)),
        };
        let acts = vec![GivenAction::IDLE; n * engine.n_agents()];
        let lane = || BatchLane {
            engine: engine.clone(),
            film: film(),
            over: true,
            fault: None,
            broken: None,
        };
        let lanes = Lanes::new((0..n).map(|_| lane()).collect(), threads)
            .map_err(|why| errors::raise_plain(py, "SetpieceError", &why.to_string()))?;
        Ok(Batch { lanes, kind, stack, action_set, next_step, acts, process: std::process::id() })
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
        self.lanes.lanes().first().map(|lane| lane.engine.term_names().to_vec()).unwrap_or_default()
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
            ObservationKind::Smm { .. } => PyArrayDyn::<u8>::zeros(py, shape, false).into_any(),
            _ => PyArrayDyn::<f32>::zeros(py, shape, false).into_any(),
        };
        let terms = lane.engine.term_names().len();
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

    /// Binds parameters for all environments, from their next episodes on.
    fn bind(&mut self, py: Python<'_>, params: &Bound<'_, PyDict>) -> PyResult<()> {
        for lane in self.lanes.lanes_mut() {
            let bindings = bind(py, &lane.engine.scenario().params, params)?;
            lane.engine
                .set_bindings(&bindings)
                .map_err(|error| crate::environment::from_engine(py, error))?;
        }
        Ok(())
    }

    /// Begins episodes of the environments that `which` marks, each with its seed, or with its next
    /// index. With `keep` the arrays still show how the last episode ended, next to the first
    /// observation of the new one.
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
        let view = RowView { kind: self.kind, action_set: self.action_set };
        self.each(py, arrays, |at, lane, row, _| {
            let (which, seed, index) = order[at];
            if which {
                lane.begin(seed, index, view, keep, row);
            }
        })?;
        self.raise_failure(py)
    }

    /// Plays a step of every environment. Those whose episode has ended begin the next, according
    /// to their mode.
    fn step(&mut self, py: Python<'_>, arrays: &Arrays, action: &Bound<'_, PyAny>) -> PyResult<()> {
        self.read(action)?;
        let agents = self.acts.len() / self.lanes.lanes().len().max(1);
        let (view, next_step) =
            (RowView { kind: self.kind, action_set: self.action_set }, self.next_step);
        if !next_step && let Some(at) = self.lanes.lanes().iter().position(|lane| lane.over) {
            let message = format!(
                "the episode of environment {at} has ended: call `reset` with a `reset_mask` that names it"
            );
            return Err(errors::raise_plain(py, "SetpieceError", &message));
        }
        let acts = std::mem::take(&mut self.acts);
        let played = self.each(py, arrays, |at, lane, row, scratch| {
            lane.step(&acts[at * agents..(at + 1) * agents], next_step, view, row, scratch);
        });
        self.acts = acts;
        played?;
        self.raise_failure(py)
    }

    /// The summary of an environment's ended episode: outcome, records, success, length, seed,
    /// index, digest, faults, return by term and agent.
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
        dict.set_item("digest", format!("{:016x}", engine.digest()))?;
        dict.set_item("faults", engine.faults())?;
        let sums: PyResult<Vec<_>> =
            (0..engine.n_agents()).map(|agent| PyList::new(py, engine.term_sums(agent))).collect();
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
            Observer::new(py, kind, &lane.engine, ObservationForm::FRESH, held).observe(
                py,
                &mut lane.engine,
                true,
            )
        };
        self.lanes.lanes_mut().iter_mut().map(look).collect()
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
                .map(Rows::Map)
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

    /// Raises the failure of the first environment that failed in a step. Its episode has ended;
    /// the others have been played.
    fn raise_failure(&mut self, py: Python<'_>) -> PyResult<()> {
        let mut first = None;
        for lane in self.lanes.lanes_mut() {
            let broken = lane.broken.take().map(|why| from_episode(py, why.into()));
            let fault = lane.fault.take().map(|why| match why {
                ResetError::Draw(why) => from_episode(py, why.into()),
                ResetError::Snapshot(why) => crate::environment::from_snapshot(py, why),
            });
            first = first.or(broken).or(fault);
        }
        first.map_or(Ok(()), Err)
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

impl BatchLane {
    /// Begins an episode and shows its first moment.
    fn begin(
        &mut self,
        seed: Option<u64>,
        index: Option<u64>,
        view: RowView,
        keep: bool,
        mut row: BatchRow<'_>,
    ) {
        if let Err(why) = self.engine.reset(seed, index) {
            self.fault = Some(why.into());
            self.over = true;
            return;
        }
        self.over = false;
        *row.begun = true;
        if !keep {
            row.rewards.fill(0.0);
            row.terms.fill(0.0);
            (*row.terminated, *row.truncated) = (false, false);
        }
        self.show(view, &mut row, true);
    }

    /// Plays a step, or begins the next episode.
    fn step(
        &mut self,
        acts: &[GivenAction],
        next_step: bool,
        view: RowView,
        mut row: BatchRow<'_>,
        scratch: &mut Scratch,
    ) {
        if self.over && next_step {
            return self.begin(None, None, view, false, row);
        }
        let mut pressed = [Action::Idle; setpiece::scenario::pitch::PLAYERS_MAX];
        for (agent, (act, action)) in acts.iter().zip(&mut pressed).enumerate() {
            *action = act.action;
            if act.steer.is_some() {
                self.engine.steer(agent, act.steer);
            }
        }
        let result = match self.engine.step(&pressed[..acts.len()], scratch) {
            Ok(result) => result,
            Err(why) => {
                (self.broken, self.over) = (Some(why), true);
                return;
            }
        };
        (*row.terminated, *row.truncated, *row.begun) =
            (result.terminated, result.truncated, false);
        for (out, paid) in row.rewards.iter_mut().zip(self.engine.rewards()) {
            *out = f64::from(*paid);
        }
        let n_terms = self.engine.term_names().len();
        for (agent, out) in row.terms.chunks_exact_mut(n_terms.max(1)).enumerate() {
            out.copy_from_slice(self.engine.terms(agent));
        }
        self.over = result.terminated || result.truncated;
        self.show(view, &mut row, false);
    }

    /// Writes the observations of the current match.
    fn show(&mut self, view: RowView, row: &mut BatchRow<'_>, first: bool) {
        let n_agents = self.engine.n_agents();
        // The buffers have the sizes that the engine requires, so this can't fail.
        let _ = observe(
            &mut self.engine,
            &mut self.film,
            view.kind,
            &mut row.observation,
            n_agents,
            first,
        );
        let size = view.action_set.masked().len();
        for (agent, mask) in row.mask.chunks_exact_mut(size).enumerate() {
            write_mask(view.action_set, &self.engine, agent, mask);
        }
        for (out, goals) in row.score.iter_mut().zip(self.engine.score()) {
            *out = goals.into();
        }
    }
}

fn observe(
    engine: &mut Engine,
    film: &mut NewestObservations,
    kind: ObservationKind,
    rows: &mut Rows<'_>,
    n_agents: usize,
    first: bool,
) -> Result<(), ObserveError> {
    match (kind, film, rows) {
        (ObservationKind::Floats(floats), NewestObservations::Floats(stack), Rows::Floats(out)) => {
            let one = (out.len() / n_agents.max(1)).max(1);
            for (agent, out) in out.chunks_exact_mut(one).enumerate() {
                stack.push(out, first, |out| write_floats(floats, engine, agent, out))?;
            }
        }
        (
            ObservationKind::Smm { width, height },
            NewestObservations::Map(stack),
            Rows::Map(out),
        ) => {
            let one = (out.len() / n_agents.max(1)).max(1);
            for (agent, out) in out.chunks_exact_mut(one).enumerate() {
                stack.push(out, first, |out| write_map((width, height), engine, agent, out))?;
            }
        }
        _ => {}
    }
    Ok(())
}
