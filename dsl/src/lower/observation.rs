//! `observe vector { … }`: the scenario's own observation.

use super::step_world::StepWorld;
use super::value::{LiteralFrame, Repr, Scope};
use super::{Lower, ProgramStage};
use crate::ast::Expr;
use crate::check::types::Ty;
use crate::problem::Problem;
use crate::problem::facts::{Instead, Names, Rewards};
use setpiece_scenario::pitch::{X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::{BinaryOp, Observation, ObservedValue, Reg};

/// Most numbers of an observation.
const NUMBERS_MAX: usize = 10_000;

/// Lowers the observation, if the scenario declares one.
pub(crate) fn lower_observation(step: &StepWorld<'_, '_>) -> Option<Observation> {
    let world = step.world;
    let (observed, span) = world.flat.observed?;
    let mut lower =
        Lower::in_step(step, ProgramStage::Observation, Scope::new(true, LiteralFrame::Own));
    let us = lower.code.us();
    lower.team = Some(us);
    let mut values: Vec<(String, Reg)> = Vec::new();
    for (expr, label) in observed {
        let name = label.as_ref().map_or_else(|| world.text(expr.span), |label| label.node.clone());
        if let Some(label) =
            label.as_ref().filter(|label| values.iter().any(|(known, _)| *known == label.node))
        {
            world.report(Problem::new(
                label.span,
                Names::ObservedTwice { label: label.node.clone() },
            ));
        }
        values.extend(lower.observed(expr, &name));
    }
    if observed.is_empty() || values.len() > NUMBERS_MAX {
        world.report(Problem::new(span, Rewards::Numbers { most: NUMBERS_MAX }));
    }
    let regs: Vec<Reg> = values.iter().map(|(_, reg)| *reg).collect();
    let (program, layout) = lower.code.finish(&regs);
    let values = values
        .into_iter()
        .map(|(name, reg)| ObservedValue { name, value: layout.reg(reg) })
        .collect();
    Some(Observation { program, values })
}

impl<'w> Lower<'_, 'w> {
    /// The numbers of one line: quantities in SI units, places normalised and in the own frame,
    /// vectors in metres.
    fn observed(&mut self, expr: &'w Expr, name: &str) -> Vec<(String, Reg)> {
        let value = self.expr(expr);
        if value.is_error() {
            return Vec::new();
        }
        let both = |(x, y): (Reg, Reg)| vec![(format!("{name}.x"), x), (format!("{name}.y"), y)];
        if value.ty.is_place() {
            let place = self.place_of(&value, expr.span);
            let (x, y) = self.turned(place);
            let (sx, sy) = (self.code.constant(X_SCALE_M), self.code.constant(Y_SCALE_M));
            return both((
                self.code.binary(BinaryOp::Div, x, sx),
                self.code.binary(BinaryOp::Div, y, sy),
            ));
        }
        match (&value.repr, value.ty) {
            (Repr::Two(x, y) | Repr::Three(x, y, _), Ty::Vector | Ty::Velocity) => {
                both(self.turned((*x, *y)))
            }
            (Repr::One(reg), Ty::Bool | Ty::Team | Ty::Mode | Ty::Role | Ty::Action) => {
                vec![(name.to_owned(), *reg)]
            }
            (Repr::One(reg), ty) if ty.dim().is_some() => vec![(name.to_owned(), *reg)],
            _ => {
                self.report(self.mismatch_with(value.ty, Ty::Number, expr.span, Instead::Observed));
                Vec::new()
            }
        }
    }
}
