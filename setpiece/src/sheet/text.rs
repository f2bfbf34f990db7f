//! Text: the outlines of an embedded font, filled like any other shape.

use super::canvas::Canvas;
use super::colours::Colour;
use tiny_skia::{Path, PathBuilder, Point};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// The font `DejaVu Sans Condensed`, with the letters of Europe; see `fonts/LICENSE`.
const REGULAR: &[u8] = include_bytes!("../../fonts/DejaVuSansCondensed.ttf");
const BOLD: &[u8] = include_bytes!("../../fonts/DejaVuSansCondensed-Bold.ttf");
/// Height of a capital letter relative to the font's size.
const CAPITAL: f32 = 0.729;

/// How text looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Pixels from line to line without a gap.
    pub size: f32,
    /// Heavy.
    pub bold: bool,
    /// Its colour.
    pub colour: Colour,
}

impl Style {
    /// Plain text.
    pub const fn plain(size: f32, colour: Colour) -> Style {
        Style { size, bold: false, colour }
    }

    /// Heavy text.
    pub const fn bold(size: f32, colour: Colour) -> Style {
        Style { size, bold: true, colour }
    }
}

/// The width of a text, pixels.
pub fn width(text: &str, style: Style) -> f32 {
    face(style).map_or(0.0, |face| glyphs(&face, text, style).map(|(_, advance)| advance).sum())
}

/// The text, or its beginning with `…` if it is wider than `room`.
pub fn fitted(text: &str, style: Style, room: f32) -> String {
    if width(text, style) <= room {
        return text.to_owned();
    }
    let room = room - width("…", style);
    let mut kept = String::new();
    for letter in text.chars() {
        kept.push(letter);
        if width(&kept, style) > room {
            kept.pop();
            break;
        }
    }
    kept.truncate(kept.trim_end().len());
    kept + "…"
}

impl Canvas<'_> {
    /// Writes a text whose middle line begins at a point, and returns its width.
    pub fn write(&mut self, text: &str, start: Point, style: Style) -> f32 {
        let Some(face) = face(style) else { return 0.0 };
        let scale = scale(&face, style);
        let mut pen = Pen { path: PathBuilder::new(), at: start, scale };
        pen.at.y += style.size * CAPITAL / 2.0;
        for (glyph, advance) in glyphs(&face, text, style) {
            let _ = face.outline_glyph(glyph, &mut pen);
            pen.at.x += advance;
        }
        let end = pen.at.x;
        if let Some(path) = pen.finish() {
            self.fill(&path, style.colour);
        }
        end - start.x
    }

    /// Writes a text around a point.
    pub fn write_centred(&mut self, text: &str, middle: Point, style: Style) {
        self.write(text, Point { x: middle.x - width(text, style) / 2.0, ..middle }, style);
    }

    /// Writes a text that ends at a point.
    pub fn write_before(&mut self, text: &str, end: Point, style: Style) {
        self.write(text, Point { x: end.x - width(text, style), ..end }, style);
    }
}

fn face(style: Style) -> Option<Face<'static>> {
    Face::parse(if style.bold { BOLD } else { REGULAR }, 0).ok()
}

fn scale(face: &Face<'_>, style: Style) -> f32 {
    style.size / f32::from(face.units_per_em())
}

/// The glyphs of a text and their advances. A letter that the font lacks becomes its empty box.
fn glyphs(face: &Face<'_>, text: &str, style: Style) -> impl Iterator<Item = (GlyphId, f32)> {
    let scale = scale(face, style);
    text.chars().filter(|letter| !letter.is_control()).map(move |letter| {
        let glyph = face.glyph_index(letter).unwrap_or_default();
        (glyph, f32::from(face.glyph_hor_advance(glyph).unwrap_or_default()) * scale)
    })
}

/// Draws outlines, whose y points up, into a path.
struct Pen {
    path: PathBuilder,
    at: Point,
    scale: f32,
}

impl Pen {
    fn to(&self, x: f32, y: f32) -> Point {
        Point { x: self.at.x + x * self.scale, y: self.at.y - y * self.scale }
    }

    fn finish(self) -> Option<Path> {
        self.path.finish()
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let to = self.to(x, y);
        self.path.move_to(to.x, to.y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let to = self.to(x, y);
        self.path.line_to(to.x, to.y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (by, to) = (self.to(x1, y1), self.to(x, y));
        self.path.quad_to(by.x, by.y, to.x, to.y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (first, second, to) = (self.to(x1, y1), self.to(x2, y2), self.to(x, y));
        self.path.cubic_to(first.x, first.y, second.x, second.y, to.x, to.y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_is_too_wide_ends_in_dots() {
        let style = Style::plain(20.0, [0; 4]);
        let text = "pass completed by the left back";
        assert_eq!(fitted(text, style, 1000.0), text);
        let short = fitted(text, style, 100.0);
        assert!(short.ends_with('…') && width(&short, style) <= 100.0, "{short}");
        assert_eq!(fitted(text, style, 0.0), "…");
    }

    #[test]
    fn the_font_has_the_letters_of_names() {
        let face = face(Style::plain(1.0, [0; 4])).unwrap();
        for letter in "Aé→ß·…Ωж–".chars() {
            assert!(face.glyph_index(letter).is_some(), "{letter}");
        }
    }
}
