//! How the world lies in a picture.

use crate::scenario::pitch::{RIM_X_M, RIM_Y_M};
use tiny_skia::Point;

/// Width over height of every picture of the pitch: what a player may stand on is 120 by 80 m.
pub const ASPECT: f32 = (RIM_X_M / RIM_Y_M) as f32;
/// A region is no smaller than this, metres.
const WIDTH_LEAST_M: f32 = 56.0;
/// Beyond this share of the pitch's width all of it is shown.
const NEARLY_ALL: f32 = 0.8;

/// The part of the world that a picture shows, world metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Its left side.
    pub left_m: f32,
    /// Its upper side.
    pub top_m: f32,
    /// Its width; it is [`ASPECT`] times as wide as high.
    pub width_m: f32,
}

impl Region {
    /// The pitch with its rim.
    pub const WHOLE: Region = Region { left_m: -RIM_X_M as f32, top_m: -RIM_Y_M as f32, width_m: 2.0 * RIM_X_M as f32 };

    /// The smallest region that shows these points with some grass around them.
    pub fn around(points: impl Iterator<Item = [f32; 2]>, margin_m: f32) -> Region {
        let (mut low, mut high) = ([f32::MAX; 2], [f32::MIN; 2]);
        for point in points {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis] - margin_m);
                high[axis] = high[axis].max(point[axis] + margin_m);
            }
        }
        let whole = Region::WHOLE;
        let width_m = (high[0] - low[0]).max((high[1] - low[1]) * ASPECT).max(WIDTH_LEAST_M);
        // Also where there was no point at all.
        if width_m > NEARLY_ALL * whole.width_m || low[0] > high[0] {
            return whole;
        }
        let height_m = width_m / ASPECT;
        let place = |low: f32, high: f32, size: f32, least: f32| {
            (f32::midpoint(low, high) - size / 2.0).clamp(least, -least - size)
        };
        Region {
            left_m: place(low[0], high[0], width_m, whole.left_m),
            top_m: place(low[1], high[1], height_m, whole.top_m),
            width_m,
        }
    }
}

/// A region laid over a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    region: Region,
    scale: f32,
}

impl View {
    /// The region over the whole width of a picture.
    pub fn new(region: Region, width: u32) -> View {
        View { region, scale: width as f32 / region.width_m }
    }

    /// Where a point of the world lies, pixels.
    pub fn point(&self, x_m: f32, y_m: f32) -> Point {
        Point { x: (x_m - self.region.left_m) * self.scale, y: (y_m - self.region.top_m) * self.scale }
    }

    /// A length in pixels.
    pub fn length(&self, metres: f32) -> f32 {
        metres * self.scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_region_shows_its_points_and_stays_on_the_pitch() {
        let points = [[50.0, 30.0], [30.0, 10.0]];
        let region = Region::around(points.into_iter(), 8.0);
        assert!(region.width_m < 80.0, "{region:?}");
        assert!(region.left_m + region.width_m <= 60.0 && region.top_m + region.width_m / ASPECT <= 40.0, "{region:?}");
        let view = View::new(region, 600);
        for [x, y] in points {
            let at = view.point(x, y);
            assert!((0.0..600.0).contains(&at.x) && (0.0..400.0).contains(&at.y), "{at:?}");
        }
    }

    #[test]
    fn a_long_way_is_shown_on_the_whole_pitch() {
        assert_eq!(Region::around([[-50.0, 0.0], [50.0, 0.0]].into_iter(), 8.0), Region::WHOLE);
        assert_eq!(Region::around(std::iter::empty(), 8.0), Region::WHOLE);
    }
}
