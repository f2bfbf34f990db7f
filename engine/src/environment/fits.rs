//! Whether a match fits an environment: the same players take part, and the same agents.

use crate::draw::Roster;
use crate::snapshot::SnapshotError;
use crate::state::{Match, PlayerId};
use setpiece_scenario::pitch::{PLAYERS_MAX, TEAM_MAX};
use setpiece_scenario::vocabulary::Team;
use std::ops::Range;

/// Checks that the same players and agents take part.
///
/// # Errors
/// [`SnapshotError::Roster`].
pub(super) fn fits(game: &Match, roster: &Roster) -> Result<(), SnapshotError> {
    let there = std::array::from_fn::<bool, PLAYERS_MAX, _>(|i| game.squad.has(PlayerId(i as u8)));
    if let Some(team) =
        Team::ALL.iter().find(|team| there[places(**team)] != roster.present[places(**team)])
    {
        let (found, expected) = (players(&there, *team), players(&roster.present, *team));
        return Err(SnapshotError::Roster { what: format!("{team} players"), found, expected });
    }
    // An agent's player must be of its own team. Players who don't take part can't have the ball or
    // be on the pitch.
    let ghost = |id: PlayerId| !there[id.index()];
    for (at, slot) in game.agents.iter().enumerate() {
        if slot.player.is_some_and(|id| ghost(id) || id.team() != slot.team) {
            return Err(SnapshotError::damaged(
                format!("match.agents[{at}].player"),
                "is nobody of its team",
            ));
        }
    }
    if let Some(at) =
        game.players.iter().zip(there).position(|(player, there)| player.active && !there)
    {
        return Err(SnapshotError::damaged(
            format!("match.players[{at}].active"),
            "is true of nobody",
        ));
    }
    if game.owner.is_some_and(ghost) {
        return Err(SnapshotError::damaged("match.owner", "is nobody"));
    }
    let found = game.agents.iter().map(|slot| (slot.team, slot.player.filter(|_| slot.fixed)));
    if !found.clone().eq(roster.agents.iter().copied()) {
        let (found, expected) = (agents(found), agents(roster.agents.iter().copied()));
        return Err(SnapshotError::Roster { what: "agents".to_owned(), found, expected });
    }
    Ok(())
}

/// A team's index range.
fn places(team: Team) -> Range<usize> {
    let first = PlayerId::new(team, 0).index();
    first..first + TEAM_MAX
}

/// The occupied places of a team: `1, 2, 4`.
fn players(present: &[bool], team: Team) -> String {
    let taken = (1..)
        .zip(&present[places(team)])
        .filter(|(_, there)| **there)
        .map(|(number, _)| number.to_string());
    let taken: Vec<String> = taken.collect();
    match taken.as_slice() {
        [] => "none".to_owned(),
        all if all.last().is_some_and(|last| *last == all.len().to_string()) => {
            all.len().to_string()
        }
        some => format!("numbers {}", some.join(", ")),
    }
}

/// Describes agents: `left` for one that switches players, else `left player 3`.
fn agents(agents: impl Iterator<Item = (Team, Option<PlayerId>)>) -> String {
    let words = agents.map(|(team, fixed)| match fixed {
        None => team.to_string(),
        Some(player) => format!("{team} player {}", player.in_team() + 1),
    });
    let words: Vec<String> = words.collect();
    if words.is_empty() { "none".to_owned() } else { words.join(", ") }
}
