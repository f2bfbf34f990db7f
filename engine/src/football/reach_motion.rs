//! The motions in which a leg goes out for the ball.

use crate::football::pace::{DRIBBLES_FROM_MPS, SPRINTS_FROM_MPS, WALKS_FROM_MPS};

/// A way to reach for the ball.
///
/// Measured of GRF's motions: how soon they touch, how long they last, and where the ball is then.
pub(super) struct ReachMotion {
    /// The lowest speed for this motion, m/s.
    pub(super) from_mps: f32,
    /// Up to which angle between the run and the way that the player wants, degrees.
    pub(super) to_degrees: f32,
    /// Ticks until the foot arrives, and until the player is free again.
    pub(super) ticks: i32,
    pub(super) lasts: i32,
    /// Where the foot then is, ahead of the player and to the side, metres.
    pub(super) ahead_m: f32,
    pub(super) aside_m: f32,
    /// How far off the ball may be, along the run and across it, metres.
    pub(super) along_m: f32,
    pub(super) across_m: f32,
    /// Whether the player stops for it.
    pub(super) stops: bool,
}

const fn motion(
    from_mps: f32,
    to_degrees: f32,
    [ticks, lasts]: [i32; 2],
    [ahead_m, aside_m]: [f32; 2],
    off: [f32; 2],
) -> ReachMotion {
    ReachMotion {
        from_mps,
        to_degrees,
        ticks,
        lasts,
        ahead_m,
        aside_m,
        along_m: off[0],
        across_m: off[1],
        stops: false,
    }
}

/// A motion for which the player stops.
const fn stop(
    from_mps: f32,
    to_degrees: f32,
    ticks: [i32; 2],
    foot: [f32; 2],
    off: [f32; 2],
) -> ReachMotion {
    ReachMotion { stops: true, ..motion(from_mps, to_degrees, ticks, foot, off) }
}

/// Angles up to which a motion leads on, turns a little, half, square, back, and about, degrees.
const ON_DEG: f32 = 13.0;
const BIT_DEG: f32 = 30.0;
const HALF_DEG: f32 = 62.0;
const SQUARE_DEG: f32 = 105.0;
pub(super) const BACK_DEG: f32 = 150.0;
const ABOUT_DEG: f32 = 180.0;

/// Pokes of a player who stands, or hardly moves.
pub(super) const STANDING_POKES: [ReachMotion; 2] = [
    motion(0.0, ABOUT_DEG, [11, 28], [0.9, 0.0], [0.59, 0.41]),
    motion(0.0, ABOUT_DEG, [15, 35], [0.0, 1.05], [0.59, 0.41]),
];
/// The poke of a player who runs: at a ball that comes from behind.
pub(super) const RUNNING_POKES: [ReachMotion; 1] =
    [motion(DRIBBLES_FROM_MPS, ABOUT_DEG, [24, 58], [-0.7, 0.6], [0.3, 0.26])];
/// Pokes of a keeper who runs. Fitted to how often one stops a sprinter.
pub(super) const KEEPER_POKES: [ReachMotion; 3] = [
    motion(SPRINTS_FROM_MPS, ABOUT_DEG, [12, 39], [0.77, 0.0], [0.47, 0.17]),
    motion(DRIBBLES_FROM_MPS, ABOUT_DEG, [9, 26], [0.61, 0.0], [0.56, 0.26]),
    motion(DRIBBLES_FROM_MPS, ABOUT_DEG, [24, 58], [-0.5, 0.7], [0.56, 0.26]),
];
/// Ways to take the ball along, fastest first, and the motions of a pace by their angles.
pub(super) const TAKES: [ReachMotion; 20] = [
    motion(SPRINTS_FROM_MPS, ON_DEG, [12, 25], [0.3, 0.0], [0.3, 0.15]),
    motion(SPRINTS_FROM_MPS, BIT_DEG, [14, 40], [0.38, 0.0], [0.27, 0.14]),
    motion(SPRINTS_FROM_MPS, SQUARE_DEG, [19, 53], [0.36, 0.1], [0.2, 0.2]),
    stop(SPRINTS_FROM_MPS, ABOUT_DEG, [22, 59], [0.62, 0.0], [0.28, 0.18]),
    motion(WALKS_FROM_MPS, ON_DEG, [15, 26], [0.0, 0.0], [0.36, 0.5]),
    motion(WALKS_FROM_MPS, BIT_DEG, [16, 29], [0.0, 0.0], [0.36, 0.18]),
    motion(WALKS_FROM_MPS, BIT_DEG, [10, 29], [-0.3, 0.0], [0.2, 0.2]),
    motion(WALKS_FROM_MPS, HALF_DEG, [27, 50], [0.0, 0.0], [0.62, 0.33]),
    motion(WALKS_FROM_MPS, SQUARE_DEG, [19, 53], [0.2, 0.0], [0.31, 0.3]),
    stop(WALKS_FROM_MPS, BACK_DEG, [20, 47], [0.8, 0.0], [0.18, 0.23]),
    motion(DRIBBLES_FROM_MPS, ON_DEG, [15, 26], [0.12, 0.0], [0.24, 0.49]),
    motion(DRIBBLES_FROM_MPS, BIT_DEG, [16, 29], [0.08, 0.0], [0.33, 0.27]),
    motion(DRIBBLES_FROM_MPS, BIT_DEG, [10, 29], [-0.16, 0.0], [0.26, 0.1]),
    motion(DRIBBLES_FROM_MPS, HALF_DEG, [27, 50], [0.23, 0.0], [0.62, 0.36]),
    motion(DRIBBLES_FROM_MPS, SQUARE_DEG, [19, 53], [0.2, 0.0], [0.15, 0.32]),
    stop(DRIBBLES_FROM_MPS, BACK_DEG, [20, 47], [0.72, 0.0], [0.24, 0.3]),
    motion(0.0, BIT_DEG, [8, 28], [0.0, 0.0], [0.3, 0.15]),
    motion(0.0, HALF_DEG, [7, 36], [0.0, 0.0], [0.43, 0.45]),
    motion(0.0, SQUARE_DEG, [8, 32], [0.0, 0.0], [0.5, 0.37]),
    motion(0.0, ABOUT_DEG, [13, 55], [0.0, 0.0], [0.75, 0.5]),
];
/// Stops a ball that rolls towards the player, long before it arrives, to go back with it. (GRF's.)
pub(super) const TRAP: ReachMotion =
    stop(DRIBBLES_FROM_MPS, ABOUT_DEG, [29, 54], [0.17, 0.0], [0.19, 0.16]);

/// The motions of a list for a pace and a turn: of those for the fastest gait that the pace allows,
/// those of the least angle that holds the turn.
pub(super) fn motions(
    ways: &'static [ReachMotion],
    pace: f32,
    turn: f32,
) -> &'static [ReachMotion] {
    let Some(gait) = ways.iter().map(|way| way.from_mps).find(|from| pace >= *from) else {
        return &[];
    };
    let fits = |way: &ReachMotion| way.from_mps == gait && turn <= way.to_degrees;
    let Some(first) = ways.iter().position(fits) else { return &[] };
    let same = |way: &&ReachMotion| fits(way) && way.to_degrees == ways[first].to_degrees;
    &ways[first..first + ways[first..].iter().take_while(same).count()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn takes_are_listed_by_falling_pace_and_rising_angle_and_answer_every_turn() {
        for pair in TAKES.windows(2) {
            let [a, b] = pair else { unreachable!() };
            assert!(
                a.from_mps > b.from_mps || a.from_mps == b.from_mps && a.to_degrees <= b.to_degrees
            );
        }
        for pace in [0.0, 1.0, 8.0] {
            for turn in 0..180 {
                assert!(!motions(&TAKES, pace, turn as f32).is_empty(), "{turn} at {pace}");
            }
        }
        assert!(motions(&TAKES, 5.0, 170.0).is_empty(), "who goes back with it traps it");
    }
}
