//! Continuous actions: four numbers instead of a key.
//!
//! `[x, y, kind, power]`, own frame. `x`, `y`: the direction to run, whose length is the pace (0
//! stands, 1 sprints). `kind`: what to do with the ball, [`KINDS`] in equal parts of -1..1.
//! `power`: the power of a kick, 0..1, which sets how hard a shot is and how far a pass goes. At 0
//! the kicker decides, as with a key.

use crate::state::Steer;
use glam::Vec2;
use setpiece_scenario::vocabulary::Action;

/// The number of values in an action.
pub const WIDTH: usize = 4;
/// Least values.
pub const LOW: [f32; WIDTH] = [-1.0, -1.0, -1.0, 0.0];
/// Greatest values.
pub const HIGH: [f32; WIDTH] = [1.0; WIDTH];
/// The meanings of `kind`, in equal parts from -1 to 1.
pub const KINDS: [Action; 6] = [
    Action::Idle,
    Action::ShortPass,
    Action::LongPass,
    Action::HighPass,
    Action::Shot,
    Action::Sliding,
];

/// Rounding may leave a direction that was cut to length 1 this much too long. Cutting it again
/// would change it, but a recorded direction must stay the same.
const ROUNDING: f32 = 1e-6;

/// Decodes four numbers, clamped to their bounds. None if one of them is NaN.
pub fn decode(values: [f32; WIDTH]) -> Option<(Steer, Action)> {
    if values.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let mut held = values;
    for (value, (low, high)) in held.iter_mut().zip(LOW.into_iter().zip(HIGH)) {
        *value = value.clamp(low, high);
    }
    let [x, y, kind, power] = held;
    let part = ((0.5 * kind + 0.5) * KINDS.len() as f32) as usize;
    let way = Vec2::new(x, y);
    let way = if way.length_squared() > 1.0 + ROUNDING { way.normalize() } else { way };
    let steer = Steer { way, power };
    Some((steer, KINDS[part.min(KINDS.len() - 1)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_an_equal_part() {
        for (i, kind) in KINDS.into_iter().enumerate() {
            let middle = -1.0 + (2 * i + 1) as f32 / KINDS.len() as f32;
            assert_eq!(decode([0.0, 0.0, middle, 0.0]).unwrap().1, kind);
        }
        assert_eq!(decode([0.0, 0.0, 1.0, 0.0]).unwrap().1, Action::Sliding);
        assert_eq!(decode([0.0, 0.0, -9.0, 0.0]).unwrap().1, Action::Idle);
    }

    #[test]
    fn a_way_is_at_most_a_sprint_and_must_be_a_number() {
        let (steer, _) = decode([1.0, -1.0, 0.0, 7.0]).unwrap();
        assert!((steer.way.length() - 1.0).abs() < 1e-6 && steer.power == 1.0);
        for i in 0..1000 {
            let (x, y) = (1.0 - 0.001 * i as f32, 1.0 - 0.0007 * i as f32);
            let way = decode([x, y, 0.0, 0.0]).unwrap().0.way;
            assert_eq!(decode([way.x, way.y, 0.0, 0.0]).unwrap().0.way, way, "cut twice");
        }
        assert_eq!(decode([f32::NAN, 0.0, 0.0, 0.0]), None);
        assert_eq!(decode([0.0, 0.0, f32::INFINITY, 0.0]), None);
    }
}
