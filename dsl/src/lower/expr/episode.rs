//! `count of EVENT`, `max of E`: over the episode so far.
//!
//! They are sums in cells, written outside every loop, so that they may stand anywhere in what
//! judges the match: `(count of pass completed by left) / (count of pass by left)`.

use super::super::value::{Repr, Value};
use super::super::{Lower, ProgramStage};
use crate::ast::{Expr, ExprKind, Ident, Span};
use crate::check::types::Ty;
use crate::problem::Problem;
use crate::problem::facts::{Instead, Scopes};
use setpiece_scenario::{BinaryOp, Fold, FoldKind, Reg, When};

impl<'w> Lower<'_, 'w> {
    /// `count of EVENT`, `max of E`: over the episode so far, or up to the step before.
    pub(super) fn over_episode(&mut self, kind: &'w Ident, of: &'w Expr, span: Span) -> Value<'w> {
        let is_series = kind.node == "series";
        if !self.stage.judges() || is_series {
            let kind = kind.node.clone();
            let alone = is_series && matches!(self.stage, ProgramStage::Record);
            let fact = if alone { Scopes::SeriesStandsAlone } else { Scopes::OverEpisode { kind } };
            return self.fail(Problem::new(span, fact));
        }
        if kind.node == "last" {
            return self.expr(of);
        }
        self.hoisted(|lower| {
            let when = std::mem::replace(&mut lower.when, When::Now);
            let value = match kind.node.as_str() {
                "count" => lower.counted(of, when),
                kind => lower.gathered(kind, of, when),
            };
            lower.when = when;
            value
        })
    }

    /// How many events there were, or at how many steps a condition held.
    fn counted(&mut self, of: &'w Expr, when: When) -> Value<'w> {
        let more = if let ExprKind::Event(event) = &of.kind {
            let Some(matching) = self.open_events(event) else { return Value::error() };
            let guard = matching.guard;
            self.close_events(matching, Fold { kind: FoldKind::Count, value: None, guard })
        } else {
            let value = self.expr(of);
            if !value.is_error() && value.ty != Ty::Bool {
                self.report(self.mismatch_with(value.ty, Ty::Bool, of.span, Instead::Counted));
            }
            if value.ty != Ty::Bool {
                return Value::error();
            }
            self.reg(&value)
        };
        let cell = self.code.new_cell();
        let before = self.code.cell(cell);
        let sum = self.code.binary(BinaryOp::Add, before, more);
        self.code.assign(cell, sum, None);
        self.code.close_cell(cell);
        Value::one(Ty::Int, if when == When::Now { sum } else { before })
    }

    /// `max`, `min`, `mean`, `sum` or `first` of a value.
    fn gathered(&mut self, kind: &str, of: &'w Expr, when: When) -> Value<'w> {
        let value = self.expr(of);
        if value.is_error() {
            return value;
        }
        let Some(regs) = self.measurable(&value, of, kind) else { return Value::error() };
        let steps = self.code.new_cell();
        let before = self.code.cell(steps);
        let one = self.code.constant(1.0);
        let now = self.code.binary(BinaryOp::Add, before, one);
        let results: Vec<Reg> =
            regs.iter().map(|&reg| self.gather(kind, reg, (before, now), when)).collect();
        self.code.assign(steps, now, None);
        self.code.close_cell(steps);
        match *results.as_slice() {
            [x, y] => Value::two(value.ty, (x, y)),
            [result] => Value::one(
                if kind == "mean" && value.ty == Ty::Int { Ty::Number } else { value.ty },
                result,
            ),
            _ => Value::error(),
        }
    }

    fn measurable(&mut self, value: &Value<'w>, of: &'w Expr, kind: &str) -> Option<Vec<Reg>> {
        if value.ty.is_place() && kind == "first" {
            let (x, y) = self.place_of(value, of.span);
            return Some(vec![x, y]);
        }
        match value.repr {
            Repr::One(reg) if value.ty.dim().is_some() => Some(vec![reg]),
            _ => {
                let instead = Instead::Measured { kind: kind.to_owned() };
                self.report(self.mismatch_with(value.ty, Ty::Number, of.span, instead));
                None
            }
        }
    }

    /// One number over the episode: `before` and `now` count the steps.
    fn gather(&mut self, kind: &str, reg: Reg, (before, now): (Reg, Reg), when: When) -> Reg {
        let cell = self.code.new_cell();
        let kept = self.code.cell(cell);
        let next = match kind {
            "max" | "min" => {
                let op = if kind == "max" { BinaryOp::Max } else { BinaryOp::Min };
                let further = self.code.binary(op, kept, reg);
                self.code.select(before, further, reg)
            }
            "first" => self.code.select(before, kept, reg),
            _ => self.code.binary(BinaryOp::Add, kept, reg),
        };
        self.code.assign(cell, next, None);
        self.code.close_cell(cell);
        let of_steps = |lower: &mut Self, value: Reg, steps: Reg| match kind {
            "mean" => lower.code.binary(BinaryOp::Div, value, steps),
            _ => value,
        };
        if when == When::Now {
            return of_steps(self, next, now);
        }
        if kind == "sum" {
            return kept;
        }
        // Before the first step nothing has changed yet.
        let kept = of_steps(self, kept, before);
        let first = of_steps(self, next, now);
        self.code.select(before, kept, first)
    }
}
