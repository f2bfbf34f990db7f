//! `observe vector { … }`: the scenario's own observation.

use super::step_world::StepWorld;
use super::value::{LiteralFrame, Repr, Scope, Value};
use super::{Lower, ProgramStage, World};
use crate::ast::{Expr, ExprKind, Observed, Span};
use crate::check::types::Ty;
use crate::problem::facts::{Bounds, Chance, Instead, Names, Rewards};
use crate::problem::{Code, Problem};
use setpiece_scenario::pitch::{STEPS_PER_S, X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::{BinaryOp, Instr, Observation, ObservedValue, Reg};
use std::collections::BTreeSet;

/// Most numbers of an observation.
const NUMBERS_MAX: usize = 10_000;
/// Most steps of a stack, and the longest delay.
const STACK_MAX: f64 = 32.0;
const DELAY_MAX_S: f64 = 10.0;

/// How late a line is seen: its delay, and how many steps that is at most.
#[derive(Clone, Copy, Default)]
struct Lateness {
    delay: Option<Reg>,
    most_steps: u32,
}

/// Lowers the observation, if the scenario declares one.
pub(crate) fn lower_observation(step: &StepWorld<'_, '_>) -> Option<Observation> {
    let world = step.world;
    let (observed, span) = world.flat.observed?;
    let mut lower =
        Lower::in_step(step, ProgramStage::Observation, Scope::new(true, LiteralFrame::Own));
    let us = lower.code.us();
    lower.team = Some(us);
    let (mut values, mut history): (Vec<ObservedValue>, u32) = (Vec::new(), 0);
    let (mut taken, mut missed) = (BTreeSet::new(), None);
    for line in observed {
        if missed.take().is_some_and(|missed| is_beside(world, missed, line.value.span)) {
            continue;
        }
        let label = line.label.as_ref();
        let name =
            label.map_or_else(|| world.laid_out(line.value.span), |label| label.node.clone());
        let (known, found) = (values.len(), world.problems.borrow().len());
        history = history.max(lower.line(line, &name, &mut values));
        // Behind a name that nothing has may stand what was meant to be its value.
        let is_unknown = |problem: &Problem| problem.code() == Code::UnknownName;
        missed = (matches!(line.value.kind, ExprKind::Name(_))
            && world.problems.borrow().iter().skip(found).any(is_unknown))
        .then_some(line.value.span);
        let mut names = values.iter().skip(known).map(|value| &value.name);
        // The numbers of a line have names of their own: those of a place end in `.x` and `.y`.
        if let Some(label) = label.filter(|_| names.any(|name| taken.contains(name))) {
            let label = (label.span, label.node.clone());
            world.report(Problem::new(label.0, Names::ObservedTwice { label: label.1 }));
        }
        taken.extend(values.iter().skip(known).map(|value| value.name.clone()));
    }
    if observed.is_empty() || values.len() > NUMBERS_MAX {
        world.report(Problem::new(span, Rewards::Numbers { most: NUMBERS_MAX }));
    }
    let regs: Vec<Reg> =
        values.iter().flat_map(|value| [Some(value.value), value.delay]).flatten().collect();
    let (program, layout) = lower.code.finish(&regs);
    for value in &mut values {
        value.value = layout.reg(value.value);
        value.delay = value.delay.map(|delay| layout.reg(delay));
    }
    Some(Observation { program, values, history })
}

/// Whether a part follows another one on its line, without a comma.
fn is_beside(world: &World<'_>, first: Span, next: Span) -> bool {
    let between = Span { start: first.end, end: next.start, ..first };
    !world.library.sources.text(between).contains(['\n', ','])
}

impl<'w> Lower<'_, 'w> {
    /// Adds the numbers of a line; gives how many steps they look back.
    fn line(&mut self, line: &'w Observed, name: &str, values: &mut Vec<ObservedValue>) -> u32 {
        // What a line draws doesn't change with the lines around it.
        let outer = self.streams.draw_for(name);
        let mut numbers = self.observed(&line.value, line.noise.as_ref(), name);
        if let Some(when) = &line.when {
            let (seen, nothing) = (self.condition(when), self.code.constant(0.0));
            for (_, reg) in &mut numbers {
                *reg = self.code.select(seen, *reg, nothing);
            }
        }
        let late = line.delay.as_ref().map(|delay| self.lateness(delay)).unwrap_or_default();
        let stack = line.stack.as_ref().map_or(1, |stack| self.stack(stack));
        self.streams.draw_for(&outer);
        for ago in (0..stack).rev() {
            for (name, value) in &numbers {
                let name = match ago {
                    0 => name.clone(),
                    1 => format!("{name}, 1 step ago"),
                    _ => format!("{name}, {ago} steps ago"),
                };
                values.push(ObservedValue { name, value: *value, delay: late.delay, ago });
            }
        }
        late.most_steps + stack - 1
    }

    /// The numbers of one line: quantities in SI units, places normalised and in the own frame,
    /// vectors in metres.
    fn observed(
        &mut self,
        expr: &'w Expr,
        noise: Option<&'w Expr>,
        name: &str,
    ) -> Vec<(String, Reg)> {
        let value = self.expr(expr);
        if value.is_error() {
            return Vec::new();
        }
        let both = |(x, y): (Reg, Reg)| vec![(format!("{name}.x"), x), (format!("{name}.y"), y)];
        if value.ty.is_place() {
            let place = self.place_of(&value, expr.span);
            let place = self.turned(place);
            let (x, y) = self.noisy(place, Ty::LENGTH, noise);
            let (sx, sy) = (self.code.constant(X_SCALE_M), self.code.constant(Y_SCALE_M));
            return both((
                self.code.binary(BinaryOp::Div, x, sx),
                self.code.binary(BinaryOp::Div, y, sy),
            ));
        }
        match (&value.repr, value.ty) {
            (Repr::Two(x, y) | Repr::Three(x, y, _), Ty::Vector | Ty::Velocity) => {
                let pair = self.turned((*x, *y));
                let unit = if value.ty == Ty::Velocity { Ty::SPEED } else { Ty::LENGTH };
                both(self.noisy(pair, unit, noise))
            }
            (Repr::One(reg), Ty::Bool | Ty::Team | Ty::Mode | Ty::Role | Ty::Action) => {
                if let Some(noise) = noise {
                    let noun = value.ty.noun();
                    self.report(Problem::new(noise.span, Rewards::NoNoise { noun }));
                }
                vec![(name.to_owned(), *reg)]
            }
            (Repr::One(reg), ty) if ty.dim().is_some() => {
                let unit = if ty.is_plain() { Ty::Number } else { ty };
                vec![(name.to_owned(), self.with_noise(*reg, unit, noise))]
            }
            _ => {
                self.report(self.mismatch_with(value.ty, Ty::Number, expr.span, Instead::Observed));
                Vec::new()
            }
        }
    }

    /// Two numbers, each with noise of its own.
    fn noisy(&mut self, pair: (Reg, Reg), unit: Ty, noise: Option<&'w Expr>) -> (Reg, Reg) {
        let errors = self.world.errors();
        let first = self.with_noise(pair.0, unit, noise);
        if self.world.errors() > errors {
            return pair;
        }
        (first, self.with_noise(pair.1, unit, noise))
    }

    fn with_noise(&mut self, reg: Reg, unit: Ty, noise: Option<&'w Expr>) -> Reg {
        let Some(noise) = noise else { return reg };
        let value: Value<'w> = self.want(noise, unit);
        if value.is_error() {
            return reg;
        }
        let drawn = self.reg(&value);
        if !self.code.depends(drawn, &|instr| matches!(instr, Instr::Random { .. })) {
            let text = self.world.text(noise.span);
            self.report(Problem::new(noise.span, Chance::NoiseNotDrawn { text }));
        }
        self.code.binary(BinaryOp::Add, reg, drawn)
    }

    fn lateness(&mut self, delay: &'w Expr) -> Lateness {
        let value = self.want(delay, Ty::DURATION);
        if value.is_error() {
            return Lateness::default();
        }
        let reg = self.reg(&value);
        let text = self.world.text(delay.span);
        match self.interval(reg) {
            Some((low, high)) if low >= 0.0 && high <= DELAY_MAX_S => {
                let most_steps = (high * STEPS_PER_S).round() as u32;
                return Lateness { delay: Some(reg), most_steps };
            }
            Some(_) => {
                let (what, shown) = ("the delay".to_owned(), "`0s..10s`".to_owned());
                self.report(Problem::new(delay.span, Bounds::Outside { what, text, shown }));
            }
            None => self.report(Problem::new(delay.span, Rewards::EndlessDelay { text })),
        }
        Lateness::default()
    }

    /// How many steps a line shows.
    fn stack(&mut self, stack: &'w Expr) -> u32 {
        let value = self.want(stack, Ty::Int);
        if value.is_error() {
            return 1;
        }
        let reg = self.reg(&value);
        let text = self.world.text(stack.span);
        match self.code.constant_of(reg) {
            Some(steps) if (1.0..=STACK_MAX).contains(&steps) => return steps as u32,
            Some(_) => {
                let (what, shown) = ("the stack".to_owned(), "`1..32`".to_owned());
                self.report(Problem::new(stack.span, Bounds::Outside { what, text, shown }));
            }
            None => self.report(Problem::new(stack.span, Rewards::StackNotConstant { text })),
        }
        1
    }
}
