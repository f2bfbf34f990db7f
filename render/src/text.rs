//! Text from a small stroke font: capitals, digits and a few signs, drawn as capsules at any size.

use crate::canvas::Raster;
use crate::color::Rgb;
use crate::math::Vec2;

/// How a text looks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lettering {
    /// Height of a capital, pixels.
    pub(crate) size: f32,
    /// Width of a stroke over the height.
    pub(crate) weight: f32,
    /// Width of the letters over their usual width; negative mirrors nothing, it is clamped.
    pub(crate) stretch: f32,
    pub(crate) color: Rgb,
}

impl Lettering {
    /// Ordinary text.
    pub(crate) fn plain(size: f32, color: Rgb) -> Lettering {
        Lettering { size, weight: 0.13, stretch: 1.0, color }
    }

    /// Bold text.
    pub(crate) fn bold(size: f32, color: Rgb) -> Lettering {
        Lettering { size, weight: 0.175, stretch: 1.0, color }
    }

    fn unit(&self) -> Vec2 {
        // Strokes stand out of the grid by half their width.
        let inner = self.size * (1.0 - self.weight);
        Vec2::new(inner * 0.155 * self.stretch.max(0.05), inner / 6.0)
    }

    /// Width of a text, pixels.
    pub(crate) fn width(&self, text: &str) -> f32 {
        let unit = self.unit();
        let gap = self.gap();
        let cells: f32 = text.chars().map(|letter| advance(letter) * unit.x + gap).sum();
        (cells - gap + self.size * self.weight).max(0.0)
    }

    /// Space between two letters.
    fn gap(&self) -> f32 {
        self.size * (self.weight + 0.14) * self.stretch.max(0.05)
    }

    /// Writes a text whose first capital has its top left corner at a place.
    pub(crate) fn write(&self, canvas: &mut Raster<'_>, text: &str, corner: Vec2) {
        let (unit, half) = (self.unit(), self.size * self.weight * 0.5);
        let mut left = corner + half;
        for letter in text.chars() {
            for stroke in glyph(letter).split(' ') {
                let mut last = None;
                for pair in stroke.as_bytes().chunks_exact(2) {
                    let point = left
                        + Vec2::new(f32::from(pair[0] - b'0'), f32::from(pair[1] - b'0')) * unit;
                    if let Some(from) = last {
                        canvas.stroke(from, point, half, self.color, 1.0);
                    }
                    last = Some(point);
                }
            }
            left.x += advance(letter) * unit.x + self.gap();
        }
    }

    /// Writes a text about a middle.
    pub(crate) fn centre(&self, canvas: &mut Raster<'_>, text: &str, middle: Vec2) {
        self.write(canvas, text, middle - Vec2::new(self.width(text), self.size) * 0.5);
    }
}

/// A number as text, without memory of its own.
#[derive(Clone, Copy)]
pub(crate) struct Digits {
    bytes: [u8; 12],
    from: usize,
}

impl Digits {
    /// At least `least` digits of a number.
    pub(crate) fn new(mut number: u32, least: usize) -> Digits {
        let mut digits = Digits { bytes: [b'0'; 12], from: 12 };
        while number > 0 || 12 - digits.from < least.clamp(1, 10) {
            digits.from -= 1;
            digits.bytes[digits.from] = b'0' + (number % 10) as u8;
            number /= 10;
        }
        digits
    }

    pub(crate) fn as_str(&self) -> &str {
        std::str::from_utf8(&self.bytes[self.from..]).unwrap_or_default()
    }
}

/// Width of a letter in cells of the grid.
fn advance(letter: char) -> f32 {
    match letter {
        ' ' => 2.0,
        // Digits are equally wide, so that a running clock doesn't tremble.
        '0'..='9' => 4.0,
        _ => {
            let widest =
                glyph(letter).split(' ').flat_map(|stroke| stroke.bytes().step_by(2)).max();
            f32::from(widest.unwrap_or(b'2') - b'0')
        }
    }
}

/// The strokes of a letter: pairs of digits, x from the left 0..4, y from the top 0..6; a space
/// lifts the pen.
fn glyph(letter: char) -> &'static str {
    match letter.to_ascii_uppercase() {
        'A' => "060110304146 0444",
        'B' => "003041423303 334445360600",
        'C' => "4130100105163645",
        'D' => "00304145360600",
        'E' => "40000646 0333",
        'F' => "400006 0333",
        'G' => "41301001051636454323",
        'H' => "0006 4046 0343",
        'I' => "0006",
        'J' => "3035261605",
        'K' => "0006 400346",
        'L' => "000646",
        'M' => "0600234046",
        'N' => "06004640",
        'O' | '0' => "103041453616050110",
        'P' => "06003041433404",
        'Q' => "103041453616050110 2446",
        'R' => "06003041423303 2346",
        'S' => "413010010213334445361605",
        'T' => "0040 2026",
        'U' => "000516364540",
        'V' => "002640",
        'W' => "0016223640",
        'X' => "0046 4006",
        'Y' => "002340 2326",
        'Z' => "00400646",
        '1' => "112026",
        '2' => "01103041420646",
        '3' => "011030414233 13334445361605",
        '4' => "300444 3036",
        '5' => "400003334445361605",
        '6' => "4130100105163645443303",
        '7' => "00404116",
        '8' => "13020110304142331304051636454433",
        '9' => "4313020110304145361605",
        '-' | '–' => "0333",
        '_' => "0646",
        '+' => "0343 2125",
        '=' => "0242 0444",
        ':' => "0202 0505",
        '.' => "0606",
        ',' => "1607",
        '!' => "0004 0606",
        '/' => "0640",
        '\'' => "0001",
        '(' => "10010516",
        ')' => "00111506",
        ' ' => "",
        _ => "011030414223 2324 2626",
    }
}
