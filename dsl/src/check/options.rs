//! The keys of every pair of braces, each list once.

use setpiece_scenario::vocabulary::{
    AgentsOption, BallOption, PitchFigure, PlayerOption, Rule, StartOption, SubstituteOption,
    TeamOption,
};

/// Keys of `agents { }`.
pub(crate) const AGENTS: &[&str] = AgentsOption::NAMES;
/// Keys of `team { }`.
pub(crate) const TEAM: &[&str] = TeamOption::NAMES;
/// Keys of a player's `{ }`.
pub(crate) const PLAYER: &[&str] = PlayerOption::NAMES;
/// Keys of `substitute … { }`.
pub(crate) const SUBSTITUTE: &[&str] = SubstituteOption::NAMES;
/// Keys of the ball's `{ }`.
pub(crate) const BALL: &[&str] = BallOption::NAMES;
/// Keys of `world { }`; the wind is one key with two figures.
pub(crate) const WORLD: &[&str] =
    &["gravity", "wind", "drag", "swerve", "spin_decay", "bounce", "friction"];
/// Keys of `rules { }`.
pub(crate) const RULES: &[&str] = Rule::NAMES;
/// Keys of `pitch { }`.
pub(crate) const PITCH: &[&str] = PitchFigure::NAMES;
/// Keys of `start … { }`.
pub(crate) const START: &[&str] = StartOption::NAMES;
