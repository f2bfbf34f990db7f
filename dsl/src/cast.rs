//! Who plays players, whatever the text says: `ai`s that a caller brings from outside.

use setpiece_scenario::vocabulary::Team;

/// An `ai` from outside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cast {
    /// Whose.
    pub whom: Whom,
    /// What stands behind `ai:`: `lazy`, `marker(3m)`, `script "f.rhai"`. It sees what the root file sees.
    pub ai: String,
}

/// Whose `ai` it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whom {
    /// That of every player of a team who has none of his own.
    Team(Team),
    /// That of one player, by his team and his place in it.
    Player(Team, usize),
}

/// How reports call the text of an `ai` from outside.
pub const CAST_NAME: &str = "<ai>";
