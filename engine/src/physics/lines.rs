//! When the whole ball is over a line. (The referee decides what that means.)

use super::constants::BALL_RADIUS;
use glam::Vec3;
use setpiece_scenario::PitchSize;
use setpiece_scenario::pitch::LINE_HALF_WIDTH_M;
use setpiece_scenario::vocabulary::Team;

/// Beyond this |x| of its centre the whole ball is over the goal line, m: 55.17 usually.
#[inline]
pub const fn out_x(pitch: &PitchSize) -> f32 {
    pitch.half_length() as f32 + LINE_HALF_WIDTH_M as f32 + BALL_RADIUS
}

/// Beyond this |y| of its centre the whole ball is over a side line, m: 36.17 usually.
#[inline]
pub const fn out_y(pitch: &PitchSize) -> f32 {
    pitch.half_width() as f32 + LINE_HALF_WIDTH_M as f32 + BALL_RADIUS
}

/// A line that the ball is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// The goal line at a team's end.
    Goal(Team),
    /// A side line.
    Side,
}

/// Whose goal the whole ball entered between two ticks. Its path must cross the far edge of the
/// line under the bar and between the posts.
pub fn crossed_goal_line(pitch: &PitchSize, before: Vec3, after: Vec3) -> Option<Team> {
    let out_x = out_x(pitch);
    let team = if after.x > 0.0 { Team::Right } else { Team::Left };
    let (from, to) = (before.x.abs(), after.x.abs());
    if to <= out_x || from > out_x || before.x * after.x < 0.0 {
        return None;
    }
    let at = before.lerp(after, (out_x - from) / (to - from));
    let (post, bar) = (pitch.goal_half_width() as f32, pitch.goal_height() as f32);
    (at.y.abs() < post && at.z < bar).then_some(team)
}

/// The line that the whole ball is over, if it is off the pitch. At a corner, where it is over
/// both, the goal line.
pub fn left_pitch(pitch: &PitchSize, pos: Vec3) -> Option<Line> {
    if pos.x.abs() > out_x(pitch) {
        Some(Line::Goal(if pos.x > 0.0 { Team::Right } else { Team::Left }))
    } else if pos.y.abs() > out_y(pitch) {
        Some(Line::Side)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::Line;
    use glam::Vec3;
    use setpiece_scenario::PitchSize;
    use setpiece_scenario::vocabulary::{PitchFigure, Team};

    fn crossed_goal_line(before: Vec3, after: Vec3) -> Option<Team> {
        super::crossed_goal_line(&PitchSize::USUAL, before, after)
    }

    fn left_pitch(pos: Vec3) -> Option<Line> {
        super::left_pitch(&PitchSize::USUAL, pos)
    }

    #[test]
    fn lines_and_goals_are_those_of_the_pitch() {
        let small = PitchSize::with([
            (PitchFigure::Length, 60.0),
            (PitchFigure::Width, 40.0),
            (PitchFigure::Goal, 4.0),
            (PitchFigure::GoalHeight, 2.0),
        ]);
        let crossed = |y: f32, z: f32| {
            let (before, after) = (Vec3::new(30.0, y, z), Vec3::new(30.3, y, z));
            super::crossed_goal_line(&small, before, after)
        };
        assert_eq!(crossed(1.9, 1.9), Some(Team::Right));
        assert_eq!(crossed(2.1, 1.0), None);
        assert_eq!(crossed(1.0, 2.1), None);
        assert_eq!(super::left_pitch(&small, Vec3::new(30.16, 20.16, 0.1)), None);
        assert_eq!(super::left_pitch(&small, Vec3::new(0.0, 20.18, 0.1)), Some(Line::Side));
    }

    #[test]
    fn a_goal_counts_when_the_whole_ball_is_over() {
        let short = crossed_goal_line(Vec3::new(54.9, 0.0, 1.0), Vec3::new(55.16, 0.0, 1.0));
        assert_eq!(short, None);
        let over = crossed_goal_line(Vec3::new(55.16, 0.0, 1.0), Vec3::new(55.18, 0.0, 1.0));
        assert_eq!(over, Some(Team::Right));
        let left = crossed_goal_line(Vec3::new(-54.9, 3.0, 2.0), Vec3::new(-55.3, 3.0, 2.0));
        assert_eq!(left, Some(Team::Left));
    }

    #[test]
    fn beside_the_posts_over_the_bar_and_from_behind_is_no_goal() {
        assert_eq!(crossed_goal_line(Vec3::new(55.0, 3.8, 1.0), Vec3::new(55.4, 3.8, 1.0)), None);
        assert_eq!(crossed_goal_line(Vec3::new(55.0, 0.0, 2.7), Vec3::new(55.4, 0.0, 2.6)), None);
        assert_eq!(crossed_goal_line(Vec3::new(55.4, 0.0, 1.0), Vec3::new(55.1, 0.0, 1.0)), None);
        assert_eq!(
            crossed_goal_line(Vec3::new(55.2, 0.0, 1.0), Vec3::new(55.5, 0.0, 1.0)),
            None,
            "over before"
        );
    }

    #[test]
    fn what_counts_is_where_the_path_crosses_the_line() {
        // Under the bar at the line, though above it before; beside the post after, though inside
        // at the line.
        assert_eq!(
            crossed_goal_line(Vec3::new(54.97, 0.0, 2.55), Vec3::new(55.37, 0.0, 2.35)),
            Some(Team::Right)
        );
        assert_eq!(
            crossed_goal_line(Vec3::new(55.07, 3.5, 1.0), Vec3::new(55.47, 3.9, 1.0)),
            Some(Team::Right)
        );
    }

    #[test]
    fn the_ball_leaves_the_pitch_over_a_goal_line_or_a_side_line() {
        assert_eq!(left_pitch(Vec3::new(55.16, 36.16, 0.11)), None);
        assert_eq!(left_pitch(Vec3::new(-55.18, 10.0, 0.11)), Some(Line::Goal(Team::Left)));
        assert_eq!(left_pitch(Vec3::new(20.0, -36.18, 0.11)), Some(Line::Side));
        assert_eq!(left_pitch(Vec3::new(55.2, 36.2, 0.11)), Some(Line::Goal(Team::Right)));
    }
}
