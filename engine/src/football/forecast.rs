//! Where the ball will be if nobody touches it: a coarse look ahead of 3.2 s, reckoned again after every touch.
//!
//! Decides what players believe, never where the ball goes: that is `physics`.

use crate::physics;
use crate::state::{Ball, Match};
use glam::Vec3;

/// Points of a forecast.
pub const POINTS: usize = 64;
/// Ticks between two points.
pub const SPACING_TICKS: u32 = 5;

/// The ball's path.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Forecast {
    #[serde(with = "crate::snapshot::array")]
    points: [Vec3; POINTS],
    from_tick: u32,
}

impl Forecast {
    /// Nothing known.
    pub const fn blank() -> Forecast {
        Forecast { points: [Vec3::ZERO; POINTS], from_tick: u32::MAX }
    }

    /// The path of a ball from a tick on.
    pub fn of(ball: &Ball, tick: u32) -> Forecast {
        let mut points = [ball.pos; POINTS];
        if let Some((_, rest)) = points.split_first_mut() {
            physics::forecast(ball, rest, SPACING_TICKS);
        }
        Forecast { points, from_tick: tick }
    }

    /// The ball at a tick.
    pub fn at(&self, tick: u32) -> Vec3 {
        let past = tick.saturating_sub(self.from_tick);
        let i = (past / SPACING_TICKS) as usize;
        if i + 1 >= POINTS {
            return self.points[POINTS - 1];
        }
        let share = (past % SPACING_TICKS) as f32 / SPACING_TICKS as f32;
        self.points[i] + (self.points[i + 1] - self.points[i]) * share
    }

    /// The points from a tick on, each with its time from then, seconds.
    pub fn from(&self, tick: u32) -> impl Iterator<Item = (f32, Vec3)> {
        let past = tick.saturating_sub(self.from_tick);
        let first = ((past / SPACING_TICKS) as usize).min(POINTS - 1);
        let offset = past as f32 * 0.01;
        self.points[first..]
            .iter()
            .enumerate()
            .map(move |(i, &point)| ((((first + i) as u32 * SPACING_TICKS) as f32 * 0.01 - offset).max(0.0), point))
    }

    /// Whether it covers a tick and the ball is where it said.
    pub fn holds(&self, ball: &Ball, tick: u32) -> bool {
        tick >= self.from_tick && tick - self.from_tick < 100 && self.at(tick).distance_squared(ball.pos) < 0.15 * 0.15
    }
}

/// Reckons the forecast again where it no longer holds.
pub fn refresh(game: &mut Match) {
    if !game.play.forecast.holds(&game.ball, game.tick) {
        game.play.forecast = Forecast::of(&game.ball, game.tick);
    }
}

/// Reckons the forecast again after a touch.
pub fn renew(game: &mut Match) {
    game.play.forecast = Forecast::of(&game.ball, game.tick);
}
