//! Where the camera stands, and where a place of the pitch is in the picture.
//!
//! Neither camera rolls or turns, so one row of the picture shows one line of the ground along x. Everything flat is
//! drawn row by row with one step per pixel.

use crate::math::{Vec2, Vec3, metres, within};
use crate::scene::Pitch;
use serde::{Deserialize, Serialize};

/// How a scene is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Camera {
    /// A plan, north up, so to say: +y is at the bottom.
    Above(Region),
    /// From the stand behind the touch line at +y. It follows the ball, and depends on nothing else.
    #[default]
    Broadcast,
}

/// The part of the ground that a plan shows. What doesn't fit the picture's shape is widened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Region {
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
pub(crate) struct View {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) eye: Eye,
}

/// The two kinds of projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Eye {
    /// World place of the top left corner, pixels per metre.
    Plan { corner: Vec2, scale: f32 },
    /// Perspective.
    Stand(Stand),
}

/// A camera in the stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stand {
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
/// How near to a goal line the camera follows.
const STOP_M: f32 = 13.0;
/// The share of the ball's way across that the camera follows, and how much more on the near side.
const ACROSS: f32 = 0.44;
const NEARER: f32 = 0.16;
/// Margins of the plan beyond goal lines and touch lines.
const MARGIN_M: Vec2 = Vec2::new(4.5, 3.5);

impl View {
    /// Places the camera.
    pub(crate) fn new(camera: Camera, pitch: &Pitch, ball: [f32; 3], width: usize, height: usize) -> View {
        let eye = match camera {
            Camera::Above(region) => plan(region, pitch, width as f32, height as f32),
            Camera::Broadcast => Eye::Stand(stand(pitch, ball, width as f32, height as f32)),
        };
        View { width, height, eye }
    }

    /// Where a place is in the picture; `None` behind the camera.
    pub(crate) fn spot(&self, p: Vec3) -> Option<Spot> {
        match self.eye {
            Eye::Plan { corner, scale } => Some(Spot { at: (Vec2::new(p.x, p.y) - corner) * scale, scale }),
            Eye::Stand(stand) => {
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
            Eye::Plan { corner, scale } => {
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
            Eye::Stand(stand) => {
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
    pub(crate) fn along_x(&self, stand: &Stand, depth: f32, y: f32, dy: f32, slant: f32) -> Row {
        let dx = depth / stand.focal;
        let x0 = stand.pos.x + (0.5 - self.width as f32 * 0.5) * dx;
        Row { y, dy, x0, dx, per_m: stand.focal / depth, eye_x: stand.pos.x, slant }
    }

    /// How flat the ground looks: its height on the screen over its depth.
    pub(crate) fn squash(&self) -> f32 {
        match self.eye {
            Eye::Plan { .. } => 1.0,
            Eye::Stand(stand) => stand.sin,
        }
    }
}

fn stand(pitch: &Pitch, ball: [f32; 3], width: f32, height: f32) -> Stand {
    let (half_x, half_y) = (pitch.length_m * 0.5, pitch.width_m * 0.5);
    // The nearer to a goal line, the less the camera follows: it comes to rest without a jerk.
    let t = within(metres(ball[0]) / (half_x + 3.0), -1.0, 1.0);
    let x = (half_x - STOP_M).max(0.0) * t * (1.5 - 0.5 * t * t);
    let y = within(metres(ball[1]), -half_y, half_y);
    let y = y * (ACROSS + NEARER * y / half_y);
    let distance = (HEIGHT_M * HEIGHT_M + BACK_M * BACK_M).sqrt();
    let focal = (width * distance / SHOWN_M).max(height / SHOWN_UP).max(1.0);
    let ahead = BACK_M + BEYOND_M;
    let ray = (HEIGHT_M * HEIGHT_M + ahead * ahead).sqrt();
    // What a tall picture has more than a wide one, it has at the bottom: the stand fills no more of it.
    let centre = (height * 0.5).min(width * (9.0 / 32.0));
    Stand { pos: Vec3::new(x, y + BACK_M, HEIGHT_M), cos: ahead / ray, sin: HEIGHT_M / ray, focal, centre }
}

fn plan(region: Region, pitch: &Pitch, width: f32, height: f32) -> Eye {
    let half = Vec2::new(pitch.length_m, pitch.width_m) * 0.5 + MARGIN_M;
    let (low, high) = match region {
        Region::Whole => (-half, half),
        Region::LeftHalf => (-half, Vec2::new(MARGIN_M.x, half.y)),
        Region::RightHalf => (Vec2::new(-MARGIN_M.x, -half.y), half),
        Region::Box { low, high } => {
            let (a, b) = (Vec2::new(metres(low[0]), metres(low[1])), Vec2::new(metres(high[0]), metres(high[1])));
            let middle = (a + b) * 0.5;
            let half = ((b - a).abs() * 0.5).max(Vec2::ONE);
            (middle - half, middle + half)
        }
    };
    let size = high - low;
    let scale = (width / size.x).min(height / size.y);
    let corner = (low + high) * 0.5 - Vec2::new(width, height) * (0.5 / scale);
    Eye::Plan { corner, scale }
}

/// The pitch's measures within what can be drawn; the usual ones where they are not numbers.
pub(crate) fn sound(pitch: &Pitch) -> Pitch {
    let usual = Pitch::default();
    let fit = |x: f32, usual: f32, lo: f32, hi: f32| if x.is_nan() { usual } else { x.clamp(lo, hi) };
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
