//! The outline of a text: what it declares.

use super::Analysis;
use crate::dsl::ast::{
    BehaviorBody, BehaviorItem, BehaviorStmt, BehaviorStmtKind, File, Item, ItemKind, RewardStmt,
    RewardStmtKind, RewardUse, RewardUseKind, ScenarioStmt, ScenarioStmtKind, Span, TeamStmt,
    TeamStmtKind,
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
    pub fn symbols(&self) -> &[Symbol] {
        &self.outline
    }
}

/// What a file declares, in order.
pub(super) fn of_file(file: &File) -> Vec<Symbol> {
    file.items.iter().filter_map(of_item).collect()
}

/// Moves the bytes of symbols.
pub(super) fn move_all(symbols: &mut [Symbol], to: &impl Fn(&Range<usize>) -> Range<usize>) {
    for symbol in symbols {
        symbol.whole = to(&symbol.whole);
        symbol.range = to(&symbol.range);
        move_all(&mut symbol.inside, to);
    }
}

/// Symbols and all that is inside them, from the outside in.
pub(super) fn flat(symbols: &[Symbol]) -> Vec<&Symbol> {
    symbols.iter().flat_map(|it| std::iter::once(it).chain(flat(&it.inside))).collect()
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
    let params = item.kind.params().iter();
    found.inside.extend(
        params.map(|it| symbol(&it.name.node, SymbolKind::Parameter, it.name.span, it.span)),
    );
    found.inside.extend(match &item.kind {
        ItemKind::Scenario(it) => it.body.iter().flat_map(of_statement).collect(),
        ItemKind::Formation(it) => it.body.iter().filter_map(of_player).collect(),
        ItemKind::Reward(it) => of_reward(&it.body),
        ItemKind::Behavior(BehaviorItem { body: BehaviorBody::Block(body), .. }) => {
            of_behavior(body)
        }
        _ => Vec::new(),
    });
    Some(found)
}

/// The states and values of a reward.
fn of_reward(body: &[RewardStmt]) -> Vec<Symbol> {
    let of = |stmt: &RewardStmt| match &stmt.kind {
        RewardStmtKind::State(it) | RewardStmtKind::Let(it) => {
            vec![symbol(&it.name.node, SymbolKind::Value, it.name.span, stmt.span)]
        }
        RewardStmtKind::On { body, .. } => of_reward(body),
        RewardStmtKind::When { then, otherwise, .. } => then
            .iter()
            .chain(otherwise.iter().flatten())
            .flat_map(|it| of_reward(one(it)))
            .collect(),
        _ => Vec::new(),
    };
    body.iter().flat_map(of).collect()
}

/// The states and values of a behaviour.
fn of_behavior(body: &[BehaviorStmt]) -> Vec<Symbol> {
    let of = |stmt: &BehaviorStmt| match &stmt.kind {
        BehaviorStmtKind::State(it) | BehaviorStmtKind::Let(it) => {
            vec![symbol(&it.name.node, SymbolKind::Value, it.name.span, stmt.span)]
        }
        BehaviorStmtKind::Interrupt { body, .. } | BehaviorStmtKind::Repeat { body, .. } => {
            of_behavior(body)
        }
        BehaviorStmtKind::Choose(chances) => {
            chances.iter().flat_map(|chance| of_behavior(&chance.body)).collect()
        }
        BehaviorStmtKind::If { arms, otherwise } => {
            let arms = arms.iter().flat_map(|(_, body)| of_behavior(body));
            arms.chain(of_behavior(otherwise)).collect()
        }
        _ => Vec::new(),
    };
    body.iter().flat_map(of).collect()
}

fn one<T>(it: &T) -> &[T] {
    std::slice::from_ref(it)
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
        ScenarioStmtKind::Reward(RewardUse {
            what: RewardUseKind::Inline { name, body }, ..
        }) => {
            let mut found = symbol(&name.node, SymbolKind::Reward, name.span, stmt.span);
            found.inside = of_reward(body);
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
