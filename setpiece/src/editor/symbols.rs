//! The outline of a text: what it declares.

use super::Analysis;
use crate::dsl::ast::{
    Item, ItemKind, ScenarioStmt, ScenarioStmtKind, Span, TeamStmt, TeamStmtKind,
};
use std::ops::Range;

/// What kind of thing a symbol is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymbolKind {
    /// A scenario.
    Scenario,
    /// A reward.
    Reward,
    /// A formation.
    Formation,
    /// A function or region with a name.
    Function,
    /// A constant, table, `let` or record.
    Value,
    /// A parameter.
    Parameter,
    /// An ending.
    Ending,
    /// A behaviour.
    Behavior,
    /// A suite, check or curriculum.
    Plan,
    /// A team.
    Team,
    /// A player.
    Player,
}

/// Something that a text declares, with what is declared in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: SymbolKind,
    /// The bytes of all of it.
    pub whole: Range<usize>,
    /// The bytes of its name.
    pub range: Range<usize>,
    /// What it contains.
    pub inside: Vec<Symbol>,
}

fn symbol(name: &str, kind: SymbolKind, at: Span, whole: Span) -> Symbol {
    let bytes = |span: Span| span.start as usize..span.end as usize;
    Symbol {
        name: name.to_owned(),
        kind,
        whole: bytes(whole.to(at)),
        range: bytes(at),
        inside: Vec::new(),
    }
}

impl Analysis {
    /// What the text declares, in order.
    pub fn symbols(&self) -> Vec<Symbol> {
        self.tree.items.iter().filter_map(of_item).collect()
    }
}

fn of_item(item: &Item) -> Option<Symbol> {
    let (name, kind) = match &item.kind {
        ItemKind::Scenario(it) => (&it.name, SymbolKind::Scenario),
        ItemKind::Reward(it) => (&it.name, SymbolKind::Reward),
        ItemKind::Formation(it) => (&it.name, SymbolKind::Formation),
        ItemKind::Const(it) => (&it.name, SymbolKind::Value),
        ItemKind::Table(it) => (&it.name, SymbolKind::Value),
        ItemKind::Fn(it) | ItemKind::Region(it) => (&it.name, SymbolKind::Function),
        ItemKind::Ending(it) => (&it.name, SymbolKind::Ending),
        ItemKind::Behavior(it) => (&it.name, SymbolKind::Behavior),
        ItemKind::Suite(it) => (&it.name, SymbolKind::Plan),
        ItemKind::Check(it) => (&it.name, SymbolKind::Plan),
        ItemKind::Curriculum(it) => (&it.name, SymbolKind::Plan),
        ItemKind::Import { .. } | ItemKind::Broken => return None,
    };
    let mut found = symbol(&name.node, kind, name.span, item.span);
    if let ItemKind::Scenario(scenario) = &item.kind {
        let params = scenario.params.iter();
        found.inside = params
            .map(|it| symbol(&it.name.node, SymbolKind::Parameter, it.name.span, it.span))
            .chain(scenario.body.iter().flat_map(of_statement))
            .collect();
    }
    Some(found)
}

fn of_statement(stmt: &ScenarioStmt) -> Vec<Symbol> {
    let one =
        |name: &crate::dsl::ast::Ident, kind| vec![symbol(&name.node, kind, name.span, stmt.span)];
    match &stmt.kind {
        ScenarioStmtKind::Param(it) => one(&it.name, SymbolKind::Parameter),
        ScenarioStmtKind::Let(it) | ScenarioStmtKind::Const(it) | ScenarioStmtKind::Record(it) => {
            one(&it.name, SymbolKind::Value)
        }
        ScenarioStmtKind::LetTuple { names, .. } => {
            names.iter().flat_map(|name| one(name, SymbolKind::Value)).collect()
        }
        ScenarioStmtKind::Region(it) => one(&it.name, SymbolKind::Function),
        ScenarioStmtKind::Team { team, body } => {
            let mut found =
                symbol(&format!("team {}", team.node), SymbolKind::Team, team.span, stmt.span);
            found.inside = body.iter().filter_map(of_player).collect();
            vec![found]
        }
        _ => Vec::new(),
    }
}

fn of_player(stmt: &TeamStmt) -> Option<Symbol> {
    let TeamStmtKind::Player(player) = &stmt.kind else { return None };
    let (name, at) = match &player.name {
        Some(name) => (name.node.clone(), name.span),
        None => (player.role.node.to_string(), player.role.span),
    };
    Some(symbol(&name, SymbolKind::Player, at, stmt.span))
}
