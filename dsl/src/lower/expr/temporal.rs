//! Operators over time: evaluated once per step, outside every loop, whatever guards their use.

use super::super::value::Value;
use super::super::{Lower, ProgramStage};
use crate::ast::{Expr, Span};
use crate::check::types::Ty;
use crate::problem::Problem;
use crate::problem::facts::Scopes;
use setpiece_scenario::pitch::LONGEST_S;
use setpiece_scenario::vocabulary::Function;
use setpiece_scenario::{BinaryOp, Reg, UnaryOp, When};

impl<'w> Lower<'_, 'w> {
    pub(super) fn temporal(
        &mut self,
        function: Function,
        given: &[&'w Expr],
        span: Span,
    ) -> Value<'w> {
        use Function as F;
        match (function, given) {
            (F::Prev, &[e]) => self.before(e, span).unwrap_or_else(Value::error),
            (F::Delta, &[e]) => self.delta(e, span),
            (F::Closing, &[a, b]) => self.closing(a, b, span),
            _ if matches!(self.stage, ProgramStage::Observation) => self.fail(Problem::new(
                span,
                Scopes::ObservationRemembersNothing { function: function.name() },
            )),
            _ if self.when == When::Prev => self.fail(Problem::new(
                span,
                Scopes::NotAStepAgo { function: function.name().to_owned() },
            )),
            _ if !self.stage.is_step() => self.fail(Problem::new(
                span,
                Scopes::NothingToLookBackAt { function: function.name() },
            )),
            _ => self.hoisted(|lower| lower.over_time(function, given)),
        }
    }

    /// `possession changes to right`: in the step in which it goes over; the first owner is no
    /// change.
    pub(super) fn changes(
        &mut self,
        what: &'w Expr,
        to: Option<&'w Expr>,
        span: Span,
    ) -> Value<'w> {
        let now = self.expr(what);
        let Some(before) = self.before(what, span) else { return Value::error() };
        if now.is_error() || before.is_error() {
            return Value::error();
        }
        if !now.regs().is_empty() && now.regs() == before.regs() {
            let text = self.world.text(what.span);
            return self.fail(Problem::new(span, Scopes::NeverChanges { text }));
        }
        let different = self.equal(false, (&now, what), (&before, what));
        let mut reg = self.reg(&different);
        if matches!(now.ty, Ty::Team | Ty::Player) {
            let old = self.reg(&before);
            let zero = self.code.constant(0.0);
            let somebody = self.code.binary(BinaryOp::Ge, old, zero);
            reg = self.code.binary(BinaryOp::And, reg, somebody);
        }
        if let Some(to) = to {
            let wanted = self.beside(now.ty, to);
            let reached = self.equal(true, (&now, what), (&wanted, to));
            let reached = self.reg(&reached);
            reg = self.code.binary(BinaryOp::And, reg, reached);
        }
        Value::one(if different.is_error() { Ty::Error } else { Ty::Bool }, reg)
    }

    /// An expression a step ago; reports where there is none.
    pub(super) fn before(&mut self, expr: &'w Expr, span: Span) -> Option<Value<'w>> {
        if !self.stage.is_step() {
            self.report(Problem::new(span, Scopes::NoEarlierStep));
            return None;
        }
        if self.when == When::Prev {
            self.report(Problem::new(span, Scopes::OneStepRemembered));
            return None;
        }
        self.when = When::Prev;
        let value = self.expr(expr);
        self.when = When::Now;
        Some(value)
    }

    /// Writes code outside every loop, where no event and no element of a loop is known.
    pub(super) fn hoisted<T>(&mut self, f: impl FnOnce(&mut Self) -> T) -> T {
        let loops = self.code.leave_loops();
        let event = self.event.take();
        let result = f(self);
        self.event = event;
        self.code.return_to(loops);
        result
    }

    fn over_time(&mut self, function: Function, given: &[&'w Expr]) -> Value<'w> {
        use Function as F;
        match (function, given) {
            (F::Held, &[c, d]) => {
                let (c, d) = (self.condition(c), self.time_span(d));
                Value::one(Ty::Bool, self.code.held(c, d))
            }
            (F::Ever, &[c]) => {
                let c = self.condition(c);
                Value::one(Ty::Bool, self.code.ever(c))
            }
            (F::Always, &[c]) => {
                let c = self.condition(c);
                let broken = self.code.unary(UnaryOp::Not, c);
                let ever = self.code.ever(broken);
                Value::one(Ty::Bool, self.code.unary(UnaryOp::Not, ever))
            }
            (F::Since, &[c]) => {
                let c = self.condition(c);
                Value::one(Ty::DURATION, self.code.since(c))
            }
            (F::Until, &[c, d]) => {
                let (c, d) = (self.condition(c), self.condition(d));
                Value::one(Ty::Bool, self.code.until(c, d))
            }
            (F::Within, &[c, d]) => {
                let (c, d) = (self.condition(c), self.time_span(d));
                let since = self.code.since(c);
                Value::one(Ty::Bool, self.code.binary(BinaryOp::Le, since, d))
            }
            (F::Potential, &[e, gamma]) => self.potential(e, gamma),
            _ => Value::error(),
        }
    }

    /// How far back an operator looks.
    fn time_span(&mut self, expr: &'w Expr) -> Reg {
        let reg = self.want_reg(expr, Ty::DURATION);
        self.check_range(reg, (0.0, LONGEST_S), "the time", expr.span, "`0 steps..1000000 steps`");
        reg
    }

    fn delta(&mut self, e: &'w Expr, span: Span) -> Value<'w> {
        let now = self.expr(e);
        let Some(before) = self.before(e, span) else { return Value::error() };
        if now.is_error() || before.is_error() {
            return Value::error();
        }
        let ty = match now.ty {
            ty if ty.dim().is_some() => ty,
            Ty::Vector | Ty::Velocity => now.ty,
            ty if ty.is_place() => Ty::Vector,
            ty => return self.fail(self.mismatch(ty, Ty::Number, e.span)),
        };
        if ty.dim().is_some() {
            let (p, q) = (self.reg(&now), self.reg(&before));
            let change = self.code.binary(BinaryOp::Sub, p, q);
            return Value::one(
                ty,
                if ty == Ty::ANGLE { self.code.unary(UnaryOp::Wrap, change) } else { change },
            );
        }
        let p = if now.ty.is_place() { self.place_of(&now, e.span) } else { self.pair(&now) };
        self.when = When::Prev;
        let q =
            if before.ty.is_place() { self.place_of(&before, e.span) } else { self.pair(&before) };
        self.when = When::Now;
        Value::two(
            ty,
            (self.code.binary(BinaryOp::Sub, p.0, q.0), self.code.binary(BinaryOp::Sub, p.1, q.1)),
        )
    }

    /// What a potential pays in a step: γ Φ(s') - Φ(s) (Ng, Harada and Russell 1999, theorem 1).
    ///
    /// A state in which the episode terminates has the potential 0. Otherwise the best policy would
    /// depend on where episodes end (Grzes 2017). Φ(s) is what the last step was judged by: before
    /// any restart, and for the player of that step. So the payments of an episode add up to -Φ of
    /// its start, and nothing that moves the ball or the agent in between is left out.
    fn potential(&mut self, e: &'w Expr, gamma: &'w Expr) -> Value<'w> {
        let now = self.want_reg(e, Ty::Number);
        let discount = self.want_reg(gamma, Ty::Number);
        self.check_range(discount, (0.0, 1.0), "`gamma`", gamma.span, "`0..1`");
        let before = self.code.value_before(now);
        let discounted = self.code.binary(BinaryOp::Mul, discount, now);
        let (over, nothing) = (self.code.terminated(), self.code.constant(0.0));
        let discounted = self.code.select(over, nothing, discounted);
        Value::one(Ty::Number, self.code.binary(BinaryOp::Sub, discounted, before))
    }

    /// The length by which two places came nearer in this step.
    fn closing(&mut self, a: &'w Expr, b: &'w Expr, span: Span) -> Value<'w> {
        let apart = |lower: &mut Self| -> Reg {
            let (p, q) = (lower.want_point(a), lower.want_point(b));
            lower.distance(p, q)
        };
        if !self.stage.is_step() || self.when == When::Prev {
            self.before(a, span);
            return Value::error();
        }
        debug_assert!(!matches!(self.stage, ProgramStage::Start(_)));
        let found = self.world.found();
        let now = apart(self);
        if self.world.found() > found {
            return Value::error();
        }
        self.when = When::Prev;
        let before = apart(self);
        self.when = When::Now;
        Value::one(Ty::LENGTH, self.code.binary(BinaryOp::Sub, before, now))
    }
}
