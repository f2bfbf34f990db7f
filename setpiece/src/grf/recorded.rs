//! What a script sets.

use crate::scenario::vocabulary::{Role, Team};

/// The seed of deterministic scenarios.
pub const FIXED_SEED: i64 = 42;
/// The largest number of steps for `end limit`.
pub const LIMIT_MAX: i64 = 1_000_000;
/// `second_half` of a match without half-time.
const NEVER: i64 = 999_999_999;

/// A player of a script.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrfPlayer {
    /// The place in the team's own frame: its own goal is at x = -1.
    pub place: [f64; 2],
    /// The role.
    pub role: Role,
    /// Whether they only move when the ball is near.
    pub lazy: bool,
    /// Whether an agent may control them.
    pub controllable: bool,
}

/// All settings of a script, with GRF's names and defaults.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the names are those of GRF's documentation")]
pub struct GrfScenario {
    /// In the left team's frame.
    pub ball_position: [f64; 2],
    pub left_team: Vec<GrfPlayer>,
    pub right_team: Vec<GrfPlayer>,
    pub left_agents: i64,
    pub right_agents: i64,
    pub game_duration: i64,
    pub second_half: i64,
    pub deterministic: bool,
    pub offsides: bool,
    pub end_episode_on_score: bool,
    pub end_episode_on_out_of_play: bool,
    pub end_episode_on_possession_change: bool,
    pub left_team_difficulty: f64,
    pub right_team_difficulty: f64,
    pub control_all_players: bool,
    pub use_magnet: bool,
    pub game_engine_random_seed: i64,
    pub real_time: bool,
}

impl Default for GrfScenario {
    fn default() -> GrfScenario {
        GrfScenario {
            ball_position: [0.0, 0.0],
            left_team: Vec::new(),
            right_team: Vec::new(),
            left_agents: 1,
            right_agents: 0,
            game_duration: 3000,
            second_half: NEVER,
            deterministic: false,
            offsides: true,
            end_episode_on_score: false,
            end_episode_on_out_of_play: false,
            end_episode_on_possession_change: false,
            left_team_difficulty: 1.0,
            right_team_difficulty: 0.6,
            control_all_players: false,
            use_magnet: true,
            game_engine_random_seed: FIXED_SEED,
            real_time: false,
        }
    }
}

impl GrfScenario {
    /// The players of a team.
    pub fn team(&self, team: Team) -> &[GrfPlayer] {
        match team {
            Team::Left => &self.left_team,
            Team::Right => &self.right_team,
        }
    }

    /// The players of a team, to add some.
    pub(super) fn team_mut(&mut self, team: Team) -> &mut Vec<GrfPlayer> {
        match team {
            Team::Left => &mut self.left_team,
            Team::Right => &mut self.right_team,
        }
    }

    /// The difficulty of a team.
    pub(super) fn difficulty(&self, team: Team) -> f64 {
        match team {
            Team::Left => self.left_team_difficulty,
            Team::Right => self.right_team_difficulty,
        }
    }

    /// The flags and numbers that no text can alternate, in GRF's order.
    pub(super) fn fixed(&self) -> [(&'static str, Setting); 13] {
        use Setting::{Flag, Whole};
        [
            ("left_agents", Whole(self.left_agents)),
            ("right_agents", Whole(self.right_agents)),
            ("game_duration", Whole(self.game_duration)),
            ("second_half", Whole(self.second_half)),
            ("deterministic", Flag(self.deterministic)),
            ("offsides", Flag(self.offsides)),
            ("end_episode_on_score", Flag(self.end_episode_on_score)),
            ("end_episode_on_out_of_play", Flag(self.end_episode_on_out_of_play)),
            ("end_episode_on_possession_change", Flag(self.end_episode_on_possession_change)),
            ("control_all_players", Flag(self.control_all_players)),
            ("use_magnet", Flag(self.use_magnet)),
            ("game_engine_random_seed", Whole(self.game_engine_random_seed)),
            ("real_time", Flag(self.real_time)),
        ]
    }
}

/// The value of a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Setting {
    /// `True` or `False`.
    Flag(bool),
    /// A whole number.
    Whole(i64),
}

impl std::fmt::Display for Setting {
    /// As Python writes it.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Setting::Flag(true) => f.write_str("True"),
            Setting::Flag(false) => f.write_str("False"),
            Setting::Whole(number) => number.fmt(f),
        }
    }
}
