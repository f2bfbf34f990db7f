//! Which players share a place in the team, since at most one of them takes part in any episode.
//!
//! A team has eleven places, and a program knows a player by theirs. Players of formations that
//! exclude each other share one; so do others where a team would have more than eleven players.

use super::cases::exclude;
use super::known::StartState;
use super::people::Rostered;
use super::value::{LiteralFrame, Scope};
use super::{Lower, World};
use setpiece_scenario::Reg;
use setpiece_scenario::pitch::TEAM_MAX;
use std::ops::RangeInclusive;

/// Sorts a team's players by their places and numbers the places; the first of a place, then the
/// others. Gives the number of places.
pub(super) fn take_seats<'w>(world: &World<'w>, players: &mut Vec<Rostered<'w>>) -> usize {
    let mut seats = by_formations(players.clone());
    if seats.len() > TEAM_MAX {
        // The same role in two formations is two players then, and each finds a place of theirs.
        let single = players.iter().flat_map(Rostered::by_formation).collect();
        seats = by_formations(single);
    }
    players.clear();
    if seats.len() > TEAM_MAX {
        seats = close_ranks(world, seats);
    }
    let number = seats.len();
    for (seat, taken) in seats.into_iter().enumerate() {
        players.extend(taken.into_iter().enumerate().map(|(nth, mut player)| {
            player.seat = seat;
            player.instead = nth > 0;
            player
        }));
    }
    number
}

/// Lets players share whose formations exclude each other.
fn by_formations(players: Vec<Rostered<'_>>) -> Vec<Vec<Rostered<'_>>> {
    let mut seats: Vec<Vec<Rostered<'_>>> = Vec::new();
    for player in players {
        let free = seats.iter_mut().find(|seat| {
            seat.iter()
                .all(|other| named_alike(other, &player) && formations_exclude(other, &player))
        });
        match free {
            Some(seat) => seat.push(player),
            None => seats.push(vec![player]),
        }
    }
    seats
}

/// The players of the roster who share the place in the team of one of them, who is the first
/// there.
pub(super) fn sharers(world: &World<'_>, first: usize) -> RangeInclusive<usize> {
    let others = world.roster.iter().skip(first + 1).take_while(|other| other.instead);
    first..=first + others.count()
}

/// Whether no program needs to tell the two apart.
fn named_alike(one: &Rostered<'_>, other: &Rostered<'_>) -> bool {
    one.name.map(|name| &name.node) == other.name.map(|name| &name.node)
}

fn formations_exclude(one: &Rostered<'_>, other: &Rostered<'_>) -> bool {
    match (&one.formations, &other.formations) {
        (Some(one), Some(other)) => {
            std::ptr::eq(one.whole, other.whole)
                && !one.which.iter().any(|which| other.which.contains(which))
        }
        _ => false,
    }
}

/// Lets players share who exclude each other by what their `when` says.
fn close_ranks<'w>(world: &World<'w>, seats: Vec<Vec<Rostered<'w>>>) -> Vec<Vec<Rostered<'w>>> {
    world.tentatively(|| {
        let mut lower =
            Lower::of_start(world, Scope::new(true, LiteralFrame::World), StartState::default());
        let mut closed: Vec<(Vec<Rostered<'w>>, Vec<Option<Reg>>)> = Vec::new();
        for seat in seats {
            let conditions: Vec<Option<Reg>> = seat
                .iter()
                .map(|player| {
                    let when = player.when?;
                    let team = player.team.index() as f64;
                    Some(lower.for_team(team, |lower| {
                        lower.within(player.scope.clone(), |lower| lower.condition(when))
                    }))
                })
                .collect();
            let apart = |one: &Option<Reg>, other: &Option<Reg>| {
                one.zip(*other).is_some_and(|(one, other)| exclude(&lower.code, one, other))
            };
            let free = closed.iter_mut().find(|(others, known)| {
                others.iter().chain(&seat).all(|player| player.name.is_none())
                    && known.iter().all(|known| conditions.iter().all(|own| apart(known, own)))
            });
            match free {
                Some((others, known)) => {
                    others.extend(seat);
                    known.extend(conditions);
                }
                None => closed.push((seat, conditions)),
            }
        }
        closed.into_iter().map(|(seat, _)| seat).collect()
    })
}
