//! A player's number in their shirt, as captions show it.

use super::canvas::Canvas;
use super::colours::shirt;
use super::text::Style;
use crate::engine::state::PlayerId;
use crate::scene::number;
use tiny_skia::Point;

/// Draws it around a point.
pub fn badge(canvas: &mut Canvas<'_>, middle: Point, radius: f32, id: PlayerId, keeper: bool) {
    let shirt = shirt(id.team(), keeper);
    canvas.disc(middle, radius, shirt.cloth);
    let number = number(id).to_string();
    canvas.write_centred(&number, middle, Style::bold(radius * 1.32, shirt.number));
}
