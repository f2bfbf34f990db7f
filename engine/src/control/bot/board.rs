//! Everyone's place while the bots decide, in columns, for queries of the nearest player.

use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::vocabulary::Team;

/// Length of a column: a whole number of vectors.
const COLUMN: usize = TEAM_MAX.next_multiple_of(4);
/// Stands for "no distance": larger than every other value.
const NONE: u64 = u64::MAX;

/// Everyone's place, world metres, by team and number. Nobody moves while the bots decide.
#[derive(Clone, Copy, Debug)]
pub struct Board {
    /// Infinite for players off the pitch.
    x: [[f32; COLUMN]; 2],
    y: [[f32; COLUMN]; 2],
}

impl Board {
    /// Copies everyone's current place.
    pub fn of(game: &Match) -> Board {
        let mut board = Board { x: [[f32::INFINITY; COLUMN]; 2], y: [[0.0; COLUMN]; 2] };
        game.squad.ids().filter(|id| game.player(*id).active).for_each(|id| {
            let (team, at) = (id.team().index(), id.in_team());
            (board.x[team][at], board.y[team][at]) = game.player(id).pos.into();
        });
        board
    }

    /// The players of a team nearest to a world place, nearest first.
    pub fn nearest<const N: usize>(
        &self,
        team: Team,
        to: Vec2,
        but: Option<PlayerId>,
    ) -> impl Iterator<Item = PlayerId> + use<N> {
        let (x, y) = (&self.x[team.index()], &self.y[team.index()]);
        let squared: [f32; COLUMN] = std::array::from_fn(|i| {
            let (dx, dy) = (x[i] - to.x, y[i] - to.y);
            dx * dx + dy * dy
        });
        // Packs a distance and its player into one number: bits of non-negative floats sort like
        // the floats, and of equals the first wins. There is no branch, because nobody can predict
        // who is near.
        let mut best = [NONE; N];
        for (number, squared) in squared.into_iter().enumerate().take(TEAM_MAX) {
            let id = PlayerId::new(team, number);
            let mut next = u64::from(squared.to_bits()) << u8::BITS | u64::from(id.0);
            if !squared.is_finite() || but == Some(id) {
                next = NONE;
            }
            for place in &mut best {
                (*place, next) = ((*place).min(next), (*place).max(next));
            }
        }
        best.into_iter().take_while(|found| *found != NONE).map(|found| PlayerId(found as u8))
    }
}
