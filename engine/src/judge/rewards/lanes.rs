//! One reward for one team: its agents are judged together, each in a lane.

use crate::in_place::clone_in_place;
use crate::judge::machine::{Crew, Input, Machine, Registers};
use crate::judge::view::player_number;
use crate::snapshot::{Archive, SnapshotError};
use crate::state::PlayerId;
use setpiece_scenario::{Program, Reg};
use std::array;

/// The program of a reward to run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum LaneStage {
    /// The initial values.
    Init,
    /// The start state, for instructions that look back later. Nothing is paid.
    Silent,
    /// A step.
    Step,
    /// Only what no step of a round changes.
    Renew,
}

/// A reward's memory for a team, as wide as its agents need.
#[derive(Debug)]
pub(super) enum Lanes {
    /// For one agent.
    One(Box<LaneMemory<1>>),
    /// For up to four.
    Four(Box<LaneMemory<4>>),
    /// For up to a whole team; the number of lanes is even.
    Twelve(Box<LaneMemory<12>>),
}

impl Clone for Lanes {
    fn clone(&self) -> Lanes {
        match self {
            Lanes::One(memory) => Lanes::One(memory.clone()),
            Lanes::Four(memory) => Lanes::Four(memory.clone()),
            Lanes::Twelve(memory) => Lanes::Twelve(memory.clone()),
        }
    }

    fn clone_from(&mut self, from: &Lanes) {
        match (self, from) {
            (Lanes::One(memory), Lanes::One(from)) => memory.clone_from(from),
            (Lanes::Four(memory), Lanes::Four(from)) => memory.clone_from(from),
            (Lanes::Twelve(memory), Lanes::Twelve(from)) => memory.clone_from(from),
            (memory, from) => *memory = from.clone(),
        }
    }
}

/// Registers, cells and terms, lane by lane.
#[derive(Debug)]
pub(super) struct LaneMemory<const W: usize> {
    init: Registers<W>,
    step: Registers<W>,
    cells: Vec<[f64; W]>,
    terms: Vec<[f64; W]>,
}

clone_in_place! {
    LaneMemory<const W: usize> { init, step, cells, terms }
}

impl Lanes {
    /// Creates memory for this many agents.
    pub(super) fn new(init: &Program, step: &Program, n_terms: usize, n_agents: usize) -> Lanes {
        match n_agents {
            0..=1 => Lanes::One(Box::new(LaneMemory::new(init, step, n_terms))),
            2..=4 => Lanes::Four(Box::new(LaneMemory::new(init, step, n_terms))),
            _ => Lanes::Twelve(Box::new(LaneMemory::new(init, step, n_terms))),
        }
    }

    /// Whether it has the width for this many agents.
    pub(super) fn seats(&self, n_agents: usize) -> bool {
        match self {
            Lanes::One(_) => n_agents <= 1,
            Lanes::Four(_) => (2..=4).contains(&n_agents),
            Lanes::Twelve(_) => n_agents > 4,
        }
    }

    /// Clears all memory.
    pub(super) fn clear(&mut self) {
        match self {
            Lanes::One(memory) => memory.cells.fill([0.0; 1]),
            Lanes::Four(memory) => memory.cells.fill([0.0; 4]),
            Lanes::Twelve(memory) => memory.cells.fill([0.0; 12]),
        }
    }

    /// Writes or reads the memory.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), SnapshotError> {
        match self {
            Lanes::One(memory) => archive.slots("cells", &mut memory.cells),
            Lanes::Four(memory) => archive.slots("cells", &mut memory.cells),
            Lanes::Twelve(memory) => archive.slots("cells", &mut memory.cells),
        }
    }

    /// Runs a program of the reward for the agents' players.
    pub(super) fn run(
        &mut self,
        players: &[Option<PlayerId>],
        input: &Input<'_>,
        stage: LaneStage,
        faults: &mut u32,
    ) {
        match self {
            Lanes::One(memory) => memory.run(players, input, stage, faults),
            Lanes::Four(memory) => memory.run(players, input, stage, faults),
            Lanes::Twelve(memory) => memory.run(players, input, stage, faults),
        }
    }

    /// A value that is the same for all agents and the whole episode.
    pub(super) fn fixed(&self, reg: Reg) -> f64 {
        match self {
            Lanes::One(memory) => memory.step.value(reg),
            Lanes::Four(memory) => memory.step.value(reg),
            Lanes::Twelve(memory) => memory.step.value(reg),
        }
    }

    /// Writes an agent's cell.
    pub(super) fn remember(&mut self, cell: u32, lane: usize, value: f64) {
        match self {
            Lanes::One(memory) => memory.cells[cell as usize][lane] = value,
            Lanes::Four(memory) => memory.cells[cell as usize][lane] = value,
            Lanes::Twelve(memory) => memory.cells[cell as usize][lane] = value,
        }
    }

    /// Writes the payments of an agent's terms in the last run.
    pub(super) fn paid(&self, lane: usize, out: &mut [f64]) {
        match self {
            Lanes::One(memory) => memory.paid(lane, out),
            Lanes::Four(memory) => memory.paid(lane, out),
            Lanes::Twelve(memory) => memory.paid(lane, out),
        }
    }
}

impl<const W: usize> LaneMemory<W> {
    fn new(init: &Program, step: &Program, n_terms: usize) -> LaneMemory<W> {
        LaneMemory {
            init: Registers::of(init),
            step: Registers::of(step),
            cells: vec![[0.0; W]; step.cells as usize],
            terms: vec![[0.0; W]; n_terms],
        }
    }

    fn run(
        &mut self,
        players: &[Option<PlayerId>],
        input: &Input<'_>,
        stage: LaneStage,
        faults: &mut u32,
    ) {
        if stage != LaneStage::Renew {
            self.terms.fill([0.0; W]);
        }
        let (plan, regs, points) =
            if stage == LaneStage::Init { &mut self.init } else { &mut self.step }.parts();
        let mut machine = Machine {
            input: Input { silent: stage == LaneStage::Silent, ..*input },
            crew: Crew {
                players: array::from_fn(|lane| player_number(players.get(lane).copied().flatten())),
                seated: array::from_fn(|lane| lane < players.len()),
            },
            plan,
            regs,
            points,
            cells: &mut self.cells,
            terms: &mut self.terms,
            faults,
            draws: None,
        };
        if stage != LaneStage::Step {
            machine.begin();
        }
        if stage != LaneStage::Renew {
            machine.run();
        }
    }

    fn paid(&self, lane: usize, out: &mut [f64]) {
        for (out, term) in out.iter_mut().zip(&self.terms) {
            *out = term[lane];
        }
    }
}
