//! The part of the pitch that a sheet shows.

use crate::scenario::PitchSize;
use setpiece_render::{Camera, PitchRegion};

/// Least size of a region, metres.
const LEAST_M: [f32; 2] = [46.0, 40.0];
/// The narrowest and the widest region: its width over its height.
const ASPECTS: [f32; 2] = [0.8, (RIM_M.0 / RIM_M.1) as f32];
/// The usual pitch with its rim, metres from the centre spot; a smaller one lies in the middle.
const RIM_M: (f64, f64) = PitchSize::USUAL.rim();
/// A region with more than this share of the pitch's length or width shows all of it.
const NEARLY_ALL: f32 = 0.8;

/// The part of the world that a picture shows, world metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Its upper left corner.
    pub corner_m: [f32; 2],
    /// Its width and height.
    pub size_m: [f32; 2],
}

impl Region {
    /// The pitch with its rim.
    pub const WHOLE: Region = Region {
        corner_m: [-RIM_M.0 as f32, -RIM_M.1 as f32],
        size_m: [2.0 * RIM_M.0 as f32, 2.0 * RIM_M.1 as f32],
    };

    /// The camera that shows it from above.
    pub fn camera(&self) -> Camera {
        let [left, top] = self.corner_m;
        let high = [left + self.size_m[0], top + self.size_m[1]];
        Camera::Above(PitchRegion::Box { low: self.corner_m, high })
    }

    /// Width over height.
    pub fn aspect(&self) -> f32 {
        self.size_m[0] / self.size_m[1]
    }

    /// The smallest region that shows these points, each with this much grass around it, metres.
    pub fn around(points: impl Iterator<Item = ([f32; 2], f32)>) -> Region {
        let (mut low, mut high) = ([f32::MAX; 2], [f32::MIN; 2]);
        for (point, margin_m) in points {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis] - margin_m);
                high[axis] = high[axis].max(point[axis] + margin_m);
            }
        }
        // Without any point, low is above high.
        if low[0] > high[0] {
            return Region::WHOLE;
        }
        let most = Region::WHOLE.size_m;
        let span = |axis: usize| {
            let span = (high[axis] - low[axis]).max(LEAST_M[axis]);
            if span > NEARLY_ALL * most[axis] { most[axis] } else { span }
        };
        let width = span(0).max(span(1) * ASPECTS[0]);
        // A region as wide as the pitch is also as high.
        let size_m = [width, span(1).max(width / ASPECTS[1])];
        let corner = |axis: usize| {
            let (size, least) = (size_m[axis], Region::WHOLE.corner_m[axis]);
            (f32::midpoint(low[axis], high[axis]) - size / 2.0).clamp(least, -least - size)
        };
        Region { corner_m: [corner(0), corner(1)], size_m }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_region_shows_its_points_and_stays_on_the_pitch() {
        let points = [[50.0, 30.0], [30.0, 10.0]];
        let region = Region::around(points.into_iter().map(|point| (point, 8.0)));
        assert!(region.size_m[0] < 60.0, "{region:?}");
        for axis in 0..2 {
            assert!(
                region.corner_m[axis] + region.size_m[axis] <= -Region::WHOLE.corner_m[axis],
                "{region:?}"
            );
        }
        for point in points {
            for axis in 0..2 {
                let from = point[axis] - region.corner_m[axis];
                assert!((0.0..region.size_m[axis]).contains(&from), "{point:?} {region:?}");
            }
        }
    }

    #[test]
    fn a_narrow_way_is_shown_upright() {
        let across = Region::around([([50.0, -36.0], 8.0), ([50.0, 36.0], 8.0)].into_iter());
        assert_eq!((across.aspect(), across.size_m[1]), (0.8, 80.0));
    }

    #[test]
    fn a_long_way_is_shown_on_the_whole_pitch() {
        assert_eq!(
            Region::around([([-50.0, 0.0], 8.0), ([50.0, 0.0], 8.0)].into_iter()),
            Region::WHOLE
        );
        assert_eq!(Region::around(std::iter::empty()), Region::WHOLE);
    }
}
