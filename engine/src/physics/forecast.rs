//! Where the ball will be if nobody touches it: a coarse lookahead of 3.2 s, computed again after
//! every touch.
//!
//! This is what players expect of the ball. The ball itself moves by [`super::advance_ball`].

use super::predict::places;
use super::{Ball, Conditions, left_pitch};
use crate::rows::WIDTH;
use glam::Vec3;
use setpiece_scenario::PitchSize;
use std::ops::Range;
use wide::f32x4;

/// Points of a forecast.
pub const POINTS: usize = 64;
/// Ticks between two points.
pub const SPACING_TICKS: u32 = 5;

/// The ball's path: a structure of arrays.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Forecast {
    /// World metres, a point every [`SPACING_TICKS`].
    #[serde(with = "crate::floats")]
    x: [f32; POINTS],
    /// World metres.
    #[serde(with = "crate::floats")]
    y: [f32; POINTS],
    /// World metres.
    #[serde(with = "crate::floats")]
    z: [f32; POINTS],
    /// The points off the pitch, one bit each.
    off: u64,
    /// The most that the ball moves along the ground between two points, metres.
    stride_m: f32,
    /// The tick of the first point.
    from_tick: u32,
}

impl Forecast {
    /// A forecast that knows nothing.
    pub const fn blank() -> Forecast {
        let zero = [0.0; POINTS];
        Forecast { x: zero, y: zero, z: zero, off: 0, stride_m: 0.0, from_tick: u32::MAX }
    }

    /// Computes the path of a ball from a tick on.
    pub fn of(ball: &Ball, pitch: &PitchSize, conditions: &Conditions, tick: u32) -> Forecast {
        let mut forecast = Forecast { from_tick: tick, ..Forecast::blank() };
        let points = std::iter::once(ball.pos).chain(places(ball, conditions, SPACING_TICKS));
        for (i, point) in (0..POINTS).zip(points) {
            (forecast.x[i], forecast.y[i], forecast.z[i]) = (point.x, point.y, point.z);
            forecast.off |= u64::from(left_pitch(pitch, point).is_some()) << i;
        }
        let steps = forecast.x.windows(2).zip(forecast.y.windows(2));
        let squared = |(x, y): (&[f32], &[f32])| (x[1] - x[0]).powi(2) + (y[1] - y[0]).powi(2);
        forecast.stride_m = steps.map(squared).fold(0.0, f32::max).sqrt();
        forecast
    }

    /// A point of the forecast, world metres.
    pub fn point(&self, i: usize) -> Vec3 {
        Vec3::new(self.x[i], self.y[i], self.z[i])
    }

    /// Four points of the forecast: their places on the pitch along each axis.
    #[inline]
    pub(crate) fn row(&self, row: usize) -> [f32x4; 2] {
        [four(&self.x, row), four(&self.y, row)]
    }

    /// The heights of four points of the forecast.
    pub(crate) fn heights(&self, row: usize) -> f32x4 {
        four(&self.z, row)
    }

    /// The last point at or before a tick, and the seconds from the forecast's first point to that
    /// tick.
    pub fn first(&self, tick: u32) -> (usize, f32) {
        let past = tick.saturating_sub(self.from_tick);
        (((past / SPACING_TICKS) as usize).min(POINTS - 1), past as f32 * 0.01)
    }

    /// The points from one on, up to the first that is off the pitch.
    pub fn on_pitch(&self, first: usize) -> Range<usize> {
        first..POINTS.min(first + (self.off >> first).trailing_zeros() as usize)
    }

    /// The most that the ball moves along the ground between two points, metres.
    pub fn stride_m(&self) -> f32 {
        self.stride_m
    }

    /// The ball at a tick.
    pub fn at(&self, tick: u32) -> Vec3 {
        let past = tick.saturating_sub(self.from_tick);
        let i = (past / SPACING_TICKS) as usize;
        if i + 1 >= POINTS {
            return self.point(POINTS - 1);
        }
        let share = (past % SPACING_TICKS) as f32 / SPACING_TICKS as f32;
        let from = self.point(i);
        from + (self.point(i + 1) - from) * share
    }

    /// The points from a tick on, each with its time from then, seconds.
    pub fn from(&self, tick: u32) -> impl Iterator<Item = (f32, Vec3)> {
        let (first, offset_s) = self.first(tick);
        (first..POINTS).map(move |i| (time_s(i, offset_s), self.point(i)))
    }

    /// Whether the forecast covers a tick and the ball is where it predicted.
    pub fn holds(&self, ball: &Ball, tick: u32) -> bool {
        tick >= self.from_tick
            && tick - self.from_tick < 100
            && self.at(tick).distance_squared(ball.pos) < 0.15 * 0.15
    }
}

/// A row of a column.
#[inline]
fn four(column: &[f32; POINTS], row: usize) -> f32x4 {
    f32x4::new(column.as_chunks::<WIDTH>().0[row])
}

/// The time from a moment to a point, if the moment is this many seconds after the first point.
pub fn time_s(point: usize, offset_s: f32) -> f32 {
    ((point as u32 * SPACING_TICKS) as f32 * 0.01 - offset_s).max(0.0)
}
