//! What a scenario declares and nothing reads: inherited parameters that do nothing, because an
//! option that they gave is written again, and constants with mistakes.

use super::value::{LiteralFrame, Scope};
use super::{Lower, World};
use crate::ast::{Expr, ExprKind, Field, FieldValue};
use crate::problem::facts::Players;
use crate::problem::{Problem, Rewrite};
use crate::source::Span;

/// Reports those of a lowered scenario: what it has read is known.
pub(crate) fn check_scenario(world: &World<'_>) {
    let flat = world.flat;
    let Some(parent) = flat.item.extends.as_ref().filter(|_| !flat.item.is_abstract) else {
        return;
    };
    for (old, new) in flat.teams.iter().flat_map(|team| &team.rewritten) {
        let (Some(by), Some(value)) = (value_of(old), value_of(new)) else { continue };
        let ExprKind::Name(name) = &by.kind else { continue };
        let mut inherited = world.params.iter().filter(|param| flat.is_inherited(param.name.span));
        let Some(param) = inherited.find(|param| param.name.node == *name) else { continue };
        let is_read = world.used.borrow().contains(&param.name.span);
        if is_read || param.bound.is_some() || !flat.is_own(new.key.span) {
            continue;
        }
        // The option goes, and its value is handed in.
        let option = new.key.span.to(value.span);
        let argument = format!("{name}: {}", world.text(value.span));
        let (given, written) = match parent.args.last() {
            Some(last) => (last.span, format!(", {argument}")),
            None => (parent.name.span, format!("({argument})")),
        };
        let behind = Span { start: given.end, ..given };
        let handed = Rewrite {
            says: format!("extends {}({argument})", parent.bare()),
            places: vec![vec![(behind, written), (option, String::new())]],
        };
        let (name, parent) = (name.clone(), parent.bare().to_owned());
        let fact = Players::DeadParameter {
            name,
            parent,
            value: world.text(value.span),
            wrote: old.key.span,
        };
        world.report(Problem::new(new.key.span, fact).with_rewrite(handed));
    }
}

fn value_of(field: &Field) -> Option<&Expr> {
    match &field.value {
        FieldValue::Expr(expr) => Some(expr),
        FieldValue::Fields(..) | FieldValue::Script(_) => None,
    }
}

/// Lowers the constants of a scenario that nothing reads, for what is wrong with them.
pub(crate) fn check_constants(world: &World<'_>) {
    for binding in &world.flat.consts {
        let name = binding.name.span;
        if !world.used.borrow().contains(&name) {
            let scope = Scope::new(false, LiteralFrame::World);
            Lower::constant(world, scope).constant_item(binding, name);
        }
    }
}
