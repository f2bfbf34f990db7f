//! The functions of the language that compute: numbers, places, angles.

use super::super::Lower;
use super::super::value::{Repr, Value};
use crate::ast::{Arg, Expr, Ident, Span};
use crate::check::types::Ty;
use crate::problem::Problem;
use crate::problem::facts::{Calls, Chance, Instead, Types};
use setpiece_scenario::pitch::{X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::vocabulary::{Field, Function};
use setpiece_scenario::{BinaryOp, Reg, UnaryOp};

impl<'w> Lower<'_, 'w> {
    /// Calls a function of the language. What is computed of something wrong is no news.
    pub(super) fn function(
        &mut self,
        function: Function,
        name: &'w Ident,
        args: &'w [Arg],
        span: Span,
    ) -> Value<'w> {
        let errors = self.world.errors();
        let value = self.computed(function, name, args, span);
        if self.world.errors() > errors { Value::error() } else { value }
    }

    fn computed(
        &mut self,
        function: Function,
        name: &'w Ident,
        args: &'w [Arg],
        span: Span,
    ) -> Value<'w> {
        use Function as F;
        let goes_through_players =
            args.iter().any(|arg| arg.binder.is_some() || arg.filter.is_some());
        match function {
            F::Min | F::Max if !goes_through_players && args.len() > 1 => {
                self.extreme(function, args)
            }
            F::Min
            | F::Max
            | F::Count
            | F::Any
            | F::All
            | F::Sum
            | F::Mean
            | F::MinBy
            | F::MaxBy => self.aggregate(function, args, span),
            F::Choice => self.choice(args, span),
            F::Shuffle => self.fail(Problem::new(span, Chance::ShuffleAsValue)),
            F::Rect | F::Circle | F::Polygon | F::Sector => self.region_call(function, args, span),
            _ => {
                let (names, required) = signature(function);
                let Some(given) = self.arguments(&name.node, args, span, names, required) else {
                    return Value::error();
                };
                let given: Vec<&'w Expr> = given.into_iter().flatten().collect();
                match (function, given.as_slice()) {
                    (
                        F::Prev
                        | F::Delta
                        | F::Closing
                        | F::Potential
                        | F::Held
                        | F::Ever
                        | F::Always
                        | F::Since
                        | F::Until
                        | F::Within,
                        _,
                    ) => self.temporal(function, &given, span),
                    (
                        F::Uniform | F::Normal | F::TruncatedNormal | F::Integer | F::Alternate,
                        _,
                    ) => self.draw(function, &given, span),
                    (F::Nearest, &[set, to]) => self.nearest(set, to),
                    (F::Pressed, &[who, within]) => self.pressed(who, within),
                    (F::Sees, &[who, place, within]) => self.sees(who, place, within),
                    (F::MinGap, &[set]) => self.min_gap(set, span),
                    (F::Grid, _) => self.fail(Problem::new(span, Calls::GridAlone)),
                    _ => self.math(function, &given, span),
                }
            }
        }
    }

    fn math(&mut self, function: Function, given: &[&'w Expr], span: Span) -> Value<'w> {
        use Function as F;
        match (function, given) {
            (F::Abs, &[x]) => self.number_op(x, Some, UnaryOp::Abs),
            (F::Floor, &[x]) => self.number_op(x, |ty| Some(whole(ty)), UnaryOp::Floor),
            (F::Ceil, &[x]) => self.number_op(x, |ty| Some(whole(ty)), UnaryOp::Ceil),
            (F::Round, &[x]) => self.number_op(x, |ty| Some(whole(ty)), UnaryOp::Round),
            (F::Sqrt, &[x]) => {
                let value =
                    self.number_op(x, |ty| ty.dim()?.root().map(Ty::with_dim), UnaryOp::Sqrt);
                self.check_domain_of(x, value, span, 0.0, "the root of a negative number")
            }
            (F::Log, &[x]) => {
                let value =
                    self.number_op(x, |ty| ty.is_plain().then_some(Ty::Number), UnaryOp::Log);
                self.check_domain_of(
                    x,
                    value,
                    span,
                    f64::MIN_POSITIVE,
                    "the logarithm of 0 or less",
                )
            }
            (F::Exp, &[x]) => Value::one(Ty::Number, {
                let reg = self.want_reg(x, Ty::Number);
                self.code.unary(UnaryOp::Exp, reg)
            }),
            (F::Sin | F::Cos, &[x]) => {
                let reg = self.want_reg(x, Ty::ANGLE);
                let op = if function == F::Sin { UnaryOp::Sin } else { UnaryOp::Cos };
                Value::one(Ty::Number, self.code.unary(op, reg))
            }
            (F::Pow, &[x, y]) => {
                let (p, q) = (self.want_reg(x, Ty::Number), self.want_reg(y, Ty::Number));
                Value::one(Ty::Number, self.code.binary(BinaryOp::Pow, p, q))
            }
            (F::Mod, &[x, y]) => {
                let a = self.expr(x);
                let b = self.like(y, a.ty);
                if a.is_error() || b.is_error() {
                    return Value::error();
                }
                if a.ty.dim().is_none() {
                    return self.fail(self.mismatch(a.ty, Ty::Number, x.span));
                }
                let (p, q) = (self.reg(&a), self.reg(&b));
                self.check_divisor(q, y, span);
                let ty = a.ty.join(b.ty).unwrap_or(a.ty);
                Value::one(ty, self.code.binary(BinaryOp::Mod, p, q))
            }
            (F::Clamp, &[x, low, high]) => self.clamp(x, low, high),
            (F::Smoothstep, &[low, high, x]) => self.smoothstep(low, high, x),
            (F::Distance, &[a, b]) => {
                let (p, q) = (self.want_point(a), self.want_point(b));
                Value::one(Ty::LENGTH, self.distance(p, q))
            }
            (F::GrfDistance, &[a, b]) => self.grf_distance(a, b),
            (F::Angle, &[a, b]) => {
                let (p, q) = (self.want_point(a), self.want_point(b));
                let (dx, dy) = (
                    self.code.binary(BinaryOp::Sub, q.0, p.0),
                    self.code.binary(BinaryOp::Sub, q.1, p.1),
                );
                let (dx, dy) = self.turned((dx, dy));
                Value::one(Ty::ANGLE, self.code.binary(BinaryOp::Atan2, dy, dx))
            }
            (F::Speed, &[x]) => self.speed(x),
            (F::Polar, &[r, angle]) => self.polar(r, angle),
            (F::Exists, &[p]) => {
                let reg = self.want_reg(p, Ty::Player);
                let present = self.exists_at_start(reg, p.span);
                let exists = present.unwrap_or_else(|| self.code.unary(UnaryOp::Exists, reg));
                Value::one(Ty::Bool, exists)
            }
            (F::OffsideLine, &[team]) => {
                let reg = self.want_reg(team, Ty::Team);
                let Some(x) = self.load(Field::OffsideLine, Some(reg), "offside_line", span) else {
                    return Value::error();
                };
                let (x, _) = self.turned((x, x));
                let scale = self.code.constant(X_SCALE_M);
                Value::one(Ty::Number, self.code.binary(BinaryOp::Div, x, scale))
            }
            _ => self.fail(Problem::new(span, Calls::NotYet { function: function.name() })),
        }
    }

    fn number_op(&mut self, x: &'w Expr, ty: impl Fn(Ty) -> Option<Ty>, op: UnaryOp) -> Value<'w> {
        let value = self.expr(x);
        if value.is_error() {
            return value;
        }
        match value.ty.dim().and_then(|_| ty(value.ty)) {
            Some(ty) => {
                let reg = self.reg(&value);
                Value::one(ty, self.code.unary(op, reg))
            }
            None => self.fail(self.mismatch(value.ty, Ty::Number, x.span)),
        }
    }

    fn check_domain_of(
        &mut self,
        x: &'w Expr,
        value: Value<'w>,
        span: Span,
        least: f64,
        what: &str,
    ) -> Value<'w> {
        let instr = value.regs().first().and_then(|&reg| self.code.instr(reg));
        let Some(&setpiece_scenario::Instr::Unary(UnaryOp::Sqrt | UnaryOp::Log, operand)) = instr
        else {
            return value;
        };
        if let Some((low, _)) = self.interval(operand)
            && low < least
        {
            let least =
                self.code.constant_of(operand).is_none().then(|| (self.world.text(x.span), low));
            return self
                .fail(Problem::new(span, Types::OutsideDomain { what: what.to_owned(), least }));
        }
        value
    }

    /// `min(a, b, …)`, `max(a, b, …)`
    fn extreme(&mut self, function: Function, args: &'w [Arg]) -> Value<'w> {
        let op = if function == Function::Min { BinaryOp::Min } else { BinaryOp::Max };
        let mut best: Option<Value<'w>> = None;
        for arg in args {
            let value = match &best {
                Some(first) => self.like(&arg.value, first.ty),
                None => self.expr(&arg.value),
            };
            if value.is_error() {
                return value;
            }
            if value.ty.dim().is_none() {
                return self.fail(self.mismatch(value.ty, Ty::Number, arg.value.span));
            }
            best = Some(match best {
                None => value,
                Some(first) => {
                    let (p, q) = (self.reg(&first), self.reg(&value));
                    let ty = first.ty.join(value.ty).unwrap_or(first.ty);
                    Value::one(ty, self.code.binary(op, p, q))
                }
            });
        }
        best.unwrap_or_else(Value::error)
    }

    /// A number of the same unit as another; a whole one stays whole.
    fn like(&mut self, expr: &'w Expr, ty: Ty) -> Value<'w> {
        if !ty.is_plain() {
            return self.want(expr, ty);
        }
        let value = self.expr(expr);
        match value.ty {
            Ty::Number if ty == Ty::Int => self.whole_constant(value),
            ty if ty.is_plain() => value,
            _ => self.convert(value, Ty::Number, expr),
        }
    }

    /// A constant without a fraction as the whole number that it is.
    fn whole_constant(&self, value: Value<'w>) -> Value<'w> {
        match value.repr {
            Repr::One(reg) if self.code.constant_of(reg).is_some_and(|v| v.fract() == 0.0) => {
                Value::one(Ty::Int, reg)
            }
            _ => value,
        }
    }

    fn clamp(&mut self, x: &'w Expr, low: &'w Expr, high: &'w Expr) -> Value<'w> {
        let value = self.expr(x);
        if value.is_error() {
            return value;
        }
        if value.ty.dim().is_none() {
            return self.fail(self.mismatch(value.ty, Ty::Number, x.span));
        }
        let (low, high) = (self.like(low, value.ty), self.like(high, value.ty));
        let (v, l, h) = (self.reg(&value), self.reg(&low), self.reg(&high));
        let raised = self.code.binary(BinaryOp::Max, v, l);
        let held = self.code.binary(BinaryOp::Min, raised, h);
        let whole_ends = low.ty == Ty::Int && high.ty == Ty::Int;
        let ty = if value.ty == Ty::Int && !whole_ends { Ty::Number } else { value.ty };
        Value::one(ty, held)
    }

    fn smoothstep(&mut self, low: &'w Expr, high: &'w Expr, x: &'w Expr) -> Value<'w> {
        let value = self.expr(x);
        let wanted = if value.ty.is_plain() { Ty::Number } else { value.ty };
        let (l, h) = (self.want_reg(low, wanted), self.want_reg(high, wanted));
        if value.is_error() {
            return value;
        }
        if value.ty.dim().is_none() {
            return self.fail(self.mismatch(value.ty, Ty::Number, x.span));
        }
        let v = self.reg(&value);
        let (zero, one) = (self.code.constant(0.0), self.code.constant(1.0));
        let (two, three) = (self.code.constant(2.0), self.code.constant(3.0));
        let (over, width) =
            (self.code.binary(BinaryOp::Sub, v, l), self.code.binary(BinaryOp::Sub, h, l));
        self.check_divisor(width, high, high.span);
        let share = self.code.binary(BinaryOp::Div, over, width);
        let share = self.code.binary(BinaryOp::Max, share, zero);
        let t = self.code.binary(BinaryOp::Min, share, one);
        let square = self.code.binary(BinaryOp::Mul, t, t);
        let twice = self.code.binary(BinaryOp::Mul, two, t);
        let rest = self.code.binary(BinaryOp::Sub, three, twice);
        Value::one(Ty::Number, self.code.binary(BinaryOp::Mul, square, rest))
    }

    /// Metres along the ground.
    pub(crate) fn distance(&mut self, p: (Reg, Reg), q: (Reg, Reg)) -> Reg {
        let (dx, dy) =
            (self.code.binary(BinaryOp::Sub, q.0, p.0), self.code.binary(BinaryOp::Sub, q.1, p.1));
        self.code.binary(BinaryOp::Hypot, dx, dy)
    }

    fn grf_distance(&mut self, a: &'w Expr, b: &'w Expr) -> Value<'w> {
        let (p, q) = (self.want_point(a), self.want_point(b));
        let (sx, sy) = (self.code.constant(X_SCALE_M), self.code.constant(Y_SCALE_M));
        let (dx, dy) =
            (self.code.binary(BinaryOp::Sub, q.0, p.0), self.code.binary(BinaryOp::Sub, q.1, p.1));
        let (dx, dy) =
            (self.code.binary(BinaryOp::Div, dx, sx), self.code.binary(BinaryOp::Div, dy, sy));
        Value::one(Ty::Number, self.code.binary(BinaryOp::Hypot, dx, dy))
    }

    fn speed(&mut self, x: &'w Expr) -> Value<'w> {
        let value = self.expr(x);
        if value.is_error() {
            return value;
        }
        if !matches!(value.ty, Ty::Player | Ty::Ball) {
            return self.fail(self.mismatch(value.ty, Ty::Player, x.span));
        }
        let flat = self.velocity(&value, x.span);
        if flat.is_error() {
            return flat;
        }
        let (vx, vy) = self.pair(&flat);
        let ground = self.code.binary(BinaryOp::Hypot, vx, vy);
        let speed = match value.ty {
            Ty::Ball => match self.load(Field::BallVz, None, "speed", x.span) {
                Some(vz) => self.code.binary(BinaryOp::Hypot, ground, vz),
                None => return Value::error(),
            },
            _ => ground,
        };
        Value::one(Ty::SPEED, speed)
    }

    fn polar(&mut self, r: &'w Expr, angle: &'w Expr) -> Value<'w> {
        let size = self.expr(r);
        if size.ty.is_plain() {
            let text = self.world.text(r.span);
            let instead = Instead::Distance { text };
            return self.fail(self.mismatch_with(size.ty, Ty::LENGTH, r.span, instead));
        }
        let (wanted, ty) = match size.ty {
            Ty::SPEED => (Ty::SPEED, Ty::Velocity),
            _ => (Ty::LENGTH, Ty::Vector),
        };
        let (size, angle) = (self.convert(size, wanted, r), self.want(angle, Ty::ANGLE));
        if size.is_error() || angle.is_error() {
            return Value::error();
        }
        let (r, angle) = (self.reg(&size), self.reg(&angle));
        let angle = self.turned_angle(angle);
        let (cos, sin) =
            (self.code.unary(UnaryOp::Cos, angle), self.code.unary(UnaryOp::Sin, angle));
        let pair =
            (self.code.binary(BinaryOp::Mul, r, cos), self.code.binary(BinaryOp::Mul, r, sin));
        Value::two(ty, pair)
    }
}

fn whole(ty: Ty) -> Ty {
    if ty.is_plain() { Ty::Int } else { ty }
}

/// The parameters of a function, and how many of them must be given.
fn signature(function: Function) -> (&'static [&'static str], usize) {
    use Function as F;
    match function {
        F::Abs | F::Exp | F::Log | F::Sqrt | F::Floor | F::Ceil | F::Round | F::Speed => {
            (&["x"], 1)
        }
        F::Sin | F::Cos => (&["angle"], 1),
        F::Pow => (&["x", "y"], 2),
        F::Mod | F::Distance | F::GrfDistance | F::Angle | F::Closing | F::Alternate => {
            (&["a", "b"], 2)
        }
        F::Clamp => (&["x", "low", "high"], 3),
        F::Smoothstep => (&["low", "high", "x"], 3),
        F::Polar => (&["r", "angle"], 2),
        F::Nearest => (&["S", "to"], 2),
        F::Exists => (&["p"], 1),
        F::Pressed => (&["p", "within"], 2),
        F::Sees => (&["p", "a", "within"], 3),
        F::OffsideLine => (&["team"], 1),
        F::Prev | F::Delta => (&["e"], 1),
        F::Potential => (&["e", "gamma"], 2),
        F::Held => (&["c", "for"], 2),
        F::Ever | F::Always => (&["c"], 1),
        F::Since => (&["E"], 1),
        F::Until | F::Within => (&["c", "d"], 2),
        F::Uniform => (&["low", "high"], 1),
        F::Integer => (&["low", "high"], 2),
        F::Normal => (&["mean", "sd"], 2),
        F::TruncatedNormal => (&["mean", "sd", "low", "high"], 4),
        F::Rect => (&["from", "to"], 2),
        F::Circle => (&["centre", "radius"], 2),
        F::Sector => (&["at", "radius", "from", "to"], 4),
        F::MinGap => (&["players"], 1),
        F::Grid => (&["columns", "rows", "region"], 2),
        F::Min
        | F::Max
        | F::Count
        | F::Any
        | F::All
        | F::Sum
        | F::Mean
        | F::MinBy
        | F::MaxBy
        | F::Choice
        | F::Shuffle
        | F::Polygon => (&[], 0),
    }
}
