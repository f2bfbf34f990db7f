//! Records: what is measured of an episode.
//!
//! `count of EVENT`, `max of E` and their like are sums in cells, so that they may stand anywhere
//! in a record: `(count of pass completed by left) / (count of pass by left)`. `series of E` keeps
//! every step's value and stands alone.

use super::step_world::StepWorld;
use super::value::{LiteralFrame, Repr, Scope, Value};
use super::{Lower, ProgramStage};
use crate::ast::{Binding, Expr, ExprKind, Ident, Span};
use crate::check::types::Ty;
use crate::lower::known::Remembered;
use crate::problem::Problem;
use crate::problem::facts::{Instead, Scopes};
use setpiece_scenario::pitch::{X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::{BinaryOp, Fold, FoldKind, Record, Reg};

/// Lowers the records.
pub(crate) fn lower_records(step: &StepWorld<'_, '_>) -> Vec<Record> {
    step.world.flat.records.iter().filter_map(|binding| lower_record(step, binding)).collect()
}

fn lower_record<'w>(step: &StepWorld<'_, 'w>, binding: &'w Binding) -> Option<Record> {
    let mut lower = Lower::in_step(
        step,
        ProgramStage::Record(Remembered::default()),
        Scope::new(true, LiteralFrame::World),
    );
    if let Some(team) = step.agents {
        let team = lower.code.constant(team.index() as f64);
        lower.team = Some(team);
    }
    let (series, expr) = match &binding.value.kind {
        ExprKind::OverTime { kind, of } if kind.node == "series" => (true, &**of),
        _ => (false, &binding.value),
    };
    let value = lower.expr(expr);
    let values = lower.measured(&value, expr)?;
    // A program that reads `me` runs once per agent.
    let per_agent =
        matches!(&lower.stage, ProgramStage::Record(remembered) if remembered.per_agent);
    let me = per_agent.then(|| lower.code.me());
    let roots: Vec<Reg> = values.iter().copied().chain(me).collect();
    let (program, layout) = lower.code.finish(&roots);
    let values = values.iter().map(|&reg| layout.reg(reg)).collect();
    Some(Record { name: binding.name.node.clone(), program, values, series })
}

impl<'w> Lower<'_, 'w> {
    /// The registers of what a record shows: a number in SI units, or a normalised place.
    fn measured(&mut self, value: &Value<'w>, expr: &Expr) -> Option<Vec<Reg>> {
        if value.is_error() {
            return None;
        }
        if value.ty.is_place() {
            let (x, y) = self.place_of(value, expr.span);
            let (sx, sy) = (self.code.constant(X_SCALE_M), self.code.constant(Y_SCALE_M));
            return Some(vec![
                self.code.binary(BinaryOp::Div, x, sx),
                self.code.binary(BinaryOp::Div, y, sy),
            ]);
        }
        match (&value.repr, value.ty) {
            (Repr::One(reg), Ty::Bool | Ty::Team) => Some(vec![*reg]),
            (Repr::One(reg), ty) if ty.dim().is_some() => Some(vec![*reg]),
            _ => {
                self.report(self.mismatch_with(value.ty, Ty::Number, expr.span, Instead::Recorded));
                None
            }
        }
    }

    /// `count of EVENT`, `max of E`: over the episode so far.
    pub(super) fn over_episode(&mut self, kind: &'w Ident, of: &'w Expr, span: Span) -> Value<'w> {
        if !matches!(self.stage, ProgramStage::Record(_)) || kind.node == "series" {
            let alone = kind.node == "series" && matches!(self.stage, ProgramStage::Record(_));
            let kind = kind.node.clone();
            let fact = if alone { Scopes::SeriesStandsAlone } else { Scopes::OverEpisode { kind } };
            return self.fail(Problem::new(span, fact));
        }
        let loops = self.code.leave_loops();
        let event = self.event.take();
        let value = match kind.node.as_str() {
            "count" => self.counted(of),
            kind => self.gathered(kind, of),
        };
        self.event = event;
        self.code.return_to(loops);
        value
    }

    /// How many events there were, or at how many steps a condition held.
    fn counted(&mut self, of: &'w Expr) -> Value<'w> {
        let more = if let ExprKind::Event(event) = &of.kind {
            let Some(matching) = self.open_events(event) else { return Value::error() };
            let guard = matching.guard;
            self.close_events(matching, Fold { kind: FoldKind::Count, value: None, guard })
        } else {
            self.condition(of)
        };
        let cell = self.code.new_cell();
        let before = self.code.cell(cell);
        let sum = self.code.binary(BinaryOp::Add, before, more);
        self.code.assign(cell, sum, None);
        Value::one(Ty::Int, sum)
    }

    /// `max`, `min`, `mean`, `sum`, `first` or `last` of a value.
    fn gathered(&mut self, kind: &str, of: &'w Expr) -> Value<'w> {
        let value = self.expr(of);
        if value.is_error() || kind == "last" {
            return value;
        }
        let Some(regs) = self.measurable(&value, of, kind) else { return Value::error() };
        let seen = self.code.new_cell();
        let before = self.code.cell(seen);
        let one = self.code.constant(1.0);
        let now = self.code.binary(BinaryOp::Add, before, one);
        let results: Vec<Reg> =
            regs.iter().map(|&reg| self.gather(kind, reg, before, now)).collect();
        self.code.assign(seen, now, None);
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
    fn gather(&mut self, kind: &str, reg: Reg, before: Reg, now: Reg) -> Reg {
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
        if kind == "mean" { self.code.binary(BinaryOp::Div, next, now) } else { next }
    }
}
