//! The observation that a scenario declares: a program, run for each agent on the current state.
//!
//! A *glance* is what an agent's program computes in one step. Numbers that are delayed or stacked
//! show earlier glances, so then everyone's glance is kept in every step, whoever asks for it.
//! Otherwise it is computed when somebody asks. Its draws depend only on the seed, the episode, the
//! step and the agent, so asking twice gives the same numbers.

use crate::in_place::clone_in_place;
use crate::judge::machine::{Crew, DrawKey, Input, Machine, Registers};
use crate::random::Stream;
use crate::snapshot::{Archive, SnapshotError};
use crate::state::Match;
use setpiece_scenario::pitch::STEPS_PER_S;
use setpiece_scenario::{Instr, Observation, Reg};
use std::sync::Arc;

/// The largest absolute value of an observed number. Larger values are clamped, and NaN becomes 0.
pub const OBSERVED_MAX: f32 = 1.0e6;

/// Writes a declared observation.
#[derive(Debug)]
pub struct ObservationJudge {
    observation: Arc<Observation>,
    /// The registers of a glance, in the order in which it is kept.
    columns: Arc<[Reg]>,
    /// The column and the delay's column of each number.
    places: Arc<[GlancePlace]>,
    /// Whether it draws.
    draws: bool,
    regs: Registers,
    /// Glances, agent by agent, each agent's in a ring.
    kept: Vec<f32>,
    /// Where in the rings the present glance stands.
    newest: u32,
    /// By column, how often it could not be computed in this episode.
    faults: Vec<u32>,
    /// By agent, 1 + the last step whose faults were counted.
    counted: Vec<u32>,
}

clone_in_place! {
    ObservationJudge { observation, columns, places, draws, regs, kept, newest, faults, counted }
}

/// Where a number stands in a glance.
#[derive(Clone, Copy, Debug)]
struct GlancePlace {
    column: usize,
    delay: Option<usize>,
    ago: usize,
}

impl ObservationJudge {
    /// Prepares the program for this many agents.
    pub fn new(observation: &Observation, n_agents: usize) -> ObservationJudge {
        let columns = observation.columns();
        let column = |reg: Reg| columns.binary_search(&reg).unwrap_or_default();
        let places = observation.values.iter().map(|value| GlancePlace {
            column: column(value.value),
            delay: value.delay.map(column),
            ago: value.ago as usize,
        });
        let places: Arc<[GlancePlace]> = places.collect();
        let rows = observation.history as usize + 1;
        ObservationJudge {
            places,
            kept: vec![0.0; n_agents * rows * columns.len()],
            newest: 0,
            faults: vec![0; columns.len()],
            counted: vec![0; n_agents],
            columns: columns.into(),
            draws: observation.program.code.iter().any(|it| matches!(it, Instr::Random { .. })),
            regs: Registers::of(&observation.program),
            observation: Arc::new(observation.clone()),
        }
    }

    /// The numbers' names, in order.
    pub fn names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.observation.values.iter().map(|value| value.name.as_str())
    }

    /// The numbers that could not be computed in this episode, and how often. A number of a stack
    /// is counted once, when it is new.
    pub fn faults(&self) -> impl Iterator<Item = (&str, u32)> {
        let values = self.observation.values.iter().zip(self.places.iter());
        let new = values.filter(|(value, _)| value.ago == 0);
        new.map(|(value, place)| (value.name.as_str(), self.faults[place.column]))
            .filter(|(_, times)| *times > 0)
    }

    /// How many glances of an agent are kept.
    fn rows(&self) -> usize {
        self.observation.history as usize + 1
    }

    /// Begins an episode: what was before its start looks like the start.
    pub fn reset(&mut self, game: &Match, shared: &Input<'_>, seed: u64) {
        self.faults.fill(0);
        self.counted.fill(0);
        self.newest = 0;
        if self.observation.history == 0 {
            return;
        }
        let (width, rows) = (self.columns.len(), self.rows());
        for agent in 0..self.counted.len().min(game.agents.len()) {
            self.glance(game, agent, shared, seed);
            let own = agent * rows * width..(agent + 1) * rows * width;
            let Some(ring) = self.kept.get_mut(own) else { continue };
            for row in 1..rows {
                ring.copy_within(..width, row * width);
            }
        }
    }

    /// Keeps what every agent sees after a step, if any number looks back.
    pub fn step(&mut self, game: &Match, shared: &Input<'_>, seed: u64) {
        if self.observation.history == 0 {
            return;
        }
        self.newest = (self.newest + 1) % (self.observation.history + 1);
        for agent in 0..self.counted.len().min(game.agents.len()) {
            self.glance(game, agent, shared, seed);
        }
    }

    /// Writes an agent's observation. `out` is as long as there are names, and the agent exists.
    pub fn write(
        &mut self,
        game: &Match,
        agent: usize,
        shared: &Input<'_>,
        seed: u64,
        out: &mut [f32],
    ) {
        if self.observation.history == 0 {
            self.glance(game, agent, shared, seed);
        }
        let (width, rows) = (self.columns.len(), self.rows());
        let ring = self.kept.get(agent * rows * width..(agent + 1) * rows * width);
        let ring = ring.unwrap_or_default();
        let seen = |ago: usize, column: usize| {
            let row = (self.newest as usize + rows - ago.min(rows - 1)) % rows;
            ring.get(row * width + column).copied().unwrap_or_default()
        };
        for (slot, place) in out.iter_mut().zip(self.places.iter()) {
            let delay = place.delay.map_or(0.0, |column| f64::from(seen(0, column)));
            let late = libm::round(delay * STEPS_PER_S).max(0.0) as usize;
            *slot = seen(late + place.ago, place.column);
        }
    }

    /// Computes what an agent sees now.
    fn glance(&mut self, game: &Match, agent: usize, shared: &Input<'_>, seed: u64) {
        let Some(slot) = game.agents.get(agent) else { return };
        let me = slot.player.filter(|player| game.players[player.index()].active);
        let index = shared.index;
        let draws = self.draws.then(|| {
            let seed = Stream::seed_of_observation(seed, index, game.step, agent);
            DrawKey { seed, index, attempt: 0 }
        });
        let (plan, regs, points) = self.regs.parts();
        let mut machine = Machine {
            input: Input { us: slot.team, ..*shared },
            crew: Crew::one(me),
            plan,
            regs,
            points,
            cells: &mut [],
            terms: &mut [],
            faults: &mut 0,
            draws,
        };
        machine.begin();
        machine.run();
        let is_new = self.counted.get(agent).is_some_and(|counted| *counted != game.step + 1);
        if let Some(counted) = self.counted.get_mut(agent) {
            *counted = game.step + 1;
        }
        let width = self.columns.len();
        let row = (agent * self.rows() + self.newest as usize) * width;
        let Some(row) = self.kept.get_mut(row..row + width) else { return };
        for ((slot, reg), faults) in row.iter_mut().zip(self.columns.iter()).zip(&mut self.faults) {
            let number = self.regs.value(*reg) as f32;
            if number.is_nan() {
                *faults += u32::from(is_new);
                *slot = 0.0;
            } else {
                *slot = number.clamp(-OBSERVED_MAX, OBSERVED_MAX);
            }
        }
    }

    /// Writes or reads what was seen; on the way in [`Self::reset`] has come before.
    pub(crate) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), SnapshotError> {
        archive.slots("faults", &mut self.faults)?;
        archive.slots("counted", &mut self.counted)?;
        if self.observation.history == 0 {
            return Ok(());
        }
        archive.slots("kept", &mut self.kept)?;
        archive.value("newest", &mut self.newest)?;
        if self.newest > self.observation.history {
            return Err(SnapshotError::damaged("newest", "is beyond what is kept"));
        }
        Ok(())
    }
}
