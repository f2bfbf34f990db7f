//! Held actions: directions, sprint and dribble last until changed.

use glam::Vec2;
use setpiece_scenario::vocabulary::{Action, StickyAction};

/// The bits of the eight directions.
const DIRECTIONS: u16 = 0xff;
const SPRINT: u16 = 1 << StickyAction::Sprint.index();
const DRIBBLE: u16 = 1 << StickyAction::Dribble.index();

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
        | Action::BottomLeft => (sticky & !DIRECTIONS) | (1 << (action.index() - Action::Left.index())),
        Action::Sprint => sticky | SPRINT,
        Action::ReleaseSprint => sticky & !SPRINT,
        Action::Dribble => sticky | DRIBBLE,
        Action::ReleaseDribble => sticky & !DRIBBLE,
        Action::ReleaseDirection => sticky & !DIRECTIONS,
        Action::BuiltinAi => 0,
        Action::Idle | Action::LongPass | Action::HighPass | Action::ShortPass | Action::Shot | Action::Sliding => {
            sticky
        }
    }
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
    direction.direction().is_some() && sticky & (1 << (direction.index() - Action::Left.index())) != 0
}

/// Whether sprint is held.
pub fn sprints(sticky: u16) -> bool {
    sticky & SPRINT != 0
}

/// Whether dribble is held.
pub fn dribbles(sticky: u16) -> bool {
    sticky & DRIBBLE != 0
}
