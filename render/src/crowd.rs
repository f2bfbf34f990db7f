//! The crowd and the boards, painted once per renderer.

use crate::canvas::{Capsule, Raster};
use crate::color::{ACCENTS, Rgb, scaled};
use crate::math::{Vec2, hash, within};
use crate::text::Lettering;
use crate::tile::Tile;

/// Height of a board.
pub(crate) const BOARD_HEIGHT_M: f32 = 1.0;
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
/// Paints the boards at a number of pixels per metre.
pub(crate) fn boards(per_m: f32) -> Tile {
    let mut tile = Tile::new([BOARD_M * BOARDS.len() as f32, BOARD_HEIGHT_M], per_m, [0, 0, 0]);
    let (length, height) = (tile.width as f32 / BOARDS.len() as f32, tile.height as f32);
    let mut canvas = Raster { px: &mut tile.px, width: tile.width, height: tile.height };
    for (i, (word, back, ink)) in BOARDS.iter().enumerate() {
        let (from, to) = (i as f32 * length, (i as f32 + 1.0) * length);
        for y in 0..canvas.height {
            let [r, g, b] = *back;
            canvas.part(y, from as usize, to as usize).fill([r, g, b, 255]);
        }
        if height >= 5.0 {
            let mut style = Lettering::bold(height * 0.62, *ink);
            style.stretch = within(length * 0.8 / style.width(word), 0.5, 1.25);
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

/// Paints a piece of the crowd at a number of pixels per metre.
pub(crate) fn crowd(per_m: f32) -> Tile {
    let size_m = [SEATS as f32 * SEAT_M, ROWS as f32 * SEAT_BACK_M];
    let mut tile = Tile::new(size_m, per_m, [40, 44, 54]);
    let (seat, back) = (tile.width as f32 / SEATS as f32, tile.height as f32 / ROWS as f32);
    let size = tile.width as f32;
    let mut canvas = Raster { px: &mut tile.px, width: tile.width, height: tile.height };
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
                person(
                    &mut canvas,
                    Vec2::new(x, y + 0.3 * back),
                    seat,
                    back,
                    [color; 2],
                    size,
                    aisle,
                );
                continue;
            }
            // Friends sit together.
            let block =
                hash(place as u32 / 7 + 9, (row.rem_euclid(ROWS as i32)) as u32 / 3 + 50) as usize;
            let coat =
                if pick(14, 100) < 45 { COATS[block % 5] } else { COATS[pick(17, COATS.len())] };
            let light = 0.72 + pick(21, 32) as f32 * 0.0085;
            let colors = [scaled(coat, light), scaled(SKINS[pick(26, SKINS.len())], light)];
            person(&mut canvas, Vec2::new(x, y), seat, back, colors, size, false);
        }
    }
    tile
}

/// A spectator: shoulders and head, drawn on both sides of the tile's seam.
fn person(
    canvas: &mut Raster<'_>,
    at: Vec2,
    seat: f32,
    back: f32,
    colors: [Rgb; 2],
    size: f32,
    flat: bool,
) {
    for seam in [-size, 0.0, size] {
        let at = at + Vec2::new(seam, 0.0);
        if at.x < -seat || at.x > canvas.width as f32 + seat {
            continue;
        }
        let radius = seat * 0.4;
        let low = at + Vec2::new(0.0, back * 0.55);
        let body = Capsule { a: at, b: low, ra: radius * 0.92, rb: radius };
        let [coat, skin] = colors;
        let shaded =
            |off: Vec2| scaled(coat, within(1.0 - 0.28 * off.x.abs() - 0.1 * off.y, 0.5, 1.0));
        canvas.capsule(body, 1.0, shaded);
        if !flat {
            let head = at - Vec2::new(0.0, back * 0.36);
            canvas.disc(
                head + Vec2::new(0.0, radius * 0.18),
                radius * 0.66,
                scaled(coat, 0.5),
                0.6,
            );
            canvas.disc(head, radius * 0.58, skin, 1.0);
        }
    }
}
