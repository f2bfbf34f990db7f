//! Who plays: formations and players of both teams as one list.

use super::known::StartState;
use super::layouts::check_same;
use super::people::{Numbered, Rostered, Stand};
use super::value::{LiteralFrame, Repr, Scope, Value};
use super::{Lower, World, casting};
use crate::ast::{
    Expr, ExprKind, Field, FieldValue, FormationItem, Ident, PlayerStmt, Span, Spanned,
    TeamStmtKind,
};
use crate::cast::CastTarget;
use crate::check::types::Ty;
use crate::problem::facts::{Kind, Names, Players, Types};
use crate::problem::{Guess, Problem};
use crate::resolve::{FlatTeam, formation_chain};
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::vocabulary::{Role, Team};

/// Lists both teams' players.
pub(super) fn lower_roster<'w>(world: &World<'w>) -> Vec<Rostered<'w>> {
    let mut roster = Vec::new();
    for team in Team::ALL {
        let Some(flat) = world.flat.teams.get(team.index()) else { continue };
        let mut players = match &world.flat.kickoff {
            Some((_, fields, span)) => from_layouts(world, *team, flat, fields, *span),
            None => from_statements(world, *team, flat),
        };
        adjust(
            world,
            &mut players,
            &flat.absent,
            &flat.overrides,
            &Scope::new(true, LiteralFrame::World),
        );
        // What a parent says of a role that the child has not is said of nobody.
        let side = world
            .casting
            .iter()
            .filter(|cast| cast.target == CastTarget::Team(*team))
            .map(|cast| (cast.who, std::slice::from_ref(cast.field)));
        let each: Vec<_> = flat.each.iter().copied().chain(side).collect();
        apply_each(world, &mut players, &each, *team, &|who| world.flat.is_own(who));
        casting::apply(world, &mut players, *team);
        check_size(world, &players, *team);
        for (index, player) in players.iter_mut().enumerate() {
            player.id = (team.index() * TEAM_MAX + index) as u8;
        }
        roster.extend(players);
    }
    check_names(world, &roster);
    for player in &mut roster {
        player.role = world.mirror.role(player.role);
    }
    roster
}

/// The players of a team.
pub(crate) fn of_team<'a, 'w>(
    roster: &'a [Rostered<'w>],
    team: Team,
) -> impl Iterator<Item = &'a Rostered<'w>> {
    roster.iter().filter(move |player| player.team == team)
}

fn from_statements<'w>(world: &World<'w>, team: Team, flat: &FlatTeam<'w>) -> Vec<Rostered<'w>> {
    let mut players = Vec::new();
    if let Some(field) = flat.fields.iter().find(|field| field.key.node == "formation") {
        match &field.value {
            FieldValue::Expr(expr) => {
                players = formation_players(world, expr, team);
            }
            FieldValue::Fields(_, span) => world.report(not_a_formation(*span)),
            FieldValue::Script(script) => world.report(not_a_formation(script.span)),
        }
    }
    for (player, span) in &flat.players {
        if !has_room(world, &players, *span, team) {
            break;
        }
        let scope = Scope::new(true, LiteralFrame::World);
        players.extend(copies(world, player, *span, &scope, team));
    }
    players
}

/// Most players that a team may write before some of them are declared absent.
const WRITTEN_MAX: usize = 4 * TEAM_MAX;

/// Whether a team may write a further player; reports one that it may not.
fn has_room(world: &World<'_>, players: &[Rostered<'_>], span: Span, team: Team) -> bool {
    if players.len() >= WRITTEN_MAX {
        let fact = Players::TooManyWritten { team, most: WRITTEN_MAX, team_max: TEAM_MAX };
        world.report(Problem::new(span, fact));
    }
    players.len() < WRITTEN_MAX
}

fn not_a_formation(span: Span) -> Problem {
    Problem::new(span, Types::NoFormation)
}

fn from_layouts<'w>(
    world: &World<'w>,
    team: Team,
    flat: &FlatTeam<'w>,
    fields: &'w [Field],
    span: Span,
) -> Vec<Rostered<'w>> {
    if let Some((_, at)) = flat.players.first() {
        world.report(Problem::new(*at, Players::LayoutsAndOwn { layouts: span }));
    }
    if let Some(field) = flat.fields.iter().find(|field| field.key.node == "formation") {
        world.report(Problem::new(field.key.span, Players::LayoutsAndFormation { layouts: span }));
    }
    let layout = |key: &'static str| {
        let field = fields.iter().find(|field| field.key.node == key);
        let Some(field) = field else {
            if team == Team::Left {
                world.report(Problem::new(span, Players::NoLayout { layout: key }));
            }
            return None;
        };
        let FieldValue::Expr(expr) = &field.value else {
            world.report(not_a_formation(field.key.span));
            return None;
        };
        // The left team reports what is wrong with a layout; the right one has the same.
        let read = || formation_players(world, expr, team);
        let players = if team == Team::Left { read() } else { world.tentatively(read) };
        Some((players, expr.span))
    };
    for field in fields.iter().filter(|_| team == Team::Left) {
        if !matches!(field.key.node.as_str(), "kicking" | "receiving") {
            world.report({
                let guess = Guess::of(&field.key.node, ["kicking", "receiving"]);
                Problem::new(
                    field.key.span,
                    Names::NoOption {
                        whose: "`kickoff`".to_owned(),
                        option: field.key.node.clone(),
                        guess,
                    },
                )
            });
        }
    }
    let (Some((mut kicking, _)), Some((receiving, at))) = (layout("kicking"), layout("receiving"))
    else {
        return Vec::new();
    };
    if team == Team::Left {
        check_same(world, &kicking, &receiving, at);
    }
    for (player, other) in kicking.iter_mut().zip(receiving) {
        player.receiving = Some(other.stand);
    }
    kicking
}

/// The players of a formation value: its name, a call with arguments, or a choice of two, which has
/// the places of both and is the first in everything else.
fn formation_players<'w>(world: &World<'w>, expr: &'w Expr, team: Team) -> Vec<Rostered<'w>> {
    if let ExprKind::If(condition, then, otherwise) = &expr.kind {
        let mut players = formation_players(world, then, team);
        let others = formation_players(world, otherwise, team);
        check_same(world, &players, &others, expr.span);
        for (player, other) in players.iter_mut().zip(others) {
            let stand =
                Stand::Either(condition, Box::new(player.stand.clone()), Box::new(other.stand));
            player.stand = stand;
        }
        return players;
    }
    let mut lower =
        Lower::of_start(world, Scope::new(true, LiteralFrame::World), StartState::default());
    if let ExprKind::Call { name, args } = &expr.kind
        && let Some(found) = world.library.find(name.span.file, &name.node)
        && let crate::ast::ItemKind::Formation(item) = &found.item.kind
    {
        world.mark_used(found.name.span);
        let mut scope = Scope::new(false, LiteralFrame::Own);
        lower.bind_params(&name.node, &item.params, args, expr.span, &mut scope, false);
        return chain_players(world, item, &scope, team);
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
        apply_each(world, &mut players, &each, team, &|_| true);
    }
    players
}

fn copies<'w>(
    world: &World<'w>,
    player: &'w PlayerStmt,
    span: Span,
    scope: &Scope<'w>,
    team: Team,
) -> Vec<Rostered<'w>> {
    let count = player.count.as_ref().map_or(1, |count| count.node);
    if let (Some(count), Some(name)) = (&player.count, &player.name)
        && count.node != 1
    {
        world.report(Problem::new(
            name.span,
            Names::OneNameForMany { name: name.node.clone(), count: count.node },
        ));
    }
    if let Some(none) = player.count.as_ref().filter(|count| count.node == 0) {
        world.report(Problem::new(
            none.span,
            Players::NoneInLine { role: player.role.node.to_string() },
        ));
    }
    let one = Rostered {
        id: 0,
        team,
        role: player.role.node,
        name: player.name.as_ref(),
        span,
        stand: Stand::At(player.place.as_ref(), scope.clone()),
        scope: scope.clone(),
        receiving: None,
        facing: player.facing.as_ref(),
        jitter: player.jitter.as_ref(),
        when: player.when.as_ref(),
        maybe: player.maybe.as_ref(),
        numbered: None,
        fields: player.fields.iter().collect(),
    };
    let mut players = vec![one; count.min(TEAM_MAX as u32 + 1) as usize];
    if let Some(least) = &player.least {
        if least.node >= count {
            let fact = Players::NumberEndsSwapped { least: least.node, most: count };
            world.report(Problem::new(least.span, fact));
        }
        for (before, one) in (0..).zip(&mut players) {
            one.numbered = Some(Numbered { before, least: least.node, most: count });
        }
    }
    players
}

/// `GK absent` and `place …`.
fn adjust<'w>(
    world: &World<'w>,
    players: &mut Vec<Rostered<'w>>,
    absent: &[Spanned<Role>],
    overrides: &[(&'w Ident, &'w PlayerStmt)],
    scope: &Scope<'w>,
) {
    for role in absent {
        let before = players.len();
        players.retain(|player| player.role != role.node);
        // A team is said to have no keeper by `GK absent`, whether a formation brings one or not.
        if before == players.len() && before > 0 && role.node != Role::GK {
            world.report(Problem::new(
                role.span,
                Players::NobodyToBeAbsent { role: role.node.to_string() },
            ));
        }
    }
    for (who, change) in overrides {
        let role = Role::from_name(&who.node);
        let meant = |player: &Rostered<'w>| {
            player.name.is_some_and(|name| name.node == who.node) || Some(player.role) == role
        };
        match players.iter().filter(|player| meant(player)).count() {
            1 => {}
            0 => {
                let names: Vec<&str> = players
                    .iter()
                    .flat_map(|player| {
                        [player.name.map(|name| name.node.as_str()), Some(player.role.name())]
                    })
                    .flatten()
                    .collect();
                world.report({
                    let guess = Guess::of(&who.node, names);
                    Problem::new(
                        who.span,
                        Names::Unknown { kind: Kind::Player, name: who.node.clone(), guess },
                    )
                });
                continue;
            }
            n => {
                world.report(Problem::new(
                    who.span,
                    Names::AmbiguousPlayer { role: who.node.clone(), count: n },
                ));
                continue;
            }
        }
        if let Some(player) = players.iter_mut().find(|player| meant(player)) {
            if change.place.is_some() {
                player.stand = Stand::At(change.place.as_ref(), scope.clone());
                player.scope = scope.clone();
                player.receiving = None;
                player.jitter = change.jitter.as_ref();
                player.span = who.span;
            }
            player.jitter = change.jitter.as_ref().or(player.jitter);
            player.facing = change.facing.as_ref().or(player.facing);
            player.fields.extend(&change.fields);
        }
    }
}

/// `each …`: defaults, behind the players' own options; `is_own` tells whether it must fit
/// somebody.
fn apply_each<'w>(
    world: &World<'w>,
    players: &mut [Rostered<'w>],
    each: &[(&'w Ident, &'w [Field])],
    team: Team,
    is_own: &dyn Fn(Span) -> bool,
) {
    let mut defaults: Vec<Vec<&'w Field>> = vec![Vec::new(); players.len()];
    for (who, fields) in each {
        let role = Role::from_name(&who.node);
        if role.is_none() && !matches!(who.node.as_str(), "all" | "outfield") {
            let known =
                ["all", "outfield"].into_iter().chain(Role::ALL.iter().map(|role| role.name()));
            world.report({
                let guess = Guess::of(&who.node, known);
                Problem::new(who.span, Names::EachOfNothing { name: who.node.clone(), guess })
            });
            continue;
        }
        let mut anyone = false;
        for (player, defaults) in players.iter().zip(&mut defaults) {
            let meant = match role {
                Some(role) => player.role == role,
                None => who.node == "all" || player.role != Role::GK,
            };
            if meant {
                anyone = true;
                defaults.extend(fields.iter());
            }
        }
        if !anyone && !players.is_empty() && is_own(who.span) {
            world.report(Problem::new(
                who.span,
                Names::NobodyOfRole { team: team.name(), name: who.node.clone() },
            ));
        }
    }
    for (player, mut fields) in players.iter_mut().zip(defaults) {
        fields.append(&mut player.fields);
        player.fields = fields;
    }
}

fn check_size(world: &World<'_>, players: &[Rostered<'_>], team: Team) {
    if let Some(extra) = players.get(TEAM_MAX) {
        world.report(Problem::new(extra.span, Players::TooMany { team, most: TEAM_MAX }));
    }
    let keepers: Vec<&Rostered<'_>> =
        players.iter().filter(|p| p.role == Role::GK && p.is_certain()).collect();
    if let [first, second, ..] = keepers.as_slice() {
        world.report(Problem::new(second.span, Players::TwoKeepers { team, first: first.span }));
    }
}

fn check_names(world: &World<'_>, roster: &[Rostered<'_>]) {
    for (index, player) in roster.iter().enumerate() {
        let Some(name) = player.name else { continue };
        let earlier = roster.iter().take(index).filter_map(|other| other.name);
        let first =
            earlier.into_iter().find(|other| other.node == name.node && other.span != name.span);
        if let Some(first) = first {
            world.report(Problem::new(
                name.span,
                Names::TwoPlayers { name: name.node.clone(), first: first.span },
            ));
        }
        if let Some(value) = world.declaration(&name.node) {
            // Of the two the author wrote the one that stands in their own scenario.
            let (again, first) =
                if world.flat.is_own(name.span) { (name.span, value) } else { (value, name.span) };
            let kinds = ("a player", "a value");
            world.report(Problem::new(
                again,
                Names::Shared { name: name.node.clone(), kinds, first },
            ));
        }
    }
}
