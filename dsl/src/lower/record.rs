//! Records: what is measured of an episode.
//!
//! Rewards, endings and other records read a record by its name: their programs measure it
//! themselves, in cells of their own. `series of E` keeps every step's value and stands alone.

use super::step_world::StepWorld;
use super::value::{LiteralFrame, Repr, Scope, Value};
use super::{Lower, ProgramStage, World};
use crate::ast::{Binding, Expr, ExprKind, Ident, Span};
use crate::check::names;
use crate::check::types::Ty;
use crate::problem::Problem;
use crate::problem::facts::{Instead, Names, Scopes, Types};
use crate::source::FileId;
use setpiece_scenario::pitch::{X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::{BinaryOp, Record, Reg, When};

/// Lowers the records.
pub(crate) fn lower_records(step: &StepWorld<'_, '_>) -> Vec<Record> {
    let records = &step.world.flat.records;
    for binding in records {
        check_name(step.world, &binding.name);
    }
    records.iter().filter_map(|binding| lower_record(step, binding)).collect()
}

/// Reports a record that a value or player of its name hides wherever it is read, and warns of one
/// that a word of the language does.
fn check_name(world: &World<'_>, name: &Ident) {
    let value = world.declaration(&name.node).map(|at| (at, "a value"));
    let known = value.or_else(|| world.player(&name.node).map(|at| (at, "a player")));
    let name_of = || name.node.clone();
    if let Some((at, kind)) = known {
        // Of the two the author wrote the one that stands in their own scenario.
        let is_record = world.flat.is_own(name.span) || !world.flat.is_own(at);
        let (again, first) = if is_record { (name.span, at) } else { (at, name.span) };
        let kinds = ("a record", kind);
        world.report(Problem::new(again, Names::Shared { name: name_of(), kinds, first }));
    } else if let Some(whose) = names::owner_of_value(&name.node)
        && name.span.file == FileId(0)
    {
        let fact = Names::UnreadableRecord { name: name_of(), whose };
        world.report(Problem::new(name.span, fact));
    }
}

fn lower_record<'w>(step: &StepWorld<'_, 'w>, binding: &'w Binding) -> Option<Record> {
    let mut lower =
        Lower::in_step(step, ProgramStage::Record, Scope::new(true, LiteralFrame::World));
    if let Some(team) = step.agents {
        let team = lower.code.constant(team.index() as f64);
        lower.team = Some(team);
    }
    let series = series_of(binding);
    let expr = series.unwrap_or(&binding.value);
    let name = binding.name.span;
    let value = lower.inline(name, name, |lower| lower.expr(expr))?;
    let values = lower.measured(&value, expr)?;
    // A program that reads `me` runs once per agent.
    let me = lower.remembered.per_agent.then(|| lower.code.me());
    let roots: Vec<Reg> = values.iter().copied().chain(me).collect();
    let (program, layout) = lower.code.finish(&roots);
    let values = values.iter().map(|&reg| layout.reg(reg)).collect();
    let (name, unit) = (binding.name.node.clone(), value.ty.dim().unwrap_or_default());
    Some(Record { name, program, values, series: series.is_some(), unit })
}

/// Whether a record can hold a value.
fn is_measure(value: &Value<'_>) -> bool {
    let ty = value.ty;
    let is_number = matches!(ty, Ty::Bool | Ty::Team) || ty.dim().is_some();
    ty.is_place() || is_number && matches!(value.repr, Repr::One(_))
}

/// What is kept of every step, of a `series of E`.
fn series_of(binding: &Binding) -> Option<&Expr> {
    match &binding.value.kind {
        ExprKind::OverTime { kind, of } if kind.node == "series" => Some(of),
        _ => None,
    }
}

impl<'w> Lower<'_, 'w> {
    /// The value of a record by its name, wherever the match is judged.
    pub(super) fn recorded(&mut self, name: &str, span: Span) -> Option<Value<'w>> {
        let world = self.world;
        let binding = world.record(name)?;
        // In the record itself its name means what it means in the file, as before the match.
        let is_elsewhere = !self.stage.judges() || self.is_inlining(binding.name.span);
        if is_elsewhere && world.library.find(span.file, name).is_some() {
            return None;
        }
        if !self.stage.judges() {
            let name = name.to_owned();
            return Some(self.fail(Problem::new(span, Scopes::MeasuredLater { name })));
        }
        if series_of(binding).is_some() {
            let name = name.to_owned();
            return Some(self.fail(Problem::new(span, Types::SeriesIsNoValue { name })));
        }
        world.mark_used(binding.name.span);
        let known = self.remembered.records.iter();
        let mut known = known.filter(|(known, when, _)| *known == name && *when == self.when);
        if let Some((.., value)) = known.next() {
            return Some(value.clone());
        }
        let value = self.seen_by_all(name, span, |lower| Some(lower.measure(binding, span)));
        let value = value.unwrap_or_else(Value::error);
        self.remembered.records.push((&binding.name.node, self.when, value.clone()));
        Some(value)
    }

    /// Measures a record in this program, outside every loop, as its own program does.
    fn measure(&mut self, binding: &'w Binding, span: Span) -> Value<'w> {
        let loops = self.code.leave_loops();
        let us = self.side_with_agents().map(|team| self.code.constant(team.index() as f64));
        let outer = (
            self.event.take(),
            std::mem::replace(&mut self.team, us),
            std::mem::replace(&mut self.stage, ProgramStage::Record),
        );
        let world = self.world;
        let read = |lower: &mut Self| {
            let value = lower.inline(binding.name.span, span, |lower| {
                lower.within(Scope::new(true, LiteralFrame::World), |lower| {
                    lower.expr(&binding.value)
                })
            });
            // What no record can hold is reported where the record is declared.
            value.filter(is_measure).unwrap_or_else(Value::error)
        };
        let value = if self.when == When::Now {
            read(self)
        } else {
            let found = world.found();
            let value = world.tentatively(|| read(self));
            if world.found() > found {
                let name = binding.name.node.clone();
                self.fail(Problem::new(span, Scopes::RecordNotAStepAgo { name }))
            } else {
                value
            }
        };
        (self.event, self.team, self.stage) = outer;
        self.code.return_to(loops);
        value
    }

    /// Reads what is kept of the episode. An ending is decided once for all agents, so it can't
    /// read what each agent sees differently; `None` after a report.
    pub(super) fn seen_by_all<T>(
        &mut self,
        name: &str,
        span: Span,
        read: impl FnOnce(&mut Self) -> Option<T>,
    ) -> Option<T> {
        let outer = std::mem::take(&mut self.remembered.has_view);
        let is_first = matches!(self.stage, ProgramStage::Ending);
        if is_first {
            self.remembered.ending_reads = Some(span);
        }
        let value = read(self);
        if is_first {
            self.remembered.ending_reads = None;
        }
        let has_view = std::mem::replace(&mut self.remembered.has_view, outer);
        self.remembered.has_view |= has_view;
        if has_view && matches!(self.stage, ProgramStage::Ending) {
            let name = name.to_owned();
            self.report(Problem::new(span, Scopes::KeptForEachAgent { name }));
            return None;
        }
        value
    }

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
        match value.repr {
            Repr::One(reg) if is_measure(value) => Some(vec![reg]),
            _ => {
                self.report(self.mismatch_with(value.ty, Ty::Number, expr.span, Instead::Recorded));
                None
            }
        }
    }
}
