//! The pitch: lawn, lines, goals with their nets.

use super::canvas::{Canvas, at};
use super::colours::{GRASS, LINE, VERGE, WOOD, faded};
use super::view::View;
use crate::scenario::pitch::{
    BOX_DEPTH_M, BOX_HALF_WIDTH_M, CIRCLE_RADIUS_M, GOAL_DEPTH_M, GOAL_HALF_WIDTH_M, HALF_LENGTH_M,
    HALF_WIDTH_M, PENALTY_SPOT_M, SIX_YARD_DEPTH_M, SIX_YARD_HALF_WIDTH_M,
};
use tiny_skia::Point;

/// Stripes of the lawn. The number is even, so that both halves look alike.
const STRIPES: u32 = 20;
/// Width of a line, metres; larger than life, so that it is visible.
const LINE_M: f32 = 0.16;
/// Distance between a net's threads, metres.
const MESH_M: f32 = 0.62;
/// Number of segments of a circle.
const PIECES: u32 = 72;

/// Draws the empty pitch over the whole picture.
pub fn draw(canvas: &mut Canvas<'_>, view: &View) {
    lawn(canvas, view);
    let width = view.length(LINE_M).max(1.0);
    let mut line = |points: &[(f64, f64)]| {
        let points: Vec<Point> =
            points.iter().map(|&(x, y)| view.point(x as f32, y as f32)).collect();
        canvas.line(&points, width, LINE);
    };
    let (x, y) = (HALF_LENGTH_M, HALF_WIDTH_M);
    line(&[(-x, -y), (x, -y), (x, y), (-x, y), (-x, -y)]);
    line(&[(0.0, -y), (0.0, y)]);
    line(&arc(0.0, 0.0, std::f64::consts::PI));
    let (spot, edge) = (x - PENALTY_SPOT_M, x - BOX_DEPTH_M);
    let half = ((spot - edge) / CIRCLE_RADIUS_M).acos();
    for side in [1.0, -1.0] {
        let turned =
            |points: &[(f64, f64)]| points.iter().map(|(x, y)| (x * side, *y)).collect::<Vec<_>>();
        for (depth, width) in
            [(BOX_DEPTH_M, BOX_HALF_WIDTH_M), (SIX_YARD_DEPTH_M, SIX_YARD_HALF_WIDTH_M)]
        {
            line(&turned(&[(x, -width), (x - depth, -width), (x - depth, width), (x, width)]));
        }
        line(&turned(&arc(spot, std::f64::consts::PI, half)));
        for flag in [-1.0, 1.0] {
            let turns = (0..=8).map(|i| f64::from(i) / 8.0 * std::f64::consts::FRAC_PI_2);
            let corner: Vec<_> =
                turns.map(|turn| (x - turn.cos(), flag * (y - turn.sin()))).collect();
            line(&turned(&corner));
        }
    }
    for (x, radius) in [(0.0, 0.35), (spot, 0.25), (-spot, 0.25)] {
        canvas.disc(view.point(x as f32, 0.0), view.length(radius).max(1.2), LINE);
    }
    for side in [1.0, -1.0] {
        goal(canvas, view, side);
    }
}

/// Part of a circle about `(x, 0)`: the angle it is centred on, and half its opening.
fn arc(x: f64, middle: f64, half: f64) -> Vec<(f64, f64)> {
    let turn = |i: u32| middle - half + 2.0 * half * f64::from(i) / f64::from(PIECES);
    (0..=PIECES)
        .map(|i| (x + CIRCLE_RADIUS_M * turn(i).cos(), CIRCLE_RADIUS_M * turn(i).sin()))
        .collect()
}

fn lawn(canvas: &mut Canvas<'_>, view: &View) {
    let (width, height) = canvas.size();
    canvas.polygon(&[at(0.0, 0.0), at(width, 0.0), at(width, height), at(0.0, height)], VERGE);
    let (half_x, half_y) = (HALF_LENGTH_M as f32, HALF_WIDTH_M as f32);
    let stripe = 2.0 * half_x / STRIPES as f32;
    for index in 0..STRIPES {
        let left = index as f32 * stripe - half_x;
        // Whole pixels, so that no seam is visible.
        let (from, to) = (view.point(left, -half_y), view.point(left + stripe, half_y));
        let (from, to) = (at(from.x.round(), from.y.round()), at(to.x.round(), to.y.round()));
        let corners = [from, at(to.x, from.y), to, at(from.x, to.y)];
        canvas.polygon(&corners, GRASS[index as usize % 2]);
    }
}

/// A goal: the net's threads, the posts. `side` is +1 at the right end.
fn goal(canvas: &mut Canvas<'_>, view: &View, side: f32) {
    let (line, half) = (HALF_LENGTH_M as f32, GOAL_HALF_WIDTH_M as f32);
    let depth = GOAL_DEPTH_M as f32;
    let point = |deep: f32, y: f32| view.point((line + deep) * side, y);
    canvas.polygon(
        &[point(0.0, -half), point(depth, -half), point(depth, half), point(0.0, half)],
        faded(WOOD, 0.12),
    );
    let thread = view.length(0.06).max(0.6);
    let rows = (2.0 * half / MESH_M).round();
    for row in 1..rows as u32 {
        let y = -half + 2.0 * half * row as f32 / rows;
        canvas.line(&[point(0.0, y), point(depth, y)], thread, faded(WOOD, 0.4));
    }
    let columns = (depth / MESH_M).round();
    for column in 1..columns as u32 {
        let deep = depth * column as f32 / columns;
        canvas.line(&[point(deep, -half), point(deep, half)], thread, faded(WOOD, 0.4));
    }
    let net = [point(0.0, -half), point(depth, -half), point(depth, half), point(0.0, half)];
    canvas.line(&net, view.length(0.14).max(1.0), faded(WOOD, 0.85));
    for y in [-half, half] {
        canvas.disc(point(0.0, y), view.length(0.28).max(1.8), WOOD);
    }
}
