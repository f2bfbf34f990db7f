//! The ball: larger the nearer it is to the viewer, and separated from its shadow by its height.

use super::canvas::{Canvas, at};
use super::colours::{BALL, DARK, SHADOW, faded};
use super::people;
use super::scene::SheetScene;
use super::text::{Style, width};
use super::view::View;
use crate::scenario::pitch::BALL_RADIUS_M;
use tiny_skia::Point;

/// Radius of the ball on the ground, metres, and its least, pixels; larger than life.
const RADIUS_M: f32 = 0.44;
const RADIUS_LEAST: f32 = 3.6;
/// How far a metre of height lifts it up the picture, metres.
const LIFT: f32 = 0.8;
/// How much a metre of height enlarges it.
const GROWTH: f32 = 0.055;
/// Above this height the height is written, metres.
const TOLD_M: f32 = 0.5;

/// Draws the ball of the last scene and its trail.
pub fn draw(canvas: &mut Canvas<'_>, view: &View, scenes: &[SheetScene]) {
    let Some(now) = scenes.last() else { return };
    let radius = view.length(RADIUS_M).max(RADIUS_LEAST);
    trail(canvas, view, scenes, radius);
    let height = height_m(now);
    let (shadow, middle) = (view.point(now.ball[0], now.ball[1]), lifted(view, now));
    let size = radius * (1.0 + GROWTH * height);
    canvas.ellipse(
        at(shadow.x + radius * 0.2, shadow.y + radius * 0.35),
        radius * 1.1,
        radius * 0.8,
        SHADOW,
    );
    if height > TOLD_M {
        canvas.ellipse(shadow, radius * 0.9, radius * 0.65, faded(DARK, 0.55));
        canvas.line(&[shadow, middle], (radius * 0.2).max(1.0), faded(BALL, 0.7));
    }
    canvas.disc(middle, size + (radius * 0.28).max(1.2), DARK);
    canvas.disc(middle, size, BALL);
    spots(canvas, middle, size);
    if height > TOLD_M {
        label(canvas, view, middle, size, height);
    }
}

/// The height above its place at rest, metres.
fn height_m(scene: &SheetScene) -> f32 {
    (scene.ball[2] - BALL_RADIUS_M as f32).max(0.0)
}

/// Where it is drawn: above its shadow, but never beyond the picture's upper edge.
fn lifted(view: &View, scene: &SheetScene) -> Point {
    let middle = view.point(scene.ball[0], scene.ball[1] - LIFT * height_m(scene));
    at(middle.x, middle.y.max(view.length(1.0)))
}

/// The path through the air, and its shadow on the grass.
fn trail(canvas: &mut Canvas<'_>, view: &View, scenes: &[SheetScene], radius: f32) {
    if scenes.iter().any(|scene| height_m(scene) > TOLD_M) {
        let ground: Vec<Point> =
            scenes.iter().map(|scene| view.point(scene.ball[0], scene.ball[1])).collect();
        canvas.tail(&ground, radius * 0.8, SHADOW);
    }
    let air: Vec<Point> = scenes.iter().map(|scene| lifted(view, scene)).collect();
    canvas.tail(&air, radius * 1.3, faded(BALL, 0.9));
}

/// The spots that make a white disc a football.
fn spots(canvas: &mut Canvas<'_>, middle: Point, size: f32) {
    if size < 6.0 {
        return;
    }
    canvas.disc(middle, size * 0.3, DARK);
    for spot in 0..5 {
        let turn = (spot as f32 * 72.0 - 90.0).to_radians();
        canvas.disc(
            at(middle.x + size * 0.76 * turn.cos(), middle.y + size * 0.76 * turn.sin()),
            size * 0.17,
            DARK,
        );
    }
}

fn label(canvas: &mut Canvas<'_>, view: &View, middle: Point, size: f32, height: f32) {
    let text = format!("{height:.1} m");
    let style = Style::bold((people::radius(view) * 1.3).max(11.0), BALL);
    let (room, pad) = (width(&text, style), style.size * 0.3);
    let (picture, _) = canvas.size();
    let right = middle.x + size + pad;
    let left =
        if right + room + 2.0 * pad > picture { middle.x - size - room - 3.0 * pad } else { right };
    let height = style.size * 1.25;
    canvas.card(
        at(left, middle.y - height / 2.0),
        room + 2.0 * pad,
        height,
        height / 3.0,
        faded(DARK, 0.7),
    );
    canvas.write(&text, at(left + pad, middle.y), style);
}
