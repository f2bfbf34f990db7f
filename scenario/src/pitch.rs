//! The pitch and its scale: the figures that all rooms share.
//!
//! World frame: the origin is the centre spot, +x points at the right team's goal, +y at the bottom
//! of the picture, z up. Lengths are metres unless a name says otherwise. Normalised coordinates
//! are Google Research Football's. They use its scale of the ball, for ball and players alike.

/// Metres per unit of normalised x.
pub const X_SCALE_M: f64 = 54.4;
/// Metres per unit of normalised y.
pub const Y_SCALE_M: f64 = 83.6;
/// Half the pitch's length: the goal lines are at x = ±55 m.
pub const HALF_LENGTH_M: f64 = 55.0;
/// Half the pitch's width: the side lines are at y = ±36 m.
pub const HALF_WIDTH_M: f64 = 36.0;
/// Half the width of the goal mouth, between the posts' centres.
pub const GOAL_HALF_WIDTH_M: f64 = 3.7;
/// Height of the crossbar's centre.
pub const GOAL_HEIGHT_M: f64 = 2.5;
/// Depth of the goal behind the line.
pub const GOAL_DEPTH_M: f64 = 2.55;
/// Depth of the penalty box.
pub const BOX_DEPTH_M: f64 = 16.5;
/// Half the width of the penalty box.
pub const BOX_HALF_WIDTH_M: f64 = 20.15;
/// Depth of the goal area.
pub const SIX_YARD_DEPTH_M: f64 = 5.5;
/// Half the width of the goal area.
pub const SIX_YARD_HALF_WIDTH_M: f64 = 9.16;
/// Distance of the penalty spot from the goal line.
pub const PENALTY_SPOT_M: f64 = 11.0;
/// Distance of the goal-kick spot from the goal line.
pub const GOAL_KICK_SPOT_M: f64 = 4.4;
/// Radius of the centre circle and of the D, and the distance that opponents keep at a free kick.
pub const CIRCLE_RADIUS_M: f64 = 9.15;
/// Radius of the ball.
pub const BALL_RADIUS_M: f64 = 0.11;
/// Half the width of a painted line.
pub const LINE_HALF_WIDTH_M: f64 = 0.06;
/// Highest ball at a start, metres.
pub const START_HEIGHT_MAX_M: f64 = 50.0;
/// Fastest ball at a start, m/s; the hardest shots on record are slower by a fifth.
pub const BALL_SPEED_MAX_MPS: f64 = 70.0;
/// Largest spin of the ball at a start about each axis, rad/s; a hard free kick spins at about 60.
pub const BALL_SPIN_MAX: f64 = 200.0;
/// Fastest player at a start, m/s: the fastest sprints on record.
pub const PLAYER_SPEED_MAX_MPS: f64 = 12.0;
/// The most goals of a team at a start.
pub const GOALS_MAX: u16 = 99;
/// The most yellow cards of a player at a start.
pub const YELLOW_CARDS_MAX: u8 = 1;
/// Longest duration in a text, seconds: more than a day of play.
pub const LONGEST_S: f64 = 1.0e5;
/// The most players of one team.
pub const TEAM_MAX: usize = 11;
/// Number of player ids of both teams: `team * 11 + index`.
pub const PLAYERS_MAX: usize = 2 * TEAM_MAX;
/// Steps of an agent per second.
pub const STEPS_PER_S: f64 = 10.0;
/// Seconds of a step.
pub const STEP_S: f64 = 1.0 / STEPS_PER_S;
/// Ticks of physics per step.
pub const TICKS_PER_STEP: u32 = 10;

/// Converts a normalised point to metres.
pub fn to_metres(x: f64, y: f64) -> (f64, f64) {
    (x * X_SCALE_M, y * Y_SCALE_M)
}

/// Converts metres to a normalised point.
pub fn to_normalised(x_m: f64, y_m: f64) -> (f64, f64) {
    (x_m / X_SCALE_M, y_m / Y_SCALE_M)
}
