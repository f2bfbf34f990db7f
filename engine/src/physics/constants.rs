//! The figures of the ball's world, each with its source.
//!
//! "Measured": taken from the flight of Google Research Football's ball and the series drawn from
//! it. "Laws": the IFAB's Laws of the Game. "Fitted": chosen to match the measured series.

/// Length of a tick, s. An agent's step has ten.
pub const TICK_S: f32 = 0.01;
/// Acceleration of free fall, m/s². Standard gravity.
pub const GRAVITY: f32 = 9.81;
/// Radius of the ball, m. Laws: 0.108–0.111.
pub const BALL_RADIUS: f32 = setpiece_scenario::pitch::BALL_RADIUS_M as f32;
/// Mass of the ball, kg. Laws: 0.410–0.450.
pub const BALL_MASS: f32 = 0.43;
/// Moment of inertia over mass and radius squared. A ball is a thin shell: 2/3.
pub const BALL_INERTIA_SHARE: f32 = 2.0 / 3.0;

/// Air drag over squared speed, 1/m. Measured at 12–30 m/s. (A smooth sphere of this size with a
/// drag coefficient of 0.29 has the same: ½ · 1.2 · 0.038 · 0.29 / 0.43.)
pub const AIR_DRAG: f32 = 0.0155;
/// Magnus acceleration over speed and the product of spin and velocity, s/m. GRF's, within 5 %
/// from 15 to 25 m/s: with 12 rad/s of backspin a shot falls with 7.4 m/s² instead of 9.81.
pub const MAGNUS: f32 = 0.00034;
/// The Magnus effect doesn't grow beyond this spin, rad/s: the lift coefficient of a football
/// levels off near 0.3 (Goff and Carré 2009, "Trajectory analysis of a soccer ball").
pub const MAGNUS_SPIN_MAX: f32 = 60.0;
/// Beyond this speed the Magnus effect grows only in proportion to speed, m/s. Fitted to GRF's
/// strength of swerve by speed, within 4 % from 15 to 35 m/s.
pub const MAGNUS_SPEED_MAX: f32 = 25.5;
/// Share of the spin that the air takes per second. Time constants of balls in flight are 10–20 s.
pub const SPIN_DECAY: f32 = 0.07;

/// Height over which the wind grows from nothing at the ground to its full speed, m. Chosen: a
/// straight line for the steep part of the wind's logarithmic profile. So a ball at rest or rolling
/// lies in the lee of the grass.
pub const WIND_SHELTER: f32 = 2.0;

/// Share of the downward speed that a bounce on grass gives back. Measured: height ratio 0.37.
pub const BOUNCE: f32 = 0.62;
/// Speed that soft grass takes from every bounce in addition, m/s. Fitted; it ends the series of
/// ever smaller bounces.
pub const BOUNCE_LOSS: f32 = 0.065;
/// Below this downward speed a touch of the ground counts as rolling, not as a bounce, m/s.
pub const BOUNCE_LEAST: f32 = 0.15;
/// The largest share of the sliding speed that a bounce takes, and from which to which downward
/// speed that grows, m/s. (GRF's.)
pub const BOUNCE_GRIP: f32 = 0.5;
/// See [`BOUNCE_GRIP`].
pub const BOUNCE_GRIPS: [f32; 2] = [0.5, 12.5];
/// Height of the blades that brake a ball, m above the resting centre. (GRF's are 0.025 high, but
/// brake with the power 0.7 of how deep the ball is in.)
pub const GRASS_DEPTH: f32 = 0.03;
/// Rolling resistance that does not depend on speed, m/s². Measured: a ≈ −(1.6 + 0.055 v²).
pub const ROLL_DRAG: f32 = 1.6;
/// Rolling resistance over squared speed, 1/m: the measured 0.055 minus the air's share.
pub const ROLL_DRAG_SQUARE: f32 = 0.055 - AIR_DRAG;
/// How much of the speed at which a ball slides over the grass the grass takes, 1/s. Measured: a
/// ball that leaves the foot at 30 m/s without spin loses twice what one that rolls does. (GRF's.)
pub const SLIDE_DRAG: f32 = 1.0;
/// The most that grass changes a ball's spin by, rad/s². Measured. (GRF's.)
pub const GRASS_TURN: f32 = 314.0;
/// Share of the spin about the vertical axis that grass takes per second.
pub const ROLL_TWIST_DECAY: f32 = 2.0;

/// Radius of posts and crossbar, m. Laws: at most 0.12 m across. 0.07 is Google Research
/// Football's; the ball then meets the frame 0.18 m from its axis, as in GRF.
pub const FRAME_RADIUS: f32 = 0.07;
/// Share of the normal speed that woodwork gives back. GRF: × 0.8.
pub const FRAME_BOUNCE: f32 = 0.8;
/// Friction of woodwork on leather. Chosen: painted metal.
pub const FRAME_FRICTION: f32 = 0.2;
/// Half the thickness of the nets, m. A ball pressed against a net must never be nearer to its far
/// side.
pub const NET_HALF: f32 = 0.03;
/// Share of the speed that a net gives back. Chosen: a slack net absorbs a shot.
pub const NET_BOUNCE: f32 = 0.1;
/// Friction of a net on leather. Chosen: meshes hold a ball.
pub const NET_FRICTION: f32 = 0.6;

/// Rapier runs if the swept ball comes nearer to a goal than this, m. Its own lookahead is 0.02.
pub const NEAR: f32 = 0.05;
/// A ball slower than this that touches something and is held up lies still, m/s: what gravity adds
/// in a tick.
pub const REST_SPEED: f32 = 0.1;
/// The most spin that rapier gets, rad/s: it turns nothing by more than 45° a tick.
pub const RIGID_SPIN_MAX: f32 = 75.0;
