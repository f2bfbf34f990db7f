//! When the whole of the ball is over a line. (What that means is the referee's.)

use super::constants::BALL_RADIUS;
use glam::Vec3;
use setpiece_scenario::pitch;
use setpiece_scenario::vocabulary::Team;

/// The ball's centre is farther out than this in x when the whole ball is over the goal line, m: 55.17.
pub const OUT_X: f32 = pitch::HALF_LENGTH_M as f32 + pitch::LINE_HALF_WIDTH_M as f32 + BALL_RADIUS;
/// The ball's centre is farther out than this in y when the whole ball is over a side line, m: 36.17.
pub const OUT_Y: f32 = pitch::HALF_WIDTH_M as f32 + pitch::LINE_HALF_WIDTH_M as f32 + BALL_RADIUS;

const MOUTH_HALF: f32 = pitch::GOAL_HALF_WIDTH_M as f32;
const MOUTH_HEIGHT: f32 = pitch::GOAL_HEIGHT_M as f32;

/// A line that the ball is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// The goal line at a team's end.
    Goal(Team),
    /// A side line.
    Side,
}

/// Whose goal the whole ball went into between two ticks: under the bar and between the posts where its path crosses
/// the far edge of the line.
pub fn crossed_goal_line(before: Vec3, after: Vec3) -> Option<Team> {
    let team = if after.x > 0.0 { Team::Right } else { Team::Left };
    let (from, to) = (before.x.abs(), after.x.abs());
    if to <= OUT_X || from > OUT_X || before.x * after.x < 0.0 {
        return None;
    }
    let at = before.lerp(after, (OUT_X - from) / (to - from));
    (at.y.abs() < MOUTH_HALF && at.z < MOUTH_HEIGHT).then_some(team)
}

/// The line that the whole ball is over, if it is off the pitch. Over both at a corner, it is the goal line.
pub fn left_pitch(pos: Vec3) -> Option<Line> {
    if pos.x.abs() > OUT_X {
        Some(Line::Goal(if pos.x > 0.0 { Team::Right } else { Team::Left }))
    } else if pos.y.abs() > OUT_Y {
        Some(Line::Side)
    } else {
        None
    }
}
