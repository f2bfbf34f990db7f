//! Who plays: formations and players of both teams as one list.

use super::formations::formation_players;
use super::layouts::{check_same, check_whole};
use super::people::{Numbered, Rostered, Scoped, Stand};
use super::seats::take_seats;
use super::value::{LiteralFrame, Scope};
use super::{World, casting};
use crate::ast::{Field, FieldValue, Ident, PlayerStmt, Span, Spanned};
use crate::cast::CastTarget;
use crate::problem::facts::{Kind, Names, Players, Types};
use crate::problem::{Guess, Problem};
use crate::resolve::FlatTeam;
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
        let scope = Scope::new(true, LiteralFrame::World);
        adjust(world, &mut players, &flat.absent, &flat.overrides, &scope);
        // What a parent says of a role that the child has not is said of nobody.
        let side = world
            .casting
            .iter()
            .filter(|cast| cast.target == CastTarget::Team(*team))
            .map(|cast| (cast.who, std::slice::from_ref(cast.field)));
        let each: Vec<_> = flat.each.iter().copied().chain(side).collect();
        apply_each(world, &mut players, &each, *team, &scope, &|who| world.flat.is_own(who));
        casting::apply(world, &mut players, *team);
        let seats = take_seats(world, &mut players);
        check_size(world, &players, seats, *team);
        for player in &mut players {
            player.id = (team.index() * TEAM_MAX + player.seat) as u8;
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
pub(super) fn has_room(
    world: &World<'_>,
    players: &[Rostered<'_>],
    span: Span,
    team: Team,
) -> bool {
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
    let written = |key: &str| fields.iter().find(|field| field.key.node == key);
    let mut lacking = ["kicking", "receiving"].into_iter().filter(|key| written(key).is_none());
    if let (Team::Left, Some(layout)) = (team, lacking.next()) {
        let both = lacking.next().is_some();
        let layout = (!both).then_some(layout);
        world.report(Problem::new(span, Players::NoLayout { layout }));
    }
    let layout = |key: &'static str| {
        let field = written(key)?;
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
    let (Some((mut kicking, of_kicking)), Some((receiving, at))) =
        (layout("kicking"), layout("receiving"))
    else {
        return Vec::new();
    };
    if team == Team::Left
        && check_whole(world, &kicking, of_kicking)
        && check_whole(world, &receiving, at)
    {
        check_same(world, &kicking, &receiving, at);
    }
    for (player, other) in kicking.iter_mut().zip(receiving) {
        player.receiving = Some(other.stand);
    }
    kicking
}

pub(super) fn copies<'w>(
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
        seat: 0,
        instead: false,
        formations: None,
        team,
        role: player.role.node,
        name: player.name.as_ref(),
        span,
        stand: Stand::At(player.place.as_ref(), scope.clone()),
        scope: scope.clone(),
        receiving: None,
        facing: player.facing.as_ref().map(|facing| Scoped::new(facing, scope)),
        jitter: player.jitter.as_ref().map(|jitter| Scoped::new(jitter, scope)),
        when: player.when.as_ref(),
        maybe: player.maybe.as_ref(),
        numbered: None,
        fields: player.fields.iter().map(|field| Scoped::new(field, scope)).collect(),
    };
    let mut players = vec![one; count.min(TEAM_MAX as u32 + 1) as usize];
    if let Some(least) = &player.least {
        if least.node >= count {
            let fact = Players::NumberEndsSwapped { least: least.node, most: count };
            let most = player.count.as_ref().map_or(least.span, |most| most.span);
            world.report(Problem::new(least.span.to(most), fact));
        }
        for (before, one) in (0..).zip(&mut players) {
            one.numbered = Some(Numbered { before, least: least.node, most: count });
        }
    }
    players
}

/// `GK absent` and `place …`.
pub(super) fn adjust<'w>(
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
                player.receiving = None;
                player.jitter = None;
                player.span = who.span;
            }
            if let Some(jitter) = &change.jitter {
                player.jitter = Some(Scoped::new(jitter, scope));
            }
            if let Some(facing) = &change.facing {
                player.facing = Some(Scoped::new(facing, scope));
            }
            player.fields.extend(change.fields.iter().map(|field| Scoped::new(field, scope)));
        }
    }
}

/// `each …` of a scope: defaults, behind the players' own options; `is_own` tells whether it must
/// fit somebody.
pub(super) fn apply_each<'w>(
    world: &World<'w>,
    players: &mut [Rostered<'w>],
    each: &[(&'w Ident, &'w [Field])],
    team: Team,
    scope: &Scope<'w>,
    is_own: &dyn Fn(Span) -> bool,
) {
    let mut defaults: Vec<Vec<Scoped<'w, Field>>> = vec![Vec::new(); players.len()];
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
                defaults.extend(fields.iter().map(|field| Scoped::new(field, scope)));
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

fn check_size(world: &World<'_>, players: &[Rostered<'_>], seats: usize, team: Team) {
    let extra = players.iter().find(|player| player.seat == TEAM_MAX);
    if let Some(extra) = extra.filter(|_| seats > TEAM_MAX) {
        let of_line = || players.iter().filter(|player| player.span == extra.span);
        let room = of_line().filter(|player| player.seat < TEAM_MAX).count();
        let least = extra.numbered.map(|numbered| numbered.least);
        let line = (of_line().count() > 1 && room > 0).then(|| match least {
            Some(least) if (least as usize) < room => format!("{least}..{room} {}", extra.role),
            _ => format!("{room} {}", extra.role),
        });
        world.report(Problem::new(extra.span, Players::TooMany { team, most: TEAM_MAX, line }));
    }
    let keepers: Vec<&Rostered<'_>> = players.iter().filter(|p| p.role == Role::GK).collect();
    for (nth, second) in keepers.iter().enumerate() {
        let first = keepers.iter().take(nth).find(|first| !first.may_exclude(second));
        if let Some(first) = first {
            world
                .report(Problem::new(second.span, Players::TwoKeepers { team, first: first.span }));
            return;
        }
    }
}

fn check_names(world: &World<'_>, roster: &[Rostered<'_>]) {
    for (index, player) in roster.iter().enumerate() {
        let Some(name) = player.name else { continue };
        let earlier = roster.iter().take(index).filter(|other| other.id != player.id);
        let earlier = earlier.filter_map(|other| other.name);
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
