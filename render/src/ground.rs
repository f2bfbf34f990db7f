//! Grass: mown stripes with a grain, and what lies around the pitch.

use crate::canvas::{Px, Raster, between, solid};
use crate::color::Rgb;
use crate::marks::Marks;
use crate::math::{hash, within};
use crate::scene::Pitch;
use crate::view::{CameraView, Row};

/// Stripes of the lawn; even, so that both halves look alike.
const STRIPES: i32 = 20;
/// How far the mown grass goes beyond the lines, metres.
const VERGE_M: f32 = 2.0;
/// Shades of a colour that the grain chooses from.
const SHADES: usize = 64;
/// Side of the grain's table, and of the coarse one, both powers of two.
const FINE: usize = 256;
const COARSE: usize = 64;
/// Grains per metre at their finest, and patches per metre.
const FINE_PER_M: f32 = 22.0;
const COARSE_PER_M: f32 = 0.55;
/// Pixels over which the coarse grain is straight.
const BLOCK: usize = 32;

/// The colours of the ground.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lawn {
    pub(crate) stripes: [Rgb; 2],
    pub(crate) verge: Rgb,
}

/// The look of the ground from the stand, and the calmer one of a plan.
pub(crate) const STADIUM: Lawn =
    Lawn { stripes: [[80, 156, 66], [64, 138, 56]], verge: [44, 104, 48] };
pub(crate) const PLAN: Lawn =
    Lawn { stripes: [[58, 122, 72], [65, 131, 79]], verge: [48, 106, 62] };

/// Paints the ground; keeps the tables of its grain.
#[derive(Debug, Default)]
pub(crate) struct Ground {
    fine: Vec<u8>,
    coarse: Vec<u8>,
    /// By the light on a row, from [`LIGHT_LEAST`] on.
    shades: Vec<Shades>,
}

/// The shades of the stripes and of the verge in one light.
type Shades = [[Px; SHADES]; 3];

/// The lights that shades are prepared for.
const LIGHT_LEAST: f32 = 0.9;
const LIGHT_STEP: f32 = 0.005;
const LIGHTS: usize = 45;

impl Ground {
    /// Grass with a grain, or plain grass.
    pub(crate) fn new(grain: bool) -> Ground {
        if !grain {
            return Ground::default();
        }
        let noise = |side: usize, seed: u32, most: u32| {
            let cell = move |i: usize| (hash(i as u32, seed) >> 8) % most;
            // The mean of two is softer than one.
            (0..side * side).map(|i| u32::midpoint(cell(i), cell(i + side * side)) as u8).collect()
        };
        let Lawn { stripes: [even, odd], verge } = STADIUM;
        let shades = (0..LIGHTS).map(|level| {
            let light = LIGHT_LEAST + level as f32 * LIGHT_STEP;
            [even, odd, verge].map(|color| shades(color, light))
        });
        Ground { fine: noise(FINE, 1, 36), coarse: noise(COARSE, 2, 29), shades: shades.collect() }
    }

    /// Paints one row of ground with its lines.
    pub(crate) fn paint(
        &self,
        row: &Row,
        px: &mut [Px],
        pitch: &Pitch,
        marks: &Marks,
        lawn: &Lawn,
        light: f32,
    ) {
        let half = [pitch.length_m * 0.5, pitch.width_m * 0.5];
        let mown = row.y.abs() < half[1] + VERGE_M;
        if self.fine.is_empty() {
            plain(row, px, half[0], mown, lawn, light);
        } else {
            self.grained(row, px, half[0], mown, light);
        }
        if row.y.abs() < half[1] + 1.0 + row.dy {
            marks.paint(row, px);
        }
    }

    fn grained(&self, row: &Row, px: &mut [Px], half_x: f32, mown: bool, light: f32) {
        let level = ((light - LIGHT_LEAST) / LIGHT_STEP) as usize;
        let Some(shades) = self.shades.get(level.min(LIGHTS - 1)) else { return };
        // A grain is never finer than a pixel.
        let mut per_m = FINE_PER_M;
        while per_m * row.dx > 1.0 && per_m > 0.01 {
            per_m *= 0.5;
        }
        // Eight whole bits: a step beyond the table's end wraps by itself.
        let fixed = |x: f32| (x * 16_777_216.0) as i64 as u32;
        let line = (row.y * per_m * 0.8) as i64 as usize & (FINE - 1);
        let Some(fine) = self.fine.as_chunks::<FINE>().0.get(line) else { return };
        let mut u = fixed(row.x0 * per_m);
        let du = fixed(row.dx * per_m);
        let patch = |x: f32| self.patch(x * COARSE_PER_M, row.y * COARSE_PER_M);
        let mut block_end = 0;
        let (mut c, mut dc, mut next) = (0_i32, 0_i32, patch(row.x0));
        runs(row, px.len(), half_x, mown, |kind, mut from, end_of_run| {
            let table = &shades[kind];
            while from < end_of_run {
                if from >= block_end {
                    block_end = from + BLOCK;
                    let end = patch(row.x0 + block_end as f32 * row.dx);
                    c = (next * 256.0) as i32;
                    dc = ((end - next) * (256.0 / BLOCK as f32)) as i32;
                    next = end;
                }
                let to = end_of_run.min(block_end);
                for px in &mut px[from..to] {
                    let shade = usize::from(fine[(u >> 24) as usize]) + (c >> 8) as usize;
                    *px = table[shade & (SHADES - 1)];
                    u = u.wrapping_add(du);
                    c += dc;
                }
                from = to;
            }
        });
        // The middle shade is the colour itself.
        soften(row, px, half_x, mown, |kind| shades[kind][SHADES / 2]);
    }

    /// The coarse grain at a place, 0..28.
    fn patch(&self, x: f32, y: f32) -> f32 {
        // Far from zero on the positive side, so that a cast rounds down.
        let (x, y) = (x + 16384.0, y + 16384.0);
        let (i, j) = (x as usize, y as usize);
        let (u, v) = (x - i as f32, y - j as f32);
        let cell = |i: usize, j: usize| {
            f32::from(self.coarse[(j & (COARSE - 1)) * COARSE + (i & (COARSE - 1))])
        };
        let top = cell(i, j) + (cell(i + 1, j) - cell(i, j)) * u;
        let bottom = cell(i, j + 1) + (cell(i + 1, j + 1) - cell(i, j + 1)) * u;
        top + (bottom - top) * v
    }
}

/// Paints the ground of a whole picture, row by row.
pub(crate) fn paint_all(
    ground: &Ground,
    canvas: &mut Raster<'_>,
    view: &CameraView,
    pitch: &Pitch,
    lawn: &Lawn,
) {
    let marks = Marks::new(pitch);
    for y in 0..canvas.height {
        if let Some(row) = view.row(y) {
            let width = canvas.width;
            ground.paint(&row, canvas.part(y, 0, width), pitch, &marks, lawn, 1.0);
        }
    }
}

/// Grass without a grain.
fn plain(row: &Row, px: &mut [Px], half_x: f32, mown: bool, lawn: &Lawn, light: f32) {
    let colors =
        [lawn.stripes[0], lawn.stripes[1], lawn.verge].map(|color| solid(lit(color, light)));
    runs(row, px.len(), half_x, mown, |kind, from, to| px[from..to].fill(colors[kind]));
    soften(row, px, half_x, mown, |kind| colors[kind]);
}

fn lit(color: Rgb, light: f32) -> Rgb {
    color.map(|part| within(f32::from(part) * light, 0.0, 255.0) as u8)
}

fn shades(color: Rgb, light: f32) -> [Px; SHADES] {
    let mut table = [[0, 0, 0, 255]; SHADES];
    for (i, px) in table.iter_mut().enumerate() {
        let by = light * (0.835 + i as f32 * (0.33 / SHADES as f32));
        *px = solid(lit(color, by));
    }
    table
}

/// The x at which stripes change, from the left: the edge of the mown grass, the stripes' borders,
/// the other edge.
fn border(index: i32, half_x: f32) -> f32 {
    match index {
        0 => -half_x - VERGE_M,
        i if i >= STRIPES => half_x + VERGE_M,
        i => -half_x + i as f32 * (2.0 * half_x / STRIPES as f32),
    }
}

/// The colour between the border before and the one of this index: the stripes 0 and 1, and 2
/// beside the pitch.
fn kind(index: i32) -> usize {
    if (1..=STRIPES).contains(&index) { (index as usize + 1) % 2 } else { 2 }
}

/// The first border that a row may show.
fn first(row: &Row, half_x: f32) -> i32 {
    let stripes = (row.x0 - row.dx + half_x) * (STRIPES as f32 / (2.0 * half_x));
    if row.x0 < -half_x { 0 } else { (stripes as i32).clamp(0, STRIPES) }
}

/// Goes through the runs of one colour of a row, from the left: kind, first pixel, end.
fn runs(
    row: &Row,
    width: usize,
    half_x: f32,
    mown: bool,
    mut take: impl FnMut(usize, usize, usize),
) {
    let inverse = row.per_m;
    let mut from = 0;
    if mown {
        for index in first(row, half_x)..=STRIPES {
            // The first pixel whose middle is past the border.
            let to = (((border(index, half_x) - row.x0) * inverse + 1.0) as i64)
                .clamp(0, width as i64) as usize;
            if from < to {
                take(kind(index), from, to);
                from = to;
            }
            if to == width {
                return;
            }
        }
    }
    if from < width {
        take(2, from, width);
    }
}

/// Mixes the colours in the pixel that a border crosses.
fn soften(row: &Row, px: &mut [Px], half_x: f32, mown: bool, color: impl Fn(usize) -> Px) {
    if !mown {
        return;
    }
    for index in first(row, half_x)..=STRIPES {
        let at = (border(index, half_x) - row.x0) / row.dx + 0.5;
        if at >= px.len() as f32 {
            return;
        }
        if at >= 0.0 {
            let share = ((at - at as usize as f32) * 256.0) as u32;
            px[at as usize] = between(color(kind(index + 1)), color(kind(index)), share);
        }
    }
}
