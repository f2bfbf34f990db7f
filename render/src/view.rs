//! Where the camera stands, and where a place of the pitch is in the picture.
//!
//! Neither camera rolls or turns, so one row of the picture shows one line of the ground along x.
//! Everything flat is drawn row by row with one step per pixel.

use crate::math::{Vec2, Vec3, metres, within};
use crate::scene::Pitch;
use serde::{Deserialize, Serialize};

/// How a scene is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Camera {
    /// A plan, north up, so to say: +y is at the bottom.
    Above(PitchRegion),
    /// From the stand behind the touch line at +y. It follows the ball, and depends on nothing
    /// else.
    #[default]
    Broadcast,
}

/// The part of the ground that a plan shows. What doesn't fit the picture's shape is widened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PitchRegion {
    /// The pitch with a margin for the goals.
    #[default]
    Whole,
    /// The half at −x.
    LeftHalf,
    /// The half at +x.
    RightHalf,
    /// A box in metres.
    Box {
        /// Least x and y.
        low: [f32; 2],
        /// Greatest x and y.
        high: [f32; 2],
    },
}

/// A place in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spot {
    /// Pixels from the left and the top.
    pub(crate) at: Vec2,
    /// Pixels per metre there.
    pub(crate) scale: f32,
}

/// What one row of the picture shows of a plane that runs along x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Row {
    /// World y.
    pub(crate) y: f32,
    /// Metres of y between this row and the next.
    pub(crate) dy: f32,
    /// World x at the middle of the first pixel.
    pub(crate) x0: f32,
    /// Metres of x per pixel, and pixels per metre.
    pub(crate) dx: f32,
    pub(crate) per_m: f32,
    /// The camera's x: lines towards it are upright in the picture.
    pub(crate) eye_x: f32,
    /// Pixels that a line along y shifts between this row and the next, per metre from `eye_x`.
    pub(crate) slant: f32,
}

/// A camera in place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CameraView {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) eye: CameraEye,
}

/// The two kinds of projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum CameraEye {
    /// World place of the top left corner, pixels per metre.
    PlanView { corner: Vec2, scale: f32 },
    /// Perspective.
    StandView(StandView),
}

/// A camera in the stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StandView {
    /// Its place.
    pub(crate) pos: Vec3,
    /// Cosine and sine of how far it looks down.
    pub(crate) cos: f32,
    pub(crate) sin: f32,
    /// Pixels per metre at one metre's distance.
    pub(crate) focal: f32,
    /// The picture's row that the camera looks along.
    pub(crate) centre: f32,
}

/// The camera's height above the ground, and its distance from the point that it looks at.
const HEIGHT_M: f32 = 22.0;
const BACK_M: f32 = 47.0;
/// How far beyond that point the middle of the picture is, so that the stand is seen.
const BEYOND_M: f32 = 5.0;
/// How much of x the middle of a picture shows, at least; tall pictures show less.
const SHOWN_M: f32 = 45.0;
/// Least height of a picture in units of its distance.
const SHOWN_UP: f32 = 0.78;
/// How much is shown behind a goal line where the camera stops following.
const BEHIND_M: f32 = 9.5;
/// How far above the camera's direction a picture reaches, over its distance.
const UPWARD: f32 = 0.244;
/// The share of the ball's way across that the camera follows, and how much more on the near side.
const ACROSS: f32 = 0.44;
const NEARER: f32 = 0.16;
/// Margins of the plan beyond goal lines and touch lines.
const MARGIN_M: Vec2 = Vec2::new(4.5, 3.5);

impl CameraView {
    /// Places the camera.
    pub(crate) fn new(
        camera: Camera,
        pitch: &Pitch,
        ball: [f32; 3],
        width: usize,
        height: usize,
    ) -> CameraView {
        let eye = match camera {
            Camera::Above(region) => plan(region, pitch, width as f32, height as f32),
            Camera::Broadcast => {
                CameraEye::StandView(stand(pitch, ball, width as f32, height as f32))
            }
        };
        CameraView { width, height, eye }
    }

    /// Where a place is in the picture; `None` behind the camera.
    pub(crate) fn spot(&self, p: Vec3) -> Option<Spot> {
        match self.eye {
            CameraEye::PlanView { corner, scale } => {
                Some(Spot { at: (Vec2::new(p.x, p.y) - corner) * scale, scale })
            }
            CameraEye::StandView(stand) => {
                let (away, up) = (stand.pos.y - p.y, p.z - stand.pos.z);
                let depth = away * stand.cos - up * stand.sin;
                if depth < 1.0 {
                    return None;
                }
                let scale = stand.focal / depth;
                let x = self.width as f32 * 0.5 + (p.x - stand.pos.x) * scale;
                let y = stand.centre - (away * stand.sin + up * stand.cos) * scale;
                Some(Spot { at: Vec2::new(x, y), scale })
            }
        }
    }

    /// The ground that a row shows, if it shows any.
    pub(crate) fn row(&self, index: usize) -> Option<Row> {
        match self.eye {
            CameraEye::PlanView { corner, scale } => {
                let step = 1.0 / scale;
                Some(Row {
                    y: corner.y + (index as f32 + 0.5) * step,
                    dy: step,
                    x0: corner.x + 0.5 * step,
                    dx: step,
                    per_m: scale,
                    eye_x: 0.0,
                    slant: 0.0,
                })
            }
            CameraEye::StandView(stand) => {
                let ray = |y: f32| {
                    let down = (y - stand.centre) / stand.focal;
                    (stand.cos - down * stand.sin, stand.sin + down * stand.cos)
                };
                let (along, fall) = ray(index as f32 + 0.5);
                let (above, below) = (ray(index as f32), ray(index as f32 + 1.0));
                if above.1 < 1e-3 {
                    return None;
                }
                let depth = stand.pos.z / fall;
                let dy = stand.pos.z * (above.0 / above.1 - below.0 / below.1);
                let slant = stand.focal / stand.pos.z * (below.1 - above.1);
                Some(self.along_x(&stand, depth, stand.pos.y - depth * along, dy, slant))
            }
        }
    }

    /// A row at a depth.
    pub(crate) fn along_x(
        &self,
        stand: &StandView,
        depth: f32,
        y: f32,
        dy: f32,
        slant: f32,
    ) -> Row {
        let dx = depth / stand.focal;
        let x0 = stand.pos.x + (0.5 - self.width as f32 * 0.5) * dx;
        Row { y, dy, x0, dx, per_m: stand.focal / depth, eye_x: stand.pos.x, slant }
    }

    /// How flat the ground looks: its height on the screen over its depth.
    pub(crate) fn squash(&self) -> f32 {
        match self.eye {
            CameraEye::PlanView { .. } => 1.0,
            CameraEye::StandView(stand) => stand.sin,
        }
    }
}

fn stand(pitch: &Pitch, ball: [f32; 3], width: f32, height: f32) -> StandView {
    let (half_x, half_y) = (pitch.length_m * 0.5, pitch.width_m * 0.5);
    let distance = (HEIGHT_M * HEIGHT_M + BACK_M * BACK_M).sqrt();
    let focal = (width * distance / SHOWN_M).max(height / SHOWN_UP).max(1.0);
    // The nearer to a goal line, the less the camera follows: it comes to rest without a jerk.
    let stop = half_x - (width * 0.5 * distance / focal - BEHIND_M).max(2.0);
    let t = within(metres(ball[0]) / (half_x + 3.0), -1.0, 1.0);
    let x = stop.max(0.0) * t * (1.5 - 0.5 * t * t);
    let y = within(metres(ball[1]), -half_y, half_y);
    let y = y * (ACROSS + NEARER * y / half_y);
    let ahead = BACK_M + BEYOND_M;
    let ray = (HEIGHT_M * HEIGHT_M + ahead * ahead).sqrt();
    // What a tall picture has more than a wide one, it has at the bottom: the stand fills no more
    // of it.
    let centre = (height * 0.5).min(focal * UPWARD);
    StandView {
        pos: Vec3::new(x, y + BACK_M, HEIGHT_M),
        cos: ahead / ray,
        sin: HEIGHT_M / ray,
        focal,
        centre,
    }
}

fn plan(region: PitchRegion, pitch: &Pitch, width: f32, height: f32) -> CameraEye {
    let half = Vec2::new(pitch.length_m, pitch.width_m) * 0.5 + MARGIN_M;
    let (low, high) = match region {
        PitchRegion::Whole => (-half, half),
        PitchRegion::LeftHalf => (-half, Vec2::new(MARGIN_M.x, half.y)),
        PitchRegion::RightHalf => (Vec2::new(-MARGIN_M.x, -half.y), half),
        PitchRegion::Box { low, high } => {
            let (a, b) = (
                Vec2::new(metres(low[0]), metres(low[1])),
                Vec2::new(metres(high[0]), metres(high[1])),
            );
            let middle = (a + b) * 0.5;
            let half = ((b - a).abs() * 0.5).max(Vec2::ONE);
            (middle - half, middle + half)
        }
    };
    let size = high - low;
    let scale = (width / size.x).min(height / size.y);
    let corner = (low + high) * 0.5 - Vec2::new(width, height) * (0.5 / scale);
    CameraEye::PlanView { corner, scale }
}

/// The pitch's measures within what can be drawn; the usual ones where they are not numbers.
pub(crate) fn sound(pitch: &Pitch) -> Pitch {
    let usual = Pitch::default();
    let fit =
        |x: f32, usual: f32, lo: f32, hi: f32| if x.is_nan() { usual } else { x.clamp(lo, hi) };
    let length_m = fit(pitch.length_m, usual.length_m, 10.0, 300.0);
    let width_m = fit(pitch.width_m, usual.width_m, 10.0, 300.0);
    let (half, across) = (length_m * 0.5, width_m);
    Pitch {
        length_m,
        width_m,
        goal_width_m: fit(pitch.goal_width_m, usual.goal_width_m, 0.5, across),
        goal_height_m: fit(pitch.goal_height_m, usual.goal_height_m, 0.3, 10.0),
        goal_depth_m: fit(pitch.goal_depth_m, usual.goal_depth_m, 0.2, 6.0),
        box_depth_m: fit(pitch.box_depth_m, usual.box_depth_m, 0.0, half),
        box_width_m: fit(pitch.box_width_m, usual.box_width_m, 0.0, across),
        six_yard_depth_m: fit(pitch.six_yard_depth_m, usual.six_yard_depth_m, 0.0, half),
        six_yard_width_m: fit(pitch.six_yard_width_m, usual.six_yard_width_m, 0.0, across),
        spot_m: fit(pitch.spot_m, usual.spot_m, 0.0, half),
        circle_m: fit(pitch.circle_m, usual.circle_m, 0.0, half),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZES: [(usize, usize); 6] =
        [(1280, 720), (96, 72), (72, 96), (84, 84), (16, 16), (480, 854)];

    fn views(ball: [f32; 3]) -> impl Iterator<Item = CameraView> {
        SIZES.into_iter().map(move |(width, height)| {
            CameraView::new(Camera::Broadcast, &Pitch::default(), ball, width, height)
        })
    }

    #[test]
    fn a_row_shows_the_ground_that_is_projected_onto_it() {
        for view in views([20.0, 7.0, 0.11]) {
            for index in 0..view.height {
                let Some(row) = view.row(index) else { continue };
                let column = view.width as f32 * 0.8;
                let place = Vec3::new(row.x0 + (column - 0.5) * row.dx, row.y, 0.0);
                let at = view.spot(place).unwrap().at;
                assert!(
                    (at.y - index as f32 - 0.5).abs() < 0.05 && (at.x - column).abs() < 0.05,
                    "{at} {index}"
                );
            }
        }
    }

    #[test]
    fn the_ball_is_in_the_picture_wherever_it_is_on_the_pitch() {
        for x in -11..=11 {
            for y in -9..=9 {
                let ball = [x as f32 * 5.0, y as f32 * 4.0, 0.11];
                for view in views(ball) {
                    let at = view.spot(Vec3::from_array(ball)).unwrap().at;
                    let inside = at.x > 0.0
                        && at.y > 0.0
                        && at.x < view.width as f32
                        && at.y < view.height as f32;
                    assert!(inside, "{ball:?} at {at} of {}x{}", view.width, view.height);
                }
            }
        }
    }

    #[test]
    fn a_mirrored_ball_gives_a_mirrored_view() {
        for (left, right) in views([-31.0, 8.0, 0.11]).zip(views([31.0, 8.0, 0.11])) {
            let (a, b) = (
                left.spot(Vec3::new(-40.0, 3.0, 1.0)).unwrap(),
                right.spot(Vec3::new(40.0, 3.0, 1.0)).unwrap(),
            );
            assert_eq!(a.scale, b.scale);
            assert!((a.at.x + b.at.x - left.width as f32).abs() < 1e-2 && a.at.y == b.at.y);
        }
    }

    #[test]
    fn the_camera_moves_no_faster_than_the_ball_by_much() {
        let eye = |x: f32| match CameraView::new(
            Camera::Broadcast,
            &Pitch::default(),
            [x, 0.0, 0.11],
            1280,
            720,
        )
        .eye
        {
            CameraEye::StandView(stand) => stand.pos.x,
            CameraEye::PlanView { .. } => f32::NAN,
        };
        for step in -700..700 {
            let x = step as f32 * 0.1;
            let moved = eye(x + 0.1) - eye(x);
            assert!((-1e-4..0.12).contains(&moved), "{x}: {moved}");
        }
    }
}
