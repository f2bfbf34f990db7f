//! Pictures that repeat, and how they are laid onto the planes around the pitch.

use crate::canvas::{Px, between, solid};
use crate::color::Rgb;
use crate::math::within;
use crate::view::Row;

/// A picture that repeats along x. Its width is a power of two.
#[derive(Debug, Default)]
pub(crate) struct Tile {
    pub(crate) px: Vec<Px>,
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Pixels per metre along x, and along y.
    pub(crate) across: f32,
    pub(crate) down: f32,
}

impl Tile {
    /// A tile for a box in metres, at about `per_m` pixels per metre.
    pub(crate) fn new(size_m: [f32; 2], per_m: f32, color: Rgb) -> Tile {
        // The power of two that is nearest, as a factor.
        let width =
            ((size_m[0] * per_m * std::f32::consts::FRAC_1_SQRT_2) as usize).next_power_of_two();
        let height = ((size_m[1] * width as f32 / size_m[0] + 0.5) as usize).max(1);
        let (across, down) = (width as f32 / size_m[0], height as f32 / size_m[1]);
        Tile { px: vec![solid(color); width * height], width, height, across, down }
    }

    /// Lays one line of the tile, `v` pixels from its top, into a row of pixels; `light` is of 256.
    pub(crate) fn lay(
        &self,
        line: &mut [Px],
        row: &Row,
        v: f32,
        shift_m: f32,
        px: &mut [Px],
        light: u32,
    ) {
        // First down, then along: two reads per pixel.
        let (top, part) = self.line(v);
        let upper = &self.px[top * self.width..][..self.width];
        let lower = &self.px[(top + 1).min(self.height - 1) * self.width..][..self.width];
        for ((to, a), b) in line.iter_mut().zip(upper).zip(lower) {
            *to = between([0, 0, 0, 255], between(*a, *b, part), light);
        }
        let mask = self.width - 1;
        let mut u = self.column(row.x0 + shift_m);
        let du = (row.dx * self.across * 4096.0) as u32;
        for px in px {
            let at = (u >> 12) as usize;
            *px = between(line[at & mask], line[(at + 1) & mask], (u >> 4) & 255);
            u = u.wrapping_add(du);
        }
    }

    /// The colour at a place, between its four nearest pixels; `light` is of 256.
    #[inline]
    pub(crate) fn at(&self, x_m: f32, v: f32, light: u32) -> Px {
        let (u, mask) = (self.column(x_m), self.width - 1);
        let (i, across) = ((u >> 12) as usize, (u >> 4) & 255);
        let (j, down) = self.line(v);
        let upper = &self.px[j * self.width..][..self.width];
        let lower = &self.px[(j + 1).min(self.height - 1) * self.width..][..self.width];
        let (i, next) = (i & mask, (i + 1) & mask);
        let top = between(upper[i], upper[next], across);
        let bottom = between(lower[i], lower[next], across);
        between([0, 0, 0, 255], between(top, bottom, down), light)
    }

    /// A place along x in 4096ths of a pixel. It wraps with the tile, whose width is a power of
    /// two.
    fn column(&self, x_m: f32) -> u32 {
        (x_m * self.across * 4096.0) as i64 as u32
    }

    /// The line above a place, and the share of the next one, of 256.
    fn line(&self, v: f32) -> (usize, u32) {
        let v = (within(v - 0.5, 0.0, self.height as f32 - 1.0) * 256.0) as u32;
        ((v >> 8) as usize, v & 255)
    }
}
