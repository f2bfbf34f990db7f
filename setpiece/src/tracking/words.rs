//! The Common Data Format's words for events.

use setpiece_scenario::{EventKind, Team};

/// A team's id.
pub(super) fn team(team: Team) -> &'static str {
    team.name()
}

/// The half of a match.
pub(super) fn period(second_half: bool) -> &'static str {
    if second_half { "second_half" } else { "first_half" }
}

/// The type of an event that is neither a pass nor a shot, and its sub type.
pub(super) fn of(kind: EventKind) -> (&'static str, &'static str) {
    match kind {
        EventKind::Save => ("goalkeeping", "save"),
        EventKind::Catch => ("goalkeeping", "claim"),
        EventKind::Parry => ("goalkeeping", "parry"),
        EventKind::Interception => ("defending", "interception"),
        EventKind::Corner => ("misc", "corner_kick"),
        EventKind::Kickoff => ("misc", "kick_off"),
        EventKind::Penalty => ("misc", "penalty_kick"),
        EventKind::End => ("referee", "episode_end"),
        EventKind::HalfTime | EventKind::FullTime => ("referee", kind.name()),
        _ => ("misc", kind.name()),
    }
}

/// Whether the referee calls it. A call that a player caused is reported twice: what the player
/// did, and the referee's call.
pub(super) fn is_called(kind: EventKind) -> bool {
    matches!(
        kind,
        EventKind::Foul
            | EventKind::Handball
            | EventKind::Offside
            | EventKind::YellowCard
            | EventKind::RedCard
            | EventKind::Advantage
    )
}

/// Whether a set piece is awarded by it, until somebody has taken it.
pub(super) fn is_set_piece(kind: EventKind) -> bool {
    matches!(
        kind,
        EventKind::ThrowIn
            | EventKind::Corner
            | EventKind::GoalKick
            | EventKind::FreeKick
            | EventKind::Penalty
            | EventKind::Kickoff
    )
}

/// Whether the ball meets somebody's body.
pub(super) fn is_touch(kind: EventKind) -> bool {
    matches!(
        kind,
        EventKind::Touch
            | EventKind::Header
            | EventKind::Save
            | EventKind::Catch
            | EventKind::Parry
    )
}
