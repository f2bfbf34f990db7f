//! A scene in a picture: the pitch, trails, players, the ball.

use super::canvas::Canvas;
use super::scene::SheetScene;
use super::view::{Region, View};
use super::{ball, people, pitch};
use tiny_skia::PixmapMut;

/// Number of steps in a trail.
pub const TRAIL_STEPS: usize = 12;

/// Draws the last of some moments, with trails, over a whole buffer of RGBA pixels.
///
/// - `moments`: in order, at most one step apart. Trails begin at the last placement.
/// - `region`: what is shown, over the whole width; the picture should have its
///   [`aspect`](Region::aspect).
pub fn draw(pixels: PixmapMut<'_>, moments: &[SheetScene], region: Region) {
    let Some(now) = moments.last() else { return };
    let view = View::new(region, pixels.width());
    let mut canvas = Canvas { pixels };
    pitch::draw(&mut canvas, &view);
    let way = way(moments);
    people::draw_trails(&mut canvas, &view, way);
    people::draw(&mut canvas, &view, now);
    ball::draw(&mut canvas, &view, way);
}

/// The moments that lead to the last one without a jump.
fn way(moments: &[SheetScene]) -> &[SheetScene] {
    let first = moments.iter().rposition(|scene| scene.placed).unwrap_or(0);
    let first = first.max(moments.len().saturating_sub(TRAIL_STEPS + 1));
    moments.get(first..).unwrap_or_default()
}
