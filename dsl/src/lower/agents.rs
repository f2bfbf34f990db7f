//! `agents { }`: who is played by agents.

use super::known::PlayedBy;
use super::mirror::Mirror;
use super::roster::of_team;
use super::team::PlayerOptions;
use super::{Lower, fields};
use crate::ast::{Expr, ExprKind, Field, Span};
use crate::check::options::AGENTS;
use crate::check::types::Ty;
use crate::problem::facts::{AskedFor, Bounds, Instead, Players};
use crate::problem::{Guess, Problem};
use setpiece_scenario::vocabulary::Team;
use setpiece_scenario::{Agents, Ai, Others, Reg, SideAgents, Switching};

/// Lowers `agents { }`: one on the left unless it is written.
pub(crate) fn lower_agents(lower: &mut Lower<'_, '_>, players: &[PlayerOptions<'_>]) -> Agents {
    let (one, none) = (lower.code.constant(1.0), lower.code.constant(0.0));
    let mut agents = Agents {
        sides: match lower.world.mirror {
            Mirror::Ends => [SideAgents::Count(none), SideAgents::Count(one)],
            _ => [SideAgents::Count(one), SideAgents::Count(none)],
        },
        others: Others::Bot,
        switching: Switching::Auto,
    };
    let mut at = [None, None];
    let mut switching = None;
    for field in lower.world.flat.agents.clone() {
        if !fields::is_known(lower, field, AGENTS, "`agents`") {
            continue;
        }
        let Some(expr) = fields::expression(lower, field) else { continue };
        match field.key.node.as_str() {
            "others" => {
                if let Some(other) =
                    word(lower, field, expr, &[("bot", Others::Bot), ("hold", Others::Hold)])
                {
                    agents.others = other;
                }
            }
            "switching" => {
                let words = [("auto", Switching::Auto), ("fixed", Switching::Fixed)];
                if let Some(found) = word(lower, field, expr, &words) {
                    agents.switching = found;
                    switching = Some(expr.span);
                }
            }
            side => {
                let team =
                    lower.world.mirror.team(if side == "left" { Team::Left } else { Team::Right });
                if let Some(found) = lower_side(lower, expr, team, players)
                    && let (Some(slot), Some(at)) =
                        (agents.sides.get_mut(team.index()), at.get_mut(team.index()))
                {
                    *slot = found;
                    *at = Some(expr.span);
                }
            }
        }
    }
    let listed = agents.sides.iter().any(|side| matches!(side, SideAgents::Players(_)));
    let counted = agents.sides.iter().any(|side| match side {
        SideAgents::Count(reg) => lower.code.constant_of(*reg) != Some(0.0),
        SideAgents::All => true,
        SideAgents::Players(_) => false,
    });
    if let Some(at) =
        switching.filter(|_| agents.switching == Switching::Auto && listed && !counted)
    {
        lower.report(Problem::new(at, Players::ListedAgentSwitches));
    }
    for (team, at) in Team::ALL.iter().zip(at) {
        check_count(lower, &agents, *team, at, players);
    }
    for team in Team::ALL {
        check_scripted(lower, &agents, *team, at, players);
    }
    agents
}

/// Warns of an agent that nobody asked for, where the scenario asks for others: it may take a
/// scripted player.
fn check_scripted(
    lower: &Lower<'_, '_>,
    agents: &Agents,
    team: Team,
    at: [Option<Span>; 2],
    players: &[PlayerOptions<'_>],
) {
    let world = lower.world;
    let own = |team: Team| {
        let at = at.get(team.index()).copied().flatten();
        at.filter(|at| world.flat.is_own(*at))
    };
    let other = if team == Team::Left { Team::Right } else { Team::Left };
    let (None, Some(asked)) = (own(team), own(other)) else { return };
    let Some(SideAgents::Count(reg)) = agents.sides.get(team.index()) else { return };
    let is_some = |reg: Reg| lower.interval(reg).is_none_or(|(_, most)| most > 0.0);
    let asks = match agents.sides.get(other.index()) {
        Some(SideAgents::Count(reg)) => is_some(*reg),
        Some(SideAgents::Players(list)) => !list.is_empty(),
        Some(SideAgents::All) => true,
        None => false,
    };
    let scripted =
        |(_, by): &(Option<Reg>, PlayedBy<'_>)| !matches!(by, PlayedBy::BuiltIn(Ai::Bot));
    let mut of_team = world.roster.iter().zip(players).filter(|(player, _)| player.team == team);
    let scripted =
        of_team.find(|(_, options)| options.controllable && options.ai.iter().any(scripted));
    if let Some((player, _)) = scripted.filter(|_| asks && is_some(*reg)) {
        let name = player.name.map_or_else(|| player.role.to_string(), |name| name.node.clone());
        let team = world.mirror.team(team);
        lower.report(Problem::new(asked, Players::AgentOverScript { team, name }));
    }
}

fn word<T: Copy>(
    lower: &Lower<'_, '_>,
    field: &Field,
    expr: &Expr,
    words: &[(&'static str, T)],
) -> Option<T> {
    let name = match &expr.kind {
        ExprKind::Name(name) => name.as_str(),
        _ => "",
    };
    let found = words.iter().find(|(word, _)| *word == name).map(|(_, value)| *value);
    if found.is_none() {
        let text = lower.world.text(expr.span);
        let known = words.iter().map(|(word, _)| *word).collect();
        lower.report(Problem::new(
            expr.span,
            Bounds::NeverWord { option: field.key.node.clone(), word: text, known },
        ));
    }
    found
}

fn lower_side<'w>(
    lower: &mut Lower<'_, 'w>,
    expr: &'w Expr,
    team: Team,
    players: &[PlayerOptions<'_>],
) -> Option<SideAgents> {
    match &expr.kind {
        ExprKind::Name(name) if name == "all" => Some(SideAgents::All),
        ExprKind::List(names) => {
            let of_team =
                lower.world.roster.iter().zip(players).filter(|(player, _)| player.team == team);
            let controllable: Vec<bool> =
                of_team.map(|(_, options)| options.controllable).collect();
            let mut list = Vec::new();
            for name in names {
                list.extend(listed(lower, name, team, &list, &controllable));
            }
            Some(SideAgents::Players(list))
        }
        _ => {
            let value = lower.expr(expr);
            if !value.is_error() && !value.ty.fits(Ty::Int) {
                lower.report(lower.mismatch_with(value.ty, Ty::Int, expr.span, Instead::Agents));
                return None;
            }
            let reg = lower.reg(&value);
            lower.check_not_drawn(reg, "the number of agents", expr.span);
            let fits =
                lower.check_range(reg, (0.0, 11.0), "the number of agents", expr.span, "`0..11`");
            fits.then_some(SideAgents::Count(reg))
        }
    }
}

fn listed<'w>(
    lower: &mut Lower<'_, 'w>,
    name: &'w Expr,
    team: Team,
    known: &[u8],
    controllable: &[bool],
) -> Option<u8> {
    let players: Vec<_> = of_team(&lower.world.roster, team).collect();
    let text = lower.world.text(name.span);
    let index = players.iter().position(|player| player.name.is_some_and(|name| name.node == text));
    let Some(index) = index else {
        let names: Vec<&str> = players
            .iter()
            .filter_map(|player| player.name.map(|name| name.node.as_str()))
            .collect();
        let (is_anyone, guess) = (!names.is_empty(), Guess::similar_or_all(&text, &names));
        let fact = Players::NoSuchAgent { team, name: text, is_anyone, guess };
        lower.report(Problem::new(name.span, fact));
        return None;
    };
    if controllable.get(index) == Some(&false) {
        lower.report(Problem::new(name.span, Players::NotControllable { name: text }));
        return None;
    }
    let seat = players.get(index).map_or(index, |player| player.seat);
    if known.contains(&(seat as u8)) {
        lower.report(Problem::new(name.span, Players::ListedTwice { name: text }));
        return None;
    }
    Some(seat as u8)
}

/// Reports a team of which more players are asked for than it has.
fn check_count(
    lower: &Lower<'_, '_>,
    agents: &Agents,
    team: Team,
    at: Option<Span>,
    players: &[PlayerOptions<'_>],
) {
    let world = lower.world;
    let Some(SideAgents::Count(reg)) = agents.sides.get(team.index()) else { return };
    let of_team = world.roster.iter().zip(players).filter(|(player, _)| player.team == team);
    let seats = of_team.filter(|(player, _)| !player.instead);
    let controllable = seats.filter(|(_, options)| options.controllable).count();
    let Some((_, most)) = lower.interval(*reg) else { return };
    // Who is missing where a layout could not be read has been reported.
    if most <= controllable as f64 || !world.whole_roster {
        return;
    }
    let name = world.flat.item.name.span;
    let (span, place) = match at {
        None => (name, AskedFor::Nowhere),
        Some(at) if world.flat.is_inherited(at) => (name, AskedFor::Inherited(at)),
        Some(at) => (at, AskedFor::Here),
    };
    lower.report(Problem::new(
        span,
        Players::TooManyAgents { team, asked: most, controllable, place },
    ));
}

/// The one team that has agents; `None` if both have or none.
pub(crate) fn side_with_agents(
    lower: &Lower<'_, '_>,
    agents: &Agents,
    players: &[PlayerOptions<'_>],
) -> Option<Team> {
    let has = |team: Team| match agents.sides.get(team.index()) {
        Some(SideAgents::Count(reg)) => lower.interval(*reg).is_none_or(|(_, most)| most > 0.0),
        Some(SideAgents::Players(list)) => !list.is_empty(),
        Some(SideAgents::All) => lower
            .world
            .roster
            .iter()
            .zip(players)
            .any(|(player, options)| player.team == team && options.controllable),
        None => false,
    };
    match (has(Team::Left), has(Team::Right)) {
        (true, false) => Some(Team::Left),
        (false, true) => Some(Team::Right),
        _ => None,
    }
}
