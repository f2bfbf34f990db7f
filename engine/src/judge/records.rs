//! Records: what a scenario measures of an episode, besides what it pays.
//!
//! Every record is a separate program, run after the rewards of each step: once, or once per agent
//! if it reads `me`. Its registers hold the metric so far; a series keeps all its values.

use crate::in_place::clone_in_place;
use crate::judge::machine::{Crew, Input, Machine, Registers};
use crate::snapshot::{Archive, SnapshotError};
use crate::state::Match;
use setpiece_scenario::Record;
use std::sync::Arc;

/// The value of a record when an episode ends.
#[derive(Clone, Debug, PartialEq)]
pub enum Recorded {
    /// A number in SI units; `None` if it could not be computed.
    Number(Option<f64>),
    /// A normalised place, world frame.
    Place([f64; 2]),
    /// One number per step.
    Numbers(Vec<f64>),
    /// One normalised place per step.
    Places(Vec<[f64; 2]>),
    /// One value per agent.
    PerAgent(Vec<Recorded>),
}

/// The records of an environment.
#[derive(Debug)]
pub struct RecordJudge {
    records: Arc<[Record]>,
    states: Vec<RecordState>,
    n_agents: usize,
    faults: u32,
}

clone_in_place! {
    RecordJudge { records, states, n_agents, faults }
}

/// The memory of one record, one entry per instance.
#[derive(Debug)]
struct RecordState {
    per_agent: bool,
    n_cells: usize,
    regs: Registers,
    cells: Vec<[f64; 1]>,
    /// The last values, as many per instance as the record has.
    last: Vec<f64>,
    /// For a series, the values of every step.
    kept: Vec<Vec<f64>>,
}

clone_in_place! {
    RecordState { per_agent, n_cells, regs, cells, last, kept }
}

impl RecordJudge {
    /// Prepares the records for this many agents.
    pub fn new(records: &[Record], n_agents: usize) -> RecordJudge {
        let state = |record: &Record| {
            let per_agent = record.program.uses_me();
            let (instances, n_cells) =
                (if per_agent { n_agents } else { 1 }, record.program.cells as usize);
            RecordState {
                per_agent,
                n_cells,
                regs: Registers::of(&record.program),
                cells: vec![[0.0]; instances * n_cells],
                last: vec![f64::NAN; instances * record.values.len()],
                kept: vec![Vec::new(); if record.series { instances } else { 0 }],
            }
        };
        RecordJudge {
            states: records.iter().map(state).collect(),
            records: records.into(),
            n_agents,
            faults: 0,
        }
    }

    /// Begins an episode; `input` shows the start state.
    pub fn reset(&mut self, game: &Match, input: &Input<'_>) {
        for state in &mut self.states {
            state.cells.fill([0.0]);
            state.last.fill(f64::NAN);
            state.kept.iter_mut().for_each(Vec::clear);
        }
        self.run(game, &Input { silent: true, ..*input });
    }

    /// Computes again what no step of a round changes.
    pub fn renew(&mut self, input: &Input<'_>) {
        for state in &mut self.states {
            let (plan, regs, points) = state.regs.parts();
            let mut machine = Machine {
                input: *input,
                crew: Crew::one(None),
                plan,
                regs,
                points,
                cells: &mut [],
                terms: &mut [],
                faults: &mut self.faults,
                draws: None,
            };
            machine.begin();
        }
    }

    /// Writes or reads what was measured. Before reading, [`Self::reset`] has been called.
    pub(crate) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), SnapshotError> {
        for state in &mut self.states {
            archive.slots("cells", &mut state.cells)?;
            archive.slots("last", &mut state.last)?;
            archive.slots("kept", &mut state.kept)?;
        }
        archive.value("faults", &mut self.faults)
    }

    /// Measures a step.
    pub fn step(&mut self, game: &Match, input: &Input<'_>) {
        self.run(game, input);
    }

    fn run(&mut self, game: &Match, input: &Input<'_>) {
        for (record, state) in self.records.iter().zip(&mut self.states) {
            let instances = if state.per_agent { self.n_agents } else { 1 };
            for instance in 0..instances {
                let slot = game.agents.get(instance).filter(|_| state.per_agent);
                let me = slot.and_then(|slot| {
                    slot.player.filter(|player| game.players[player.index()].active)
                });
                let (plan, regs, points) = state.regs.parts();
                let mut machine = Machine {
                    input: Input { us: slot.map_or(input.us, |slot| slot.team), ..*input },
                    crew: Crew::one(me),
                    plan,
                    regs,
                    points,
                    cells: &mut state.cells
                        [instance * state.n_cells..(instance + 1) * state.n_cells],
                    terms: &mut [],
                    faults: &mut self.faults,
                    draws: None,
                };
                if input.silent {
                    machine.begin();
                }
                machine.run();
                if input.silent {
                    continue;
                }
                let n = record.values.len();
                for (slot, reg) in
                    state.last[instance * n..(instance + 1) * n].iter_mut().zip(&record.values)
                {
                    *slot = state.regs.value(*reg);
                    if let Some(kept) = state.kept.get_mut(instance) {
                        kept.push(*slot);
                    }
                }
            }
        }
    }

    /// The names and values so far, in source order.
    pub fn values(&self) -> impl Iterator<Item = (&str, Recorded)> {
        self.records.iter().zip(&self.states).map(|(record, state)| {
            let n = record.values.len();
            let one = |instance: usize| match state.kept.get(instance) {
                Some(kept) if n == 2 => {
                    Recorded::Places(kept.chunks_exact(2).map(|at| [at[0], at[1]]).collect())
                }
                Some(kept) => Recorded::Numbers(kept.clone()),
                None => match &state.last[instance * n..(instance + 1) * n] {
                    [x, y] => Recorded::Place([*x, *y]),
                    [value] => Recorded::Number(value.is_finite().then_some(*value)),
                    _ => Recorded::Number(None),
                },
            };
            let value = match (state.per_agent, self.n_agents) {
                (true, n) if n != 1 => Recorded::PerAgent((0..n).map(one).collect()),
                _ => one(0),
            };
            (record.name.as_str(), value)
        })
    }
}

impl Recorded {
    /// The value as a number, or the mean over agents: what can be averaged over episodes.
    pub fn number(&self) -> Option<f64> {
        match self {
            Recorded::Number(value) => *value,
            Recorded::PerAgent(values) => {
                let numbers: Vec<f64> = values.iter().filter_map(Recorded::number).collect();
                (!numbers.is_empty()).then(|| numbers.iter().sum::<f64>() / numbers.len() as f64)
            }
            Recorded::Place(_) | Recorded::Numbers(_) | Recorded::Places(_) => None,
        }
    }
}
