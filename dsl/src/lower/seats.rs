//! Which players share a place in the team, since at most one of them takes part in any episode.
//!
//! A team has eleven places, and a program knows a player by theirs. Players of formations that
//! exclude each other share one; so do others where a team would have more than eleven players.

use super::known::StartState;
use super::people::Rostered;
use super::value::{LiteralFrame, Scope};
use super::{Lower, World};
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::{BinaryOp, Instr, Reg, UnaryOp};
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
        let mut closed: Vec<(Vec<Rostered<'w>>, Vec<Vec<Claim>>)> = Vec::new();
        for seat in seats {
            let claims: Vec<Vec<Claim>> = seat
                .iter()
                .map(|player| {
                    let Some(when) = player.when else { return Vec::new() };
                    let team = player.team.index() as f64;
                    let holds = lower.for_team(team, |lower| {
                        lower.within(player.scope.clone(), |lower| lower.condition(when))
                    });
                    let mut claims = Vec::new();
                    claims_of(&lower, holds, &mut claims);
                    claims
                })
                .collect();
            let free = closed.iter_mut().find(|(others, known)| {
                others.iter().chain(&seat).all(|player| player.name.is_none())
                    && known
                        .iter()
                        .all(|known| claims.iter().all(|claims| claims_exclude(known, claims)))
            });
            match free {
                Some((others, known)) => {
                    others.extend(seat);
                    known.extend(claims);
                }
                None => closed.push((seat, claims)),
            }
        }
        closed.into_iter().map(|(seat, _)| seat).collect()
    })
}

/// A part of a condition: what a register is compared with, as an interval.
struct Claim {
    of: Reg,
    low: (f64, bool),
    high: (f64, bool),
}

const ANYTHING: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

/// Takes a condition apart into what must hold of its parts; the rest is left out.
fn claims_of(lower: &Lower<'_, '_>, holds: Reg, claims: &mut Vec<Claim>) {
    let mut claim = |of, low, high| claims.push(Claim { of, low, high });
    let (least, most) = ((ANYTHING.0, true), (ANYTHING.1, true));
    match lower.code.instr(holds) {
        Some(&Instr::Binary(BinaryOp::And, a, b)) => {
            claims_of(lower, a, claims);
            claims_of(lower, b, claims);
        }
        // A condition is 0 or 1.
        Some(&Instr::Unary(UnaryOp::Not, a)) => claim(a, (0.0, true), (0.0, true)),
        Some(&Instr::Binary(op, a, b)) => {
            claim(holds, (1.0, true), (1.0, true));
            // Which side the constant stands on doesn't matter.
            let (op, of, k) = match (lower.code.constant_of(a), lower.code.constant_of(b)) {
                (_, Some(k)) => (op, a, k),
                (Some(k), _) => (turned(op), b, k),
                _ => return,
            };
            match op {
                BinaryOp::Eq => claim(of, (k, true), (k, true)),
                BinaryOp::Lt => claim(of, least, (k, false)),
                BinaryOp::Le => claim(of, least, (k, true)),
                BinaryOp::Gt => claim(of, (k, false), most),
                BinaryOp::Ge => claim(of, (k, true), most),
                _ => {}
            }
        }
        _ => claim(holds, (1.0, true), (1.0, true)),
    }
}

/// The comparison with its sides exchanged.
fn turned(op: BinaryOp) -> BinaryOp {
    match op {
        BinaryOp::Lt => BinaryOp::Gt,
        BinaryOp::Le => BinaryOp::Ge,
        BinaryOp::Gt => BinaryOp::Lt,
        BinaryOp::Ge => BinaryOp::Le,
        other => other,
    }
}

/// Whether two conditions never hold together.
fn claims_exclude(one: &[Claim], other: &[Claim]) -> bool {
    let before = |high: (f64, bool), low: (f64, bool)| {
        high.0 < low.0 || (high.0 == low.0 && !(high.1 && low.1))
    };
    one.iter().any(|one| {
        other.iter().any(|other| {
            one.of == other.of && (before(one.high, other.low) || before(other.high, one.low))
        })
    })
}
