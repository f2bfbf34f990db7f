//! Whether a match fits an environment: the same players take part, and the same agents.

use super::error::SnapshotError;
use crate::draw::Roster;
use crate::state::{Match, PlayerId};
use setpiece_scenario::pitch::{PLAYERS_MAX, TEAM_MAX};
use setpiece_scenario::vocabulary::Team;

/// Says who is not there, or has no place here.
///
/// # Errors
/// [`SnapshotError::Roster`].
pub(crate) fn fits(game: &Match, roster: &Roster) -> Result<(), SnapshotError> {
    let there = std::array::from_fn::<bool, PLAYERS_MAX, _>(|i| game.squad.has(PlayerId(i as u8)));
    for team in Team::ALL {
        let (found, expected) = (players(&there, *team), players(&roster.present, *team));
        if found != expected {
            return Err(SnapshotError::Roster { what: format!("{team} players"), found, expected });
        }
    }
    // An agent has a player of its own team, and nobody who does not take part has the ball or is on the pitch.
    let ghost = |id: PlayerId| !there[id.index()];
    for (at, slot) in game.agents.iter().enumerate() {
        if slot.player.is_some_and(|id| ghost(id) || id.team() != slot.team) {
            return Err(SnapshotError::damaged(format!("match.agents[{at}].player"), "is nobody of its team"));
        }
    }
    if let Some(at) = game.players.iter().zip(there).position(|(player, there)| player.active && !there) {
        return Err(SnapshotError::damaged(format!("match.players[{at}].active"), "is true of nobody"));
    }
    if game.owner.is_some_and(ghost) {
        return Err(SnapshotError::damaged("match.owner", "is nobody"));
    }
    let found: Vec<(Team, Option<PlayerId>)> =
        game.agents.iter().map(|slot| (slot.team, slot.player.filter(|_| slot.fixed))).collect();
    if found != roster.agents {
        let (found, expected) = (agents(&found), agents(&roster.agents));
        return Err(SnapshotError::Roster { what: "agents".to_owned(), found, expected });
    }
    Ok(())
}

/// The places of a team that are taken: `1, 2, 4`.
fn players(present: &[bool], team: Team) -> String {
    let first = PlayerId::new(team, 0).index();
    let taken = (0..TEAM_MAX).filter(|place| present[first + place]).map(|place| (place + 1).to_string());
    let taken: Vec<String> = taken.collect();
    match taken.as_slice() {
        [] => "none".to_owned(),
        all if all.last().is_some_and(|last| *last == all.len().to_string()) => all.len().to_string(),
        some => format!("numbers {}", some.join(", ")),
    }
}

/// Agents in words: `left` for one that changes players, else `left player 3`.
fn agents(agents: &[(Team, Option<PlayerId>)]) -> String {
    let words = agents.iter().map(|(team, fixed)| match fixed {
        None => team.to_string(),
        Some(player) => format!("{team} player {}", player.in_team() + 1),
    });
    let words: Vec<String> = words.collect();
    if words.is_empty() { "none".to_owned() } else { words.join(", ") }
}
