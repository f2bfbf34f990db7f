//! Grass: mown stripes with a grain, and what lies around the pitch.

use crate::canvas::{Canvas, Px};
use crate::color::{Rgb, mixed};
use crate::marks::Marks;
use crate::math::{hash, within};
use crate::scene::Pitch;
use crate::view::{Row, View};

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
pub(crate) const STADIUM: Lawn = Lawn { stripes: [[80, 156, 66], [64, 138, 56]], verge: [44, 104, 48] };
pub(crate) const PLAN: Lawn = Lawn { stripes: [[58, 122, 72], [65, 131, 79]], verge: [48, 106, 62] };

/// Paints the ground; keeps the tables of its grain.
#[derive(Debug, Default)]
pub(crate) struct Ground {
    fine: Vec<u8>,
    coarse: Vec<u8>,
}

/// The shades of one row's colours.
struct Shades {
    stripes: [[Px; SHADES]; 2],
    verge: [Px; SHADES],
}

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
        Ground { fine: noise(FINE, 1, 36), coarse: noise(COARSE, 2, 29) }
    }

    /// Paints one row of ground with its lines.
    pub(crate) fn paint(&self, row: &Row, px: &mut [Px], pitch: &Pitch, marks: &Marks, lawn: &Lawn, light: f32) {
        let half = [pitch.length_m * 0.5, pitch.width_m * 0.5];
        let mown = row.y.abs() < half[1] + VERGE_M;
        if self.fine.is_empty() {
            self.plain(row, px, half[0], mown, lawn, light);
        } else {
            self.grained(row, px, half[0], mown, lawn, light);
        }
        if row.y.abs() < half[1] + 1.0 + row.dy {
            marks.paint(row, px);
        }
    }

    fn plain(&self, row: &Row, px: &mut [Px], half_x: f32, mown: bool, lawn: &Lawn, light: f32) {
        let [even, odd, verge] = [lawn.stripes[0], lawn.stripes[1], lawn.verge].map(|color| lit(color, light));
        for run in runs(row, px.len(), half_x, mown) {
            let color = [even, odd, verge][run.kind];
            let [r, g, b] = color;
            px[run.from..run.to].fill([r, g, b, 255]);
        }
        soften(row, px, half_x, mown, |kind| [even, odd, verge][kind]);
    }

    fn grained(&self, row: &Row, px: &mut [Px], half_x: f32, mown: bool, lawn: &Lawn, light: f32) {
        let shades = Shades {
            stripes: [shades(lawn.stripes[0], light), shades(lawn.stripes[1], light)],
            verge: shades(lawn.verge, light),
        };
        // A grain is never finer than a pixel.
        let mut per_m = FINE_PER_M;
        while per_m * row.dx > 1.0 && per_m > 0.01 {
            per_m *= 0.5;
        }
        let fixed = |x: f32| (x * 65536.0) as i64 as u32;
        let line = ((row.y * per_m * 0.8) as i64 as usize & (FINE - 1)) * FINE;
        let fine = &self.fine[line..line + FINE];
        let mut u = fixed(row.x0 * per_m);
        let du = fixed(row.dx * per_m);
        let patch = |x: f32| self.patch(x * COARSE_PER_M, row.y * COARSE_PER_M);
        let mut block_end = 0;
        let (mut c, mut dc, mut next) = (0_i32, 0_i32, patch(row.x0));
        for run in runs(row, px.len(), half_x, mown) {
            let table = match run.kind {
                2 => &shades.verge,
                kind => &shades.stripes[kind],
            };
            let mut from = run.from;
            while from < run.to {
                if from >= block_end {
                    block_end = from + BLOCK;
                    let end = patch(row.x0 + block_end as f32 * row.dx);
                    c = (next * 256.0) as i32;
                    dc = ((end - next) * (256.0 / BLOCK as f32)) as i32;
                    next = end;
                }
                let to = run.to.min(block_end);
                for px in &mut px[from..to] {
                    let shade = usize::from(fine[(u >> 16) as usize & (FINE - 1)]) + (c >> 8) as usize;
                    *px = table[shade & (SHADES - 1)];
                    u = u.wrapping_add(du);
                    c += dc;
                }
                from = to;
            }
        }
        soften(row, px, half_x, mown, |kind| match kind {
            2 => lit(lawn.verge, light),
            kind => lit(lawn.stripes[kind], light),
        });
    }

    /// The coarse grain at a place, 0..28.
    fn patch(&self, x: f32, y: f32) -> f32 {
        // Far from zero on the positive side, so that a cast rounds down.
        let (x, y) = (x + 16384.0, y + 16384.0);
        let (i, j) = (x as usize, y as usize);
        let (u, v) = (x - i as f32, y - j as f32);
        let cell = |i: usize, j: usize| f32::from(self.coarse[(j & (COARSE - 1)) * COARSE + (i & (COARSE - 1))]);
        let top = cell(i, j) + (cell(i + 1, j) - cell(i, j)) * u;
        let bottom = cell(i, j + 1) + (cell(i + 1, j + 1) - cell(i, j + 1)) * u;
        top + (bottom - top) * v
    }
}

/// Paints the ground of a whole picture, row by row.
pub(crate) fn paint_all(ground: &Ground, canvas: &mut Canvas<'_>, view: &View, pitch: &Pitch, lawn: &Lawn) {
    let marks = Marks::new(pitch);
    for y in 0..canvas.height {
        if let Some(row) = view.row(y) {
            let width = canvas.width;
            ground.paint(&row, canvas.part(y, 0, width), pitch, &marks, lawn, 1.0);
        }
    }
}

fn lit(color: Rgb, light: f32) -> Rgb {
    color.map(|part| within(f32::from(part) * light, 0.0, 255.0) as u8)
}

fn shades(color: Rgb, light: f32) -> [Px; SHADES] {
    let mut table = [[0, 0, 0, 255]; SHADES];
    for (i, px) in table.iter_mut().enumerate() {
        let by = light * (0.835 + i as f32 * (0.33 / SHADES as f32));
        let [r, g, b] = lit(color, by);
        *px = [r, g, b, 255];
    }
    table
}

/// Pixels of one colour: the stripes 0 and 1, and 2 beside the pitch.
struct Run {
    kind: usize,
    from: usize,
    to: usize,
}

/// The x at which stripes change, from the left: the edge of the mown grass, the stripes' borders, the other edge.
fn border(index: i32, half_x: f32) -> f32 {
    match index {
        0 => -half_x - VERGE_M,
        i if i >= STRIPES => half_x + VERGE_M,
        i => -half_x + i as f32 * (2.0 * half_x / STRIPES as f32),
    }
}

fn kind(index: i32) -> usize {
    if (1..=STRIPES).contains(&index) { (index as usize + 1) % 2 } else { 2 }
}

/// The runs of a row, from the left. Run `i` ends at border `i`.
fn runs(row: &Row, width: usize, half_x: f32, mown: bool) -> impl Iterator<Item = Run> {
    let (x0, inverse) = (row.x0, 1.0 / row.dx);
    let mut from = 0;
    let last = if mown { STRIPES + 1 } else { 0 };
    (0..=last).filter_map(move |index| {
        let to = if index == last {
            width
        } else {
            // The first pixel whose middle is past the border.
            (((border(index, half_x) - x0) * inverse + 1.0) as i64).clamp(0, width as i64) as usize
        };
        let run = Run { kind: if mown { kind(index) } else { 2 }, from, to: to.max(from) };
        from = run.to;
        (run.from < run.to).then_some(run)
    })
}

/// Mixes the colours in the pixel that a border crosses.
fn soften(row: &Row, px: &mut [Px], half_x: f32, mown: bool, color: impl Fn(usize) -> Rgb) {
    if !mown {
        return;
    }
    for index in 0..=STRIPES {
        let at = (border(index, half_x) - row.x0) / row.dx + 0.5;
        if at >= 0.0 && at < px.len() as f32 {
            let share = at - at as usize as f32;
            let [r, g, b] = mixed(color(kind(index + 1)), color(kind(index)), share);
            px[at as usize] = [r, g, b, 255];
        }
    }
}
