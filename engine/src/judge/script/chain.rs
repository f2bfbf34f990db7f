//! Chains of a script, `a.b[c].d(e)`, and its closures, as Rhai's syntax tree has them.

use super::functions::ANONYMOUS;
use rhai::{Expr, FnCallExpr, FnPtr, Position, Stmt};

/// The name of a closure's function and the variables it captures, if an expression is one.
pub(super) fn closure(expr: &Expr) -> Option<(String, &[Expr])> {
    fn pointer(expr: &Expr) -> Option<String> {
        let Expr::DynamicConstant(value, _) = expr else { return None };
        let name = value.read_lock::<FnPtr>()?.fn_name().to_owned();
        name.starts_with(ANONYMOUS).then_some(name)
    }
    match expr {
        Expr::Stmt(block) => match block.statements() {
            [Stmt::Share(_), Stmt::Expr(expr)] => closure(expr),
            [Stmt::Share(_), Stmt::FnCall(call, _)] => {
                Some((pointer(call.args.first()?)?, call.args.get(1..)?))
            }
            _ => None,
        },
        Expr::FnCall(call, _) if call.name == "curry" => {
            Some((pointer(call.args.first()?)?, call.args.get(1..)?))
        }
        _ => Some((pointer(expr)?, &[])),
    }
}

/// A link of a chain.
pub(super) enum Link<'a> {
    /// With the position of its name.
    Property(&'a str, Position),
    /// With the position of its name.
    Method(&'a FnCallExpr, Position),
    /// With the position of its bracket.
    Index(&'a Expr, Position),
}

/// The root of a chain, and its links.
pub(super) fn links(expr: &Expr) -> (&Expr, Vec<Link<'_>>) {
    let mut links = Vec::new();
    let mut root = expr;
    let mut next = Some(expr);
    while let Some(here) = next.take() {
        let (pair, options, position, indexes) = match here {
            Expr::Dot(pair, options, position) => (pair, options, position, false),
            Expr::Index(pair, options, position) => (pair, options, position, true),
            _ => break,
        };
        if links.is_empty() {
            root = &pair.lhs;
        }
        let goes_on = matches!(pair.rhs, Expr::Dot(..) | Expr::Index(..))
            && !options.contains(rhai::ASTFlags::BREAK);
        let step = match &pair.rhs {
            Expr::Dot(rest, ..) | Expr::Index(rest, ..) if goes_on => {
                next = Some(&pair.rhs);
                &rest.lhs
            }
            last => last,
        };
        links.push(match step {
            Expr::Property(property, position) if !indexes => {
                Link::Property(property.2.as_str(), *position)
            }
            Expr::MethodCall(call, position) if !indexes => Link::Method(call, *position),
            index => Link::Index(index, *position),
        });
    }
    (root, links)
}
