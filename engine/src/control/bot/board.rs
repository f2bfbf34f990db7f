//! Everyone's place while the bots decide, in columns, for queries of the nearest player.

use crate::rows::WIDTH;
use crate::state::{Match, PlayerId};
use arrayvec::ArrayVec;
use glam::Vec2;
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::vocabulary::Team;
use wide::f32x4;

/// Rows of a team's column.
const ROWS: usize = TEAM_MAX.div_ceil(WIDTH);
/// The place of each lane in its column.
const NUMBERS: [[f32; WIDTH]; ROWS] =
    [[0.0, 1.0, 2.0, 3.0], [4.0, 5.0, 6.0, 7.0], [8.0, 9.0, 10.0, 11.0]];

/// Everyone's place, world metres, by team and number. Nobody moves while the bots decide.
#[derive(Clone, Copy, Debug)]
pub struct Board {
    /// Infinite for players off the pitch.
    x: [[[f32; WIDTH]; ROWS]; 2],
    y: [[[f32; WIDTH]; ROWS]; 2],
}

impl Board {
    /// Copies everyone's current place.
    pub fn of(game: &Match) -> Board {
        let mut board =
            Board { x: [[[f32::INFINITY; WIDTH]; ROWS]; 2], y: [[[0.0; WIDTH]; ROWS]; 2] };
        game.squad.ids().filter(|id| game.player(*id).active).for_each(|id| {
            let (team, row, lane) = (id.team().index(), id.in_team() / WIDTH, id.in_team() % WIDTH);
            (board.x[team][row][lane], board.y[team][row][lane]) = game.player(id).pos.into();
        });
        board
    }

    /// The players of a team nearest to a world place, nearest first; of equals the first.
    pub fn nearest<const N: usize>(
        &self,
        team: Team,
        to: Vec2,
        but: Option<PlayerId>,
    ) -> ArrayVec<PlayerId, N> {
        let taken = f32x4::splat(f32::INFINITY);
        let strike = |squared: &mut [f32x4; ROWS], number: usize| {
            let number = f32x4::splat(number as f32);
            for (squared, numbers) in squared.iter_mut().zip(NUMBERS) {
                *squared = f32x4::new(numbers).simd_eq(number).select(taken, *squared);
            }
        };
        let (x, y) = (&self.x[team.index()], &self.y[team.index()]);
        let mut squared: [f32x4; ROWS] = std::array::from_fn(|row| {
            let (dx, dy) = (f32x4::new(x[row]) - to.x, f32x4::new(y[row]) - to.y);
            dx * dx + dy * dy
        });
        if let Some(but) = but.filter(|but| but.team() == team) {
            strike(&mut squared, but.in_team());
        }
        let mut found = ArrayVec::new();
        while !found.is_full() {
            let [a, b, c, d] =
                squared[1..].iter().fold(squared[0], |a, b| a.fast_min(*b)).to_array();
            let least = a.min(b).min(c.min(d));
            if !least.is_finite() {
                break;
            }
            let is_least = |row: usize| squared[row].simd_eq(f32x4::splat(least)).to_bitmask();
            let lanes = (0..ROWS).fold(0, |lanes, row| lanes | is_least(row) << (row * WIDTH));
            let number = lanes.trailing_zeros() as usize;
            strike(&mut squared, number);
            found.push(PlayerId::new(team, number));
        }
        found
    }
}
