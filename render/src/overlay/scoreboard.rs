//! Teams with their colours, score, clock, and the set piece that is waiting.

use crate::canvas::Raster;
use crate::color::{ACCENTS, FAINT, INK, PANEL};
use crate::math::{Vec2, within};
use crate::scene::Scene;
use crate::text::{Digits, Lettering};

/// Most letters of a team's name.
const LETTERS: usize = 12;

/// Draws the board at the top left.
pub(super) fn draw(canvas: &mut Raster<'_>, scene: &Scene, unit: f32) {
    let (left, top, high) = (34.0 * unit, 28.0 * unit, 40.0 * unit);
    let (name, bold) = (Lettering::bold(17.0 * unit, INK), Lettering::bold(19.0 * unit, PANEL));
    let middle = top + high * 0.5;
    let (pad, bar) = (16.0 * unit, 7.0 * unit);
    let names = [short(&scene.names[0]), short(&scene.names[1])];
    // Both names take the same room, so that the score is in the middle.
    let wide = name.width(names[0]).max(name.width(names[1])) + 2.0 * pad;
    let score = scene.score.map(|goals| Digits::new(u32::from(goals), 1));
    let score_wide = scores_width(&bold, &score) + 2.2 * pad;
    let clock_wide = 92.0 * unit;
    let whole = bar + wide + score_wide + wide + bar + clock_wide;
    canvas.panel(
        Vec2::new(left - 2.0 * unit, top - 2.0 * unit + 3.0 * unit),
        Vec2::new(left + whole + 2.0 * unit, top + high + 4.0 * unit),
        6.0 * unit,
        [0, 0, 0],
        0.35,
    );
    canvas.panel(
        Vec2::new(left, top),
        Vec2::new(left + whole, top + high),
        4.0 * unit,
        PANEL,
        0.94,
    );
    let mut x = left;
    canvas.panel(Vec2::new(x, top), Vec2::new(x + bar, top + high), 2.0 * unit, ACCENTS[0], 1.0);
    x += bar;
    name.centre(canvas, names[0], Vec2::new(x + wide * 0.5, middle));
    x += wide;
    canvas.panel(Vec2::new(x, top), Vec2::new(x + score_wide, top + high), 1.0, INK, 1.0);
    write_score(canvas, &bold, &score, Vec2::new(x + score_wide * 0.5, middle));
    x += score_wide;
    name.centre(canvas, names[1], Vec2::new(x + wide * 0.5, middle));
    x += wide;
    canvas.panel(Vec2::new(x, top), Vec2::new(x + bar, top + high), 2.0 * unit, ACCENTS[1], 1.0);
    x += bar;
    clock(canvas, scene.clock_s, Vec2::new(x + clock_wide * 0.5, middle), unit);
    set_piece(canvas, scene, Vec2::new(left, top + high + 8.0 * unit), unit);
}

/// The first letters of a name.
fn short(name: &str) -> &str {
    name.char_indices().nth(LETTERS).map_or(name, |(end, _)| &name[..end])
}

fn scores_width(style: &Lettering, score: &[Digits; 2]) -> f32 {
    style.width(score[0].as_str()) + style.width(score[1].as_str()) + style.size * 1.5
}

fn write_score(canvas: &mut Raster<'_>, style: &Lettering, score: &[Digits; 2], middle: Vec2) {
    let gap = style.size * 0.75;
    let top = middle.y - style.size * 0.5;
    let first = score[0].as_str();
    style.write(canvas, first, Vec2::new(middle.x - gap - style.width(first), top));
    style.write(canvas, score[1].as_str(), Vec2::new(middle.x + gap, top));
    let dash = style.size * 0.2;
    canvas.stroke(
        middle - Vec2::new(dash, 0.0),
        middle + Vec2::new(dash, 0.0),
        style.size * 0.09,
        FAINT,
        1.0,
    );
}

/// Minutes and seconds.
fn clock(canvas: &mut Raster<'_>, seconds: f32, middle: Vec2, unit: f32) {
    let seconds = within(seconds, 0.0, 599_999.0) as u32;
    let (minutes, seconds) = (Digits::new(seconds / 60, 2), Digits::new(seconds % 60, 2));
    let style = Lettering::plain(18.0 * unit, INK);
    let half = 5.0 * unit;
    let top = middle.y - style.size * 0.5;
    style.write(
        canvas,
        minutes.as_str(),
        Vec2::new(middle.x - half - style.width(minutes.as_str()), top),
    );
    style.write(canvas, seconds.as_str(), Vec2::new(middle.x + half, top));
    for dot in [-0.22, 0.22] {
        canvas.disc(middle + Vec2::new(0.0, dot * style.size), style.size * 0.085, INK, 1.0);
    }
}

fn set_piece(canvas: &mut Raster<'_>, scene: &Scene, corner: Vec2, unit: f32) {
    let words = scene.mode.caption();
    if words.is_empty() {
        return;
    }
    let style = Lettering::plain(14.0 * unit, INK);
    let (high, pad, bar) = (28.0 * unit, 12.0 * unit, 5.0 * unit);
    let size = Vec2::new(style.width(words) + 2.0 * pad + bar, high);
    canvas.panel(corner, corner + size, 3.0 * unit, PANEL, 0.86);
    if let Some(team) = scene.mode_team {
        canvas.panel(corner, corner + Vec2::new(bar, high), 2.0 * unit, ACCENTS[team.index()], 1.0);
    }
    style.write(canvas, words, corner + Vec2::new(bar + pad, (high - style.size) * 0.5));
}
