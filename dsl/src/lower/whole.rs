//! Why a number isn't a whole one: which names stand for numbers only because no type says that
//! they are whole.
//!
//! `state n = 0` holds numbers, since a half may be added to it later; `state n: int = 0` doesn't.

use super::Lower;
use super::value::LocalName;
use crate::ast::{Expr, ExprKind, InfixOp, PrefixOp, Span};
use crate::check::types::Ty;
use crate::problem::facts::{Instead, Undeclared};
use setpiece_scenario::vocabulary::Function;

/// Deepest nesting that is looked into.
const DEPTH_MAX: u32 = 12;

impl<'w> Lower<'_, 'w> {
    /// How a number becomes a whole one.
    pub(super) fn made_whole(&mut self, expr: &'w Expr) -> Instead {
        let mut open = Vec::new();
        let undeclared =
            if self.is_whole(expr, &mut open, DEPTH_MAX) { open.into_iter().next() } else { None };
        let is_literal = matches!(expr.kind, ExprKind::Number { .. });
        Instead::Whole { undeclared, is_literal }
    }

    /// Whether an expression is a whole number once some names are declared as whole.
    fn is_whole(&mut self, expr: &'w Expr, open: &mut Vec<Undeclared>, depth: u32) -> bool {
        let Some(depth) = depth.checked_sub(1) else { return false };
        match &expr.kind {
            ExprKind::Unary(PrefixOp::Neg | PrefixOp::Plus, of) => self.is_whole(of, open, depth),
            ExprKind::Binary(op, a, b)
                if matches!(op.node, InfixOp::Add | InfixOp::Sub | InfixOp::Mul) =>
            {
                self.is_whole(a, open, depth) && self.is_whole(b, open, depth)
            }
            ExprKind::If(_, a, b) => self.is_whole(a, open, depth) && self.is_whole(b, open, depth),
            ExprKind::Call { name, args }
                if keeps_whole(&name.node) && args.iter().all(is_plain) =>
            {
                args.iter().all(|arg| self.is_whole(&arg.value, open, depth))
            }
            ExprKind::Name(name) => match self.scope.find(name).cloned() {
                Some(LocalName::Expr { expr, scope, ty: None, .. }) => {
                    self.within(scope, |lower| lower.is_whole(expr, open, depth))
                }
                Some(binding) if self.has_type(expr, Ty::Number) => {
                    let written = binding.declared().and_then(|at| self.undeclared(name, at));
                    let is_written = written.is_some();
                    open.extend(written);
                    is_written
                }
                _ => self.has_type(expr, Ty::Int),
            },
            _ => self.has_type(expr, Ty::Int),
        }
    }

    fn has_type(&mut self, expr: &'w Expr, ty: Ty) -> bool {
        self.world.tentatively(|| self.expr(expr).ty) == ty
    }

    /// The declaration of a name without a type whose value is written as a whole number.
    fn undeclared(&self, name: &str, at: Span) -> Option<Undeclared> {
        let value = self.world.text_behind(at).trim_start().strip_prefix('=')?;
        let value = value.trim_start();
        let end = value.find(|c: char| !c.is_ascii_alphanumeric() && !matches!(c, '_' | '.'));
        let (value, behind) = value.split_at(end.unwrap_or(value.len()));
        let is_whole = !value.is_empty() && value.bytes().all(|b| b.is_ascii_digit() || b == b'_');
        let goes_on = behind.trim_start().starts_with(['+', '-', '*', '/']);
        (is_whole && !goes_on).then(|| Undeclared {
            name: name.to_owned(),
            value: value.to_owned(),
            at,
        })
    }
}

/// Whether a function of whole numbers is whole.
fn keeps_whole(name: &str) -> bool {
    matches!(
        Function::from_name(name),
        Some(Function::Min | Function::Max | Function::Clamp | Function::Abs | Function::Mod)
    )
}

/// Whether an argument is nothing but a value.
fn is_plain(arg: &crate::ast::Arg) -> bool {
    arg.binder.is_none() && arg.filter.is_none()
}
