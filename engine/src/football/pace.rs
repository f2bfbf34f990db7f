//! How fast players run and want to run, and the length of a tick.

/// Speed with the dribble key, m/s.
pub const DRIBBLE_MPS: f32 = 3.5;
/// Speed without sprint, m/s.
pub const RUN_MPS: f32 = 5.0;
/// The speed that a sprinting player asks for, m/s: above everyone's top speed.
pub const SPRINT_MPS: f32 = 8.0;
/// Speed with the dribble key and the ball, m/s. Measured.
pub const DRIBBLE_WITH_BALL_MPS: f32 = 3.7;
/// Speed without sprint with the ball, m/s. Measured.
pub const RUN_WITH_BALL_MPS: f32 = 5.0;

/// From this speed on a runner dribbles rather than stands, m/s. (GRF's gaits.)
pub const DRIBBLES_FROM_MPS: f32 = 1.8;
/// From this speed on a runner walks rather than dribbles, m/s. (GRF's gaits.)
pub const WALKS_FROM_MPS: f32 = 4.2;
/// From this speed on a runner sprints, m/s. (GRF's gaits.)
pub const SPRINTS_FROM_MPS: f32 = 6.0;

/// Length of a tick, seconds.
pub const DT: f32 = 0.01;
/// Wanted speed (m/s) per metre of distance.
pub const ARRIVAL_PER_S: f32 = 2.6;
