//! The players of a team's formation, or of the one of several that an episode has.

use super::alternatives::leaves;
use super::known::StartState;
use super::layouts::says_more;
use super::people::Rostered;
use super::roster::{adjust, apply_each, copies, has_room};
use super::value::{LiteralFrame, Repr, Scope, Value};
use super::{Lower, World};
use crate::ast::{Expr, ExprKind, FormationItem, ItemKind, TeamStmtKind};
use crate::check::names;
use crate::check::types::Ty;
use crate::problem::facts::{Kind, Names};
use crate::problem::{Guess, Problem};
use crate::resolve::formation_chain;
use setpiece_scenario::vocabulary::{Function, Team};

/// The players of a formation value: its name, a call with arguments, or one of several.
pub(super) fn formation_players<'w>(
    world: &World<'w>,
    expr: &'w Expr,
    team: Team,
) -> Vec<Rostered<'w>> {
    let several: Vec<Vec<Rostered<'w>>> =
        leaves(expr).into_iter().map(|leaf| players_of(world, leaf, team)).collect();
    let mut listed = several.into_iter();
    let mut players = listed.next().unwrap_or_default();
    let others: Vec<_> = listed.collect();
    if others.is_empty() {
        return players;
    }
    for player in &mut players {
        player.join(expr, 0);
    }
    for (which, others) in (1..).zip(others) {
        let known = players.len();
        let mut joined = vec![false; known];
        for mut other in others {
            let same = |(index, player): (usize, &Rostered<'w>)| {
                let name = |player: &Rostered<'w>| player.name.map(|name| name.node.as_str());
                joined.get(index) == Some(&false)
                    && player.role == other.role
                    && name(player) == name(&other)
                    && !says_more(world, player, &other)
                    && !says_more(world, &other, player)
            };
            let found = players.iter().enumerate().position(same);
            let known = found.and_then(|at| players.get_mut(at).zip(joined.get_mut(at)));
            if let Some((player, joined)) = known {
                *joined = true;
                player.also(which, other.stand);
            } else {
                other.join(expr, which);
                players.push(other);
            }
        }
    }
    let number = leaves(expr).len();
    for player in &mut players {
        player.formations = player.formations.take().filter(|them| them.which.len() < number);
    }
    players
}

/// The players of one formation.
fn players_of<'w>(world: &World<'w>, expr: &'w Expr, team: Team) -> Vec<Rostered<'w>> {
    let mut lower =
        Lower::of_start(world, Scope::new(true, LiteralFrame::World), StartState::default());
    if let ExprKind::Call { name, args } = &expr.kind
        && let Some(found) = world.library.find(name.span.file, &name.node)
        && let ItemKind::Formation(item) = &found.item.kind
    {
        world.mark_used(found.name.span);
        let mut scope = Scope::new(false, LiteralFrame::Own);
        lower.bind_params(&name.node, &item.params, args, expr.span, &mut scope, false);
        return chain_players(world, item, &scope, team);
    }
    if let Some(problem) = unknown_formation(&lower, expr) {
        world.report(problem);
        return Vec::new();
    }
    let value: Value<'w> = lower.want(expr, Ty::Formation);
    match value.repr {
        Repr::Formation(item) => {
            let mut scope = Scope::new(false, LiteralFrame::Own);
            lower.bind_params(&item.name.node, &item.params, &[], expr.span, &mut scope, false);
            chain_players(world, item, &scope, team)
        }
        _ => Vec::new(),
    }
}

/// Reports a name, or that of a call, which nothing has: a formation was meant.
fn unknown_formation(lower: &Lower<'_, '_>, expr: &Expr) -> Option<Problem> {
    let (name, span) = match &expr.kind {
        ExprKind::Name(name) => (name.as_str(), expr.span),
        ExprKind::Call { name, .. } if Function::from_name(&name.node).is_none() => {
            (name.node.as_str(), name.span)
        }
        _ => return None,
    };
    let library = lower.world.library;
    let is_known = library.find(span.file, name).is_some()
        || names::is_value(name)
        || lower.world.declares(name)
        || lower.names_in_sight(span).iter().any(|known| known == name);
    if is_known {
        return None;
    }
    let known: Vec<&str> = library
        .visible(span.file)
        .filter(|(_, found)| matches!(found.item.kind, ItemKind::Formation(_)))
        .map(|(name, _)| name)
        .collect();
    let guess = Guess::similar_or_all(name, &known);
    let fact = Names::Unknown { kind: Kind::Formation, name: name.to_owned(), guess };
    Some(Problem::new(span, fact))
}

fn chain_players<'w>(
    world: &World<'w>,
    item: &'w FormationItem,
    scope: &Scope<'w>,
    team: Team,
) -> Vec<Rostered<'w>> {
    let mut found = Vec::new();
    let chain = formation_chain(world.library, item, &mut found);
    for problem in found {
        world.report(problem);
    }
    let mut players: Vec<Rostered<'w>> = Vec::new();
    for (link, reference) in chain {
        let mut scope = scope.clone();
        scope.players_of = Some(team);
        if !std::ptr::eq(link, item) {
            world.mark_used(link.name.span);
            // A parent's parameters are bound by the reference of its child.
            let mut lower = Lower::of_start(world, scope, StartState::default());
            scope = Scope::new(false, LiteralFrame::Own);
            let args = reference.map_or(&[][..], |reference| reference.args.as_slice());
            lower.bind_params(
                &link.name.node,
                &link.params,
                args,
                link.name.span,
                &mut scope,
                false,
            );
            scope.players_of = Some(team);
        }
        let (mut absent, mut overrides, mut each) = (Vec::new(), Vec::new(), Vec::new());
        for stmt in &link.body {
            match &stmt.kind {
                TeamStmtKind::Player(_) if !has_room(world, &players, stmt.span, team) => break,
                TeamStmtKind::Player(player) => {
                    players.extend(copies(world, player, stmt.span, &scope, team));
                }
                TeamStmtKind::Override { who, change } => overrides.push((who, change)),
                TeamStmtKind::Each { who, fields } => each.push((who, fields.as_slice())),
                TeamStmtKind::Absent(role) => absent.push(role.clone()),
                TeamStmtKind::Field(field) => world.report(Problem::new(
                    field.key.span,
                    Names::NoFormationOption { option: field.key.node.clone() },
                )),
                TeamStmtKind::Broken => {}
            }
        }
        adjust(world, &mut players, &absent, &overrides, &scope);
        apply_each(world, &mut players, &each, team, &scope, &|_| true);
    }
    players
}
