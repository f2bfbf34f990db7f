//! What surrounds the pitch: boards with the project's name, stands with a crowd.
//!
//! Both are painted once, at the picture's own size, and then laid into each frame row by row.

use crate::canvas::{Px, Raster};
use crate::crowd::{BOARD_HEIGHT_M, boards, crowd};
use crate::ground::{Ground, STADIUM};
use crate::marks::Marks;
use crate::math::{mix, within};
use crate::scene::Pitch;
use crate::tile::Tile;
use crate::view::{CameraEye, CameraView, StandView};

/// Distance of the boards from the lines.
const BOARDS_Y_M: f32 = 5.0;
const BOARDS_X_M: f32 = 6.5;
/// Where the stand begins behind the boards, how high, and how steep it is: metres up per metre
/// back.
const STAND_BACK_M: f32 = 1.6;
const STAND_LOW_M: f32 = 1.3;
const STEEP: f32 = 0.62;
/// The roof begins here.
const STAND_TOP_M: f32 = 22.0;
/// How far the pieces of the crowd are shifted against each other, from the front to the back.
const SHIFT_M: f32 = 17.3;
/// The wall below the first row.
const WALL: Px = [28, 31, 38, 255];
/// Typical distance of the far stand from the camera, metres.
const AWAY_M: f32 = 95.0;

/// Crowd and boards, ready to be laid into a frame.
#[derive(Debug)]
pub(crate) struct Stands {
    crowd: Tile,
    boards: Tile,
    line: Vec<Px>,
}

impl Stands {
    /// Paints crowd and boards for a picture of this size.
    pub(crate) fn new(width: usize, height: usize) -> Stands {
        let view =
            CameraView::new(crate::Camera::Broadcast, &Pitch::default(), [0.0; 3], width, height);
        let per_m = match view.eye {
            CameraEye::StandView(stand) => within(stand.focal / AWAY_M, 0.5, 40.0),
            CameraEye::PlanView { .. } => 1.0,
        };
        let (crowd, boards) = (crowd(per_m), boards(per_m));
        let line = vec![[0, 0, 0, 255]; crowd.width.max(boards.width)];
        Stands { crowd, boards, line }
    }

    /// Paints everything behind the players: stands, boards, ground.
    pub(crate) fn paint(
        &mut self,
        canvas: &mut Raster<'_>,
        view: &CameraView,
        stand: &StandView,
        pitch: &Pitch,
        ground: &Ground,
    ) {
        let marks = Marks::new(pitch);
        let far = -pitch.width_m * 0.5 - BOARDS_Y_M;
        let width = canvas.width;
        for y in 0..canvas.height {
            let row = view.row(y).filter(|row| row.y > far);
            let px = canvas.part(y, 0, width);
            let depth = match row {
                Some(row) => {
                    // Far grass is a little lighter and paler.
                    let light = 1.0 + 0.0022 * (stand.pos.y - row.y - 50.0);
                    ground.paint(&row, px, pitch, &marks, &STADIUM, within(light, 0.9, 1.12));
                    let shade = row.y - far;
                    if shade < 2.5 {
                        darken(px, 0.6 + 0.16 * shade);
                    }
                    row.dx * stand.focal
                }
                None => self.behind(view, stand, y, far, px),
            };
            for side in [-1.0, 1.0] {
                self.beside(stand, y, depth, side, pitch, px);
            }
        }
        self.sides(canvas, stand, pitch, far);
    }

    /// A row of the far boards and the stand above them; returns how far away it is.
    fn behind(
        &mut self,
        view: &CameraView,
        stand: &StandView,
        y: usize,
        far: f32,
        px: &mut [Px],
    ) -> f32 {
        let (along, fall) = ray(stand, y);
        let back = stand.pos.y - far;
        let depth = back / along.max(1e-3);
        let z = stand.pos.z - depth * fall;
        if z < BOARD_HEIGHT_M {
            let row = view.along_x(stand, depth, far, 1.0, 0.0);
            let v = (BOARD_HEIGHT_M - z) * self.boards.down;
            self.boards.lay(&mut self.line, &row, v, 0.0, px, 256);
            return depth;
        }
        // Where the ray meets the slope.
        let foot = back + STAND_BACK_M;
        let depth = (stand.pos.z - STAND_LOW_M + STEEP * foot) / (fall + STEEP * along).max(1e-3);
        let up = depth * along - foot;
        if up < 0.0 {
            px.fill(WALL);
            return depth;
        }
        let z = STAND_LOW_M + STEEP * up;
        if z > STAND_TOP_M {
            px.fill(roof(z));
            return depth;
        }
        let row = view.along_x(stand, depth, 0.0, 1.0, 0.0);
        let (block, v) = self.seats(up);
        self.crowd.lay(
            &mut self.line,
            &row,
            v,
            block * SHIFT_M,
            px,
            (seat_light(z) * 256.0) as u32,
        );
        depth
    }

    /// The stands behind the goals: pixels of a row, from the picture's edge inwards, that show one
    /// before `depth`.
    #[allow(clippy::too_many_arguments, reason = "a row, a plane, and where it is")]
    fn beside(
        &self,
        stand: &StandView,
        y: usize,
        depth: f32,
        side: f32,
        pitch: &Pitch,
        px: &mut [Px],
    ) {
        let (along, fall) = ray(stand, y);
        let off = pitch.length_m * 0.5 + BOARDS_X_M + STAND_BACK_M - side * stand.pos.x;
        let above = stand.pos.z - STAND_LOW_M + STEEP * off;
        let middle = px.len() as f32 * 0.5;
        for step in 0..px.len() / 2 {
            let column = if side > 0.0 { px.len() - 1 - step } else { step };
            let right = side * (column as f32 + 0.5 - middle) / stand.focal;
            if off >= depth * right {
                return;
            }
            let reach = above / (fall + STEEP * right).max(1e-3);
            let up = reach * right - off;
            if reach >= depth {
                // Before this stand there is a part of the other one.
                continue;
            }
            let z = STAND_LOW_M + STEEP * up;
            px[column] = if up < 0.0 {
                WALL
            } else if z > STAND_TOP_M {
                roof(z)
            } else {
                let (block, v) = self.seats(up);
                let along_y = (stand.pos.y - reach * along) * side;
                self.crowd.at(along_y + block * SHIFT_M, v, (seat_light(z) * 218.0) as u32)
            };
        }
    }

    /// The piece of the crowd at a distance up the slope, and the line of its tile.
    fn seats(&self, up: f32) -> (f32, f32) {
        let (slope, height) = (up * self.crowd.down, self.crowd.height as f32);
        let block = (slope / height) as usize as f32;
        (block, height - 1.0 - (slope - block * height))
    }

    /// The boards behind the goals. A column of the picture shows one depth of their plane.
    fn sides(&self, canvas: &mut Raster<'_>, stand: &StandView, pitch: &Pitch, far: f32) {
        let (middle, centre) = (canvas.width as f32 * 0.5, stand.centre);
        for side in [-1.0, 1.0] {
            let off = side * (pitch.length_m * 0.5 + BOARDS_X_M) - stand.pos.x;
            for column in 0..canvas.width {
                let right = column as f32 + 0.5 - middle;
                if right * off <= 0.0 {
                    continue;
                }
                let depth = stand.focal * off / right;
                let row_of = |z: f32| {
                    let down = ((stand.pos.z - z) / depth - stand.sin) / stand.cos;
                    centre + down * stand.focal
                };
                let (top, bottom) = (row_of(BOARD_HEIGHT_M), row_of(0.0));
                let place = |row: f32| {
                    let down = (row - centre) / stand.focal;
                    stand.pos.y - depth * (stand.cos - down * stand.sin)
                };
                if bottom < 0.0 || top >= canvas.height as f32 || place(bottom) < far {
                    continue;
                }
                let clip = |x: f32| (x as i64).clamp(0, canvas.height as i64) as usize;
                let inverse = self.boards.height as f32 / (bottom - top);
                for y in clip(top)..clip(bottom + 1.0) {
                    let at = y as f32 + 0.5;
                    let world_y = place(at);
                    if world_y < far {
                        continue;
                    }
                    let share =
                        within(at + 0.5 - top, 0.0, 1.0) * within(bottom - at + 0.5, 0.0, 1.0);
                    let [r, g, b, _] = self.boards.at(world_y * side, (at - top) * inverse, 205);
                    crate::canvas::blend(
                        &mut canvas.part(y, column, column + 1)[0],
                        [r, g, b],
                        crate::canvas::cover(share),
                    );
                }
            }
        }
    }
}

/// How far forward and how far down the rays of a row go per metre of depth.
fn ray(stand: &StandView, y: usize) -> (f32, f32) {
    let down = (y as f32 + 0.5 - stand.centre) / stand.focal;
    (stand.cos - down * stand.sin, stand.sin + down * stand.cos)
}

/// The light on the seats: the roof shades the upper ones.
fn seat_light(z: f32) -> f32 {
    mix(0.95, 0.5, within(z / STAND_TOP_M, 0.0, 1.0))
}

fn roof(z: f32) -> Px {
    let dark = within(30.0 - (z - STAND_TOP_M) * 0.5, 14.0, 30.0) as u8;
    [dark, dark + 2, dark + 8, 255]
}

fn darken(px: &mut [Px], by: f32) {
    let by = (within(by, 0.0, 1.0) * 256.0) as u32;
    for px in px {
        for part in &mut px[..3] {
            *part = ((u32::from(*part) * by) >> 8) as u8;
        }
    }
}
