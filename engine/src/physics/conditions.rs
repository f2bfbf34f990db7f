//! What nature does to the ball in an episode: gravity, the wind, the air, the ground.

use super::constants::{
    AIR_DRAG, BOUNCE, BOUNCE_GRIP, BOUNCE_LEAST, BOUNCE_LOSS, GRAVITY, MAGNUS, REST_SPEED,
    ROLL_DRAG, ROLL_DRAG_SQUARE, SLIDE_DRAG, SPIN_DECAY, TICK_S,
};
use glam::Vec2;
use setpiece_scenario::vocabulary::WorldFigure;

/// The figures that the ball's motion reads, drawn once per episode.
///
/// Each is within its range, so that a snapshot can't hold impossible ones.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(from = "[f32; WorldFigure::ALL.len()]", into = "[f32; WorldFigure::ALL.len()]")]
pub struct Conditions {
    figures: [f32; WorldFigure::ALL.len()],
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
        Conditions { figures }
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
        Conditions { figures }
    }

    /// The same with the wind turned by 180°.
    #[must_use]
    pub fn turned(mut self) -> Conditions {
        for wind in [WorldFigure::WindX, WorldFigure::WindY] {
            self.figures[wind.index()] *= -1.0;
        }
        self
    }

    /// The scenario's figures, by [`WorldFigure::index`].
    pub fn figures(&self) -> [f32; WorldFigure::ALL.len()] {
        self.figures
    }

    #[inline]
    const fn figure(&self, figure: WorldFigure) -> f32 {
        self.figures[figure.index()]
    }

    /// The wind above the shelter of the ground, m/s.
    #[inline]
    pub(super) fn wind(&self) -> Vec2 {
        Vec2::new(self.figure(WorldFigure::WindX), self.figure(WorldFigure::WindY))
    }

    /// m/s².
    #[inline]
    pub(super) const fn gravity(&self) -> f32 {
        self.figure(WorldFigure::Gravity)
    }

    /// See [`AIR_DRAG`].
    #[inline]
    pub(super) const fn air_drag(&self) -> f32 {
        AIR_DRAG * self.figure(WorldFigure::Drag)
    }

    /// See [`MAGNUS`].
    #[inline]
    pub(super) const fn magnus(&self) -> f32 {
        MAGNUS * self.figure(WorldFigure::Swerve)
    }

    /// See [`SPIN_DECAY`].
    #[inline]
    pub(super) const fn spin_decay(&self) -> f32 {
        self.figure(WorldFigure::SpinDecay)
    }

    /// See [`BOUNCE`].
    #[inline]
    pub(super) const fn bounce(&self) -> f32 {
        self.figure(WorldFigure::Bounce)
    }

    /// See [`BOUNCE_LOSS`]; at least what a bounce gives back of one tick's fall, so that a ball
    /// comes to rest.
    #[inline]
    pub(super) const fn bounce_loss(&self) -> f32 {
        BOUNCE_LOSS.max(1.01 * self.bounce() * self.fall())
    }

    /// See [`BOUNCE_LEAST`]; more than one tick's fall, so that rolling is no bounce.
    #[inline]
    pub(super) const fn bounce_least(&self) -> f32 {
        BOUNCE_LEAST.max(1.5 * self.fall())
    }

    /// See [`BOUNCE_GRIP`].
    #[inline]
    pub(super) const fn bounce_grip(&self) -> f32 {
        BOUNCE_GRIP * self.figure(WorldFigure::Friction)
    }

    /// See [`ROLL_DRAG`].
    #[inline]
    pub(super) const fn roll_drag(&self) -> f32 {
        ROLL_DRAG * self.figure(WorldFigure::Friction)
    }

    /// See [`ROLL_DRAG_SQUARE`].
    #[inline]
    pub(super) const fn roll_drag_square(&self) -> f32 {
        ROLL_DRAG_SQUARE * self.figure(WorldFigure::Friction)
    }

    /// See [`SLIDE_DRAG`].
    #[inline]
    pub(super) const fn slide_drag(&self) -> f32 {
        SLIDE_DRAG * self.figure(WorldFigure::Friction)
    }

    /// See [`REST_SPEED`]; more than one tick's fall.
    #[inline]
    pub(super) const fn rest_speed(&self) -> f32 {
        REST_SPEED.max(1.01 * self.fall())
    }

    /// What gravity adds to a fall in a tick, m/s.
    const fn fall(&self) -> f32 {
        self.gravity() * TICK_S
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
    assert!(
        usual.gravity() == GRAVITY && usual.bounce() == BOUNCE && usual.spin_decay() == SPIN_DECAY
    );
    assert!(usual.bounce_loss() == BOUNCE_LOSS && usual.bounce_least() == BOUNCE_LEAST);
    assert!(usual.rest_speed() == REST_SPEED);
};
