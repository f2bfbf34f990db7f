//! Expressions: typed and lowered in one pass.

mod arithmetic;
mod call;
mod episode;
mod event;
mod function;
mod grid;
mod member;
mod metres;
mod name;
mod random;
mod region;
mod sample;
mod set;
mod temporal;

use super::mirror::Mirror;
use super::value::{LiteralFrame, Repr, Value};
use super::{DEPTH_MAX, Lower};
use crate::ast::{Expr, ExprKind, PrefixOp, Span};
use crate::check::types::Ty;
use crate::index::{Index, ValueFact};
use crate::problem::Problem;
use crate::problem::facts::{Calls, Instead, Operand, Scopes, Types};
use setpiece_scenario::pitch::{X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::vocabulary::{PitchFigure, Unit};
use setpiece_scenario::{BinaryOp, Reg, UnaryOp as WorldOp};

/// Whether an expression is written as `(x, y)`, signs and brackets aside.
pub(crate) fn is_tuple(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Tuple(_) => true,
        ExprKind::Unary(PrefixOp::Neg | PrefixOp::Plus, inner) | ExprKind::Own(inner) => {
            is_tuple(inner)
        }
        _ => false,
    }
}

impl<'w> Lower<'_, 'w> {
    /// Lowers an expression.
    pub(crate) fn expr(&mut self, expr: &'w Expr) -> Value<'w> {
        if !self.pay() {
            return Value::error();
        }
        self.depth += 1;
        let value = if self.depth > DEPTH_MAX {
            if self.depth == DEPTH_MAX + 1 {
                self.report(Problem::new(expr.span, Calls::TooDeep));
            }
            Value::error()
        } else {
            self.expr_kind(expr)
        };
        self.depth -= 1;
        if !value.is_error() {
            let note = |index: &mut Index| index.value(expr.span, self.value_fact(&value));
            self.world.library.note(note);
        }
        value
    }

    /// What an editor shows of a value.
    fn value_fact(&self, value: &Value<'w>) -> ValueFact {
        let constants = value.regs().into_iter().map(|reg| self.code.constant_of(reg));
        ValueFact {
            ty: value.ty.noun(),
            constants: constants.collect::<Option<_>>().unwrap_or_default(),
            is_point: value.ty == Ty::Point,
        }
    }

    fn expr_kind(&mut self, expr: &'w Expr) -> Value<'w> {
        let span = expr.span;
        match &expr.kind {
            ExprKind::Number { value, is_int, unit } => self.number(*value, *is_int, *unit, span),
            ExprKind::Bool(value) => Value::one(Ty::Bool, self.code.bool(*value)),
            ExprKind::String(text) => Value { ty: Ty::String, repr: Repr::Text(text.clone()) },
            ExprKind::Name(name) => self.name(name, span),
            ExprKind::Role(role) => {
                let role = self.world.mirror.role(*role);
                Value::one(Ty::Role, self.code.constant(role.index() as f64))
            }
            ExprKind::Member(of, member) => self.member(of, member, span),
            ExprKind::Own(inner) => self.own(inner, span),
            ExprKind::Tuple(parts) => self.tuple(parts, span),
            ExprKind::List(parts) => {
                let list = parts.iter().map(|part| self.expr(part)).collect();
                Value { ty: Ty::List, repr: Repr::List(list) }
            }
            ExprKind::Call { name, args } => self.call(name, args, span),
            ExprKind::Unary(op, inner) => self.unary(*op, inner),
            ExprKind::Binary(op, a, b) => self.binary(op, a, b, span),
            ExprKind::If(condition, then, otherwise) => self.if_expr(condition, then, otherwise),
            ExprKind::HasBall(who) => self.has_ball(who),
            ExprKind::Changes(what, to) => self.changes(what, to.as_deref(), span),
            ExprKind::Event(event) => self.event_happened(event),
            ExprKind::OverTime { kind, of } => self.over_episode(kind, of, span),
            ExprKind::Broken => Value::error(),
        }
    }

    fn number(&mut self, value: f64, is_int: bool, unit: Option<Unit>, span: Span) -> Value<'w> {
        let si = unit.map_or(value, |unit| unit.si(value));
        if !si.is_finite() {
            return self.fail(Problem::new(span, Types::NumberTooLarge));
        }
        let reg = self.code.constant(si);
        let ty = match unit {
            Some(unit) => Ty::of_unit(unit),
            None if is_int => Ty::Int,
            None => Ty::Number,
        };
        Value::one(ty, reg)
    }

    fn own(&mut self, inner: &'w Expr, span: Span) -> Value<'w> {
        if self.team.is_none() {
            return self.fail(Problem::new(span, Scopes::OwnWithoutTeam));
        }
        if let Some(path) = path_of(inner) {
            let team = self.team.map_or_else(Value::error, |team| Value::one(Ty::Team, team));
            return self.member_of_team(&team, &path, inner.span, span);
        }
        self.in_frame(LiteralFrame::Own, |lower| lower.expr(inner))
    }

    /// `(0.5, 0.1)`, `(27m, 8m)`, `(5m/s, 0m/s)`
    fn tuple(&mut self, parts: &'w [Expr], span: Span) -> Value<'w> {
        let values: Vec<Value<'w>> = parts.iter().map(|part| self.expr(part)).collect();
        if values.iter().any(Value::is_error) {
            return Value::error();
        }
        let kinds: Vec<Option<Ty>> = values
            .iter()
            .map(|value| match value.ty {
                ty if ty.is_plain() => Some(Ty::Number),
                Ty::LENGTH => Some(Ty::LENGTH),
                Ty::SPEED => Some(Ty::SPEED),
                _ => None,
            })
            .collect();
        if let Some(at) = kinds.iter().position(Option::is_none) {
            let (ty, at) = (values.get(at).map_or(Ty::Error, |value| value.ty), parts.get(at));
            let wanted = if kinds.contains(&Some(Ty::SPEED)) { Ty::SPEED } else { Ty::LENGTH };
            let span = at.map_or(span, |part| part.span);
            return self.fail(self.mismatch_with(ty, wanted, span, Instead::Coordinate));
        }
        let kinds: Vec<Ty> = kinds.into_iter().flatten().collect();
        let first = kinds.first().copied().unwrap_or(Ty::Number);
        // The height of a normalised point is in metres, as the frame has no scale for it.
        let wanted = |i: usize| if i == 2 && first == Ty::Number { Ty::LENGTH } else { first };
        if let Some(at) = (0..kinds.len()).find(|&i| kinds.get(i) != Some(&wanted(i))) {
            let spans =
                (parts.first().map_or(span, |p| p.span), parts.get(at).map_or(span, |p| p.span));
            let mut operand = |i: usize, span: Span| {
                let ty = values.get(i).map_or(Ty::Error, |value| value.ty);
                let plain = parts.get(i).filter(|_| ty.is_plain() && at < 2);
                Operand {
                    ty,
                    text: self.world.text(span),
                    span,
                    is_quoted: false,
                    metres: plain.and_then(|part| self.written_in_metres(part)),
                }
            };
            let (first, other) = (operand(0, spans.0), operand(at, spans.1));
            return self.fail(Problem::new(
                spans.1,
                Types::MixedPoint { first, other, is_height: at == 2 },
            ));
        }
        let regs: Vec<Reg> = values.iter().flat_map(Value::regs).collect();
        let (Some(&x), Some(&y)) = (regs.first(), regs.get(1)) else { return Value::error() };
        let (x, y) = if first == Ty::Number { self.in_metres(x, y) } else { (x, y) };
        let pair = self.turned((x, y));
        let ty = if first == Ty::SPEED { Ty::Velocity } else { Ty::Point };
        match regs.get(2) {
            Some(&z) => Value { ty, repr: Repr::Three(pair.0, pair.1, z) },
            None => Value::two(ty, pair),
        }
    }

    /// Normalised coordinates in metres. A formation is as large as the pitch.
    pub(super) fn in_metres(&mut self, x: Reg, y: Reg) -> (Reg, Reg) {
        let (sx, sy) = if self.scope.players_of.is_some() {
            let along = self.in_proportion(X_SCALE_M, PitchFigure::Length);
            (along, self.in_proportion(Y_SCALE_M, PitchFigure::Width))
        } else {
            (self.code.constant(X_SCALE_M), self.code.constant(Y_SCALE_M))
        };
        (self.code.binary(BinaryOp::Mul, x, sx), self.code.binary(BinaryOp::Mul, y, sy))
    }

    /// A pair of the reader's frame in the world's, or back: both frames differ by half a turn.
    pub(crate) fn turned(&mut self, (x, y): (Reg, Reg)) -> (Reg, Reg) {
        let (x, y) = match self.side() {
            Some(side) => {
                (self.code.binary(BinaryOp::Mul, x, side), self.code.binary(BinaryOp::Mul, y, side))
            }
            None => (x, y),
        };
        (x, if self.world.mirror == Mirror::Flanks { self.code.unary(WorldOp::Neg, y) } else { y })
    }

    /// An angle of the reader's frame in the world's, or back.
    pub(crate) fn turned_angle(&mut self, angle: Reg) -> Reg {
        let flipped = |lower: &mut Self, angle: Reg| match lower.world.mirror {
            Mirror::Flanks => lower.code.unary(WorldOp::Neg, angle),
            _ => angle,
        };
        let Some(side) = self.side() else { return flipped(self, angle) };
        // side 1 adds nothing, side -1 adds half a turn.
        let one = self.code.constant(1.0);
        let half = self.code.constant(std::f64::consts::FRAC_PI_2);
        let away = self.code.binary(BinaryOp::Sub, one, side);
        let turn = self.code.binary(BinaryOp::Mul, away, half);
        let sum = self.code.binary(BinaryOp::Add, angle, turn);
        let turned = self.code.unary(WorldOp::Wrap, sum);
        flipped(self, turned)
    }

    /// A truth value.
    pub(crate) fn condition(&mut self, expr: &'w Expr) -> Reg {
        self.condition_or(expr, |_, _| None)
    }

    /// A truth value; `better` knows what was meant by some values that are none.
    pub(crate) fn condition_or(
        &mut self,
        expr: &'w Expr,
        better: impl FnOnce(&Self, Ty) -> Option<(String, Option<Span>)>,
    ) -> Reg {
        let value = self.expr(expr);
        self.condition_of(&value, expr, better)
    }

    /// The truth value that a value is; `better` knows what was meant by some that are none.
    fn condition_of(
        &mut self,
        value: &Value<'w>,
        expr: &'w Expr,
        better: impl FnOnce(&Self, Ty) -> Option<(String, Option<Span>)>,
    ) -> Reg {
        if !value.is_error() && value.ty != Ty::Bool {
            let condition = better(self, value.ty);
            let instead = condition.map_or(Instead::Condition, |(condition, whole)| {
                Instead::Repeated { condition, whole }
            });
            self.report(self.mismatch_with(value.ty, Ty::Bool, expr.span, instead));
            return self.code.unknown();
        }
        self.reg(value)
    }
}

/// `a.b` of `own.a.b`.
pub(crate) fn path_of(expr: &Expr) -> Option<String> {
    match &expr.kind {
        ExprKind::Name(name) => Some(name.clone()),
        ExprKind::Member(of, member) => Some(format!("{}.{}", path_of(of)?, member.node)),
        _ => None,
    }
}
