//! Curves as a picture: the return of an episode and of its terms against time.
//!
//! One list of shapes is written as SVG or drawn as PNG.

use crate::curves::Curves;
use crate::scenario::pitch::STEPS_PER_S;
use crate::sheet::canvas::{Canvas, at};
use crate::sheet::colours::{Colour, FAINT, INK, PAGE};
use crate::sheet::text::{Style, fitted};
use std::fmt::Write as _;
use tiny_skia::{Pixmap, Point};

/// The picture's size, and the edges of the plot in it, pixels.
const SIZE: (u32, u32) = (960, 540);
const LEFT: f32 = 84.0;
const RIGHT: f32 = 660.0;
const TOP: f32 = 56.0;
const BOTTOM: f32 = 480.0;
/// The size of text, pixels, and the room of a name.
const TEXT: f32 = 15.0;
const NAME: f32 = 190.0;
/// Marks on an axis, about.
const MARKS: f64 = 5.0;
/// The colours of terms, in order and again: distinguishable with every kind of colour vision.
const TERMS: [Colour; 7] = [
    [230, 159, 0, 255],
    [86, 180, 233, 255],
    [0, 158, 115, 255],
    [240, 228, 66, 255],
    [204, 121, 167, 255],
    [213, 94, 0, 255],
    [120, 150, 255, 255],
];

/// What a picture consists of.
enum Shape {
    Line {
        points: Vec<Point>,
        width: f32,
        colour: Colour,
    },
    /// Text that begins, or with `ends` ends, at a point, centred on it vertically.
    Words {
        text: String,
        at: Point,
        colour: Colour,
        ends: bool,
    },
}

/// Draws curves as SVG.
pub fn svg(title: &str, curves: &Curves) -> String {
    let (width, height) = SIZE;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"system-ui, sans-serif\" font-size=\"{TEXT}\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
        hex(PAGE)
    );
    for shape in shapes(title, curves) {
        let _ = match shape {
            Shape::Line { points, width, colour } => {
                let points: Vec<String> =
                    points.iter().map(|point| format!("{:.1},{:.1}", point.x, point.y)).collect();
                writeln!(
                    text,
                    "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\"/>",
                    points.join(" "),
                    hex(colour)
                )
            }
            Shape::Words { text: words, at, colour, ends } => writeln!(
                text,
                "<text x=\"{:.1}\" y=\"{:.1}\" dominant-baseline=\"central\" text-anchor=\"{}\" fill=\"{}\">{}</text>",
                at.x,
                at.y,
                if ends { "end" } else { "start" },
                hex(colour),
                words.replace('&', "&amp;").replace('<', "&lt;")
            ),
        };
    }
    text + "</svg>\n"
}

/// Draws curves as PNG. None if the picture can't be allocated.
pub fn png(title: &str, curves: &Curves) -> Option<Vec<u8>> {
    let mut page = Pixmap::new(SIZE.0, SIZE.1)?;
    let [red, green, blue, opacity] = PAGE;
    page.fill(tiny_skia::Color::from_rgba8(red, green, blue, opacity));
    let mut canvas = Canvas { pixels: page.as_mut() };
    for shape in shapes(title, curves) {
        match shape {
            Shape::Line { points, width, colour } => canvas.line(&points, width, colour),
            Shape::Words { text, at, colour, ends } if ends => {
                canvas.write_before(&text, at, Style::plain(TEXT, colour));
            }
            Shape::Words { text, at, colour, .. } => {
                canvas.write(&text, at, Style::plain(TEXT, colour));
            }
        }
    }
    page.encode_png().ok()
}

fn shapes(title: &str, curves: &Curves) -> Vec<Shape> {
    let total = curves.total();
    let steps = total.len().saturating_sub(1).max(1);
    let all = || curves.terms.iter().flat_map(|(_, curve)| curve).chain(&total).copied();
    let (least, most) = (all().fold(0.0, f64::min), all().fold(0.0, f64::max));
    let most = if most - least < 1e-9 { least + 1.0 } else { most };
    let x = |step: f64| LEFT + (RIGHT - LEFT) * (step / steps as f64) as f32;
    let y = |value: f64| BOTTOM - (BOTTOM - TOP) * ((value - least) / (most - least)) as f32;
    let words = |text: String, at: Point, colour: Colour, ends: bool| Shape::Words {
        text,
        at,
        colour,
        ends,
    };
    let head = format!("{title} · mean of {} episodes", curves.episodes);
    let head = fitted(&head, Style::plain(TEXT, INK), SIZE.0 as f32 - 2.0 * LEFT);
    let mut shapes = vec![
        words(head, at(LEFT, 26.0), INK, false),
        words("return".to_owned(), at(LEFT - 12.0, TOP - 18.0), FAINT, true),
        words("s".to_owned(), at(RIGHT + 14.0, BOTTOM + 22.0), FAINT, false),
    ];
    for value in marks(least, most) {
        let height = y(value);
        let points = vec![at(LEFT, height), at(RIGHT, height)];
        shapes.push(Shape::Line { points, width: 1.0, colour: [60, 70, 82, 255] });
        shapes.push(words(short(value), at(LEFT - 12.0, height), FAINT, true));
    }
    for second in marks(0.0, steps as f64 / STEPS_PER_S) {
        let along = x(second * STEPS_PER_S);
        shapes.push(words(short(second), at(along + 5.0, BOTTOM + 22.0), FAINT, true));
    }
    let named = curves.terms.iter().map(|(name, curve)| (name.as_str(), curve.as_slice()));
    let colours = TERMS.into_iter().cycle();
    let lines = std::iter::once((("return", total.as_slice()), INK)).chain(named.zip(colours));
    for (place, ((name, curve), colour)) in lines.enumerate() {
        let width = if place == 0 { 3.0 } else { 2.0 };
        let points = curve.iter().enumerate().map(|(step, value)| at(x(step as f64), y(*value)));
        shapes.push(Shape::Line { points: points.collect(), width, colour });
        let row = TOP + 10.0 + 24.0 * place as f32;
        let key = vec![at(RIGHT + 24.0, row), at(RIGHT + 46.0, row)];
        shapes.push(Shape::Line { points: key, width, colour });
        let last = curve.last().copied().unwrap_or_default();
        let label = fitted(&format!("{last:+.3} {name}"), Style::plain(TEXT, INK), NAME);
        shapes.push(words(label, at(RIGHT + 54.0, row), INK, false));
    }
    shapes
}

/// Round values between two ends.
fn marks(least: f64, most: f64) -> Vec<f64> {
    let rough = (most - least) / MARKS;
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|step| *step >= rough)
        .unwrap_or(power);
    let (first, last) = ((least / step).ceil() as i64, (most / step + 1e-9).floor() as i64);
    (first..=last).map(|mark| mark as f64 * step).collect()
}

/// A number without needless digits.
fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn hex([red, green, blue, _]: Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_round_and_inside() {
        assert_eq!(marks(0.0, 1.0), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(marks(-3.0, 20.0), [0.0, 5.0, 10.0, 15.0, 20.0]);
        assert_eq!(
            [0.5, 10.0, -0.00001, 0.125].map(short),
            ["0.5", "10", "0", "0.125"].map(String::from)
        );
    }

    #[test]
    fn every_term_has_its_line_and_its_name() {
        let terms = vec![
            ("a/goal".to_owned(), vec![0.0, 0.0, 1.0]),
            ("b/<near>".to_owned(), vec![0.0, 0.1, 0.2]),
        ];
        let curves = Curves { episodes: 3, terms };
        let picture = svg("s", &curves);
        assert!(picture.contains("+1.000 a/goal") && picture.contains("+0.200 b/&lt;near>"));
        assert!(picture.contains("+1.200 return") && picture.contains("mean of 3 episodes"));
        assert!(png("s", &curves).is_some());
        let empty = Curves { episodes: 1, terms: Vec::new() };
        assert!(svg("s", &empty).ends_with("</svg>\n"));
    }
}
