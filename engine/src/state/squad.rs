//! A set of a match's players, one bit each.

use super::PlayerId;
use setpiece_scenario::pitch::{PLAYERS_MAX, TEAM_MAX};
use setpiece_scenario::vocabulary::Team;

/// A set of players. Iterating costs nothing for players outside it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(try_from = "u32")]
pub struct Squad(u32);

/// The bits of all possible players.
const ALL: u32 = (1 << PLAYERS_MAX) - 1;

impl TryFrom<u32> for Squad {
    type Error = &'static str;

    fn try_from(bits: u32) -> Result<Squad, &'static str> {
        if bits & !ALL == 0 { Ok(Squad(bits)) } else { Err("a squad has 22 places") }
    }
}

impl FromIterator<PlayerId> for Squad {
    fn from_iter<I: IntoIterator<Item = PlayerId>>(ids: I) -> Squad {
        Squad(ids.into_iter().fold(0, |bits, id| bits | (1 << id.0)))
    }
}

impl Squad {
    /// Whether a player is in the set.
    pub const fn has(self, id: PlayerId) -> bool {
        self.0 & (1 << id.0) != 0
    }

    /// Adds a player.
    pub const fn add(&mut self, id: PlayerId) {
        self.0 |= 1 << id.0;
    }

    /// The players of a team.
    #[must_use]
    pub const fn of(self, team: Team) -> Squad {
        Squad(self.0 & (((1 << TEAM_MAX) - 1) << (team.index() * TEAM_MAX)))
    }

    /// How many.
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether the set is empty.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The players by id.
    pub fn ids(self) -> Ids {
        self.ids_from(Team::Left)
    }

    /// The players by id, one team before the other.
    pub fn ids_from(self, team: Team) -> Ids {
        let first = (team.index() * TEAM_MAX) as u8;
        let turned = (self.0 >> first | self.0 << (PLAYERS_MAX as u8 - first)) & ALL;
        Ids { left: turned, first }
    }
}

/// Iterates over a set of players.
#[derive(Clone, Debug)]
pub struct Ids {
    /// Bit k: the k-th from the first.
    left: u32,
    first: u8,
}

impl Iterator for Ids {
    type Item = PlayerId;

    #[inline]
    fn next(&mut self) -> Option<PlayerId> {
        if self.left == 0 {
            return None;
        }
        let id = self.first + self.left.trailing_zeros() as u8;
        self.left &= self.left - 1;
        Some(PlayerId(if id < PLAYERS_MAX as u8 { id } else { id - PLAYERS_MAX as u8 }))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.left.count_ones() as usize;
        (left, Some(left))
    }
}

impl ExactSizeIterator for Ids {}

#[cfg(test)]
mod tests {
    use super::*;

    fn squad(ids: &[u8]) -> Squad {
        ids.iter().map(|id| PlayerId(*id)).collect()
    }

    #[test]
    fn goes_through_a_team_before_the_other() {
        let some = squad(&[21, 3, 0, 11]);
        assert_eq!(some.ids().map(|id| id.0).collect::<Vec<_>>(), [0, 3, 11, 21]);
        assert_eq!(some.ids_from(Team::Right).map(|id| id.0).collect::<Vec<_>>(), [11, 21, 0, 3]);
        assert_eq!(
            (some.len(), some.of(Team::Left), some.of(Team::Right)),
            (4, squad(&[0, 3]), squad(&[11, 21]))
        );
        assert!(some.has(PlayerId(3)) && !some.has(PlayerId(4)) && squad(&[]).is_empty());
    }

    #[test]
    fn has_no_more_places_than_players() {
        assert_eq!(Squad::try_from(ALL).unwrap().ids().len(), PLAYERS_MAX);
        assert!(Squad::try_from(1 << PLAYERS_MAX).is_err());
    }
}
