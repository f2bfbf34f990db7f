//! Steering with an agent's keys: one of eight directions, sprint and dribble held until released,
//! one press per step.

use crate::control::{agents, sticky};
use glam::Vec2;
use setpiece_scenario::vocabulary::Action;

/// How the player runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gait {
    /// Without anything held.
    Run,
    /// With sprint held.
    Sprint,
    /// With dribble held: close control.
    Dribble,
}

/// A held direction is kept while it is off by less than this, cos 30°. The border between two
/// directions is at 22.5°.
const KEEP_COS: f32 = 0.866;
/// Nearer than this to the target, the best direction is taken at once, metres.
const FINE_M: f32 = 3.0;

/// The press that brings the player towards a target; own frame, metres.
pub fn towards(held: u16, way: Vec2, gait: Gait) -> Action {
    let near = way.length() < FINE_M;
    let kept =
        sticky::direction(held).is_some_and(|dir| dir.dot(way.normalize_or_zero()) > KEEP_COS);
    if kept && !near {
        return pace(held, gait);
    }
    let best = agents::direction_action(way);
    if sticky::holds(held, best) { pace(held, gait) } else { best }
}

/// The press that changes the gait, if one does.
fn pace(held: u16, gait: Gait) -> Action {
    match (sticky::sprints(held), sticky::dribbles(held), gait) {
        (true, _, Gait::Run | Gait::Dribble) => Action::ReleaseSprint,
        (_, true, Gait::Run | Gait::Sprint) => Action::ReleaseDribble,
        (false, _, Gait::Sprint) => Action::Sprint,
        (_, false, Gait::Dribble) => Action::Dribble,
        _ => Action::Idle,
    }
}

/// The press that stops the player.
pub fn rest(held: u16) -> Action {
    if sticky::direction(held).is_some() { Action::ReleaseDirection } else { pace(held, Gait::Run) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Presses until nothing changes. Returns what is held then, and the number of presses.
    fn settled(mut held: u16, way: Vec2, gait: Gait) -> (u16, u32) {
        for presses in 0..10 {
            let action = towards(held, way, gait);
            if action == Action::Idle {
                return (held, presses);
            }
            held = sticky::next(held, action);
        }
        panic!("never settles");
    }

    #[test]
    fn a_way_is_taken_by_the_nearest_direction_then_the_gait() {
        let (held, presses) = settled(0, Vec2::new(10.0, 1.0), Gait::Sprint);
        assert_eq!(
            (sticky::direction(held), sticky::sprints(held), presses),
            (Some(Vec2::X), true, 2)
        );
        let (held, _) = settled(held, Vec2::new(10.0, 9.0), Gait::Dribble);
        let direction = sticky::direction(held).expect("a direction");
        assert!(direction.x > 0.7 && direction.y > 0.7);
        assert!(!sticky::sprints(held) && sticky::dribbles(held));
    }

    #[test]
    fn a_way_on_the_border_of_two_directions_does_not_flutter() {
        let held = sticky::next(0, Action::Right);
        let at = |degrees: f32| {
            Vec2::new(libm::cosf(degrees.to_radians()), libm::sinf(degrees.to_radians()))
        };
        assert_eq!(towards(held, at(26.0) * 20.0, Gait::Run), Action::Idle);
        assert_eq!(towards(held, at(32.0) * 20.0, Gait::Run), Action::BottomRight);
        // The last metres are steered exactly.
        assert_eq!(towards(held, at(26.0) * 2.0, Gait::Run), Action::BottomRight);
    }

    #[test]
    fn rest_releases_all_that_is_held() {
        let mut held =
            [Action::Top, Action::Sprint, Action::Dribble].into_iter().fold(0, sticky::next);
        for _ in 0..3 {
            held = sticky::next(held, rest(held));
        }
        assert_eq!((held, rest(held)), (0, Action::Idle));
    }
}
