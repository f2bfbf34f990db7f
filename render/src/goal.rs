//! Goals from the stand: posts, bar, and a net that bulges where the ball lies in it.
//!
//! A goal is drawn in bands across, so that whoever stands in the mouth is in front of one part and
//! behind another.

use crate::ball;
use crate::canvas::Raster;
use crate::color::{WOOD, scaled};
use crate::math::{Vec2, Vec3, smooth, within};
use crate::scene::{Pitch, Scene};
use crate::view::CameraView;

/// Bands of a goal, from the far post to the near one.
pub(crate) const BANDS: usize = 8;
/// Distance of a net's threads, metres, and its least on the screen, pixels.
const MESH_M: f32 = 0.24;
const MESH_PX: f32 = 3.6;
/// Radius of the woodwork.
const POST_M: f32 = 0.075;
/// How far around the ball the net bulges, and how far out.
const BULGE_M: f32 = 1.8;
const PUSH_M: f32 = 0.65;
/// Share of the depth that the net has at the bar's height.
const TOP: f32 = 0.8;

/// One goal.
pub(crate) struct Goal {
    side: f32,
    line: f32,
    half: f32,
    height: f32,
    depth: f32,
    ball: Vec3,
    inside: bool,
}

impl Goal {
    /// The goal at −x (`side` −1) or at +x.
    pub(crate) fn new(scene: &Scene, pitch: &Pitch, side: f32) -> Goal {
        let ball = ball::place(&scene.ball);
        let (line, half) = (pitch.length_m * 0.5, pitch.goal_width_m * 0.5);
        let behind = ball.x * side - line;
        let inside = behind > 0.0
            && behind < pitch.goal_depth_m + 0.8
            && ball.y.abs() < half + 0.6
            && ball.z < pitch.goal_height_m + 0.6;
        Goal {
            side,
            line,
            half,
            height: pitch.goal_height_m,
            depth: pitch.goal_depth_m,
            ball,
            inside,
        }
    }

    /// The y at which a band begins; band 0 is at the far post.
    pub(crate) fn band_y(&self, band: usize) -> f32 {
        -self.half + 2.0 * self.half * band as f32 / BANDS as f32
    }

    /// A point of the goal: metres behind the line, across, up.
    fn point(&self, behind: f32, y: f32, z: f32) -> Vec3 {
        Vec3::new((self.line + behind) * self.side, y, z)
    }

    /// A point of the net, pushed out by the ball; `out` is the panel's outward direction in
    /// (behind, y, z).
    fn net(&self, behind: f32, y: f32, z: f32, out: Vec3) -> Vec3 {
        let at = self.point(behind, y, z);
        if !self.inside {
            return at;
        }
        let out = Vec3::new(out.x * self.side, out.y, out.z);
        let to_ball = self.ball - at;
        // How far the ball is inside the panel; beyond it, the net goes along.
        let gap = -to_ball.dot(out) - ball::RADIUS_M;
        let around = (to_ball + out * (gap + ball::RADIUS_M)).length();
        let push = PUSH_M * within(1.0 - gap / 0.5, 0.0, 1.0) + within(-gap, 0.0, 0.8);
        at + out * (push * smooth(1.0 - around / BULGE_M))
    }

    /// How deep the net is at a height.
    fn deep(&self, z: f32) -> f32 {
        self.depth * (1.0 - (1.0 - TOP) * z / self.height)
    }

    /// Draws one band: woodwork and net.
    pub(crate) fn draw(&self, canvas: &mut Raster<'_>, view: &CameraView, band: usize) {
        let Some(spot) = view.spot(self.point(0.0, 0.0, 0.0)) else { return };
        if spot.scale < 4.0 {
            self.small(canvas, view, band);
            return;
        }
        if !self.seen(canvas, view) {
            return;
        }
        let mesh = MESH_M.max(MESH_PX / spot.scale);
        let (from, to) = (self.band_y(band), self.band_y(band + 1));
        if band == 0 {
            self.side_net(canvas, view, -self.half, mesh);
        }
        self.back(canvas, view, from, to, mesh);
        if band == 0 {
            self.post(canvas, view, -self.half);
        }
        self.bar(canvas, view, from, to);
        if band + 1 == BANDS {
            self.side_net(canvas, view, self.half, mesh);
            self.post(canvas, view, self.half);
        }
    }

    /// Whether any part of the goal can be in the picture.
    fn seen(&self, canvas: &Raster<'_>, view: &CameraView) -> bool {
        let mut low = Vec2::splat(f32::MAX);
        let mut high = Vec2::splat(f32::MIN);
        for corner in 0..8 {
            let pick = |bit: u32, a: f32, b: f32| if corner & bit == 0 { a } else { b };
            let at = self.point(
                pick(1, -1.0, self.depth + 1.5),
                pick(2, -1.0, 1.0) * (self.half + 1.0),
                pick(4, 0.0, self.height + 1.0),
            );
            let Some(spot) = view.spot(at) else { return true };
            low = low.min(spot.at);
            high = high.max(spot.at);
        }
        canvas.span(low, high).is_some()
    }

    /// A goal of a few pixels.
    fn small(&self, canvas: &mut Raster<'_>, view: &CameraView, band: usize) {
        let (from, to) = (self.band_y(band), self.band_y(band + 1));
        let corners = [(0.0, self.height), (self.depth * TOP, self.height), (self.depth, 0.0)];
        let spots = |y: f32| {
            corners.map(|(behind, z)| view.spot(self.point(behind, y, z)).map(|spot| spot.at))
        };
        if let ([Some(a), Some(b), Some(c)], [Some(d), Some(e), Some(f)]) = (spots(from), spots(to))
        {
            for corners in [[a, b, d], [b, d, e], [b, c, e], [c, e, f]] {
                canvas.triangle(corners, WOOD, 0.3);
            }
        }
        self.bar(canvas, view, from, to);
        if band == 0 {
            self.post(canvas, view, -self.half);
        } else if band + 1 == BANDS {
            self.post(canvas, view, self.half);
        }
    }

    fn post(&self, canvas: &mut Raster<'_>, view: &CameraView, y: f32) {
        wood(canvas, view, self.point(0.0, y, 0.0), self.point(0.0, y, self.height));
    }

    fn bar(&self, canvas: &mut Raster<'_>, view: &CameraView, from: f32, to: f32) {
        wood(canvas, view, self.point(0.0, from, self.height), self.point(0.0, to, self.height));
    }

    /// Roof and back of the net between two y.
    fn back(&self, canvas: &mut Raster<'_>, view: &CameraView, from: f32, to: f32, mesh: f32) {
        let columns = cells((to - from) / mesh);
        let (rows, roof) = (cells(self.height / mesh), cells(self.depth * TOP / mesh));
        let step_y = (to - from) / columns as f32;
        let edge = self.depth * TOP;
        let behind_out = Vec3::X;
        let roof_at =
            |i: usize, y: f32| self.net(edge * i as f32 / roof as f32, y, self.height, Vec3::Z);
        let back_at = |j: usize, y: f32| {
            let z = self.height * (1.0 - j as f32 / rows as f32);
            self.net(self.deep(z), y, z, behind_out)
        };
        for column in 0..=columns {
            let y = from + step_y * column as f32;
            // The last thread of a band is the first of the next one.
            if column < columns || to >= self.half {
                thread(canvas, view, (0..=roof).map(|i| roof_at(i, y)), 0.34);
                thread(canvas, view, (0..=rows).map(|j| back_at(j, y)), 0.38);
            }
        }
        for i in 1..=roof {
            thread(canvas, view, (0..=columns).map(|c| roof_at(i, from + step_y * c as f32)), 0.34);
        }
        for j in 1..=rows {
            let strength = if j == rows { 0.7 } else { 0.38 };
            thread(
                canvas,
                view,
                (0..=columns).map(|c| back_at(j, from + step_y * c as f32)),
                strength,
            );
        }
    }

    fn side_net(&self, canvas: &mut Raster<'_>, view: &CameraView, y: f32, mesh: f32) {
        let out = Vec3::new(0.0, if y > 0.0 { 1.0 } else { -1.0 }, 0.0);
        let (columns, rows) = (cells(self.depth / mesh), cells(self.height / mesh));
        let at = |i: usize, j: usize| {
            let z = self.height * j as f32 / rows as f32;
            self.net(self.deep(z) * i as f32 / columns as f32, y, z, out)
        };
        for i in 1..=columns {
            thread(canvas, view, (0..=rows).map(|j| at(i, j)), 0.34);
        }
        for j in 0..=rows {
            let strength = if j == 0 { 0.7 } else { 0.34 };
            thread(canvas, view, (0..=columns).map(|i| at(i, j)), strength);
        }
    }
}

/// Whole cells of a net; a bound keeps a strange goal cheap.
fn cells(count: f32) -> usize {
    within(count + 0.5, 1.0, 40.0) as usize
}

/// A thread of the net through some points.
fn thread(
    canvas: &mut Raster<'_>,
    view: &CameraView,
    points: impl Iterator<Item = Vec3>,
    strength: f32,
) {
    let mut last = None;
    for point in points {
        let spot = view.spot(point);
        if let (Some(from), Some(to)) = (last, spot) {
            line(canvas, from, to, strength);
        }
        last = spot.map(|spot| spot.at);
    }
}

fn line(canvas: &mut Raster<'_>, from: Vec2, to: crate::view::Spot, strength: f32) {
    canvas.stroke(from, to.at, (0.011 * to.scale).max(0.3), WOOD, strength);
}

/// A piece of woodwork, lit from the left.
fn wood(canvas: &mut Raster<'_>, view: &CameraView, a: Vec3, b: Vec3) {
    let (Some(a), Some(b)) = (view.spot(a), view.spot(b)) else { return };
    let shape = crate::canvas::Capsule {
        a: a.at,
        b: b.at,
        ra: (POST_M * a.scale).max(0.55),
        rb: (POST_M * b.scale).max(0.55),
    };
    canvas.capsule(shape, 1.0, |off| {
        scaled(WOOD, within(0.9 - 0.22 * off.x - 0.1 * off.y, 0.6, 1.0))
    });
}
