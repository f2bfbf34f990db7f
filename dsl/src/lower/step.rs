//! What a program of a step reads of the start.

use super::Lower;
use super::value::Value;
use setpiece_scenario::Reg;
use setpiece_scenario::vocabulary::{Rule, Team};

impl<'w> Lower<'_, 'w> {
    /// A `let` of the scenario in a program of a step.
    pub(super) fn step_let(&mut self, name: &str) -> Value<'w> {
        let lets = self.step.map_or(&[][..], |step| &step.lets);
        // They stand in the order of their names.
        let slot =
            lets.binary_search_by(|slot| slot.name.cmp(name)).ok().and_then(|at| lets.get(at));
        let Some(slot) = slot else { return Value::error() };
        // A value's registers are gone through in the order of its parts.
        let mut parts = slot.parts.iter();
        let mut map = |reg: Reg| match parts.find(|(known, _)| *known == reg) {
            Some((_, source)) => self.read(*source),
            None => self.code.constant(0.0),
        };
        slot.value.map(&mut map)
    }

    /// The one team that has agents, if it is one.
    pub(super) fn side_with_agents(&self) -> Option<Team> {
        self.step.and_then(|step| step.agents)
    }

    /// Whether a rule is off, whatever the parameters are.
    pub(super) fn is_off(&self, rule: Rule) -> bool {
        self.step.is_some_and(|step| step.rules_off.contains(&rule))
    }

    /// How long an episode lasts at most, seconds, if that is known.
    pub(super) fn longest(&self) -> Option<f64> {
        self.step.and_then(|step| step.longest)
    }

    /// How high the ball rises at most, metres.
    pub(super) fn highest_ball(&self) -> f64 {
        self.step.map_or(f64::MAX, |step| step.highest_ball)
    }
}
