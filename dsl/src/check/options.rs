//! The keys of every pair of braces, each list once.

/// Keys of `agents { }`.
pub(crate) const AGENTS: &[&str] = &["left", "right", "others", "switching"];
/// Keys of `team { }`.
pub(crate) const TEAM: &[&str] = &["difficulty", "formation"];
/// Keys of a player's `{ }`.
pub(crate) const PLAYER: &[&str] = &[
    "ai",
    "difficulty",
    "controllable",
    "stats",
    "fatigue",
    "yellow_cards",
    "velocity",
    "overlap",
];
/// Keys of `substitute … { }`.
pub(crate) const SUBSTITUTE: &[&str] = &["fatigue", "difficulty", "stats"];
/// Keys of the ball's `{ }`.
pub(crate) const BALL: &[&str] = &["velocity", "height", "spin", "owner"];
/// Keys of `world { }`.
pub(crate) const WORLD: &[&str] =
    &["gravity", "wind", "drag", "swerve", "spin_decay", "bounce", "friction"];
/// Keys of `pitch { }`.
pub(crate) const PITCH: &[&str] = &["length", "width", "goal", "goal_height", "box", "box_width"];
/// Keys of `start … { }`.
pub(crate) const START: &[&str] = &["score", "elapsed"];
