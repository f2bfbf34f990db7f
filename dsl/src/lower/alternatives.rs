//! One of several things that are no numbers: `choice(press, hold)`, `if C then f else g`.

use super::Lower;
use crate::ast::{Arg, Expr, ExprKind, Span};
use crate::problem::Problem;
use crate::problem::facts::Calls;
use setpiece_scenario::vocabulary::{Function, Team};
use setpiece_scenario::{BinaryOp, Reg, UnaryOp};

/// One of several, and the condition under which it is meant: always if absent.
pub(crate) type Alternative<'w> = (Option<Reg>, &'w Expr);

/// What an expression may be, in the order of [`Lower::alternatives`].
pub(crate) fn leaves(expr: &Expr) -> Vec<&Expr> {
    match &expr.kind {
        ExprKind::If(_, then, otherwise) => [leaves(then), leaves(otherwise)].concat(),
        ExprKind::Call { name, args } if is_one_of(&name.node) => {
            args.iter().flat_map(|arg| leaves(arg.key.as_ref().unwrap_or(&arg.value))).collect()
        }
        _ => vec![expr],
    }
}

fn is_one_of(name: &str) -> bool {
    [Function::Choice, Function::Alternate].iter().any(|function| function.name() == name)
}

impl<'w> Lower<'_, 'w> {
    /// What an expression may be; exactly one of the conditions holds.
    pub(crate) fn alternatives(&mut self, expr: &'w Expr) -> Vec<Alternative<'w>> {
        let mut found = Vec::new();
        self.spread(expr, None, &mut found);
        found
    }

    fn spread(&mut self, expr: &'w Expr, when: Option<Reg>, found: &mut Vec<Alternative<'w>>) {
        match &expr.kind {
            ExprKind::If(condition, then, otherwise) => {
                let holds = self.condition(condition);
                let not = self.code.unary(UnaryOp::Not, holds);
                for (holds, branch) in [(holds, then), (not, otherwise)] {
                    let when = self.both(when, holds);
                    self.spread(branch, Some(when), found);
                }
            }
            ExprKind::Call { name, args } if name.node == Function::Choice.name() => {
                let number = |expr: &Expr| matches!(expr.kind, ExprKind::Number { .. });
                let swapped = |arg: &&Arg| arg.key.as_ref().is_some_and(number);
                if let Some(arg) = args.iter().find(swapped)
                    && let Some(weight) = &arg.key
                {
                    let [value, weight] = [&arg.value, weight].map(|one| self.world.text(one.span));
                    self.report(Problem::new(arg.span, Calls::WeightFirst { value, weight }));
                    return;
                }
                let Some(index) = self.pick(args, expr.span, &mut |_, _| {}) else { return };
                for (nth, arg) in args.iter().enumerate() {
                    let nth = self.code.constant(nth as f64);
                    let holds = self.code.binary(BinaryOp::Eq, index, nth);
                    let when = self.both(when, holds);
                    self.spread(arg.key.as_ref().unwrap_or(&arg.value), Some(when), found);
                }
            }
            ExprKind::Call { name, args } if name.node == Function::Alternate.name() => {
                let [first, second] = args.as_slice() else {
                    self.expr(expr);
                    return;
                };
                let even = self.is_even_episode();
                let odd = self.code.unary(UnaryOp::Not, even);
                for (holds, arg) in [(even, first), (odd, second)] {
                    let when = self.both(when, holds);
                    self.spread(&arg.value, Some(when), found);
                }
            }
            _ => found.push((when, expr)),
        }
    }

    /// Both conditions.
    pub(super) fn both(&mut self, one: Option<Reg>, other: Reg) -> Reg {
        one.map_or(other, |one| self.code.binary(BinaryOp::And, one, other))
    }

    /// When each formation of a team is meant, drawn once for all its players.
    pub(super) fn formations_of(&mut self, team: Team, whole: &'w Expr) -> Vec<Option<Reg>> {
        let same =
            |known: &&(Team, Span, Vec<Option<Reg>>)| (known.0, known.1) == (team, whole.span);
        if let Some(known) = self.start().and_then(|start| start.formations.iter().find(same)) {
            return known.2.clone();
        }
        let scope = super::value::Scope::new(true, super::value::LiteralFrame::World);
        let conditions: Vec<Option<Reg>> = self
            .drawing(&format!("formation {team}"), |lower| {
                lower.within(scope, |lower| lower.alternatives(whole))
            })
            .into_iter()
            .map(|(when, _)| when)
            .collect();
        if let Some(start) = self.start_mut() {
            start.formations.push((team, whole.span, conditions.clone()));
        }
        conditions
    }
}
