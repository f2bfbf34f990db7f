//! What nature does to the ball in an episode: gravity, the wind, the air, the ground.

use super::constants::{
    AIR_DRAG, BOUNCE, BOUNCE_FRICTION, BOUNCE_LEAST, BOUNCE_LOSS, GRAVITY, MAGNUS, REST_SPEED,
    ROLL_DRAG, ROLL_DRAG_SQUARE, SPIN_DECAY, TICK_S,
};
use glam::Vec2;
use setpiece_scenario::vocabulary::WorldFigure;

/// The figures that the ball's motion reads, drawn once per episode.
///
/// They are serialized as the scenario's figures, each within its range, so that a snapshot can't
/// hold impossible ones.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(from = "[f32; WorldFigure::ALL.len()]", into = "[f32; WorldFigure::ALL.len()]")]
pub struct Conditions {
    figures: [f32; WorldFigure::ALL.len()],
    /// The wind above the shelter of the ground, m/s.
    pub(super) wind: Vec2,
    /// m/s².
    pub(super) gravity: f32,
    /// See [`AIR_DRAG`].
    pub(super) air_drag: f32,
    /// See [`MAGNUS`].
    pub(super) magnus: f32,
    /// See [`SPIN_DECAY`].
    pub(super) spin_decay: f32,
    /// See [`BOUNCE`].
    pub(super) bounce: f32,
    /// See [`BOUNCE_LOSS`]; at least what a bounce gives back of one tick's fall, so that a ball
    /// comes to rest.
    pub(super) bounce_loss: f32,
    /// See [`BOUNCE_LEAST`]; more than one tick's fall, so that rolling is no bounce.
    pub(super) bounce_least: f32,
    /// See [`BOUNCE_FRICTION`].
    pub(super) bounce_friction: f32,
    /// See [`ROLL_DRAG`].
    pub(super) roll_drag: f32,
    /// See [`ROLL_DRAG_SQUARE`].
    pub(super) roll_drag_square: f32,
    /// See [`REST_SPEED`]; more than one tick's fall.
    pub(super) rest_speed: f32,
}

impl Conditions {
    /// A windless day on grass.
    pub const USUAL: Conditions = {
        let mut figures = [0.0; WorldFigure::ALL.len()];
        let mut i = 0;
        while i < figures.len() {
            figures[i] = WorldFigure::ALL[i].usual() as f32;
            i += 1;
        }
        Conditions::of(figures)
    };

    /// The usual conditions with some figures changed; a value out of its range becomes the nearest
    /// in it, one that is no number the usual one.
    pub fn with(changes: impl IntoIterator<Item = (WorldFigure, f64)>) -> Conditions {
        let mut figures = Conditions::USUAL.figures;
        for (figure, value) in changes {
            let (low, high) = figure.range();
            let value = if value.is_nan() { figure.usual() } else { value.clamp(low, high) };
            figures[figure.index()] = value as f32;
        }
        Conditions::of(figures)
    }

    /// The same with the wind turned by 180°.
    #[must_use]
    pub fn turned(mut self) -> Conditions {
        for wind in [WorldFigure::WindX, WorldFigure::WindY] {
            self.figures[wind.index()] *= -1.0;
        }
        Conditions::of(self.figures)
    }

    /// The scenario's figures, by [`WorldFigure::index`].
    pub fn figures(&self) -> [f32; WorldFigure::ALL.len()] {
        self.figures
    }

    const fn of(figures: [f32; WorldFigure::ALL.len()]) -> Conditions {
        let gravity = figures[WorldFigure::Gravity.index()];
        let bounce = figures[WorldFigure::Bounce.index()];
        let friction = figures[WorldFigure::Friction.index()];
        let fall = gravity * TICK_S;
        Conditions {
            wind: Vec2::new(
                figures[WorldFigure::WindX.index()],
                figures[WorldFigure::WindY.index()],
            ),
            gravity,
            air_drag: AIR_DRAG * figures[WorldFigure::Drag.index()],
            magnus: MAGNUS * figures[WorldFigure::Swerve.index()],
            spin_decay: figures[WorldFigure::SpinDecay.index()],
            bounce,
            bounce_loss: BOUNCE_LOSS.max(1.01 * bounce * fall),
            bounce_least: BOUNCE_LEAST.max(1.5 * fall),
            bounce_friction: BOUNCE_FRICTION * friction,
            roll_drag: ROLL_DRAG * friction,
            roll_drag_square: ROLL_DRAG_SQUARE * friction,
            rest_speed: REST_SPEED.max(1.01 * fall),
            figures,
        }
    }
}

impl Default for Conditions {
    fn default() -> Conditions {
        Conditions::USUAL
    }
}

impl From<[f32; WorldFigure::ALL.len()]> for Conditions {
    fn from(figures: [f32; WorldFigure::ALL.len()]) -> Conditions {
        Conditions::with(WorldFigure::ALL.iter().copied().zip(figures.map(f64::from)))
    }
}

impl From<Conditions> for [f32; WorldFigure::ALL.len()] {
    fn from(conditions: Conditions) -> Self {
        conditions.figures
    }
}

// The engine's figures are those that the language calls usual.
const _: () = {
    let usual = Conditions::USUAL;
    assert!(usual.gravity == GRAVITY && usual.bounce == BOUNCE && usual.spin_decay == SPIN_DECAY);
    assert!(usual.bounce_loss == BOUNCE_LOSS && usual.bounce_least == BOUNCE_LEAST);
    assert!(usual.rest_speed == REST_SPEED);
};
