//! Operators: arithmetic with units, comparison, logic, membership.

use super::super::Lower;
use super::super::value::{RegionValue, Repr, Value};
use super::is_tuple;
use crate::ast::{self, Expr, ExprKind, Span, Spanned};
use crate::check::types::{Dim, Ty};
use crate::problem::facts::{Kind, Names, Operand, Types, Verb};
use crate::problem::{Guess, Problem};
use setpiece_scenario::vocabulary::{Action, Field, GameMode};
use setpiece_scenario::{BinaryOp, Reg, UnaryOp};
use std::sync::Arc;

impl<'w> Lower<'_, 'w> {
    pub(super) fn unary(&mut self, op: ast::PrefixOp, inner: &'w Expr) -> Value<'w> {
        if op == ast::PrefixOp::Not {
            let reg = self.condition(inner);
            return Value::one(Ty::Bool, self.code.unary(UnaryOp::Not, reg));
        }
        let value = self.expr(inner);
        let is_number = value.ty.dim().is_some();
        if value.is_error() {
            return value;
        }
        if !is_number && !matches!(value.ty, Ty::Point | Ty::Vector | Ty::Velocity) {
            return self.fail(self.mismatch(value.ty, Ty::Number, inner.span));
        }
        if op == ast::PrefixOp::Plus {
            return value;
        }
        let negated: Vec<Reg> =
            value.regs().into_iter().map(|reg| self.code.unary(UnaryOp::Neg, reg)).collect();
        match negated.as_slice() {
            [a] => Value::one(value.ty, *a),
            [a, b] => Value::two(value.ty, (*a, *b)),
            [a, b, c] => Value { ty: value.ty, repr: Repr::Three(*a, *b, *c) },
            _ => Value::error(),
        }
    }

    pub(super) fn binary(
        &mut self,
        op: &'w Spanned<ast::InfixOp>,
        a: &'w Expr,
        b: &'w Expr,
        span: Span,
    ) -> Value<'w> {
        use ast::InfixOp as Op;
        match op.node {
            Op::And | Op::Or => {
                let first = self.expr(a);
                if let Some(joined) = self.regions_joined(op.node, (&first, a), b) {
                    let word = if op.node == Op::And { "and" } else { "or" };
                    return self.fail(Problem::new(span, Types::RegionsJoined { word, joined }));
                }
                let x = self.condition_of(&first, a, |_, _| None);
                let y = self.condition_or(b, |lower, ty| lower.shared(op.node, a, b, ty));
                let code = if op.node == Op::And { BinaryOp::And } else { BinaryOp::Or };
                Value::one(Ty::Bool, self.code.binary(code, x, y))
            }
            Op::Add | Op::Sub => self.sum(op.node == Op::Add, a, b, span),
            Op::Mul => self.product(a, b),
            Op::Div => self.quotient(a, b, span),
            Op::Lt | Op::Le | Op::Gt | Op::Ge => self.order(op.node, a, b),
            Op::Eq | Op::Ne => self.equality(op.node == Op::Eq, a, b),
            Op::In => self.membership(a, b),
            Op::Union | Op::Intersection => {
                let (Some(x), Some(y)) = (self.region(a), self.region(b)) else {
                    return Value::error();
                };
                let value = if op.node == Op::Union {
                    RegionValue::Union(x, y)
                } else {
                    RegionValue::Intersection(x, y)
                };
                Value { ty: Ty::Region, repr: Repr::Region(Arc::new(value)) }
            }
        }
    }

    /// How `A or B`, `A and B`, `A and not B` of two regions is written; none of anything else.
    fn regions_joined(
        &mut self,
        op: ast::InfixOp,
        (first, a): (&Value<'w>, &Expr),
        b: &'w Expr,
    ) -> Option<String> {
        let (b, is_without) = match &b.kind {
            ExprKind::Unary(ast::PrefixOp::Not, inner) => (&**inner, true),
            _ => (b, false),
        };
        let world = self.world;
        if first.ty != Ty::Region || world.tentatively(|| self.expr(b).ty) != Ty::Region {
            return None;
        }
        let sign = match (op, is_without) {
            (ast::InfixOp::And, true) => "-",
            (ast::InfixOp::And, false) => "&",
            _ => "|",
        };
        Some(format!("{} {sign} {}", world.text(a.span), world.text(b.span)))
    }

    /// How `A or b` is written where `b` is no condition, but goes on with the end of A:
    /// `goal by left or right`; and in the place of what.
    fn shared(
        &self,
        op: ast::InfixOp,
        a: &Expr,
        b: &Expr,
        ty: Ty,
    ) -> Option<(String, Option<Span>)> {
        let last = match &a.kind {
            ExprKind::Binary(inner, _, last)
                if matches!(inner.node, ast::InfixOp::And | ast::InfixOp::Or) =>
            {
                last
            }
            _ => a,
        };
        let is_or = op == ast::InfixOp::Or;
        let (word, sign) = if is_or { ("or", '|') } else { ("and", '&') };
        let part = match &last.kind {
            ExprKind::Event(event) if matches!(ty, Ty::Team | Ty::Player) => {
                event.by.as_ref()?.span
            }
            ExprKind::Binary(op, _, region) if op.node == ast::InfixOp::In && ty == Ty::Region => {
                let whole = region.span.to(b.span);
                let (region, other) = (self.world.text(region.span), self.world.text(b.span));
                return Some((format!("{region} {sign} {other}"), Some(whole)));
            }
            ExprKind::Binary(op, _, part)
                if matches!(op.node, ast::InfixOp::Eq | ast::InfixOp::Ne) =>
            {
                part.span
            }
            _ => return None,
        };
        let to = |end: u32| Span { end, ..last.span };
        let (whole, head) = (self.world.text(last.span), self.world.text(to(part.start)));
        let tail = self.world.text(Span { start: part.end, ..last.span });
        let again = format!("{head} {} {tail}", self.world.text(b.span));
        Some((format!("{whole} {word} {}", again.trim_end()), Some(last.span.to(b.span))))
    }

    fn sum(&mut self, is_add: bool, a: &'w Expr, b: &'w Expr, span: Span) -> Value<'w> {
        let (x, y) = (self.expr(a), self.expr(b));
        if x.is_error() || y.is_error() {
            return Value::error();
        }
        let op = if is_add { BinaryOp::Add } else { BinaryOp::Sub };
        if let (Some(left), Some(right)) = (x.ty.dim(), y.ty.dim()) {
            if left != right {
                return self.disagree(
                    &x,
                    &y,
                    a,
                    b,
                    if is_add { Verb::Add } else { Verb::Subtract },
                );
            }
            let (p, q) = (self.reg(&x), self.reg(&y));
            let reg = self.code.binary(op, p, q);
            if left == Dim::ANGLE && !is_add {
                // The difference of two headings is the turn between them.
                return Value::one(x.ty, self.code.unary(UnaryOp::Wrap, reg));
            }
            return Value::one(x.ty.join(y.ty).unwrap_or(Ty::Number), reg);
        }
        if x.ty == Ty::Region && y.ty == Ty::Region && !is_add {
            let (Repr::Region(p), Repr::Region(q)) = (x.repr, y.repr) else {
                return Value::error();
            };
            return Value {
                ty: Ty::Region,
                repr: Repr::Region(Arc::new(RegionValue::Difference(p, q))),
            };
        }
        let offset = |value: &Value<'w>, expr: &Expr| {
            value.ty == Ty::Vector || (value.ty == Ty::Point && is_tuple(expr))
        };
        let ty = match (x.ty, y.ty) {
            (Ty::Velocity, Ty::Velocity) => Ty::Velocity,
            (Ty::Vector, Ty::Vector) => Ty::Vector,
            (left, _) if left.is_place() && offset(&y, b) => Ty::Point,
            (_, right) if is_add && right.is_place() && offset(&x, a) => Ty::Point,
            (left, right) if !is_add && left.is_place() && right.is_place() => Ty::Vector,
            (left, right) if left.is_place() && right.is_place() => {
                let offset = match (&b.kind, right) {
                    (ExprKind::Name(name), Ty::Point) => Some(name.clone()),
                    _ => None,
                };
                return self.fail(Problem::new(span, Types::PointsAdded { offset }));
            }
            _ => {
                return self.disagree(
                    &x,
                    &y,
                    a,
                    b,
                    if is_add { Verb::Add } else { Verb::Subtract },
                );
            }
        };
        let (p, q) = (self.any_pair(&x, a.span), self.any_pair(&y, b.span));
        let pair = (self.code.binary(op, p.0, q.0), self.code.binary(op, p.1, q.1));
        Value::two(ty, pair)
    }

    /// The two registers of a point, vector, velocity, player or the ball.
    fn any_pair(&mut self, value: &Value<'w>, span: Span) -> (Reg, Reg) {
        if value.ty.is_place() { self.place_of(value, span) } else { self.pair(value) }
    }

    fn disagree(
        &mut self,
        x: &Value<'w>,
        y: &Value<'w>,
        a: &'w Expr,
        b: &'w Expr,
        verb: Verb,
    ) -> Value<'w> {
        let mut operand = |value: &Value<'w>, expr: &'w Expr| Operand {
            ty: value.ty,
            text: self.world.text(expr.span),
            span: expr.span,
            is_quoted: matches!(&value.repr, Repr::Text(_)),
            metres: value.ty.is_plain().then(|| self.written_in_metres(expr)).flatten(),
        };
        let (left, right) = (operand(x, a), operand(y, b));
        self.fail(Problem::new(b.span, Types::Disagree { verb, left, right }))
    }

    fn product(&mut self, a: &'w Expr, b: &'w Expr) -> Value<'w> {
        let (x, y) = (self.expr(a), self.expr(b));
        if x.is_error() || y.is_error() {
            return Value::error();
        }
        if let (Some(left), Some(right)) = (x.ty.dim(), y.ty.dim()) {
            let (p, q) = (self.reg(&x), self.reg(&y));
            let ty = if x.ty == Ty::Int && y.ty == Ty::Int {
                Ty::Int
            } else {
                Ty::with_dim(left.times(right))
            };
            return Value::one(ty, self.code.binary(BinaryOp::Mul, p, q));
        }
        let (vector, factor, factor_expr) = match (x.ty, y.ty) {
            (Ty::Vector | Ty::Velocity, _) => (&x, &y, b),
            (Ty::Point, _) if is_tuple(a) => (&x, &y, b),
            _ => (&y, &x, a),
        };
        let ty = match (vector.ty, factor.ty) {
            (Ty::Vector, ty) if ty.is_plain() => Ty::Vector,
            (Ty::Velocity, ty) if ty.is_plain() => Ty::Velocity,
            (Ty::Velocity, Ty::DURATION) => Ty::Vector,
            (Ty::Point, ty) if ty.is_plain() && (is_tuple(a) || is_tuple(b)) => Ty::Vector,
            (Ty::Vector | Ty::Velocity, ty) => {
                return self.fail(self.mismatch(ty, Ty::Number, factor_expr.span));
            }
            _ => {
                let (ty, expr) = if x.ty.dim().is_some() { (y.ty, b) } else { (x.ty, a) };
                return self.fail(self.mismatch(ty, Ty::Number, expr.span));
            }
        };
        let (pair, scale) = (self.pair(vector), self.reg(factor));
        let scaled = (
            self.code.binary(BinaryOp::Mul, pair.0, scale),
            self.code.binary(BinaryOp::Mul, pair.1, scale),
        );
        Value::two(ty, scaled)
    }

    fn quotient(&mut self, a: &'w Expr, b: &'w Expr, span: Span) -> Value<'w> {
        let (x, y) = (self.expr(a), self.expr(b));
        if x.is_error() || y.is_error() {
            return Value::error();
        }
        let Some(right) = y.ty.dim() else {
            return self.fail(self.mismatch(y.ty, Ty::Number, b.span));
        };
        let divisor = self.reg(&y);
        self.check_divisor(divisor, b, span);
        if let Some(left) = x.ty.dim() {
            let p = self.reg(&x);
            return Value::one(
                Ty::with_dim(left.over(right)),
                self.code.binary(BinaryOp::Div, p, divisor),
            );
        }
        let ty = match (x.ty, right) {
            (Ty::Vector, Dim::NONE) => Ty::Vector,
            (Ty::Velocity, Dim::NONE) | (Ty::Vector, Dim::DURATION) => Ty::Velocity,
            _ => return self.fail(self.mismatch(x.ty, Ty::Number, a.span)),
        };
        let p = self.pair(&x);
        let pair = (
            self.code.binary(BinaryOp::Div, p.0, divisor),
            self.code.binary(BinaryOp::Div, p.1, divisor),
        );
        Value::two(ty, pair)
    }

    /// Reports a divisor that constants or the parameters' ranges let become zero.
    pub(super) fn check_divisor(&self, divisor: Reg, expr: &Expr, span: Span) {
        let text = self.world.text(expr.span);
        match self.interval(divisor) {
            Some((0.0, 0.0)) => {
                let text = (text != "0").then_some(text);
                self.report(Problem::new(span, Types::DividedByZero { text }));
            }
            Some((low, high)) if low <= 0.0 && high >= 0.0 => {
                self.report(Problem::new(span, Types::MayDivideByZero { text, low, high }));
            }
            _ => {}
        }
    }

    fn order(&mut self, op: ast::InfixOp, a: &'w Expr, b: &'w Expr) -> Value<'w> {
        let (x, y) = (self.expr(a), self.expr(b));
        if x.is_error() || y.is_error() {
            return Value::error();
        }
        match (x.ty.dim(), y.ty.dim()) {
            (Some(left), Some(right)) if left == right => {}
            _ => return self.disagree(&x, &y, a, b, Verb::Compare),
        }
        let code = match op {
            ast::InfixOp::Lt => BinaryOp::Lt,
            ast::InfixOp::Le => BinaryOp::Le,
            ast::InfixOp::Gt => BinaryOp::Gt,
            _ => BinaryOp::Ge,
        };
        let (p, q) = (self.reg(&x), self.reg(&y));
        Value::one(Ty::Bool, self.code.binary(code, p, q))
    }

    fn equality(&mut self, is_eq: bool, a: &'w Expr, b: &'w Expr) -> Value<'w> {
        let x = self.expr(a);
        let y = self.beside(x.ty, b);
        self.equal(is_eq, (&x, a), (&y, b))
    }

    /// What stands where a value of this type is expected. Game modes and actions are words that
    /// are no names elsewhere.
    pub(crate) fn beside(&mut self, ty: Ty, expr: &'w Expr) -> Value<'w> {
        let word = match &expr.kind {
            ExprKind::Name(name) => name.as_str(),
            ExprKind::Event(event) => event.name.node.as_str(),
            _ => return self.expr(expr),
        };
        let (found, kind, known): (Option<usize>, Kind, Vec<&str>) = match ty {
            Ty::Mode => {
                // `kickoff` is the event's name, `kick_off` GRF's for the mode.
                let word = if word == "kickoff" { GameMode::KickOff.name() } else { word };
                let found = GameMode::from_name(word).map(GameMode::index);
                (found, Kind::Mode, GameMode::ALL.iter().map(|mode| mode.name()).collect())
            }
            Ty::Action => {
                let found = Action::from_name(word).map(Action::index);
                let default = &Action::ALL[..Action::DEFAULT_SET];
                (found, Kind::Action, default.iter().map(|action| action.name()).collect())
            }
            _ => return self.expr(expr),
        };
        if let Some(index) = found {
            return Value::one(ty, self.code.constant(index as f64));
        }
        if self.scope.find(word).is_some() || self.world.declares(word) {
            return self.expr(expr);
        }
        let guess = Guess::similar_or_all(word, &known);
        self.fail(Problem::new(expr.span, Names::Unknown { kind, name: word.to_owned(), guess }))
    }

    /// Whether two values are equal.
    pub(super) fn equal(
        &mut self,
        is_eq: bool,
        x: (&Value<'w>, &'w Expr),
        y: (&Value<'w>, &'w Expr),
    ) -> Value<'w> {
        let ((x, a), (y, b)) = (x, y);
        if x.is_error() || y.is_error() {
            return Value::error();
        }
        let op = if is_eq { BinaryOp::Eq } else { BinaryOp::Ne };
        match (&x.repr, &y.repr) {
            (Repr::Choice(reg, words), Repr::Text(text)) => {
                return self.word_equal(op, *reg, words, text, b);
            }
            (Repr::Text(text), Repr::Choice(reg, words)) => {
                return self.word_equal(op, *reg, words, text, a);
            }
            (Repr::Text(p), Repr::Text(q)) => {
                return Value::one(Ty::Bool, self.code.bool((p == q) == is_eq));
            }
            _ => {}
        }
        let comparable = match (x.ty, y.ty) {
            (Ty::Team, Ty::Team)
            | (Ty::Player, Ty::Player)
            | (Ty::Role, Ty::Role)
            | (Ty::Mode, Ty::Mode)
            | (Ty::Action, Ty::Action)
            | (Ty::Bool, Ty::Bool) => true,
            (left, right) => left.dim().is_some() && left.dim() == right.dim(),
        };
        if !comparable {
            return self.disagree(x, y, a, b, Verb::Compare);
        }
        let (p, q) = (self.reg(x), self.reg(y));
        Value::one(Ty::Bool, self.code.binary(op, p, q))
    }

    fn word_equal(
        &mut self,
        op: BinaryOp,
        reg: Reg,
        words: &[String],
        text: &str,
        at: &Expr,
    ) -> Value<'w> {
        match words.iter().position(|word| word == text) {
            Some(index) => {
                let index = self.code.constant(index as f64);
                Value::one(Ty::Bool, self.code.binary(op, reg, index))
            }
            None => self.fail({
                let guess = Guess::of(text, words.iter().map(String::as_str));
                Problem::new(
                    at.span,
                    Names::NoneOfItsWords { word: text.to_owned(), parameter: None, guess },
                )
            }),
        }
    }

    pub(super) fn if_expr(
        &mut self,
        condition: &'w Expr,
        then: &'w Expr,
        otherwise: &'w Expr,
    ) -> Value<'w> {
        let c = self.condition(condition);
        let (x, y) = (self.expr(then), self.expr(otherwise));
        self.choose(c, (&x, then), (&y, otherwise))
    }

    /// One of two values, by a condition.
    pub(super) fn choose(
        &mut self,
        c: Reg,
        x: (&Value<'w>, &'w Expr),
        y: (&Value<'w>, &'w Expr),
    ) -> Value<'w> {
        let ((x, a), (y, b)) = (x, y);
        // `(0m, 0m)` is a vector beside one.
        let like = |one: &Value<'w>, expr: &Expr, other: Ty| match (one.ty, &one.repr) {
            (Ty::Point, Repr::Two(p, q)) if other == Ty::Vector && is_tuple(expr) => {
                Value::two(Ty::Vector, (*p, *q))
            }
            _ => one.clone(),
        };
        let (x, y) = (&like(x, a, y.ty), &like(y, b, x.ty));
        let Some(ty) = x.ty.join(y.ty) else {
            let text = self.world.text(b.span);
            let fact = Types::ChoiceMismatch { wanted: x.ty, found: y.ty, text, other: a.span };
            return self.fail(Problem::new(b.span, fact));
        };
        if ty == Ty::Error {
            return Value::error();
        }
        let (x, y) = if ty == Ty::Point && x.ty != y.ty {
            (self.convert(x.clone(), ty, a), self.convert(y.clone(), ty, b))
        } else {
            (x.clone(), y.clone())
        };
        if let (Repr::Region(x), Repr::Region(y)) = (&x.repr, &y.repr) {
            let either = RegionValue::Either(c, x.clone(), y.clone());
            return Value { ty, repr: Repr::Region(Arc::new(either)) };
        }
        let (p, q) = (x.regs(), y.regs());
        let picked: Vec<Reg> = p.iter().zip(&q).map(|(&p, &q)| self.code.select(c, p, q)).collect();
        match (picked.as_slice(), p.len() == q.len()) {
            ([r], true) if matches!(x.repr, Repr::One(_)) => Value::one(ty, *r),
            ([r, s], true) if matches!(x.repr, Repr::Two(..)) => Value::two(ty, (*r, *s)),
            ([r, s, t], true) if matches!(x.repr, Repr::Three(..)) => {
                Value { ty, repr: Repr::Three(*r, *s, *t) }
            }
            _ => {
                let values = [a, b].map(|value| self.world.text(value.span));
                self.fail(Problem::new(a.span.to(b.span), Types::NoChoiceOf { ty, values }))
            }
        }
    }

    pub(super) fn has_ball(&mut self, who: &'w Expr) -> Value<'w> {
        let value = self.expr(who);
        let reg = self.reg(&value);
        match (value.ty, &value.repr) {
            (Ty::Error, _) => Value::error(),
            (Ty::Team, _) => {
                let has = self.load(Field::TeamHasBall, Some(reg), "has ball", who.span);
                has.map_or_else(Value::error, |reg| Value::one(Ty::Bool, reg))
            }
            (Ty::Player, _) => {
                self.owns(reg, who.span).map_or_else(Value::error, |reg| Value::one(Ty::Bool, reg))
            }
            (Ty::Set, Repr::Set(set)) => {
                let set = *set;
                let Some(owner) = self.load(Field::BallOwner, None, "has ball", who.span) else {
                    return Value::error();
                };
                Value::one(Ty::Bool, self.in_set(owner, set))
            }
            (ty, _) => self.fail(self.mismatch(ty, Ty::Player, who.span)),
        }
    }

    /// Whether a player, unless it is nobody, has the ball.
    fn owns(&mut self, player: Reg, span: Span) -> Option<Reg> {
        let owner = self.load(Field::BallOwner, None, "has ball", span)?;
        let same = self.code.binary(BinaryOp::Eq, owner, player);
        let zero = self.code.constant(0.0);
        let somebody = self.code.binary(BinaryOp::Ge, player, zero);
        Some(self.code.binary(BinaryOp::And, same, somebody))
    }

    fn membership(&mut self, a: &'w Expr, b: &'w Expr) -> Value<'w> {
        let x = self.expr(a);
        let y = match &b.kind {
            ExprKind::List(words) if matches!(x.ty, Ty::Mode | Ty::Action) => {
                let list = words.iter().map(|word| self.beside(x.ty, word)).collect();
                Value { ty: Ty::List, repr: Repr::List(list) }
            }
            _ => self.expr(b),
        };
        if x.is_error() || y.is_error() {
            return Value::error();
        }
        match (x.ty, y.ty, &y.repr) {
            (ty, Ty::Region, Repr::Region(region)) if ty.is_place() => {
                let place = self.place_of(&x, a.span);
                let region = region.clone();
                self.note_asked_about(&region, b.span);
                Value::one(Ty::Bool, self.inside(place, &region))
            }
            (Ty::Player, Ty::Team | Ty::Set, _) => {
                let set = self.convert(y, Ty::Set, b);
                let Repr::Set(set) = set.repr else { return Value::error() };
                let player = self.reg(&x);
                let mut inside = self.in_set(player, set);
                if self.stage.is_step() {
                    // No set contains who is off the pitch.
                    let exists = self.code.unary(UnaryOp::Exists, player);
                    inside = self.code.binary(BinaryOp::And, inside, exists);
                }
                Value::one(Ty::Bool, inside)
            }
            (_, Ty::List, Repr::List(list)) => {
                let list = list.clone();
                let mut any = self.code.bool(false);
                for entry in &list {
                    let equal = self.equal(true, (&x, a), (entry, b));
                    let equal = self.reg(&equal);
                    any = self.code.binary(BinaryOp::Or, any, equal);
                }
                Value::one(Ty::Bool, any)
            }
            (_, Ty::Region, _) => self.fail(self.mismatch(x.ty, Ty::Point, a.span)),
            (_, ty, _) => self.fail(self.mismatch(ty, Ty::Region, b.span)),
        }
    }
}
