//! The picture's memory, and the few shapes that everything is made of: capsules, discs, boxes,
//! triangles.
//!
//! A shape covers a pixel by its signed distance to the pixel's centre, which smooths its edge by
//! itself.

use crate::color::Rgb;
use crate::math::{Vec2, within};

/// One pixel: red, green, blue, opacity.
pub(crate) type Px = [u8; 4];

/// A picture that is being drawn.
pub(crate) struct Raster<'a> {
    pub(crate) px: &'a mut [Px],
    pub(crate) width: usize,
    pub(crate) height: usize,
}

/// Whole pixels: from (inclusive) to (exclusive).
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowSpan {
    pub(crate) x0: usize,
    pub(crate) x1: usize,
    pub(crate) y0: usize,
    pub(crate) y1: usize,
}

/// A tapered capsule in pixels: a disc of radius `ra` at `a` drawn along to one of radius `rb` at
/// `b`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Capsule {
    pub(crate) a: Vec2,
    pub(crate) b: Vec2,
    pub(crate) ra: f32,
    pub(crate) rb: f32,
}

/// Every other byte of a pixel: two parts are computed in one number.
const PAIR: u32 = 0x00ff_00ff;

/// The pixel `share` (of 256) of the way from `a` to `b`.
#[inline]
pub(crate) fn between(a: Px, b: Px, share: u32) -> Px {
    let (a, b, keep) = (u32::from_le_bytes(a), u32::from_le_bytes(b), 256 - share);
    let even = ((a & PAIR) * keep + (b & PAIR) * share) >> 8;
    let odd = ((a >> 8) & PAIR) * keep + ((b >> 8) & PAIR) * share;
    ((even & PAIR) | (odd & !PAIR)).to_le_bytes()
}

/// Lays a colour over a pixel; `cover` is 0..=256.
#[inline]
pub(crate) fn blend(px: &mut Px, color: Rgb, cover: u32) {
    *px = between(*px, solid(color), cover);
}

/// A colour as a pixel.
#[inline]
pub(crate) fn solid(color: Rgb) -> Px {
    [color[0], color[1], color[2], 255]
}

/// Coverage 0..=256 of a share 0..1.
#[inline]
pub(crate) fn cover(share: f32) -> u32 {
    (within(share, 0.0, 1.0) * 256.0) as u32
}

impl Capsule {
    /// The point of the axis nearest to a pixel, and the radius there: offset from the point,
    /// radius.
    #[inline]
    fn nearest(&self, axis: Vec2, inverse: f32, at: Vec2) -> (Vec2, f32) {
        let from = at - self.a;
        let along = within((from.x * axis.x + from.y * axis.y) * inverse, 0.0, 1.0);
        (from - axis * along, self.ra + (self.rb - self.ra) * along)
    }

    fn inverse(&self) -> f32 {
        let axis = self.b - self.a;
        1.0 / (axis.x * axis.x + axis.y * axis.y).max(1e-6)
    }
}

impl Raster<'_> {
    /// The pixels of the picture within a box, if there are any.
    pub(crate) fn span(&self, low: Vec2, high: Vec2) -> Option<RowSpan> {
        // A cast of a float saturates, and NaN becomes 0.
        let clip = |x: f32, most: usize| (x as i64).clamp(0, most as i64) as usize;
        let (x0, x1) = (clip(low.x, self.width), clip(high.x + 1.0, self.width));
        let (y0, y1) = (clip(low.y, self.height), clip(high.y + 1.0, self.height));
        (x0 < x1 && y0 < y1).then_some(RowSpan { x0, x1, y0, y1 })
    }

    /// A part of a row.
    #[inline]
    pub(crate) fn part(&mut self, y: usize, x0: usize, x1: usize) -> &mut [Px] {
        &mut self.px[y * self.width + x0..y * self.width + x1]
    }

    /// A capsule; `paint` gives the colour from the offset of a pixel to the axis over the radius,
    /// −1..1.
    #[inline]
    pub(crate) fn capsule(&mut self, shape: Capsule, opacity: f32, paint: impl Fn(Vec2) -> Rgb) {
        let pad = shape.ra.max(shape.rb) + 0.5;
        let (low, high) = (shape.a.min(shape.b), shape.a.max(shape.b));
        let Some(span) = self.span(low - pad, high + pad) else { return };
        let (axis, inverse) = (shape.b - shape.a, shape.inverse());
        for y in span.y0..span.y1 {
            let mut at = Vec2::new(span.x0 as f32 + 0.5, y as f32 + 0.5);
            for px in self.part(y, span.x0, span.x1) {
                let (off, radius) = shape.nearest(axis, inverse, at);
                at.x += 1.0;
                let square = off.x * off.x + off.y * off.y;
                let reach = radius + 0.5;
                if square < reach * reach {
                    let share = reach - square.sqrt();
                    blend(px, paint(off / radius), cover(share.min(1.0) * opacity));
                }
            }
        }
    }

    /// A capsule of one colour.
    pub(crate) fn stroke(&mut self, a: Vec2, b: Vec2, radius: f32, color: Rgb, opacity: f32) {
        // A line thinner than a pixel is a fainter line of one pixel.
        let (radius, opacity) =
            if radius < 0.5 { (0.5, opacity * radius * 2.0) } else { (radius, opacity) };
        self.capsule(Capsule { a, b, ra: radius, rb: radius }, opacity, |_| color);
    }

    /// A disc of one colour.
    pub(crate) fn disc(&mut self, at: Vec2, radius: f32, color: Rgb, opacity: f32) {
        self.stroke(at, at, radius, color, opacity);
    }

    /// An upright ellipse, or its outline if `line` is the half width of one.
    pub(crate) fn ellipse(
        &mut self,
        at: Vec2,
        radii: Vec2,
        line: Option<f32>,
        color: Rgb,
        opacity: f32,
    ) {
        let pad = line.unwrap_or(0.0) + 1.0;
        let Some(span) = self.span(at - radii - pad, at + radii + pad) else { return };
        for y in span.y0..span.y1 {
            let dy = y as f32 + 0.5 - at.y;
            let mut dx = span.x0 as f32 + 0.5 - at.x;
            for px in self.part(y, span.x0, span.x1) {
                let (u, v) = (dx / radii.x, dy / radii.y);
                dx += 1.0;
                let k = (u * u + v * v).sqrt();
                // The distance, to first order: the value over the length of its slope.
                let slope = ((u / radii.x) * (u / radii.x) + (v / radii.y) * (v / radii.y)).sqrt()
                    / k.max(1e-3);
                let away = (k - 1.0) / slope.max(1e-3);
                let inside = line.map_or(-away, |half| half - away.abs());
                blend(px, color, cover(within(inside + 0.5, 0.0, 1.0) * opacity));
            }
        }
    }

    /// A box with rounded corners.
    pub(crate) fn panel(&mut self, low: Vec2, high: Vec2, corner: f32, color: Rgb, opacity: f32) {
        let (middle, half) = ((low + high) * 0.5, (high - low) * 0.5 - corner);
        let Some(span) = self.span(low - 1.0, high + 1.0) else { return };
        // Columns that no edge touches.
        let clip = |x: f32| (x as i64).clamp(span.x0 as i64, span.x1 as i64) as usize;
        let from = clip(low.x + corner + 1.0);
        let to = clip(high.x - corner).max(from);
        for y in span.y0..span.y1 {
            let dy = ((y as f32 + 0.5 - middle.y).abs() - half.y).max(0.0);
            let plain = cover(within(corner - dy + 0.5, 0.0, 1.0) * opacity);
            let over = solid(color);
            for px in self.part(y, from, to) {
                *px = between(*px, over, plain);
            }
            for x in (span.x0..from).chain(to..span.x1) {
                let px = &mut self.px[y * self.width + x];
                let dx = ((x as f32 + 0.5 - middle.x).abs() - half.x).max(0.0);
                let inside = if dx == 0.0 || dy == 0.0 {
                    corner - dx - dy
                } else {
                    corner - (dx * dx + dy * dy).sqrt()
                };
                blend(px, color, cover(within(inside + 0.5, 0.0, 1.0) * opacity));
            }
        }
    }

    /// A triangle.
    pub(crate) fn triangle(&mut self, corners: [Vec2; 3], color: Rgb, opacity: f32) {
        let [a, b, c] = corners;
        let low = a.min(b).min(c);
        let high = a.max(b).max(c);
        let Some(span) = self.span(low - 1.0, high + 1.0) else { return };
        let turn = if (b - a).perp_dot(c - a) < 0.0 { -1.0 } else { 1.0 };
        let edges = [(a, b), (b, c), (c, a)].map(|(from, to)| {
            let edge = to - from;
            let length = edge.length().max(1e-3);
            (from, Vec2::new(-edge.y, edge.x) * (turn / length))
        });
        for y in span.y0..span.y1 {
            let mut at = Vec2::new(span.x0 as f32 + 0.5, y as f32 + 0.5);
            for px in self.part(y, span.x0, span.x1) {
                let inside = edges
                    .iter()
                    .map(|(from, normal)| (at - *from).dot(*normal))
                    .fold(1.0, f32::min);
                at.x += 1.0;
                blend(px, color, cover(within(inside + 0.5, 0.0, 1.0) * opacity));
            }
        }
    }
}

/// A small coverage buffer, so that shapes that overlap darken what is below only once.
#[derive(Debug, Default)]
pub(crate) struct Mask {
    cells: Vec<u8>,
}

/// How a mask is laid over a picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wash {
    pub(crate) color: Rgb,
    pub(crate) opacity: f32,
    /// How flat the ground looks: its height on the screen over its depth.
    pub(crate) squash: f32,
    /// Half the width of the edges, pixels.
    pub(crate) soft: f32,
}

impl Mask {
    /// Lays a colour over everything below some capsules, each with a strength 0..1, as one shape.
    pub(crate) fn wash(
        &mut self,
        canvas: &mut Raster<'_>,
        shapes: impl Iterator<Item = (Capsule, f32)> + Clone,
        wash: Wash,
    ) {
        let Wash { color, opacity, squash, soft } = wash;
        let mut low = Vec2::splat(f32::MAX);
        let mut high = Vec2::splat(f32::MIN);
        for (shape, _) in shapes.clone() {
            let pad = shape.ra.max(shape.rb) + soft;
            low = low.min(shape.a.min(shape.b) - pad);
            high = high.max(shape.a.max(shape.b) + pad);
        }
        let Some(all) = canvas.span(low, high) else { return };
        let width = all.x1 - all.x0;
        self.cells.clear();
        self.cells.resize(width * (all.y1 - all.y0), 0);
        let stretch = 1.0 / squash;
        let flat = |v: Vec2| Vec2::new(v.x, v.y * stretch);
        for (shape, strength) in shapes {
            let pad = Vec2::new(1.0, squash) * shape.ra.max(shape.rb) + soft;
            let Some(span) = canvas.span(shape.a.min(shape.b) - pad, shape.a.max(shape.b) + pad)
            else {
                continue;
            };
            let tall = Capsule { a: flat(shape.a), b: flat(shape.b), ..shape };
            let (axis, inverse, edge) =
                (tall.b - tall.a, tall.inverse(), strength * 255.0 / (2.0 * soft));
            let most = strength * 255.0;
            for y in span.y0..span.y1 {
                let mut at = flat(Vec2::new(span.x0 as f32 + 0.5, y as f32 + 0.5));
                let start = (y - all.y0) * width + span.x0 - all.x0;
                for cell in &mut self.cells[start..start + span.x1 - span.x0] {
                    let (off, radius) = tall.nearest(axis, inverse, at);
                    at.x += 1.0;
                    let reach = radius + soft;
                    let square = off.x * off.x + off.y * off.y;
                    if square < reach * reach {
                        *cell = (*cell).max(((reach - square.sqrt()) * edge).min(most) as u8);
                    }
                }
            }
        }
        let opacity = (opacity * 257.0) as u32;
        for y in all.y0..all.y1 {
            let cells = &self.cells[(y - all.y0) * width..][..width];
            for (px, cell) in canvas.part(y, all.x0, all.x1).iter_mut().zip(cells) {
                blend(px, color, (u32::from(*cell) * opacity) >> 8);
            }
        }
    }
}
