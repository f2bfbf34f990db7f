//! The players' statistics: one table by index in the team, the same for both teams.
//!
//! Source: Google Research Football's records of players.

use crate::start::DrawnPlayer;
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::vocabulary::Stat;

/// Heights by index in the team, metres.
const HEIGHT_M: [f32; TEAM_MAX] =
    [1.87, 1.70, 1.74, 1.93, 1.72, 1.71, 1.89, 1.84, 1.74, 1.81, 1.69];

/// A statistic's row, by index in the team.
const fn row(stat: Stat) -> [f32; TEAM_MAX] {
    match stat {
        Stat::Balance => [0.941, 0.834, 1.0, 1.0, 0.773, 0.613, 1.0, 0.798, 0.599, 0.635, 0.658],
        Stat::Reaction => [1.0, 0.785, 0.916, 1.0, 0.727, 0.772, 0.870, 0.798, 0.756, 0.801, 0.831],
        Stat::Acceleration => {
            [0.796, 0.785, 0.692, 0.730, 0.727, 0.930, 0.716, 0.798, 0.991, 1.0, 1.0]
        }
        Stat::Speed => [0.652, 0.785, 0.692, 0.730, 0.727, 0.930, 0.716, 0.798, 0.991, 1.0, 1.0],
        Stat::Stamina | Stat::Calmness | Stat::Workrate | Stat::Resilience => {
            [0.796, 0.688, 0.692, 0.730, 0.636, 0.772, 0.716, 0.722, 0.756, 0.801, 0.831]
        }
        Stat::Agility => [0.941, 0.785, 0.692, 0.655, 0.681, 1.0, 0.716, 0.874, 1.0, 1.0, 1.0],
        Stat::ShotPower => [0.941, 0.834, 0.841, 0.955, 0.727, 1.0, 0.870, 0.949, 1.0, 1.0, 1.0],
        Stat::StandingTackle => {
            [0.362, 0.785, 1.0, 1.0, 0.819, 0.296, 1.0, 0.646, 0.285, 0.302, 0.313]
        }
        Stat::SlidingTackle => {
            [0.362, 0.785, 0.990, 1.0, 0.773, 0.296, 0.870, 0.570, 0.207, 0.219, 0.227]
        }
        Stat::BallControl => {
            [0.507, 0.737, 0.692, 0.580, 0.727, 0.930, 0.716, 0.798, 0.834, 0.885, 0.917]
        }
        Stat::Dribble => [0.362, 0.688, 0.468, 0.355, 0.590, 1.0, 0.561, 0.798, 1.0, 1.0, 1.0],
        Stat::ShortPass => {
            [0.941, 0.834, 0.841, 0.655, 0.865, 0.930, 1.0, 0.949, 0.912, 0.968, 1.0]
        }
        Stat::HighPass => [1.0, 0.785, 0.841, 0.655, 0.819, 0.772, 1.0, 0.874, 0.834, 0.885, 0.917],
        Stat::Header => {
            [0.362, 0.688, 0.767, 0.880, 0.636, 0.613, 0.716, 0.646, 0.599, 0.635, 0.658]
        }
        Stat::Shot => [0.507, 0.639, 0.468, 0.355, 0.498, 1.0, 0.561, 0.798, 1.0, 1.0, 1.0],
        Stat::Volley => {
            [0.362, 0.444, 0.319, 0.280, 0.360, 0.772, 0.407, 0.570, 0.677, 0.718, 0.744]
        }
        Stat::DefensivePositioning => {
            [1.0, 0.785, 0.990, 1.0, 0.819, 0.454, 0.870, 0.646, 0.403, 0.427, 0.443]
        }
        Stat::OffensivePositioning => {
            [0.217, 0.639, 0.468, 0.355, 0.498, 1.0, 0.561, 0.798, 1.0, 1.0, 1.0]
        }
        Stat::Vision => {
            [0.796, 0.737, 0.841, 0.730, 0.819, 0.613, 0.870, 0.722, 0.677, 0.718, 0.744]
        }
    }
}

/// The statistics of a player: the table's, overridden by the scenario's.
pub fn stats_of(index: usize, drawn: &DrawnPlayer) -> [f32; Stat::ALL.len()] {
    let mut stats = [0.0; Stat::ALL.len()];
    for &stat in Stat::ALL {
        stats[stat.index()] = row(stat)[index % TEAM_MAX];
    }
    for &(stat, value) in &drawn.stats {
        stats[stat.index()] = value.clamp(LEAST, 1.0);
    }
    stats
}

/// The height of a team's player, metres.
pub fn height_of(index: usize) -> f32 {
    HEIGHT_M[index % TEAM_MAX]
}

/// The least value of a statistic.
pub const LEAST: f32 = 0.01;

/// How well a player of this difficulty plays, 0.3..1.
pub fn level_of(difficulty: f32) -> f32 {
    0.3 + 0.7 * difficulty.clamp(0.0, 1.0)
}

/// Top speed, m/s: 7.2 at speed 0 to 8.0 at 1.
pub fn speed_top(speed: f32) -> f32 {
    8.0 * (0.9 + 0.1 * speed)
}
