//! What `world { … }` sets: the figures of nature that an episode plays under.

use super::words;

words! {
    /// A figure of the world that a scenario may set.
    WorldFigure {
        Gravity = "gravity", "acceleration of free fall, m/s²";
        WindX = "wind_x", "the wind's speed along x from 2 m above the ground on, m/s";
        WindY = "wind_y", "the wind's speed along y, m/s";
        Drag = "drag", "the air's resistance, as a multiple of the usual one";
        Swerve = "swerve", "how strongly spin bends a flight, as a multiple of the usual strength";
        SpinDecay = "spin_decay", "share of the spin that the air takes per second";
        Bounce = "bounce", "share of the downward speed that a bounce on the ground gives back";
        Friction = "friction", "the ground's grip on a ball that rolls or bounces, as a multiple of the usual one";
    }
}

/// The strongest wind, m/s: a gale, in which no match is played.
pub const WIND_MAX_MPS: f64 = 20.0;

impl WorldFigure {
    /// The value without a setting.
    pub const fn usual(self) -> f64 {
        match self {
            WorldFigure::Gravity => 9.81,
            WorldFigure::WindX | WorldFigure::WindY => 0.0,
            WorldFigure::Drag | WorldFigure::Swerve | WorldFigure::Friction => 1.0,
            WorldFigure::SpinDecay => 0.07,
            WorldFigure::Bounce => 0.62,
        }
    }

    /// The least and greatest value. Within them a ball comes to rest in calm air, whatever
    /// its spin.
    pub const fn range(self) -> (f64, f64) {
        match self {
            WorldFigure::Gravity => (1.0, 30.0),
            WorldFigure::WindX | WorldFigure::WindY => (-WIND_MAX_MPS, WIND_MAX_MPS),
            WorldFigure::Drag => (0.2, 5.0),
            WorldFigure::Swerve => (0.0, 3.0),
            WorldFigure::SpinDecay => (0.01, 1.0),
            WorldFigure::Bounce => (0.0, 0.95),
            WorldFigure::Friction => (0.1, 5.0),
        }
    }
}
