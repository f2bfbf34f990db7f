//! A picture to draw shapes on, in pixels from the upper left corner.
//!
//! A shape that can't be drawn (empty, or with non-finite coordinates) is left out.

use super::colours::{Colour, faded};
use tiny_skia::{
    Color, FillRule, GradientStop, LineCap, LineJoin, LinearGradient, Paint, Path, PathBuilder,
    PixmapMut, Point, Rect, SpreadMode, Stroke, Transform,
};

/// The constant with which four cubic curves approximate a circle.
const ROUND: f32 = 0.552_284_8;

/// A picture to draw on.
pub struct Canvas<'a> {
    /// Its pixels.
    pub pixels: PixmapMut<'a>,
}

impl Canvas<'_> {
    /// Width and height, pixels.
    pub fn size(&self) -> (f32, f32) {
        (self.pixels.width() as f32, self.pixels.height() as f32)
    }

    /// Fills a path.
    pub fn fill(&mut self, path: &Path, colour: Colour) {
        self.pixels.fill_path(path, &paint(colour), FillRule::Winding, Transform::identity(), None);
    }

    /// Draws along a path, with round ends and corners.
    pub fn stroke(&mut self, path: &Path, width: f32, colour: Colour) {
        let stroke = Stroke {
            width,
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        self.pixels.stroke_path(path, &paint(colour), &stroke, Transform::identity(), None);
    }

    /// A disc.
    pub fn disc(&mut self, at: Point, radius: f32, colour: Colour) {
        if let Some(path) = PathBuilder::from_circle(at.x, at.y, radius) {
            self.fill(&path, colour);
        }
    }

    /// A circle.
    pub fn ring(&mut self, at: Point, radius: f32, width: f32, colour: Colour) {
        if let Some(path) = PathBuilder::from_circle(at.x, at.y, radius) {
            self.stroke(&path, width, colour);
        }
    }

    /// A filled ellipse with horizontal and vertical axes.
    pub fn ellipse(&mut self, at: Point, half_width: f32, half_height: f32, colour: Colour) {
        let corners = Rect::from_ltrb(
            at.x - half_width,
            at.y - half_height,
            at.x + half_width,
            at.y + half_height,
        );
        if let Some(path) = corners.and_then(PathBuilder::from_oval) {
            self.fill(&path, colour);
        }
    }

    /// A polygon.
    pub fn polygon(&mut self, corners: &[Point], colour: Colour) {
        if let Some(path) = through(corners, true) {
            self.fill(&path, colour);
        }
    }

    /// A line through points.
    pub fn line(&mut self, points: &[Point], width: f32, colour: Colour) {
        if let Some(path) = through(points, false) {
            self.stroke(&path, width, colour);
        }
    }

    /// A trail through points that widens from nothing towards its end.
    pub fn tail(&mut self, points: &[Point], width: f32, colour: Colour) {
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return };
        let stops = [(0.0, 0.0), (1.0, 1.0)]
            .map(|(place, share)| GradientStop::new(place, tiny_colour(faded(colour, share))))
            .to_vec();
        let shader =
            LinearGradient::new(*first, *last, stops, SpreadMode::Pad, Transform::identity());
        let (Some(path), Some(shader)) = (ribbon(points, width), shader) else { return };
        let paint = Paint { shader, ..Paint::default() };
        self.pixels.fill_path(&path, &paint, FillRule::Winding, Transform::identity(), None);
    }

    /// A rectangle with round corners.
    pub fn card(&mut self, corner: Point, width: f32, height: f32, radius: f32, colour: Colour) {
        if let Some(path) = round_rect(corner, width, height, radius) {
            self.fill(&path, colour);
        }
    }

    /// The outline of such a rectangle.
    pub fn outline(
        &mut self,
        corner: Point,
        size: (f32, f32),
        radius: f32,
        width: f32,
        colour: Colour,
    ) {
        if let Some(path) = round_rect(corner, size.0, size.1, radius) {
            self.stroke(&path, width, colour);
        }
    }
}

/// A point.
pub const fn at(x: f32, y: f32) -> Point {
    Point { x, y }
}

fn tiny_colour([red, green, blue, opacity]: Colour) -> Color {
    Color::from_rgba8(red, green, blue, opacity)
}

fn paint(colour: Colour) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color(tiny_colour(colour));
    paint
}

/// The outline of a trail: pointed at its beginning and this wide at its end.
fn ribbon(points: &[Point], width: f32) -> Option<Path> {
    let last = points.len().checked_sub(1)?;
    let sides = |index: usize| {
        let (from, to) = (points[index.saturating_sub(1)], points[(index + 1).min(last)]);
        let (x, y) = (to.x - from.x, to.y - from.y);
        let half = width / 2.0 * index as f32 / last.max(1) as f32 / x.hypot(y).max(1e-3);
        let here = points[index];
        [at(here.x - y * half, here.y + x * half), at(here.x + y * half, here.y - x * half)]
    };
    let pairs: Vec<[Point; 2]> = (0..points.len()).map(sides).collect();
    let outline: Vec<Point> =
        pairs.iter().map(|pair| pair[0]).chain(pairs.iter().rev().map(|pair| pair[1])).collect();
    through(&outline, true)
}

fn through(points: &[Point], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (index, point) in points.iter().enumerate() {
        if index == 0 {
            path.move_to(point.x, point.y);
        } else {
            path.line_to(point.x, point.y);
        }
    }
    if closed {
        path.close();
    }
    path.finish()
}

fn round_rect(corner: Point, width: f32, height: f32, radius: f32) -> Option<Path> {
    let (left, top, right, bottom) = (corner.x, corner.y, corner.x + width, corner.y + height);
    let radius = radius.min(width / 2.0).min(height / 2.0);
    let bend = radius * (1.0 - ROUND);
    let mut path = PathBuilder::new();
    path.move_to(left + radius, top);
    path.line_to(right - radius, top);
    path.cubic_to(right - bend, top, right, top + bend, right, top + radius);
    path.line_to(right, bottom - radius);
    path.cubic_to(right, bottom - bend, right - bend, bottom, right - radius, bottom);
    path.line_to(left + radius, bottom);
    path.cubic_to(left + bend, bottom, left, bottom - bend, left, bottom - radius);
    path.line_to(left, top + radius);
    path.cubic_to(left, top + bend, left + bend, top, left + radius, top);
    path.close();
    path.finish()
}
