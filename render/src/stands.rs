//! What surrounds the pitch: boards with the project's name, stands with a crowd.
//!
//! Both are painted once, at the picture's own size, and then laid into each frame row by row.

use crate::canvas::{Canvas, Capsule, Px};
use crate::color::{ACCENTS, Rgb, scaled};
use crate::ground::{Ground, STADIUM};
use crate::marks::Marks;
use crate::math::{Vec2, hash, mix, within};
use crate::scene::Pitch;
use crate::text::Style;
use crate::view::{Eye, Row, Stand, View};

/// Distance of the boards from the lines.
const BOARDS_Y_M: f32 = 5.0;
const BOARDS_X_M: f32 = 6.5;
const BOARD_HEIGHT_M: f32 = 1.0;
/// Where the stand begins behind the boards, how high, and how steep it is: metres up per metre back.
const STAND_BACK_M: f32 = 1.6;
const STAND_LOW_M: f32 = 1.3;
const STEEP: f32 = 0.62;
/// The roof begins here.
const STAND_TOP_M: f32 = 22.0;
/// Distance from row to row and from seat to seat.
const SEAT_BACK_M: f32 = 0.92;
const SEAT_M: f32 = 0.56;
/// The repeating piece of the crowd: so many seats by so many rows.
const SEATS: usize = 80;
const ROWS: usize = 12;
/// A board is so long; the words alternate.
const BOARD_M: f32 = 9.0;
const BOARDS: [(&str, Rgb, Rgb); 4] = [
    ("SETPIECE", [16, 22, 34], [240, 244, 250]),
    (".PITCH", ACCENTS[0], [30, 20, 8]),
    ("SETPIECE", [236, 240, 244], [20, 44, 110]),
    ("PLAY - LEARN", ACCENTS[1], [250, 250, 255]),
];
/// Typical distance of the far stand from the camera, metres.
const AWAY_M: f32 = 95.0;

/// A picture that repeats.
#[derive(Debug, Default)]
struct Tile {
    px: Vec<Px>,
    width: usize,
    height: usize,
    per_m: f32,
}

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
        let view = View::new(crate::Camera::Broadcast, &Pitch::default(), [0.0; 3], width, height);
        let per_m = match view.eye {
            Eye::Stand(stand) => within(stand.focal / AWAY_M, 0.5, 40.0),
            Eye::Plan { .. } => 1.0,
        };
        let (crowd, boards) = (crowd(per_m), boards(per_m));
        let line = vec![[0, 0, 0, 255]; crowd.width.max(boards.width) + 1];
        Stands { crowd, boards, line }
    }

    /// Paints everything behind the players: stands, boards, ground.
    pub(crate) fn paint(
        &mut self,
        canvas: &mut Canvas<'_>,
        view: &View,
        stand: &Stand,
        pitch: &Pitch,
        ground: &Ground,
    ) {
        let marks = Marks::new(pitch);
        let far = -pitch.width_m * 0.5 - BOARDS_Y_M;
        let width = canvas.width;
        for y in 0..canvas.height {
            let row = view.row(y).filter(|row| row.y > far);
            let px = canvas.part(y, 0, width);
            match row {
                Some(row) => {
                    // Far grass is a little lighter and paler.
                    let light = 1.0 + 0.0022 * (stand.pos.y - row.y - 50.0);
                    ground.paint(&row, px, pitch, &marks, &STADIUM, within(light, 0.9, 1.12));
                    let shade = row.y - far;
                    if shade < 2.5 {
                        darken(px, 0.55 + 0.18 * shade);
                    }
                }
                None => self.behind(view, stand, y, far, px),
            }
        }
        self.sides(canvas, stand, pitch, far);
    }

    /// A row of the far boards and the stand above them.
    fn behind(&mut self, view: &View, stand: &Stand, y: usize, far: f32, px: &mut [Px]) {
        let down = (y as f32 + 0.5 - view.height as f32 * 0.5) / stand.focal;
        let (along, fall) = (stand.cos - down * stand.sin, stand.sin + down * stand.cos);
        let back = stand.pos.y - far;
        let depth = back / along.max(1e-3);
        let z = stand.pos.z - depth * fall;
        if z < BOARD_HEIGHT_M {
            let row = view.along_x(stand, depth, far, 1.0, 0.0);
            let v = (BOARD_HEIGHT_M - z) * self.boards.per_m;
            self.boards.lay(&mut self.line, &row, v, 0.0, px, 256);
            return;
        }
        // Where the ray meets the slope.
        let foot = back + STAND_BACK_M;
        let depth = (stand.pos.z - STAND_LOW_M + STEEP * foot) / (fall + STEEP * along).max(1e-3);
        let up = depth * along - foot;
        if up < 0.0 {
            px.fill([28, 31, 38, 255]);
            return;
        }
        let z = STAND_LOW_M + STEEP * up;
        if z > STAND_TOP_M {
            let dark = within(30.0 - (z - STAND_TOP_M) * 0.5, 14.0, 30.0) as u8;
            px.fill([dark, dark + 2, dark + 8, 255]);
            return;
        }
        let row = view.along_x(stand, depth, 0.0, 1.0, 0.0);
        let slope = up * self.crowd.per_m;
        let block = (slope / self.crowd.height as f32) as usize;
        let v = self.crowd.height as f32 - 1.0 - (slope - block as f32 * self.crowd.height as f32);
        let light = mix(0.95, 0.5, within(z / STAND_TOP_M, 0.0, 1.0));
        self.crowd.lay(&mut self.line, &row, v, block as f32 * 17.3, px, (light * 256.0) as u32);
    }

    /// The boards behind the goals. A column of the picture shows one depth of their plane.
    fn sides(&self, canvas: &mut Canvas<'_>, stand: &Stand, pitch: &Pitch, far: f32) {
        let (middle, centre) = (canvas.width as f32 * 0.5, canvas.height as f32 * 0.5);
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
                    let share = within(at + 0.5 - top, 0.0, 1.0) * within(bottom - at + 0.5, 0.0, 1.0);
                    let color = self.boards.near(world_y * side, (at - top) * inverse);
                    let shaded = scaled([color[0], color[1], color[2]], 0.8);
                    crate::canvas::blend(
                        &mut canvas.part(y, column, column + 1)[0],
                        shaded,
                        crate::canvas::cover(share),
                    );
                }
            }
        }
    }
}

impl Tile {
    /// Lays one line of the tile, `v` from its top, into a row of pixels; `light` of 256.
    fn lay(&self, line: &mut [Px], row: &Row, v: f32, shift_m: f32, px: &mut [Px], light: u32) {
        // First down, then along: two reads per pixel.
        let v = within(v - 0.5, 0.0, self.height as f32 - 1.001);
        let (top, part) = (v as usize, ((v - v as usize as f32) * 256.0) as u32);
        let upper = &self.px[top * self.width..][..self.width];
        let lower = &self.px[(top + 1).min(self.height - 1) * self.width..][..self.width];
        for ((to, a), b) in line.iter_mut().zip(upper).zip(lower) {
            for i in 0..3 {
                to[i] = (((u32::from(a[i]) * (256 - part) + u32::from(b[i]) * part) * light) >> 16) as u8;
            }
        }
        line[self.width] = line[0];
        let size = self.width as f32 / self.per_m;
        let start = (row.x0 + shift_m) / size + 64.0;
        let start = (start - start as i64 as f32) * self.width as f32;
        let all = (self.width as u32) << 12;
        let mut u = (within(start, 0.0, self.width as f32 - 0.01) * 4096.0) as u32;
        let du = ((row.dx * self.per_m * 4096.0) as u32).min(all - 1);
        for px in px {
            let (at, part) = ((u >> 12) as usize, (u >> 4) & 255);
            let (a, b) = (line[at], line[at + 1]);
            let blend = |i: usize| ((u32::from(a[i]) * (256 - part) + u32::from(b[i]) * part) >> 8) as u8;
            *px = [blend(0), blend(1), blend(2), 255];
            u += du;
            if u >= all {
                u -= all;
            }
        }
    }

    /// The pixel nearest to a place.
    fn near(&self, x_m: f32, v: f32) -> Px {
        let size = self.width as f32 / self.per_m;
        let turns = x_m / size + 64.0;
        let u = ((turns - turns as i64 as f32) * self.width as f32) as usize;
        self.px[(v as usize).min(self.height - 1) * self.width + u.min(self.width - 1)]
    }
}

fn darken(px: &mut [Px], by: f32) {
    let by = (within(by, 0.0, 1.0) * 256.0) as u32;
    for px in px {
        for part in &mut px[..3] {
            *part = ((u32::from(*part) * by) >> 8) as u8;
        }
    }
}

fn tile(width: usize, height: usize, per_m: f32, color: Rgb) -> Tile {
    let (width, height) = (width.max(1), height.max(1));
    Tile { px: vec![[color[0], color[1], color[2], 255]; width * height], width, height, per_m }
}

fn boards(per_m: f32) -> Tile {
    let width = (BOARD_M * BOARDS.len() as f32 * per_m) as usize;
    let mut tile = tile(width, (BOARD_HEIGHT_M * per_m + 0.5) as usize, per_m, [0, 0, 0]);
    tile.per_m = tile.width as f32 / (BOARD_M * BOARDS.len() as f32);
    let (length, height) = (tile.width as f32 / BOARDS.len() as f32, tile.height as f32);
    let mut canvas = Canvas { px: &mut tile.px, width: tile.width, height: tile.height };
    for (i, (word, back, ink)) in BOARDS.iter().enumerate() {
        let (from, to) = (i as f32 * length, (i as f32 + 1.0) * length);
        for y in 0..canvas.height {
            let [r, g, b] = *back;
            canvas.part(y, from as usize, to as usize).fill([r, g, b, 255]);
        }
        if height >= 5.0 {
            let mut style = Style::bold(height * 0.62, *ink);
            style.stretch = within(length * 0.8 / style.width(word), 0.5, 1.6);
            style.centre(&mut canvas, word, Vec2::new((from + to) * 0.5, height * 0.5));
        }
    }
    tile
}

/// Shirts in the crowd: mostly the teams' colours and the greys of coats.
const COATS: [Rgb; 9] = [
    ACCENTS[0],
    [214, 140, 28],
    ACCENTS[1],
    [60, 92, 168],
    [206, 210, 216],
    [92, 98, 110],
    [54, 58, 70],
    [132, 116, 104],
    [150, 52, 48],
];
const SKINS: [Rgb; 4] = [[226, 184, 152], [198, 150, 118], [146, 102, 76], [96, 66, 50]];

fn crowd(per_m: f32) -> Tile {
    let (width, height) = (SEATS as f32 * SEAT_M * per_m, ROWS as f32 * SEAT_BACK_M * per_m);
    let mut tile = tile(width as usize, height as usize, per_m, [40, 44, 54]);
    tile.per_m = tile.width as f32 / (SEATS as f32 * SEAT_M);
    let (seat, back) = (tile.width as f32 / SEATS as f32, tile.height as f32 / ROWS as f32);
    let size = tile.width as f32;
    let mut canvas = Canvas { px: &mut tile.px, width: tile.width, height: tile.height };
    // From the top, where the furthest row is; one row more on either side closes the pattern.
    for row in -1..=ROWS as i32 {
        for place in 0..SEATS as i32 {
            let dice = hash(place as u32, (row.rem_euclid(ROWS as i32)) as u32 + 100);
            let pick = |shift: u32, of: usize| (dice >> shift) as usize % of;
            let aisle = place % 40 < 2;
            let x = (place as f32 + 0.5 + (pick(3, 16) as f32 - 7.5) * 0.012) * seat;
            let y = (row as f32 + 0.5 + (pick(7, 16) as f32 - 7.5) * 0.014) * back;
            if aisle || pick(11, 100) < 7 {
                let color = if aisle { [74, 78, 86] } else { [58, 66, 88] };
                person(&mut canvas, Vec2::new(x, y + 0.3 * back), seat, back, [color; 2], size, aisle);
                continue;
            }
            // Friends sit together.
            let block = hash(place as u32 / 7 + 9, (row.rem_euclid(ROWS as i32)) as u32 / 3 + 50) as usize;
            let coat = if pick(14, 100) < 45 { COATS[block % 5] } else { COATS[pick(17, COATS.len())] };
            let light = 0.72 + pick(21, 32) as f32 * 0.0085;
            let colors = [scaled(coat, light), scaled(SKINS[pick(26, SKINS.len())], light)];
            person(&mut canvas, Vec2::new(x, y), seat, back, colors, size, false);
        }
    }
    tile
}

/// A spectator: shoulders and head, drawn on both sides of the tile's seam.
fn person(canvas: &mut Canvas<'_>, at: Vec2, seat: f32, back: f32, colors: [Rgb; 2], size: f32, flat: bool) {
    for seam in [-size, 0.0, size] {
        let at = at + Vec2::new(seam, 0.0);
        if at.x < -seat || at.x > canvas.width as f32 + seat {
            continue;
        }
        let radius = seat * 0.4;
        let low = at + Vec2::new(0.0, back * 0.55);
        let body = Capsule { a: at, b: low, ra: radius * 0.92, rb: radius };
        let [coat, skin] = colors;
        let shaded = |off: Vec2| scaled(coat, within(1.0 - 0.28 * off.x.abs() - 0.1 * off.y, 0.5, 1.0));
        canvas.capsule(body, 1.0, shaded);
        if !flat {
            let head = at - Vec2::new(0.0, back * 0.36);
            canvas.disc(head + Vec2::new(0.0, radius * 0.18), radius * 0.66, scaled(coat, 0.5), 0.6);
            canvas.disc(head, radius * 0.58, skin, 1.0);
        }
    }
}
