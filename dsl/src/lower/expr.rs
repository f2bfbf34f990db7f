//! Expressions: typed and lowered in one pass.

mod arithmetic;
mod call;
mod event;
mod function;
mod member;
mod name;
mod random;
mod region;
mod sample;
mod set;
mod temporal;

use super::mirror::Mirror;
use super::value::{Frame, Repr, Value};
use super::{DEPTH_MAX, Lower};
use crate::ast::{Expr, ExprKind, Span, UnaryOp};
use crate::check::types::Ty;
use crate::problem::{Code, Problem};
use setpiece_scenario::pitch::{X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::vocabulary::Unit;
use setpiece_scenario::{BinaryOp, Reg, UnaryOp as WorldOp};

/// Whether an expression is written as `(x, y)`, signs and brackets aside.
pub(crate) fn is_tuple(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Tuple(_) => true,
        ExprKind::Unary(UnaryOp::Neg | UnaryOp::Plus, inner) | ExprKind::Own(inner) => is_tuple(inner),
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
                self.report(
                    Problem::new(Code::TooDeep, expr.span, "the expression is nested too deeply", "")
                        .help("name a part of it with `let`"),
                );
            }
            Value::error()
        } else {
            self.expr_kind(expr)
        };
        self.depth -= 1;
        value
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
            return self.fail(
                Problem::new(Code::Impossible, span, "the number is too large", "")
                    .help("the pitch is 110m by 72m: write less"),
            );
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
            return self.fail(
                Problem::new(Code::WrongScope, span, "`own` needs a team", "no team is known here")
                    .help("use it in a `team`, a `formation` or a `reward`; elsewhere write world coordinates"),
            );
        }
        if let Some(path) = path_of(inner) {
            let team = self.team.map_or_else(Value::error, |team| Value::one(Ty::Team, team));
            return self.member_of_team(&team, &path, inner.span, span);
        }
        self.in_frame(Frame::Own, |lower| lower.expr(inner))
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
            let mut problem = self.mismatch(ty, wanted, at.map_or(span, |part| part.span));
            problem.help = Some("a point is written `(0.5, 0.1)` or `(27m, 8m)`, a velocity `(5m/s, 0m/s)`".to_owned());
            return self.fail(problem);
        }
        let kinds: Vec<Ty> = kinds.into_iter().flatten().collect();
        let first = kinds.first().copied().unwrap_or(Ty::Number);
        // The height of a normalised point is in metres, as the frame has no scale for it.
        let wanted = |i: usize| if i == 2 && first == Ty::Number { Ty::LENGTH } else { first };
        if let Some(at) = (0..kinds.len()).find(|&i| kinds.get(i) != Some(&wanted(i))) {
            let text = |i: usize| parts.get(i).map_or(String::new(), |part| self.world.text(part.span));
            let spans = (parts.first().map_or(span, |p| p.span), parts.get(at).map_or(span, |p| p.span));
            let noun = |i: usize| values.get(i).map_or(String::new(), |value| value.ty.noun());
            return self.fail(
                Problem::new(
                    Code::MixedUnits,
                    spans.1,
                    format!("`{}` is {}, `{}` {}: a point has one unit", text(0), noun(0), text(at), noun(at)),
                    noun(at),
                )
                .label(spans.0, noun(0))
                .help(if at == 2 {
                    "a place on the pitch has two coordinates; a third is a height, `1m`"
                } else {
                    "write both coordinates normalised, `(0.5, 0.1)`, or both in metres, `(27m, 8m)`"
                }),
            );
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

    /// Normalised coordinates in metres.
    pub(super) fn in_metres(&mut self, x: Reg, y: Reg) -> (Reg, Reg) {
        let (sx, sy) = (self.code.constant(X_SCALE_M), self.code.constant(Y_SCALE_M));
        (self.code.binary(BinaryOp::Mul, x, sx), self.code.binary(BinaryOp::Mul, y, sy))
    }

    /// A pair of the reader's frame in the world's, or back: both frames differ by half a turn.
    pub(crate) fn turned(&mut self, (x, y): (Reg, Reg)) -> (Reg, Reg) {
        let (x, y) = match self.side() {
            Some(side) => (self.code.binary(BinaryOp::Mul, x, side), self.code.binary(BinaryOp::Mul, y, side)),
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

    /// A truth value; `help` knows a better form for some values that are none.
    fn condition_or(&mut self, expr: &'w Expr, help: impl FnOnce(&Self, Ty) -> Option<String>) -> Reg {
        let value = self.expr(expr);
        if !value.is_error() && value.ty != Ty::Bool {
            let mut problem = self.mismatch(value.ty, Ty::Bool, expr.span);
            problem.help = help(self, value.ty).or_else(|| {
                Some(match value.ty {
                    Ty::Team | Ty::Player => "compare it, as in `possession == left`, or write `… has ball`".to_owned(),
                    ty if ty.dim().is_some() => "compare it with something: `… > 0`".to_owned(),
                    ty if ty.is_place() || ty == Ty::Region => "ask where something is: `ball in right.box`".to_owned(),
                    _ => "write a condition, for example `us has ball`".to_owned(),
                })
            });
            self.report(problem);
            return self.code.unknown();
        }
        self.reg(&value)
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
