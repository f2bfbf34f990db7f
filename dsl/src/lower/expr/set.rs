//! Players as a group: `count(p in them where …)`, `nearest`, `pressed`, and the aggregates.

use super::super::Lower;
use super::super::value::{Binding, Repr, SetValue, Value};
use crate::ast::{self, Arg, Expr, ExprKind, Span};
use crate::check::types::Ty;
use crate::problem::{Code, Problem};
use setpiece_scenario::vocabulary::Function;
use setpiece_scenario::{BinaryOp, Fold, FoldKind, Over, Reg, UnaryOp};

/// `E for p in S where C`, taken apart.
struct Comprehension<'w> {
    value: Option<&'w Expr>,
    name: Option<&'w str>,
    set: &'w Expr,
    filter: Option<&'w Expr>,
}

impl<'w> Lower<'_, 'w> {
    /// Whether a player belongs to a set.
    pub(super) fn in_set(&mut self, player: Reg, set: SetValue) -> Reg {
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
        match self.want(expr, Ty::Set).repr {
            Repr::Set(set) => Some(set),
            _ => None,
        }
    }

    /// Reports a loop over players where no match is under way.
    fn players_known(&self, span: Span, what: &str) -> bool {
        let known = self.stage.is_step();
        if !known {
            self.report(
                Problem::new(Code::WrongScope, span, format!("`{what}` goes through players, and the match has not begun"), "")
                    .help("name the players: `distance(a, b)`"),
            );
        }
        known
    }

    pub(super) fn aggregate(&mut self, function: Function, args: &'w [Arg], span: Span) -> Value<'w> {
        let name = function.name();
        let [arg] = args else {
            return self.fail(
                Problem::new(Code::WrongArguments, span, format!("`{name}` goes through one set of players"), "")
                    .help(format!("`{}`", function.doc().split(": ").next().unwrap_or(name))),
            );
        };
        let Some(parts) = take_apart(function, arg) else {
            return self.fail(
                Problem::new(Code::WrongArguments, arg.span, format!("`{name}` doesn't say which players"), "")
                    .help(format!("`{}`", function.doc().split(": ").next().unwrap_or(name))),
            );
        };
        if !self.players_known(span, name) {
            return Value::error();
        }
        let Some(set) = self.want_set(parts.set) else { return Value::error() };
        let open = self.code.open_loop(Over::Players { team: set.team, except: set.except });
        let outer = self.scope.clone();
        if let Some(name) = parts.name {
            self.scope.bind(name, Binding::Value(Value::one(Ty::Player, open.element())));
        }
        let filter = parts.filter.map(|filter| self.condition(filter));
        let value = parts.value.map(|value| (self.expr(value), value));
        self.scope = outer;
        let (fold, ty) = self.fold_of(function, value, filter);
        let result = self.code.close_loop(open, fold);
        Value { ty, repr: if ty == Ty::Error { Repr::Nothing } else { Repr::One(result) } }
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
            return match kind {
                FoldKind::Count => (Fold { kind, value: None, guard: filter }, Ty::Int),
                _ => {
                    let value = filter.unwrap_or_else(|| self.code.bool(true));
                    (Fold { kind, value: Some(value), guard: None }, Ty::Bool)
                }
            };
        };
        let fits = value.is_error() || if is_logic { value.ty == Ty::Bool } else { value.ty.dim().is_some() };
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

fn take_apart<'w>(function: Function, arg: &'w Arg) -> Option<Comprehension<'w>> {
    if let Some((name, set)) = &arg.binder {
        return Some(Comprehension { value: Some(&arg.value), name: Some(&name.node), set, filter: arg.filter.as_ref() });
    }
    if !matches!(function, Function::Count | Function::Any | Function::All) {
        return None;
    }
    match &arg.value.kind {
        ExprKind::Binary(op, name, set) if op.node == ast::BinaryOp::In => match &name.kind {
            ExprKind::Name(name) => Some(Comprehension { value: None, name: Some(name), set, filter: arg.filter.as_ref() }),
            _ => None,
        },
        _ if function == Function::Count && arg.filter.is_none() => {
            Some(Comprehension { value: None, name: None, set: &arg.value, filter: None })
        }
        _ => None,
    }
}
