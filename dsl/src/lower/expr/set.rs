//! Players as a group: `count(p in them where …)`, `nearest`, `pressed`, and the aggregates.

use super::super::people::Presence;
use super::super::value::{LocalName, Repr, SetValue, Value};
use super::super::{Lower, ProgramStage};
use super::grid::as_grid;
use crate::ast::{self, Arg, Expr, ExprKind, Span};
use crate::check::types::Ty;
use crate::problem::facts::{Calls, Chance, Instead, Scopes};
use crate::problem::{Problem, signature};
use setpiece_scenario::vocabulary::{Field, Function};
use setpiece_scenario::{BinaryOp, Fold, FoldKind, Over, Reg, UnaryOp};
use std::f64::consts::TAU;

/// The gap between two players if one is absent, metres: more than the pitch has room for.
const APART_M: f64 = 1000.0;
/// Deepest nesting of loops over players and events that a program may have.
const LOOPS_MAX: usize = 4;

/// `E for p in S where C`, taken apart.
struct Comprehension<'w> {
    value: Option<&'w Expr>,
    name: Option<(&'w str, Span)>,
    set: &'w Expr,
    filter: Option<&'w Expr>,
}

impl<'w> Lower<'_, 'w> {
    /// Whether a player belongs to a set.
    pub(crate) fn in_set(&mut self, player: Reg, set: SetValue) -> Reg {
        let team = self.code.unary(UnaryOp::TeamOf, player);
        let mut inside = match self.code.constant_of(set.team) {
            Some(both) if both < 0.0 => {
                let zero = self.code.constant(0.0);
                self.code.binary(BinaryOp::Ge, player, zero)
            }
            _ => self.code.binary(BinaryOp::Eq, team, set.team),
        };
        if let Some(except) = set.except {
            let other = self.code.binary(BinaryOp::Ne, player, except);
            inside = self.code.binary(BinaryOp::And, inside, other);
        }
        inside
    }

    fn want_set(&mut self, expr: &'w Expr) -> Option<SetValue> {
        if matches!(expr.kind, ExprKind::Event(_)) {
            let value = self.expr(expr);
            if !value.is_error() {
                let instead = Instead::CountedEvent;
                self.report(self.mismatch_with(value.ty, Ty::Set, expr.span, instead));
            }
            return None;
        }
        match self.want(expr, Ty::Set).repr {
            Repr::Set(set) => Some(set),
            _ => None,
        }
    }

    /// `min_gap(players)`: the least distance between two of some players at the start.
    pub(super) fn min_gap(&mut self, set: &'w Expr, span: Span) -> Value<'w> {
        if !matches!(self.stage, ProgramStage::Start(_)) {
            return self.fail(Problem::new(span, Scopes::GapInMatch));
        }
        let Some(set) = self.want_set(set) else { return Value::error() };
        let Some(team) = self.code.constant_of(set.team) else {
            return self.fail(Problem::new(span, Chance::WhoseGap));
        };
        let world = self.world;
        let meant = |player: &crate::lower::people::Rostered<'_>| {
            team < 0.0 || player.team.index() as f64 == team
        };
        let indices: Vec<usize> =
            (0..world.roster.len()).filter(|&i| world.roster.get(i).is_some_and(meant)).collect();
        let places: Vec<((Reg, Reg), Presence)> = indices
            .iter()
            .map(|&i| (self.place_of_rostered(i, span), self.presence_of(i, span)))
            .collect();
        let mut least: Option<Reg> = None;
        // Who is absent is near nobody.
        let apart = self.code.constant(APART_M);
        for (nth, &(one, of_one)) in places.iter().enumerate() {
            for &(other, of_other) in places.iter().skip(nth + 1) {
                let conditions = of_one.conditions().chain(of_other.conditions());
                let mut gap = self.distance(one, other);
                for condition in conditions {
                    gap = self.code.select(condition, gap, apart);
                }
                least =
                    Some(least.map_or(gap, |least| self.code.binary(BinaryOp::Min, least, gap)));
            }
        }
        match least {
            Some(reg) => Value::one(Ty::LENGTH, reg),
            None => self.fail(Problem::new(span, Calls::NoGap)),
        }
    }

    /// Reports a loop over players where no match is under way, or inside too many others.
    fn players_known(&self, span: Span, what: &str) -> bool {
        let known = self.stage.is_step();
        if self.code.loops() >= LOOPS_MAX {
            self.report(Problem::new(span, Calls::TooManyLoops { most: LOOPS_MAX }));
            return false;
        }
        if !known {
            self.report(Problem::new(span, Scopes::PlayersBeforeMatch { what: what.to_owned() }));
        }
        known
    }

    pub(super) fn aggregate(
        &mut self,
        function: Function,
        args: &'w [Arg],
        span: Span,
    ) -> Value<'w> {
        let name = function.name();
        let [arg] = args else {
            return self.fail(Problem::new(
                span,
                Calls::OneSet { function: name, signature: signature(function.doc()).to_owned() },
            ));
        };
        let Some(parts) = take_apart(function, arg) else {
            return self.fail(Problem::new(
                arg.span,
                Calls::WhichPlayers {
                    function: name,
                    signature: signature(function.doc()).to_owned(),
                },
            ));
        };
        if matches!(self.stage, ProgramStage::Start(_)) {
            return self.aggregate_start(function, &parts, span);
        }
        if !self.players_known(span, name) {
            return Value::error();
        }
        let grid = as_grid(parts.set).map(|args| self.grid(parts.set, args));
        let over = match grid {
            Some(Some(grid)) => Over::Numbers(grid.points()),
            Some(None) => return Value::error(),
            None => {
                let Some(set) = self.want_set(parts.set) else { return Value::error() };
                Over::Players { team: set.team, except: set.except }
            }
        };
        let grid = grid.flatten();
        let open = self.code.open_loop(over);
        let outer = self.scope.clone();
        if let Some((name, at)) = parts.name {
            self.check_hides_local(name, at, &outer);
            let element = match &grid {
                Some(grid) => self.grid_point(grid, open.element()),
                None => Value::one(Ty::Player, open.element()),
            };
            self.scope.bind(name, LocalName::Value(element));
        }
        let filter = parts.filter.map(|filter| self.condition(filter));
        let value = parts.value.map(|value| (self.expr(value), value));
        self.scope = outer;
        let (fold, ty) = self.fold_of(function, value, filter);
        let result = self.code.close_loop(open, fold);
        if let (Some(grid), Ty::Player) = (&grid, ty) {
            return self.chosen_point(grid, result);
        }
        Value { ty, repr: if ty == Ty::Error { Repr::Nothing } else { Repr::One(result) } }
    }

    /// An aggregate over the roster, written out player by player: the start has no loops.
    fn aggregate_start(
        &mut self,
        function: Function,
        parts: &Comprehension<'w>,
        span: Span,
    ) -> Value<'w> {
        if as_grid(parts.set).is_some() {
            return self.fail(Problem::new(parts.set.span, Calls::GridAtStart));
        }
        let Some(set) = self.want_set(parts.set) else { return Value::error() };
        let ids: Vec<Reg> = self
            .world
            .roster
            .iter()
            .map(|player| player.id)
            .map(f64::from)
            .collect::<Vec<_>>()
            .into_iter()
            .map(|id| self.code.constant(id))
            .collect();
        let mut elements = Vec::new();
        let mut ty = None;
        for (index, id) in ids.into_iter().enumerate() {
            let mut belongs = self.in_set(id, set);
            if self.code.constant_of(belongs) == Some(0.0) {
                continue;
            }
            for condition in self.presence_of(index, span).conditions() {
                belongs = self.code.binary(BinaryOp::And, belongs, condition);
            }
            let outer = self.scope.clone();
            if let Some((name, at)) = parts.name {
                self.check_hides_local(name, at, &outer);
                self.scope.bind(name, LocalName::Value(Value::one(Ty::Player, id)));
            }
            let filter = parts.filter.map(|filter| self.condition(filter));
            let value = parts.value.map(|value| (self.expr(value), value));
            self.scope = outer;
            let (fold, found) = self.fold_of(function, value, filter);
            ty = Some(found);
            let counts = match fold.guard {
                Some(guard) => self.code.binary(BinaryOp::And, belongs, guard),
                None => belongs,
            };
            elements.push((counts, fold.value.unwrap_or(belongs)));
        }
        let zero = self.code.constant(0.0);
        match (function, ty) {
            (_, Some(Ty::Error)) => Value::error(),
            (Function::MinBy | Function::MaxBy, _) => {
                self.fail(Problem::new(span, Calls::NotYetAtStart { function: function.name() }))
            }
            (Function::Count, _) => {
                let sum = elements
                    .into_iter()
                    .fold(zero, |sum, (counts, _)| self.code.binary(BinaryOp::Add, sum, counts));
                Value::one(Ty::Int, sum)
            }
            (Function::Any, _) => {
                let any = elements.into_iter().fold(zero, |any, (counts, value)| {
                    let hit = self.code.binary(BinaryOp::And, counts, value);
                    self.code.binary(BinaryOp::Or, any, hit)
                });
                Value::one(Ty::Bool, any)
            }
            (Function::All, _) => {
                let every = self.code.bool(true);
                let all = elements.into_iter().fold(every, |all, (counts, value)| {
                    let spared = self.code.unary(UnaryOp::Not, counts);
                    let met = self.code.binary(BinaryOp::Or, spared, value);
                    self.code.binary(BinaryOp::And, all, met)
                });
                Value::one(Ty::Bool, all)
            }
            (_, None) => {
                self.fail(Problem::new(span, Calls::NobodyToCount { function: function.name() }))
            }
            (_, Some(ty)) => Value::one(ty, self.fold_numbers(function, &elements)),
        }
    }

    /// Sum, mean, least or greatest of values of which some may not count.
    fn fold_numbers(&mut self, function: Function, elements: &[(Reg, Reg)]) -> Reg {
        let zero = self.code.constant(0.0);
        if matches!(function, Function::Sum | Function::Mean) {
            let (mut sum, mut n) = (zero, zero);
            for &(counts, value) in elements {
                let part = self.code.select(counts, value, zero);
                sum = self.code.binary(BinaryOp::Add, sum, part);
                n = self.code.binary(BinaryOp::Add, n, counts);
            }
            return if function == Function::Sum {
                sum
            } else {
                self.code.binary(BinaryOp::Div, sum, n)
            };
        }
        let op = if function == Function::Min { BinaryOp::Min } else { BinaryOp::Max };
        // Beyond every length, duration and number of a start.
        let far = self.code.constant(if function == Function::Min { 1.0e9 } else { -1.0e9 });
        elements.iter().fold(far, |best, &(counts, value)| {
            let value = self.code.select(counts, value, far);
            self.code.binary(op, best, value)
        })
    }

    fn fold_of(
        &mut self,
        function: Function,
        value: Option<(Value<'w>, &'w Expr)>,
        filter: Option<Reg>,
    ) -> (Fold, Ty) {
        use Function as F;
        let kind = match function {
            F::Count => FoldKind::Count,
            F::Any => FoldKind::Any,
            F::All => FoldKind::All,
            F::Sum => FoldKind::Sum,
            F::Mean => FoldKind::Mean,
            F::Min => FoldKind::Min,
            F::Max => FoldKind::Max,
            F::MinBy => FoldKind::ArgMin,
            _ => FoldKind::ArgMax,
        };
        let is_logic = matches!(kind, FoldKind::Any | FoldKind::All);
        // `count(p in S where C)`, `any(p in S where C)`, `all(p in S where C)`
        let Some((value, expr)) = value else {
            if kind == FoldKind::Count {
                return (Fold { kind, value: None, guard: filter }, Ty::Int);
            }
            let value = filter.unwrap_or_else(|| self.code.bool(true));
            return (Fold { kind, value: Some(value), guard: None }, Ty::Bool);
        };
        let fits = value.is_error()
            || if is_logic { value.ty == Ty::Bool } else { value.ty.dim().is_some() };
        if !fits {
            let wanted = if is_logic { Ty::Bool } else { Ty::Number };
            self.report(self.mismatch(value.ty, wanted, expr.span));
        }
        let ty = match kind {
            _ if value.is_error() || !fits => Ty::Error,
            FoldKind::ArgMin | FoldKind::ArgMax => Ty::Player,
            FoldKind::Any | FoldKind::All => Ty::Bool,
            FoldKind::Count => Ty::Int,
            FoldKind::Mean if value.ty == Ty::Int => Ty::Number,
            _ => value.ty,
        };
        let reg = self.reg(&value);
        (Fold { kind, value: Some(reg), guard: filter }, ty)
    }

    pub(super) fn nearest(&mut self, set: &'w Expr, to: &'w Expr) -> Value<'w> {
        if !self.players_known(set.span, "nearest") {
            return Value::error();
        }
        let target = self.want_point(to);
        let Some(set) = self.want_set(set) else { return Value::error() };
        let open = self.code.open_loop(Over::Players { team: set.team, except: set.except });
        let place = self.player_place(open.element());
        let distance = self.distance(place, target);
        let fold = Fold { kind: FoldKind::ArgMin, value: Some(distance), guard: None };
        Value::one(Ty::Player, self.code.close_loop(open, fold))
    }

    /// Whether a place lies within the angle of view of a player: half to each side of where they
    /// face.
    pub(super) fn sees(&mut self, who: &'w Expr, place: &'w Expr, within: &'w Expr) -> Value<'w> {
        if !self.players_known(who.span, "sees") {
            return Value::error();
        }
        let player = self.want(who, Ty::Player);
        let (x, y) = self.want_point(place);
        let angle = self.want_reg(within, Ty::ANGLE);
        self.check_range(angle, (0.0, TAU), "the angle of view", within.span, "`0deg..360deg`");
        if player.is_error() {
            return player;
        }
        let player = self.reg(&player);
        let here = self.player_place(player);
        let facing = self.code.load(Field::PlayerHeading, Some(player), self.when);
        let (dx, dy) = (
            self.code.binary(BinaryOp::Sub, x, here.0),
            self.code.binary(BinaryOp::Sub, y, here.1),
        );
        let towards = self.code.binary(BinaryOp::Atan2, dy, dx);
        let turn = self.code.binary(BinaryOp::Sub, towards, facing);
        let turn = self.code.unary(UnaryOp::Wrap, turn);
        let turn = self.code.unary(UnaryOp::Abs, turn);
        let two = self.code.constant(2.0);
        let half = self.code.binary(BinaryOp::Div, angle, two);
        Value::one(Ty::Bool, self.code.binary(BinaryOp::Le, turn, half))
    }

    pub(super) fn pressed(&mut self, who: &'w Expr, within: &'w Expr) -> Value<'w> {
        if !self.players_known(who.span, "pressed") {
            return Value::error();
        }
        let player = self.want(who, Ty::Player);
        let reach = self.want_reg(within, Ty::LENGTH);
        if player.is_error() {
            return player;
        }
        let player = self.reg(&player);
        let here = self.player_place(player);
        let team = self.code.unary(UnaryOp::TeamOf, player);
        let opponents = self.code.unary(UnaryOp::OtherTeam, team);
        let open = self.code.open_loop(Over::Players { team: opponents, except: None });
        let place = self.player_place(open.element());
        let distance = self.distance(place, here);
        let near = self.code.binary(BinaryOp::Lt, distance, reach);
        let fold = Fold { kind: FoldKind::Any, value: Some(near), guard: None };
        Value::one(Ty::Bool, self.code.close_loop(open, fold))
    }
}

fn take_apart(function: Function, arg: &Arg) -> Option<Comprehension<'_>> {
    if let Some((name, set)) = &arg.binder {
        return Some(Comprehension {
            value: Some(&arg.value),
            name: Some((&name.node, name.span)),
            set,
            filter: arg.filter.as_ref(),
        });
    }
    if !matches!(function, Function::Count | Function::Any | Function::All) {
        return None;
    }
    match &arg.value.kind {
        ExprKind::Binary(op, name, set) if op.node == ast::InfixOp::In => match &name.kind {
            ExprKind::Name(word) => Some(Comprehension {
                value: None,
                name: Some((word, name.span)),
                set,
                filter: arg.filter.as_ref(),
            }),
            _ => None,
        },
        _ if function == Function::Count && arg.filter.is_none() => {
            Some(Comprehension { value: None, name: None, set: &arg.value, filter: None })
        }
        _ => None,
    }
}
