//! Coordinates in metres: `.metres`, and how a text that means metres is written.

use super::super::Lower;
use super::super::value::Value;
use crate::ast::{Arg, Expr, ExprKind, InfixOp, PrefixOp, Span};
use crate::check::types::Ty;
use setpiece_scenario::vocabulary::Function;

impl<'w> Lower<'_, 'w> {
    /// `.metres`: a place as a vector from the centre spot, so that its coordinates are lengths.
    pub(super) fn metres(&mut self, value: &Value<'w>, span: Span) -> Value<'w> {
        let place = self.place_of(value, span);
        Value::two(Ty::Vector, place)
    }

    /// How an expression is written with its coordinates in metres; `None` if that is no length.
    pub(crate) fn written_in_metres(&mut self, expr: &'w Expr) -> Option<String> {
        let mut places = Vec::new();
        let mut text = self.world.text(expr.span);
        let is_whole = text.len() == (expr.span.end - expr.span.start) as usize;
        if !is_whole || !self.becomes_length(expr, None, &mut places) {
            return None;
        }
        places.sort_unstable();
        for end in places.into_iter().rev() {
            let at = (end - expr.span.start) as usize;
            if !text.is_char_boundary(at) {
                return None;
            }
            text.insert_str(at, ".metres");
        }
        Some(text)
    }

    /// Whether a plain number is a length once the places in it are in metres; `ends`: where their
    /// texts end; `player`: what each player is called around it.
    fn becomes_length(
        &mut self,
        expr: &'w Expr,
        player: Option<&str>,
        ends: &mut Vec<u32>,
    ) -> bool {
        use Function as F;
        match &expr.kind {
            ExprKind::Member(of, axis) if matches!(axis.node.as_str(), "x" | "y") => {
                let world = self.world;
                ends.push(of.span.end);
                let is_player = matches!(&of.kind, ExprKind::Name(name) if player == Some(name));
                is_player || world.tentatively(|| self.expr(of).ty).is_place()
            }
            ExprKind::Unary(PrefixOp::Neg | PrefixOp::Plus, inner) => {
                self.becomes_length(inner, player, ends)
            }
            ExprKind::Binary(op, a, b) => match op.node {
                InfixOp::Add | InfixOp::Sub => {
                    self.becomes_length(a, player, ends) && self.becomes_length(b, player, ends)
                }
                InfixOp::Mul if is_number(a) => self.becomes_length(b, player, ends),
                InfixOp::Mul | InfixOp::Div if is_number(b) => self.becomes_length(a, player, ends),
                _ => false,
            },
            ExprKind::Call { name, args } => {
                let function = Function::from_name(&name.node);
                let keeps_unit = matches!(
                    function,
                    Some(F::Abs | F::Min | F::Max | F::Mean | F::Prev | F::Delta)
                );
                let mut stays = |arg: &'w Arg| {
                    let each = arg.binder.as_ref().map(|(name, _)| name.node.as_str());
                    arg.key.is_none() && self.becomes_length(&arg.value, each.or(player), ends)
                };
                keeps_unit && args.iter().all(&mut stays)
            }
            _ => false,
        }
    }
}

fn is_number(expr: &Expr) -> bool {
    matches!(expr.kind, ExprKind::Number { unit: None, .. })
}
