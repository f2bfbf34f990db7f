//! What the programs of a step know of the start: it is made from a lowered one, so none can be
//! written before.

use super::value::Value;
use super::{Lower, World};
use setpiece_scenario::vocabulary::{Rule, Team};
use setpiece_scenario::{Instr, Reg, Start};

/// What every program of a step is lowered against.
pub(crate) struct StepWorld<'c, 'w> {
    /// The scenario.
    pub(crate) world: &'c World<'w>,
    /// Its `let`s, in the order of their names.
    lets: Vec<LetSlot<'w>>,
    /// The one team that has agents, if it is one.
    pub(crate) agents: Option<Team>,
    /// The rules that are off, whatever its parameters are.
    rules_off: Vec<Rule>,
    /// How long an episode lasts at most, seconds, if that is known.
    longest: Option<f64>,
}

impl<'c, 'w> StepWorld<'c, 'w> {
    /// What is known once the start is lowered.
    ///
    /// - `lets`: in the order of their names;
    /// - `agents`: the one team that has agents, if it is one.
    pub(super) fn new(
        world: &'c World<'w>,
        start: &Start,
        lets: Vec<LetSlot<'w>>,
        agents: Option<Team>,
    ) -> StepWorld<'c, 'w> {
        StepWorld { world, lets, agents, rules_off: rules_off(start), longest: longest(start) }
    }
}

/// A `let` as step programs see it.
pub(crate) struct LetSlot<'w> {
    /// Its name.
    pub(crate) name: &'w str,
    /// Its value in the start program.
    pub(crate) value: Value<'w>,
    /// For each of its registers: a constant, or its place in the scenario's `let`s.
    pub(crate) parts: Vec<(Reg, LetSource)>,
}

/// A register of a `let`, seen from a step program.
#[derive(Clone, Copy)]
pub(crate) enum LetSource {
    /// Known now.
    Constant(f64),
    /// A parameter.
    Param(u32),
    /// Drawn or computed at reset.
    Let(u32),
}

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
            Some((_, LetSource::Constant(value))) => self.code.constant(*value),
            Some((_, LetSource::Param(index))) => self.code.param(*index),
            Some((_, LetSource::Let(index))) => self.code.scenario_let(*index),
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
}

/// The rules that are off, whatever the parameters are.
fn rules_off(start: &Start) -> Vec<Rule> {
    let value = |rule: &Rule| match start.rules.iter().rfind(|setting| setting.rule == *rule) {
        Some(setting) => constant(start, setting.value),
        None => Some(rule.default_value()),
    };
    Rule::ALL.iter().copied().filter(|rule| value(rule) == Some(0.0)).collect()
}

/// How long an episode lasts at most, seconds, if it begins at 0 and has a limit that is known.
fn longest(start: &Start) -> Option<f64> {
    let limit = start.limit.filter(|_| start.elapsed.is_none())?;
    constant(start, limit)
}

fn constant(start: &Start, reg: Reg) -> Option<f64> {
    match start.program.code.get(reg.index())? {
        Instr::Const(value) => Some(*value),
        _ => None,
    }
}
