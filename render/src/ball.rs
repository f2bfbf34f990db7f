//! The ball from the stand: a lit sphere whose dark panels turn with it, and its shadow.

use crate::canvas::{Raster, blend, cover};
use crate::math::{Vec2, Vec3, cos, sin, space, unit_or, within};
use crate::scene::SceneBall;
use crate::view::CameraView;

/// Radius of the ball, and the size at which it is drawn: larger than life, as on any screen.
pub(crate) const RADIUS_M: f32 = 0.11;
const DRAWN_M: f32 = 0.17;
/// Least radius, pixels.
const LEAST_PX: f32 = 1.2;
/// From this radius on, panels are drawn.
const PANELS_PX: f32 = 2.6;
/// Where a shadow falls, metres per metre of height.
const CAST: Vec2 = Vec2::new(0.42, -0.3);

/// Where the ball is drawn.
pub(crate) fn place(ball: &SceneBall) -> Vec3 {
    let at = space(ball.pos);
    Vec3::new(at.x, at.y, at.z.max(0.0))
}

/// Draws the shadow.
pub(crate) fn below(canvas: &mut Raster<'_>, view: &CameraView, ball: &SceneBall) {
    let at = place(ball);
    let high = (at.z - RADIUS_M).max(0.0);
    let on = Vec3::new(at.x + high * CAST.x, at.y + high * CAST.y, 0.0);
    let Some(spot) = view.spot(on) else { return };
    let radius = (DRAWN_M * spot.scale).max(LEAST_PX);
    let fade = 1.0 / (1.0 + high * 0.12);
    canvas.ellipse(
        spot.at,
        Vec2::new(radius * 1.15, (radius * view.squash()).max(0.6)),
        None,
        [6, 16, 8],
        0.55 * fade,
    );
}

/// Draws the ball.
pub(crate) fn draw(canvas: &mut Raster<'_>, view: &CameraView, ball: &SceneBall, time_s: f32) {
    let at = place(ball);
    let Some(spot) = view.spot(Vec3::new(at.x, at.y, at.z.max(DRAWN_M))) else { return };
    let radius = (DRAWN_M * spot.scale).max(LEAST_PX);
    let Some(span) = canvas.span(spot.at - radius - 0.5, spot.at + radius + 0.5) else { return };
    if radius < PANELS_PX {
        // A small ball keeps apart from lines and shirts.
        canvas.disc(spot.at, radius + 0.8, [12, 30, 16], 0.6);
    }
    let turn = turned(ball, time_s);
    let panels = radius >= PANELS_PX;
    for y in span.y0..span.y1 {
        let v = (y as f32 + 0.5 - spot.at.y) / radius;
        for x in span.x0..span.x1 {
            let u = (x as f32 + 0.5 - spot.at.x) / radius;
            let square = u * u + v * v;
            let share = (1.0 - square.sqrt()) * radius + 0.5;
            if share <= 0.0 {
                continue;
            }
            let w = (1.0 - square).max(0.0).sqrt();
            let floor = if panels { 0.45 } else { 0.9 };
            let light = within(0.62 + 0.45 * (-0.42 * u - 0.62 * v + 0.66 * w), floor, 1.0);
            let mut shade = 254.0 * light;
            if panels {
                // The screen's right, down and out as the world's x, −z and y.
                shade *= 1.0 - 0.82 * dark(turn.apply(Vec3::new(u, w, -v)), radius);
            }
            let shade = shade as u8;
            blend(&mut canvas.part(y, x, x + 1)[0], [shade, shade, shade], cover(share));
        }
    }
}

/// A turn about an axis.
struct Turn {
    axis: Vec3,
    cos: f32,
    sin: f32,
}

impl Turn {
    /// The point of the ball that is now at a direction.
    fn apply(&self, v: Vec3) -> Vec3 {
        v * self.cos - self.axis.cross(v) * self.sin
            + self.axis * (self.axis.dot(v) * (1.0 - self.cos))
    }
}

/// How the ball is turned. A scene has no history: the way along the velocity decides, or the time
/// if it spins in place.
fn turned(ball: &SceneBall, time_s: f32) -> Turn {
    let (pos, vel, spin) = (place(ball), space(ball.vel), space(ball.spin));
    let roll = Vec3::new(-vel.y, vel.x, 0.0);
    let axis = unit_or(spin, unit_or(roll, Vec3::X));
    let speed = vel.length();
    let angle = if speed > 0.3 {
        pos.dot(vel) / speed / RADIUS_M * within(spin.length() * RADIUS_M / speed, 0.3, 1.0)
    } else {
        spin.length().min(60.0) * time_s + (pos.x + pos.y) * 2.0
    };
    Turn { axis, cos: cos(angle), sin: sin(angle) }
}

/// How dark a point of the ball is, 0..1: twelve dark panels, at the corners of an icosahedron.
fn dark(at: Vec3, radius: f32) -> f32 {
    const A: f32 = 0.525_731_1;
    const B: f32 = 0.850_650_8;
    let (x, y, z) = (at.x.abs(), at.y.abs(), at.z.abs());
    // By symmetry the nearest of the twelve is among three.
    let near = (A * x + B * y).max(A * y + B * z).max(A * z + B * x);
    within((near - 0.93) * (radius * 3.2) + 0.5, 0.0, 1.0)
}
