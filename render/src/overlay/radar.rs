//! The whole pitch in small.

use crate::canvas::Raster;
use crate::color::{BALL, LINE, kit};
use crate::math::{Vec2, ground, space};
use crate::scene::{Pitch, Scene};

/// Draws it at the bottom, in the middle.
pub(super) fn draw(canvas: &mut Raster<'_>, scene: &Scene, pitch: &Pitch, unit: f32) {
    let field = Vec2::new(pitch.length_m, pitch.width_m);
    let scale = (206.0 * unit / field.x).min(150.0 * unit / field.y);
    let half = field * (0.5 * scale);
    let margin = 7.0 * unit;
    let middle =
        Vec2::new(canvas.width as f32 * 0.5, canvas.height as f32 - half.y - margin - 14.0 * unit);
    let at = |x: f32, y: f32| middle + Vec2::new(x, y) * scale;
    canvas.panel(middle - half - margin, middle + half + margin, 6.0 * unit, [10, 34, 20], 0.74);
    let (x, y) = (pitch.length_m * 0.5, pitch.width_m * 0.5);
    let width = (0.65 * unit).max(0.4);
    let mut line = |ax: f32, ay: f32, bx: f32, by: f32| {
        canvas.stroke(at(ax, ay), at(bx, by), width, LINE, 0.6);
    };
    for side in [-1.0, 1.0] {
        line(-x, side * y, x, side * y);
        line(side * x, -y, side * x, y);
        let (inner, half) = (side * (x - pitch.box_depth_m), pitch.box_width_m * 0.5);
        line(inner, -half, inner, half);
        line(inner, -half, side * x, -half);
        line(inner, half, side * x, half);
    }
    line(0.0, -y, 0.0, y);
    canvas.ellipse(middle, Vec2::splat(pitch.circle_m * scale), Some(width), LINE, 0.6);
    let rim = half + margin * 0.6;
    let inside = |p: Vec2| middle + (p - middle).clamp(-rim, rim);
    let dot = 3.4 * unit;
    for player in scene.players.iter().filter(|player| player.present) {
        let place = ground(player.pos);
        let spot = inside(at(place.x, place.y));
        let edge = if player.agent { [255, 255, 255] } else { [8, 18, 12] };
        canvas.disc(spot, dot + if player.agent { 1.5 } else { 0.9 } * unit, edge, 0.9);
        canvas.disc(spot, dot, kit(player).shirt, 1.0);
    }
    let ball = space(scene.ball.pos);
    let spot = inside(at(ball.x, ball.y));
    canvas.disc(spot, 3.3 * unit, [10, 14, 12], 0.9);
    canvas.disc(spot, 2.4 * unit, BALL, 1.0);
}
