//! The observation that a scenario declares: a program, run for each agent on the current state.

use crate::in_place::clone_in_place;
use crate::judge::machine::{Crew, Input, Machine, Registers};
use crate::state::Match;
use setpiece_scenario::Observation;
use std::sync::Arc;

/// The largest absolute value of an observed number. Larger values are clamped, and NaN becomes 0.
pub const OBSERVED_MAX: f32 = 1.0e6;

/// Writes a declared observation.
#[derive(Debug)]
pub struct ObservationJudge {
    observation: Arc<Observation>,
    regs: Registers,
}

clone_in_place! {
    ObservationJudge { observation, regs }
}

impl ObservationJudge {
    /// Prepares the program.
    pub fn new(observation: &Observation) -> ObservationJudge {
        ObservationJudge {
            regs: Registers::of(&observation.program),
            observation: Arc::new(observation.clone()),
        }
    }

    /// The numbers' names, in order.
    pub fn names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.observation.values.iter().map(|value| value.name.as_str())
    }

    /// Writes an agent's observation. `out` is as long as there are names, and the agent exists.
    pub fn write(&mut self, game: &Match, agent: usize, shared: &Input<'_>, out: &mut [f32]) {
        let Some(slot) = game.agents.get(agent) else { return };
        let me = slot.player.filter(|player| game.players[player.index()].active);
        let (plan, regs) = self.regs.parts();
        let mut machine = Machine {
            input: Input { us: slot.team, ..*shared },
            crew: Crew::one(me),
            plan,
            regs,
            cells: &mut [],
            terms: &mut [],
            faults: &mut 0,
            draws: None,
        };
        machine.begin();
        machine.run();
        for (slot, value) in out.iter_mut().zip(&self.observation.values) {
            let number = self.regs.value(value.value) as f32;
            *slot = if number.is_nan() { 0.0 } else { number.clamp(-OBSERVED_MAX, OBSERVED_MAX) };
        }
    }
}
