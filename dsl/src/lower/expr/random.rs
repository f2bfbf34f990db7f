//! Draws: at the start, when a statement of a behaviour is reached, and in every step of an
//! observation.

use super::super::value::Value;
use super::super::{Lower, ProgramStage};
use crate::ast::{Arg, Expr, ExprKind, Span};
use crate::check::types::Ty;
use crate::lower::known::Draw;
use crate::problem::facts::{Chance, Implied};
use crate::problem::{Problem, signature};
use setpiece_scenario::vocabulary::Function;
use setpiece_scenario::{BinaryOp, Distribution, Reg, UnaryOp, When};

/// Most values of a `shuffle`: each may come to each place, so the program grows with the square.
const SHUFFLED_MAX: usize = 64;

impl<'w> Lower<'_, 'w> {
    /// Reports a draw that stands outside the start.
    fn may_draw(&self, function: Function, span: Span) -> bool {
        if matches!(self.stage, ProgramStage::Start(_)) {
            return true;
        }
        if matches!(self.stage, ProgramStage::Behavior(_)) {
            return self.may_draw_now(function, span);
        }
        if matches!(self.stage, ProgramStage::Observation) {
            let is_once = !self.code.in_loop() && self.when == When::Now;
            if !is_once {
                self.report(Problem::new(span, Chance::DrawnOnce { function: function.name() }));
            }
            return is_once;
        }
        let is_constant = matches!(self.stage, ProgramStage::Constant);
        self.report(Problem::new(
            span,
            Chance::NoDrawHere { function: function.name(), is_constant },
        ));
        false
    }

    /// Reports a draw of a behaviour that belongs to no statement: it would happen in every step.
    fn may_draw_now(&self, function: Function, span: Span) -> bool {
        if matches!(self.stage, ProgramStage::Behavior(Some(_))) && !self.code.in_loop() {
            return true;
        }
        self.report(Problem::new(span, Chance::NoDrawNow { function: function.name() }));
        false
    }

    pub(super) fn draw(&mut self, function: Function, given: &[&'w Expr], span: Span) -> Value<'w> {
        use Function as F;
        if function == F::Alternate {
            return self.alternate(given, span);
        }
        if !self.may_draw(function, span) {
            return Value::error();
        }
        if let (F::Uniform, &[region]) = (function, given) {
            let Some(region) = self.region(region) else { return Value::error() };
            return match self.draw_in(&region, span) {
                Some(place) => Value::two(Ty::Point, place),
                None => Value::error(),
            };
        }
        let Some((&first, rest)) = given.split_first() else { return Value::error() };
        let head =
            if function == F::Integer { self.want(first, Ty::Int) } else { self.expr(first) };
        if head.is_error() {
            return head;
        }
        if head.ty.dim().is_none() {
            return self.fail(self.mismatch(head.ty, Ty::Number, first.span));
        }
        let values: Vec<Value<'w>> = rest.iter().map(|expr| self.expr(expr)).collect();
        let wanted = match head.ty {
            Ty::Int if function == F::Integer => Ty::Int,
            // `0` needs no unit: it takes that of what stands beside it.
            ty if ty.is_plain() && self.is_zero(&head) => {
                let mut types = values.iter().map(|value| value.ty);
                types.find(|ty| matches!(ty, Ty::Quantity(_))).unwrap_or(Ty::Number)
            }
            ty if ty.is_plain() => Ty::Number,
            ty => ty,
        };
        let mut regs = vec![self.reg(&head)];
        for (value, expr) in values.into_iter().zip(rest) {
            let value = self.convert(value, wanted, expr);
            if value.is_error() {
                return value;
            }
            regs.push(self.reg(&value));
        }
        let (distribution, ends) = match (function, regs.as_slice()) {
            (F::Uniform, &[a, b]) => (Distribution::Uniform(a, b), Some((a, b))),
            (F::Integer, &[a, b]) => (Distribution::Integer(a, b), Some((a, b))),
            (F::Normal, &[mean, sd]) => (Distribution::Normal(mean, sd), None),
            (F::TruncatedNormal, &[mean, sd, a, b]) => {
                (Distribution::TruncatedNormal(mean, sd, a, b), Some((a, b)))
            }
            _ => {
                return self.fail(Problem::new(
                    span,
                    Chance::NoEnds {
                        function: function.name(),
                        signature: signature(function.doc()).to_owned(),
                    },
                ));
            }
        };
        if let Some((a, b)) = ends
            && !self.check_ends(a, b, span)
        {
            return Value::error();
        }
        if let Distribution::Normal(_, sd) | Distribution::TruncatedNormal(_, sd, _, _) =
            distribution
        {
            let at = rest.first().map_or(span, |sd| sd.span);
            self.check_range(sd, (0.0, f64::MAX), "the standard deviation", at, "`0` or more");
        }
        Value::one(wanted, self.random(distribution))
    }

    fn is_zero(&mut self, value: &Value<'w>) -> bool {
        let reg = self.reg(value);
        self.code.constant_of(reg) == Some(0.0)
    }

    /// Reports ends that are the wrong way round; `false` if they always are.
    fn check_ends(&mut self, a: Reg, b: Reg, span: Span) -> bool {
        if let (Some(low), Some(high)) = (self.interval(a), self.interval(b)) {
            if low.0 > high.1 {
                self.report(Problem::new(span, Chance::EndsSwapped));
                return false;
            }
            if low.1 <= high.0 {
                return true;
            }
        }
        let ordered = self.code.binary(BinaryOp::Le, a, b);
        self.imply(ordered, &Implied::EndsOrdered { text: self.world.text(span) }, Some(span));
        true
    }

    /// Reports weights that are negative, or all nothing.
    pub(crate) fn check_weights(&mut self, weights: &[(Reg, Span)], span: Span) {
        let mut fit = true;
        for &(weight, at) in weights {
            fit &= self.check_range(weight, (0.0, f64::MAX), "the weight", at, "`0` or more");
        }
        if !fit {
            return;
        }
        let sum = weights
            .iter()
            .map(|(weight, _)| *weight)
            .reduce(|a, b| self.code.binary(BinaryOp::Add, a, b));
        let Some(sum) = sum else { return };
        if self.interval(sum).is_some_and(|(low, _)| low > 0.0) {
            return;
        }
        if self.code.constant_of(sum) == Some(0.0) {
            self.report(Problem::new(span, Chance::NoWeight));
            return;
        }
        let zero = self.code.constant(0.0);
        let any = self.code.binary(BinaryOp::Gt, sum, zero);
        self.imply(any, &Implied::AnyWeight { text: self.world.text(span) }, Some(span));
    }

    /// Draws one of the arguments of a `choice` by its index; `read` is called for each of them.
    /// `None` after a report.
    pub(crate) fn pick(
        &mut self,
        args: &'w [Arg],
        span: Span,
        read: &mut dyn FnMut(&mut Self, &'w Expr),
    ) -> Option<Reg> {
        if !self.may_draw(Function::Choice, span) {
            return None;
        }
        if args.is_empty() {
            self.report(Problem::new(span, Chance::NoChoices));
            return None;
        }
        let weighted = args.iter().any(|arg| arg.key.is_some());
        if let Some(bare) = args.iter().find(|arg| weighted && arg.key.is_none()) {
            self.report(Problem::new(bare.span, Chance::WeightMissing));
            return None;
        }
        let mut weights = Vec::new();
        for arg in args {
            let (option, weight) = match &arg.key {
                Some(key) => (key, self.want_reg(&arg.value, Ty::Number)),
                None => (&arg.value, self.code.constant(1.0)),
            };
            read(self, option);
            weights.push(weight);
        }
        if weighted {
            let given: Vec<(Reg, Span)> =
                weights.iter().zip(args).map(|(reg, arg)| (*reg, arg.value.span)).collect();
            self.check_weights(&given, span);
        }
        Some(self.random(Distribution::Weighted(weights)))
    }

    /// `choice(a, b, c)`, `choice(a: 3, b: 1)`
    pub(super) fn choice(&mut self, args: &'w [Arg], span: Span) -> Value<'w> {
        let mut options: Vec<(Value<'w>, &'w Expr)> = Vec::new();
        let index = self.pick(args, span, &mut |lower, option| {
            options.push((lower.expr(option), option));
        });
        let Some(index) = index else { return Value::error() };
        if options.iter().any(|(value, _)| value.is_error()) {
            return Value::error();
        }
        let mut options = options.into_iter().enumerate().rev();
        let Some((_, (mut picked, mut picked_at))) = options.next() else { return Value::error() };
        for (i, (option, at)) in options {
            let i = self.code.constant(i as f64);
            let is_this = self.code.binary(BinaryOp::Eq, index, i);
            picked = self.choose(is_this, (&option, at), (&picked, picked_at));
            picked_at = at;
        }
        picked
    }

    /// `shuffle(x, y, z)`: its values in an order that is drawn (Fisher and Yates's way); `None`
    /// after a report.
    pub(crate) fn shuffle(&mut self, expr: &'w Expr, wanted: usize) -> Option<Vec<Value<'w>>> {
        let ExprKind::Call { name, args } = &expr.kind else {
            self.report(Problem::new(expr.span, Chance::OnlyShuffleGivesSeveral));
            return None;
        };
        if name.node != Function::Shuffle.name() || args.len() != wanted {
            let fact = match name.node.as_str() {
                "shuffle" => Chance::ShuffleCount { names: wanted, values: args.len() },
                other => Chance::OneValueForNames { function: other.to_owned(), names: wanted },
            };
            self.report(Problem::new(expr.span, fact));
            return None;
        }
        if let Some(more) = args.get(SHUFFLED_MAX) {
            self.report(Problem::new(more.span, Chance::ShuffleTooMuch { most: SHUFFLED_MAX }));
            return None;
        }
        let mut values: Vec<Value<'w>> = args.iter().map(|arg| self.expr(&arg.value)).collect();
        if values.iter().any(Value::is_error) {
            return None;
        }
        for i in 0..values.len().saturating_sub(1) {
            let (low, high) =
                (self.code.constant(i as f64), self.code.constant((values.len() - 1) as f64));
            let drawn = self.random(Distribution::Integer(low, high));
            let mut first = values[i].clone();
            let at = &args[i].value;
            for j in i + 1..values.len() {
                let index = self.code.constant(j as f64);
                let is_this = self.code.binary(BinaryOp::Eq, drawn, index);
                let other = values[j].clone();
                values[j] =
                    self.choose(is_this, (&values[i].clone(), at), (&other, &args[j].value));
                if values[j].is_error() {
                    return None;
                }
                first = self.choose(is_this, (&other, &args[j].value), (&first, at));
            }
            values[i] = first;
        }
        if values.iter().any(Value::is_error) { None } else { Some(values) }
    }

    /// `alternate(a, b)`: `a` in even episodes, `b` in odd ones.
    fn alternate(&mut self, given: &[&'w Expr], span: Span) -> Value<'w> {
        let &[a, b] = given else { return Value::error() };
        if matches!(self.stage, ProgramStage::Constant) {
            return self.fail(Problem::new(span, Chance::AlternateInConstant));
        }
        let (x, y) = (self.expr(a), self.expr(b));
        let even = self.is_even_episode();
        self.choose(even, (&x, a), (&y, b))
    }

    pub(crate) fn is_even_episode(&mut self) -> Reg {
        let (index, two) = (self.code.episode_index(), self.code.constant(2.0));
        let odd = self.code.binary(BinaryOp::Mod, index, two);
        self.code.unary(UnaryOp::Not, odd)
    }

    /// Draws from the stream of what is being drawn: its name and the draw's ordinal in it.
    pub(crate) fn random(&mut self, from: Distribution) -> Reg {
        let ordinal = self.streams.next_draw();
        let key = stream_key(self.streams.drawing(), ordinal);
        if let ProgramStage::Behavior(Some(draws)) = &mut self.stage {
            let (cell, count) = (self.code.new_cell(), self.code.new_cell());
            draws.push(Draw { cell, count, key, from });
            return self.code.cell(cell);
        }
        self.code.random(key, from)
    }
}

/// The key of a stream: FNV-1a over the name and the ordinal.
fn stream_key(name: &str, ordinal: u32) -> u64 {
    let bytes = name.bytes().chain([0]).chain(ordinal.to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
