//! Keeps players out of posts and nets; the only way into a goal is through its mouth.

use glam::Vec2;
use setpiece_scenario::PitchSize;
use setpiece_scenario::pitch::GOAL_DEPTH_M;

/// Least distance of a body's middle from a post or net, metres: half the breadth of both.
const KEEP_M: f32 = 0.36;

/// Sides and rear of the goal at +x, the ends of each, metres.
fn walls(pitch: &PitchSize) -> [[Vec2; 2]; 3] {
    let half = pitch.half_length();
    let (line, rear, post) =
        (half as f32, (half + GOAL_DEPTH_M) as f32, pitch.goal_half_width() as f32);
    [
        [Vec2::new(line, -post), Vec2::new(rear, -post)],
        [Vec2::new(line, post), Vec2::new(rear, post)],
        [Vec2::new(rear, -post), Vec2::new(rear, post)],
    ]
}

/// Keeps a player's place and velocity out of the frames and nets of both goals.
#[inline]
pub fn keep_out(pitch: &PitchSize, pos: &mut Vec2, vel: &mut Vec2) {
    let reach = pitch.half_length() as f32 - KEEP_M;
    if pos.x.abs() >= reach && pos.y.abs() <= pitch.goal_half_width() as f32 + KEEP_M {
        keep_off_walls(pitch, pos, vel);
    }
}

/// Keeps a player at a goal out of its frame and net.
fn keep_off_walls(pitch: &PitchSize, pos: &mut Vec2, vel: &mut Vec2) {
    // Both ends are alike: the one at -x is turned by 180°.
    let side = if pos.x < 0.0 { -1.0 } else { 1.0 };
    for [from, to] in walls(pitch) {
        let at = *pos * side;
        let along = to - from;
        let share = ((at - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let away = at - (from + along * share);
        let distance = away.length();
        if distance < KEEP_M && distance > 1e-4 {
            let out = away / distance;
            *pos = (at + out * (KEEP_M - distance)) * side;
            let into = (*vel * side).dot(out).min(0.0);
            *vel -= out * (into * side);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where a player is who runs for two seconds from a place at a velocity.
    fn run(from: Vec2, vel: Vec2) -> Vec2 {
        let mut pos = from;
        for _ in 0..100 {
            pos += vel * 0.02;
            keep_out(&PitchSize::USUAL, &mut pos, &mut { vel });
        }
        pos
    }

    #[test]
    fn nobody_runs_through_a_net() {
        for side in [1.0, -1.0] {
            let beside = run(Vec2::new(56.0, 6.0) * side, Vec2::new(0.0, -8.0) * side) * side;
            assert!((3.9..4.2).contains(&beside.y), "{beside}");
            let behind = run(Vec2::new(59.0, 1.0) * side, Vec2::new(-8.0, 0.0) * side) * side;
            assert!((57.8..58.1).contains(&behind.x), "{behind}");
        }
    }

    #[test]
    fn the_mouth_is_open_and_the_rear_holds_players() {
        let inside = run(Vec2::new(52.0, 1.0), Vec2::new(6.0, 0.0));
        assert!((57.1..57.3).contains(&inside.x) && (inside.y - 1.0).abs() < 0.1, "{inside}");
    }

    #[test]
    fn a_post_is_run_round() {
        let past = run(Vec2::new(53.0, 3.75), Vec2::new(6.0, 0.0));
        assert!((past.y - 3.7).abs() > 0.3, "{past}");
    }
}
