//! Who plays players, whatever the text says: `ai`s that a caller brings from outside.

use setpiece_scenario::vocabulary::Team;

/// An `ai` from outside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cast {
    /// Which players it plays.
    pub target: CastTarget,
    /// What stands behind `ai:`: `lazy`, `marker(3m)`, `script "f.rhai"`. It sees what the root
    /// file sees.
    pub ai: String,
}

/// The players that an `ai` from outside plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CastTarget {
    /// Every player of a team without an `ai` of their own.
    Team(Team),
    /// One player, by team and by place in it.
    Player(Team, usize),
}

/// How reports call the text of an `ai` from outside.
pub const CAST_NAME: &str = "<ai>";
