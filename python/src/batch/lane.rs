//! One match of a batch, and the row that it writes into.

use super::stage::{BatchStage, Unfit, Upcoming};
use crate::actions::{ActionSet, GivenAction};
use crate::info::write_mask;
use crate::observation::{ByteWriter, ObservationForm, ObservationKind, Stack, write_floats};
use crate::params::to_python;
use crate::scenario::Scenario;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use setpiece::engine::draw::DrawError;
use setpiece::engine::environment::{Environment as Engine, Scratch, StepError};
use setpiece::engine::observe::{Floats, ObserveError};
use setpiece::levels::ChosenLevel;
use setpiece::scenario::{Action, Bindings};
use std::sync::Arc;

/// One of the matches.
pub(super) struct BatchLane {
    pub(super) engine: Engine,
    /// The scenario that it plays.
    pub(super) stage: Arc<BatchStage>,
    /// The level that begins next, if it is chosen.
    pub(super) upcoming: Option<Upcoming>,
    /// The level that is played, if its source wants to know the result.
    pub(super) chosen: Option<ChosenLevel>,
    pub(super) film: NewestObservations,
    /// The parameters of the current episode; others may be bound for the next.
    pub(super) played: Bindings,
    /// Whether the episode has ended and no other has begun.
    pub(super) over: bool,
    /// Whether its source has no more levels: nothing begins.
    pub(super) rests: bool,
    /// The failure of the last step or reset.
    pub(super) failure: Option<LaneFailure>,
}

/// Why an episode has failed.
pub(super) enum LaneFailure {
    Step(StepError),
    Draw(DrawError),
    Level(Unfit),
}

/// The latest observations of a match.
pub(super) enum NewestObservations {
    Floats(Floats, Stack<f32>),
    Bytes(ByteWriter, Stack<u8>),
}

/// The row that a match writes into in a step.
pub(super) struct BatchRow<'a> {
    pub(super) observation: Rows<'a>,
    pub(super) rewards: &'a mut [f64],
    pub(super) terms: &'a mut [f64],
    pub(super) mask: &'a mut [i8],
    pub(super) score: &'a mut [i64],
    pub(super) terminated: &'a mut bool,
    pub(super) truncated: &'a mut bool,
    /// Whether the row shows the first moment of an episode that this step has begun.
    pub(super) begun: &'a mut bool,
}

/// An observation's place in the caller's array.
pub(super) enum Rows<'a> {
    Floats(&'a mut [f32]),
    Bytes(&'a mut [u8]),
}

impl NewestObservations {
    /// Prepares observations of a kind; none for dicts.
    pub(super) fn new(
        py: Python<'_>,
        kind: ObservationKind,
        engine: &Engine,
        shown: ObservationForm,
    ) -> PyResult<Option<NewestObservations>> {
        let (planes, one) = (kind.planes(engine), kind.shape(engine, 1).iter().product());
        if let Some(writer) = ByteWriter::of(py, kind)? {
            let stack = Stack::new(shown.stack, planes, one);
            return Ok(Some(NewestObservations::Bytes(writer, stack)));
        }
        let ObservationKind::Floats(floats) = kind else { return Ok(None) };
        Ok(Some(NewestObservations::Floats(floats, Stack::new(shown.stack, planes, one))))
    }

    /// Writes what every agent of a match sees.
    fn write(
        &mut self,
        engine: &mut Engine,
        rows: &mut Rows<'_>,
        first: bool,
    ) -> Result<(), ObserveError> {
        let n_agents = engine.n_agents().max(1);
        match (self, rows) {
            (NewestObservations::Floats(floats, stack), Rows::Floats(out)) => {
                let one = (out.len() / n_agents).max(1);
                for (agent, out) in out.chunks_exact_mut(one).enumerate() {
                    stack.push(out, first, |out| write_floats(*floats, engine, agent, out))?;
                }
            }
            (NewestObservations::Bytes(writer, stack), Rows::Bytes(out)) => {
                let one = (out.len() / n_agents).max(1);
                for (agent, out) in out.chunks_exact_mut(one).enumerate() {
                    stack.push(out, first, |out| writer.write(engine, agent, out))?;
                }
            }
            _ => {}
        }
        Ok(())
    }
}

impl BatchLane {
    /// The scenario and the parameters of the current episode.
    pub(super) fn played<'py>(&self, py: Python<'py>) -> PyResult<(Scenario, Bound<'py, PyDict>)> {
        let scenario = self.engine.scenario().clone();
        let values = PyDict::new(py);
        for (param, &value) in scenario.params.iter().zip(&self.played.0) {
            values.set_item(&param.name, to_python(py, param, value)?)?;
        }
        Ok((Scenario::of(py, scenario), values))
    }

    /// Begins an episode and shows its first moment.
    pub(super) fn begin(
        &mut self,
        seed: Option<u64>,
        index: Option<u64>,
        action_set: ActionSet,
        keep: bool,
        mut row: BatchRow<'_>,
    ) {
        if self.rests {
            return;
        }
        if let Err(why) = self.draw(seed, index) {
            self.failure = Some(why);
            self.over = true;
            return;
        }
        self.played.0.clone_from(&self.engine.bindings().0);
        self.over = false;
        *row.begun = true;
        if !keep {
            row.rewards.fill(0.0);
            row.terms.fill(0.0);
            (*row.terminated, *row.truncated) = (false, false);
        }
        self.show(action_set, &mut row, true);
    }

    /// Draws the start of the upcoming level, or of another episode of the same scenario.
    fn draw(&mut self, mut seed: Option<u64>, mut index: Option<u64>) -> Result<(), LaneFailure> {
        self.chosen = None;
        if let Some(level) = self.upcoming.take() {
            if !Arc::ptr_eq(&self.stage, &level.stage) {
                self.engine.clone_from(&level.stage.engine);
                self.stage = level.stage;
            }
            let stage = &self.stage;
            stage.bind(&mut self.engine, &level.bindings).map_err(LaneFailure::Level)?;
            self.chosen = level.chosen;
            (seed, index) = (Some(level.seed), Some(level.episode));
        }
        self.engine.reset(seed, index).map_err(LaneFailure::Draw)
    }

    /// Plays a step, or begins the next episode.
    pub(super) fn step(
        &mut self,
        acts: &[GivenAction],
        next_step: bool,
        action_set: ActionSet,
        mut row: BatchRow<'_>,
        scratch: &mut Scratch,
    ) {
        if self.over && self.rests {
            return;
        }
        if self.over && next_step {
            return self.begin(None, None, action_set, false, row);
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
                (self.failure, self.over) = (Some(LaneFailure::Step(why)), true);
                return;
            }
        };
        (*row.terminated, *row.truncated, *row.begun) =
            (result.terminated, result.truncated, false);
        for (out, paid) in row.rewards.iter_mut().zip(self.engine.rewards()) {
            *out = f64::from(*paid);
        }
        let n_terms = row.terms.len() / acts.len().max(1);
        for (agent, out) in row.terms.chunks_exact_mut(n_terms.max(1)).enumerate() {
            self.stage.enter(self.engine.terms(agent), out);
        }
        self.over = result.terminated || result.truncated;
        self.show(action_set, &mut row, false);
    }

    /// Writes the observations of the current match.
    fn show(&mut self, action_set: ActionSet, row: &mut BatchRow<'_>, first: bool) {
        // The buffers have the sizes that the engine requires, so this can't fail.
        let _ = self.film.write(&mut self.engine, &mut row.observation, first);
        let size = action_set.masked().len();
        for (agent, mask) in row.mask.chunks_exact_mut(size).enumerate() {
            write_mask(action_set, &self.engine, agent, mask);
        }
        for (out, goals) in row.score.iter_mut().zip(self.engine.score()) {
            *out = goals.into();
        }
    }
}
