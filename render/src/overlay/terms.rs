//! The terms of a step's reward, as far as they paid something.

use crate::canvas::Raster;
use crate::color::{FAINT, INK, PANEL};
use crate::math::{Vec2, within};
use crate::scene::Scene;
use crate::text::{Digits, Lettering};

/// Most rows, and most letters of a name.
const ROWS: usize = 8;
const LETTERS: usize = 28;
/// Colours of payments and of costs.
const GAIN: [u8; 3] = [126, 211, 133];
const LOSS: [u8; 3] = [255, 130, 120];

/// Draws them at the top right.
pub(super) fn draw(canvas: &mut Raster<'_>, scene: &Scene, unit: f32) {
    let paid = || scene.rewards.iter().filter(|term| term.value != 0.0).take(ROWS);
    let count = paid().count();
    if count == 0 {
        return;
    }
    let line = 22.0 * unit;
    let size = Vec2::new(300.0 * unit, line * count as f32 + 14.0 * unit);
    let corner = Vec2::new(canvas.width as f32 - size.x - 34.0 * unit, 28.0 * unit);
    canvas.panel(corner, corner + size, 5.0 * unit, PANEL, 0.86);
    for (i, term) in paid().enumerate() {
        let y = corner.y + 7.0 * unit + (i as f32 + 0.5) * line;
        let style = Lettering::plain(11.0 * unit, INK);
        let end = term.name.char_indices().nth(LETTERS).map_or(term.name.len(), |(end, _)| end);
        style.write(
            canvas,
            &term.name[..end],
            Vec2::new(corner.x + 12.0 * unit, y - style.size * 0.5),
        );
        let ink = if term.value > 0.0 {
            GAIN
        } else if term.value < 0.0 {
            LOSS
        } else {
            FAINT
        };
        value(
            canvas,
            term.value,
            Vec2::new(corner.x + size.x - 12.0 * unit, y),
            Lettering { color: ink, ..style },
        );
    }
}

/// A number with a sign and three decimals, from the right.
fn value(canvas: &mut Raster<'_>, value: f32, end: Vec2, style: Lettering) {
    let thousandths = (within(value.abs(), 0.0, 999_999.0) * 1000.0 + 0.5) as u32;
    let (whole, part) = (Digits::new(thousandths / 1000, 1), Digits::new(thousandths % 1000, 3));
    let mut x = end.x;
    let sign = if value < 0.0 { "-" } else { "+" };
    for text in [part.as_str(), ".", whole.as_str(), sign] {
        x -= style.width(text);
        style.write(canvas, text, Vec2::new(x, end.y - style.size * 0.5));
        x -= style.size * 0.22;
    }
}
