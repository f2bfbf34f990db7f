//! Checks what a `reward` hook returns, as far as the text shows it: a number, or a map of its
//! terms.

use super::super::api::type_words;
use super::super::functions::functions;
use super::super::hooks::{REWARD, hook_arguments};
use super::super::place::word_at;
use super::super::terms::{FOUND_MAP, expected_map, list_them, no_term, not_listed};
use super::{ScriptFault, ScriptFaultKind, position_offset};
use rhai::{AST, ASTFlags, ASTNode, Expr, Map, Stmt, StmtBlock};
use std::ops::Range;

/// Reports values that can't be paid as these terms.
pub(super) fn check(source: &str, ast: &AST, terms: &[&str], faults: &mut Vec<ScriptFault>) {
    let n_params = hook_arguments(REWARD).map_or(0, <[_]>::len);
    let mut own = functions(ast).into_iter();
    let Some(hook) = own.find(|own| own.name == REWARD && own.params.len() == n_params) else {
        return;
    };
    let mut returned = Vec::new();
    for statement in &hook.body {
        statement.walk(&mut Vec::new(), &mut |path: &[ASTNode]| {
            // `throw` is a `return` with a flag.
            if let Some(ASTNode::Stmt(Stmt::Return(Some(expr), flags, _))) = path.last()
                && !flags.contains(ASTFlags::BREAK)
            {
                returned.push((**expr).clone());
            }
            true
        });
    }
    last_value(hook.body.last(), &mut returned);
    let mut fault = |range: Range<usize>, message: String, help: Option<String>| {
        faults.push(ScriptFault {
            kind: ScriptFaultKind::Hook,
            module: None,
            range,
            message,
            help,
        });
    };
    for expr in &returned {
        let start = position_offset(source, expr.position());
        let Some(keys) = keys(expr) else {
            if let (Some(found), false) = (constant(expr), terms.is_empty()) {
                fault(word_at(source, start), expected_map(terms, &found), None);
            }
            continue;
        };
        // Rhai counts other line ends, so that a map may begin elsewhere than it says.
        let begins = source.get(start..).is_some_and(|rest| rest.starts_with("#{"));
        let whole = if begins { start..start + 2 } else { word_at(source, start) };
        if terms.is_empty() {
            let listed: Vec<String> = keys.iter().map(|key| format!("{key:?}")).collect();
            fault(whole, FOUND_MAP.to_owned(), Some(list_them(&listed.join(", "))));
            continue;
        }
        let mut meant = String::new();
        for key in keys.iter().filter(|key| !terms.contains(&key.as_str())) {
            let (message, help) = not_listed(key, terms.iter().copied());
            meant += help.as_deref().unwrap_or_default();
            fault(key_at(source, start, key).unwrap_or(whole.clone()), message, help);
        }
        // A misspelt term has been reported.
        let missing = terms.iter().filter(|term| keys.iter().all(|key| key != *term));
        for term in missing.filter(|term| !meant.contains(&format!("`{term}`"))) {
            fault(
                whole.clone(),
                no_term(term),
                Some(format!("write `{term}: 0`, if it pays nothing here")),
            );
        }
    }
}

/// The values that a last statement may have.
fn last_value(statement: Option<&Stmt>, found: &mut Vec<Expr>) {
    let mut last_of = |block: &StmtBlock| last_value(block.statements().last(), found);
    match statement {
        Some(Stmt::Expr(expr)) => of_expr(expr, found),
        Some(Stmt::Block(inner)) => last_of(inner),
        Some(Stmt::If(flow, _) | Stmt::TryCatch(flow, _)) => {
            last_of(&flow.body);
            last_of(&flow.branch);
        }
        Some(Stmt::Switch(switch, _)) => {
            switch.1.expressions.iter().for_each(|case| of_expr(&case.rhs, found));
        }
        _ => {}
    }
}

fn of_expr(expr: &Expr, found: &mut Vec<Expr>) {
    match expr {
        Expr::Stmt(block) => last_value(block.statements().last(), found),
        expr => found.push(expr.clone()),
    }
}

/// The keys of a map that the text shows.
fn keys(expr: &Expr) -> Option<Vec<String>> {
    match expr {
        Expr::Map(map, _) => Some(map.0.iter().map(|(key, _)| key.name.to_string()).collect()),
        // A map of constants is folded into one value.
        Expr::DynamicConstant(value, _) => {
            Some(value.read_lock::<Map>()?.keys().map(ToString::to_string).collect())
        }
        _ => None,
    }
}

/// What a constant that is no map is called.
fn constant(expr: &Expr) -> Option<String> {
    let value = expr.get_literal_value(None)?;
    (!value.is_map()).then(|| type_words(value.type_name()))
}

/// The place of a key in a map that begins at `start`.
fn key_at(source: &str, start: usize, key: &str) -> Option<Range<usize>> {
    let rest = source.get(start..)?;
    let places = rest.match_indices(key).map(|(at, _)| start + at);
    places.map(|at| word_at(source, at)).find(|range| {
        let before = source.get(..range.start).unwrap_or_default().chars().next_back();
        source.get(range.clone()) == Some(key)
            && before.is_none_or(|char| !(char.is_alphanumeric() || char == '_'))
    })
}
