//! The banner that says that a goal fell, a flag went up, a card was shown.

use crate::canvas::Raster;
use crate::color::{ACCENTS, INK, PANEL, RED_CARD, YELLOW_CARD};
use crate::math::{Vec2, smooth};
use crate::scene::{News, NewsKind, Scene};
use crate::text::{Digits, Lettering};

/// How long a banner stays, steps.
const STAYS_STEPS: u32 = 25;
/// How long it takes to come.
const COMES_STEPS: f32 = 2.0;

/// Draws the most important news that is recent.
pub(super) fn draw(canvas: &mut Raster<'_>, scene: &Scene, unit: f32) {
    let recent = scene.news.iter().filter(|news| news.age_steps < STAYS_STEPS);
    // Of equals, the latest.
    let Some(news) = recent.max_by_key(|news| (news.kind, std::cmp::Reverse(news.age_steps)))
    else {
        return;
    };
    let age = news.age_steps as f32 + crate::math::within(scene.between, 0.0, 1.0);
    let open = smooth((age + 1.0) / COMES_STEPS);
    strip(canvas, *news, unit, open);
}

fn strip(canvas: &mut Raster<'_>, news: News, unit: f32, open: f32) {
    let words = match news.kind {
        NewsKind::Goal => "GOAL!",
        NewsKind::Offside => "OFFSIDE",
        NewsKind::YellowCard => "YELLOW CARD",
        NewsKind::RedCard => "RED CARD",
        NewsKind::Foul => "FOUL",
    };
    let goal = news.kind == NewsKind::Goal;
    let accent = ACCENTS[news.team.index()];
    let style = Lettering::bold(if goal { 42.0 } else { 26.0 } * unit, INK);
    let small = Lettering::bold(style.size * 0.62, [20, 20, 24]);
    let number = news.number.map(|number| Digits::new(u32::from(number), 1));
    let (pad, high) = (style.size * 0.75, style.size * 2.0);
    let badge = if number.is_some() { high * 0.82 } else { 0.0 };
    let card = match news.kind {
        NewsKind::YellowCard => Some(YELLOW_CARD),
        NewsKind::RedCard => Some(RED_CARD),
        _ => None,
    };
    let card_wide = if card.is_some() { style.size * 1.15 } else { 0.0 };
    let wide = (style.width(words) + 2.0 * pad + badge + card_wide + 8.0 * unit) * open;
    let middle = Vec2::new(canvas.width as f32 * 0.5, canvas.height as f32 * 0.235);
    let half = Vec2::new(wide, high) * 0.5;
    let (low, end) = (middle - half, middle + half);
    canvas.panel(low + 4.0 * unit, end + 4.0 * unit, 7.0 * unit, [0, 0, 0], 0.3);
    canvas.panel(low, end, 5.0 * unit, PANEL, 0.93);
    canvas.panel(low, Vec2::new(low.x + 8.0 * unit, end.y), 3.0 * unit, accent, 1.0);
    canvas.panel(Vec2::new(low.x, end.y - 4.0 * unit), end, 2.0 * unit, accent, 1.0);
    if open < 0.999 {
        return;
    }
    let mut x = low.x + 8.0 * unit + pad;
    if let Some(color) = card {
        let size = Vec2::new(style.size * 0.62, style.size * 0.9);
        let corner = Vec2::new(x, middle.y - size.y * 0.5);
        canvas.panel(corner, corner + size, 2.0 * unit, color, 1.0);
        x += card_wide;
    }
    style.write(canvas, words, Vec2::new(x, middle.y - style.size * 0.5));
    if let Some(number) = number {
        let at = Vec2::new(end.x - pad * 0.5 - badge * 0.5, middle.y);
        canvas.disc(at, badge * 0.4, accent, 1.0);
        let ink = if news.team.index() == 0 { small } else { Lettering { color: INK, ..small } };
        ink.centre(canvas, number.as_str(), at);
    }
}
