//! What the programs of a step know of the start: it is made from a lowered one, so none can be
//! written before.

use super::World;
use super::value::Value;
use setpiece_scenario::vocabulary::{PitchFigure, Rule, Team};
use setpiece_scenario::{Instr, Reg, Start};

/// What every program of a step is lowered against.
pub(crate) struct StepWorld<'c, 'w> {
    /// The scenario.
    pub(crate) world: &'c World<'w>,
    /// Its `let`s, in the order of their names.
    pub(super) lets: Vec<LetSlot<'w>>,
    /// The pitch's figures that the scenario sets, by their index.
    pub(super) pitch: PitchSources,
    /// The one team that has agents, if it is one.
    pub(crate) agents: Option<Team>,
    /// The rules that are off, whatever its parameters are.
    pub(super) rules_off: Vec<Rule>,
    /// How long an episode lasts at most, seconds, if that is known.
    pub(super) longest: Option<f64>,
    /// How many rounds an episode has at most, if that is known.
    pub(super) rounds: Option<f64>,
    /// How high the ball rises at most, metres.
    pub(super) highest_ball: f64,
}

impl<'c, 'w> StepWorld<'c, 'w> {
    /// What is known once the start is lowered.
    ///
    /// - `lets`: in the order of their names;
    /// - `pitch`: the pitch's figures that the scenario sets, by their index;
    /// - `agents`: the one team that has agents, if it is one;
    /// - `highest_ball`: how high the ball rises at most, metres.
    pub(super) fn new(
        world: &'c World<'w>,
        start: &Start,
        lets: Vec<LetSlot<'w>>,
        pitch: PitchSources,
        agents: Option<Team>,
        highest_ball: f64,
    ) -> StepWorld<'c, 'w> {
        StepWorld {
            world,
            lets,
            pitch,
            agents,
            rules_off: rules_off(start),
            longest: longest(start),
            rounds: start.rounds.and_then(|rounds| constant(start, rounds)),
            highest_ball,
        }
    }
}

/// The pitch's figures as step programs see them, by their index; `None`: not set.
pub(super) type PitchSources = [Option<LetSource>; PitchFigure::ALL.len()];

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
