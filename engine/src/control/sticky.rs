//! Held actions: directions, gaits and team orders last until changed.

use glam::Vec2;
use setpiece_scenario::vocabulary::{Action, StickyAction};

/// The bits of the eight directions.
const DIRECTIONS: u16 = 0xff;
const SPRINT: u16 = 1 << StickyAction::Sprint.index();
const DRIBBLE: u16 = 1 << StickyAction::Dribble.index();
const KEEPER_RUSH: u16 = 1 << StickyAction::KeeperRush.index();
const PRESSURE: u16 = 1 << StickyAction::Pressure.index();
const TEAM_PRESSURE: u16 = 1 << StickyAction::TeamPressure.index();

/// The held actions after an action.
pub fn next(sticky: u16, action: Action) -> u16 {
    match action {
        Action::Left
        | Action::TopLeft
        | Action::Top
        | Action::TopRight
        | Action::Right
        | Action::BottomRight
        | Action::Bottom
        | Action::BottomLeft => {
            (sticky & !DIRECTIONS) | (1 << (action.index() - Action::Left.index()))
        }
        Action::Sprint => sticky | SPRINT,
        Action::ReleaseSprint => sticky & !SPRINT,
        Action::Dribble => sticky | DRIBBLE,
        Action::ReleaseDribble => sticky & !DRIBBLE,
        Action::ReleaseDirection => sticky & !DIRECTIONS,
        Action::BuiltinAi => 0,
        Action::KeeperRush => sticky | KEEPER_RUSH,
        Action::ReleaseKeeperRush => sticky & !KEEPER_RUSH,
        Action::Pressure => sticky | PRESSURE,
        Action::ReleasePressure => sticky & !PRESSURE,
        Action::TeamPressure => sticky | TEAM_PRESSURE,
        Action::ReleaseTeamPressure => sticky & !TEAM_PRESSURE,
        Action::Idle
        | Action::LongPass
        | Action::HighPass
        | Action::ShortPass
        | Action::Shot
        | Action::Sliding
        | Action::Switch
        | Action::ReleaseLongPass
        | Action::ReleaseHighPass
        | Action::ReleaseShortPass
        | Action::ReleaseShot
        | Action::ReleaseSliding
        | Action::ReleaseSwitch => sticky,
    }
}

/// Whether an action replaces a steered direction by one of the eight, or by none.
pub fn unsteers(action: Action) -> bool {
    action.direction().is_some() || matches!(action, Action::ReleaseDirection | Action::BuiltinAi)
}

/// The held direction in the own frame.
pub fn direction(sticky: u16) -> Option<Vec2> {
    let bit = (sticky & DIRECTIONS).trailing_zeros() as usize;
    if bit >= 8 {
        return None;
    }
    let (x, y) = Action::from_index(bit + Action::Left.index())?.direction()?;
    Some(Vec2::new(x as f32, y as f32))
}

/// Whether a direction action is held; false for any other action.
pub fn holds(sticky: u16, direction: Action) -> bool {
    direction.direction().is_some()
        && sticky & (1 << (direction.index() - Action::Left.index())) != 0
}

/// Whether sprint is held.
pub fn sprints(sticky: u16) -> bool {
    sticky & SPRINT != 0
}

/// Whether the keeper is called out.
pub fn rushes(sticky: u16) -> bool {
    sticky & KEEPER_RUSH != 0
}

/// Whether the controlled player is ordered to chase.
pub fn presses(sticky: u16) -> bool {
    sticky & PRESSURE != 0
}

/// Whether a teammate is ordered to press.
pub fn team_presses(sticky: u16) -> bool {
    sticky & TEAM_PRESSURE != 0
}

/// Whether dribble is held.
pub fn dribbles(sticky: u16) -> bool {
    sticky & DRIBBLE != 0
}
