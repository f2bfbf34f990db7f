//! The painted lines of the pitch, each with the share of a pixel that it covers.

use crate::canvas::{Px, blend, cover};
use crate::color::LINE;
use crate::math::within;
use crate::scene::Pitch;
use crate::view::Row;

/// Half the width of a line, and the least that is drawn, pixels.
const HALF_M: f32 = 0.06;
const HALF_PX: f32 = 0.46;
/// Radius of a painted spot.
const SPOT_M: f32 = 0.2;
/// Radius of the arc at a corner.
const CORNER_M: f32 = 1.0;
/// How white the paint is.
const PAINT: f32 = 0.88;

/// A painted shape.
#[derive(Clone, Copy, Debug)]
enum Mark {
    /// Along x: y, from, to.
    Across(f32, f32, f32),
    /// Along y: x, from, to.
    Along(f32, f32, f32),
    /// Part of a circle.
    Ring { x: f32, y: f32, radius: f32, keep: Keep },
    /// A spot.
    Spot { x: f32 },
}

/// The part of a circle that is painted.
#[derive(Clone, Copy, Debug)]
enum Keep {
    All,
    /// Towards the centre of the pitch from this |x|.
    Below(f32),
    /// Within the pitch.
    Inside(f32, f32),
}

/// Most marks of a pitch.
const MARKS: usize = 32;

/// Everything that is painted on a pitch.
#[derive(Debug)]
pub(crate) struct Marks {
    list: [Mark; MARKS],
    count: usize,
}

impl Marks {
    /// The laws' lines for these measures.
    pub(crate) fn new(pitch: &Pitch) -> Marks {
        let mut marks = Marks { list: [Mark::Spot { x: 0.0 }; MARKS], count: 1 };
        let (x, y) = (pitch.length_m * 0.5, pitch.width_m * 0.5);
        for side in [-1.0, 1.0] {
            marks.push(Mark::Across(side * y, -x, x));
            marks.push(Mark::Along(side * x, -y, y));
            for (depth, width) in [
                (pitch.box_depth_m, pitch.box_width_m),
                (pitch.six_yard_depth_m, pitch.six_yard_width_m),
            ] {
                let (inner, half) = (x - depth, width * 0.5);
                marks.push(Mark::Along(side * inner, -half, half));
                let (from, to) = if side > 0.0 { (inner, x) } else { (-x, -inner) };
                marks.push(Mark::Across(-half, from, to));
                marks.push(Mark::Across(half, from, to));
            }
            let spot = x - pitch.spot_m;
            marks.push(Mark::Spot { x: side * spot });
            let keep = Keep::Below(x - pitch.box_depth_m);
            marks.push(Mark::Ring { x: side * spot, y: 0.0, radius: pitch.circle_m, keep });
            for corner in [-y, y] {
                marks.push(Mark::Ring {
                    x: side * x,
                    y: corner,
                    radius: CORNER_M,
                    keep: Keep::Inside(x, y),
                });
            }
        }
        marks.push(Mark::Along(0.0, -y, y));
        marks.push(Mark::Ring { x: 0.0, y: 0.0, radius: pitch.circle_m, keep: Keep::All });
        marks
    }

    fn push(&mut self, mark: Mark) {
        if let Some(place) = self.list.get_mut(self.count) {
            *place = mark;
            self.count += 1;
        }
    }

    /// Paints what a row shows of them.
    pub(crate) fn paint(&self, row: &Row, px: &mut [Px]) {
        for mark in &self.list[..self.count] {
            match *mark {
                Mark::Across(y, from, to) => across(row, px, y, from, to),
                Mark::Along(x, from, to) => along(row, px, x, from, to),
                Mark::Ring { x, y, radius, keep } => ring(row, px, [x, y], radius, keep),
                Mark::Spot { x } => spot(row, px, x),
            }
        }
    }
}

/// The share of a row between two y.
fn share(row: &Row, from: f32, to: f32) -> f32 {
    let (top, bottom) = (row.y - row.dy * 0.5, row.y + row.dy * 0.5);
    let covered = to.min(bottom) - from.max(top);
    if covered <= 0.0 { 0.0 } else { covered / row.dy }
}

fn column(row: &Row, x: f32) -> f32 {
    (x - row.x0) * row.per_m + 0.5
}

fn clip(from: f32, to: f32, px: &[Px]) -> std::ops::Range<usize> {
    let clip = |x: f32| (x as i64).clamp(0, px.len() as i64) as usize;
    let (from, to) = (clip(from), clip(to + 1.0));
    from..to.max(from)
}

fn across(row: &Row, px: &mut [Px], y: f32, from: f32, to: f32) {
    let half = HALF_M.max(row.dy * HALF_PX);
    if (row.y - y).abs() > half + row.dy {
        return;
    }
    band(row, px, from - HALF_M, to + HALF_M, 1.0, share(row, y - half, y + half));
}

fn along(row: &Row, px: &mut [Px], x: f32, from: f32, to: f32) {
    let covered = share(row, from - HALF_M, to + HALF_M);
    if covered > 0.0 {
        let half = HALF_M.max(row.dx * HALF_PX);
        let blur = ((x - row.eye_x) * row.slant).abs().max(1.0);
        band(row, px, x - half, x + half, blur, covered);
    }
}

/// Paints between two x, with edges as wide as `blur` pixels.
fn band(row: &Row, px: &mut [Px], from: f32, to: f32, blur: f32, covered: f32) {
    let (left, right) = (column(row, from), column(row, to));
    if right < -blur || left > px.len() as f32 + blur {
        return;
    }
    let edge = 1.0 / blur;
    let pad = blur * 0.5 + 1.0;
    let whole = clip(left - pad, right + pad - 1.0, px);
    // Between the two edges the line covers every pixel alike.
    let inner = clip(left + pad, right - pad - 1.0, px);
    let (start, end) =
        if inner.is_empty() { (whole.end, whole.end) } else { (inner.start, inner.end) };
    let mut edges = |range: std::ops::Range<usize>| {
        let mut at = range.start as f32 + 0.5;
        for px in &mut px[range] {
            let before = within((at - left) * edge + 0.5, 0.0, 1.0);
            let after = within((at - right) * edge + 0.5, 0.0, 1.0);
            blend(px, LINE, cover((before - after) * covered * PAINT));
            at += 1.0;
        }
    };
    edges(whole.start..start);
    edges(end..whole.end);
    let cover = cover(covered * PAINT);
    for px in &mut px[start..end] {
        blend(px, LINE, cover);
    }
}

fn ring(row: &Row, px: &mut [Px], centre: [f32; 2], radius: f32, keep: Keep) {
    let away = row.y - centre[1];
    let pad = HALF_M + 1.5 * row.dy.max(row.dx);
    let outer = radius + pad;
    if radius <= 0.0 || away.abs() > outer {
        return;
    }
    let middle = column(row, centre[0]);
    let wide = outer * row.per_m;
    if middle + wide < 0.0 || middle - wide > px.len() as f32 {
        return;
    }
    let reach = (outer * outer - away * away).sqrt();
    let hole = (radius - pad).max(0.0);
    let hole = (hole * hole - away * away).max(0.0).sqrt();
    if hole == 0.0 {
        arc(row, px, centre, radius, keep, -reach, reach);
    } else {
        arc(row, px, centre, radius, keep, -reach, -hole);
        arc(row, px, centre, radius, keep, hole, reach);
    }
}

/// The pixels of a circle between two offsets from its middle.
fn arc(row: &Row, px: &mut [Px], centre: [f32; 2], radius: f32, keep: Keep, from: f32, to: f32) {
    let dy = row.y - centre[1];
    let range = clip(column(row, centre[0] + from) - 0.5, column(row, centre[0] + to) + 0.5, px);
    let mut x = row.x0 + range.start as f32 * row.dx;
    for px in &mut px[range] {
        let dx = x - centre[0];
        let kept = match keep {
            Keep::All => true,
            Keep::Below(limit) => x.abs() < limit,
            Keep::Inside(half_x, half_y) => x.abs() < half_x && row.y.abs() < half_y,
        };
        x += row.dx;
        if kept {
            let distance = (dx * dx + dy * dy).sqrt().max(1e-3);
            // How much of the ground a pixel shows across the line.
            let shown = (dx.abs() * row.dx + dy.abs() * row.dy) / distance;
            let half = HALF_M.max(shown * HALF_PX);
            let share = (half - (distance - radius).abs()) / shown + 0.5;
            blend(px, LINE, cover(within(share, 0.0, 1.0) * PAINT));
        }
    }
}

fn spot(row: &Row, px: &mut [Px], x: f32) {
    let half = SPOT_M.max(row.dy * 0.6);
    let covered = share(row, -half, half);
    if covered > 0.0 {
        let inside = within(1.0 - (row.y / half) * (row.y / half), 0.2, 1.0).sqrt();
        let reach = (SPOT_M * inside).max(row.dx * 0.6);
        band(row, px, x - reach, x + reach, 1.0, covered);
    }
}
