//! Where a team lines up for a set piece. (GRF's figures.)
//!
//! Places go by the number in the team, whatever the roles: each number has a slot of one 4-3-3, and a set piece stretches
//! that block over a part of the pitch and draws it towards the ball. Everything is in the own frame of the team, which
//! attacks towards +x.

use crate::math;
use glam::Vec2;
use setpiece_scenario::pitch::{BOX_DEPTH_M, CIRCLE_RADIUS_M, HALF_LENGTH_M, HALF_WIDTH_M, TEAM_MAX};
use setpiece_scenario::vocabulary::GameMode;

/// Half the pitch, metres.
const HALF: Vec2 = Vec2::new(HALF_LENGTH_M as f32, HALF_WIDTH_M as f32);
/// How far in front of the goal line a keeper waits, metres.
const KEEPER_M: f32 = 0.02 * HALF.x;
/// How far everybody keeps from a penalty and from its box, metres beyond the law's distance.
const PENALTY_MARGIN_M: f32 = 0.5;
/// How far from the point that draws them players feel nothing of it, metres.
const DRAW_M: f32 = 50.0;

/// The slot of each number in a whole team: x -1 back to 1 front, y + to the right of the own frame; the first is a keeper's.
pub const SLOTS: [Vec2; TEAM_MAX] = [
    Vec2::new(-1.0, 0.0),
    Vec2::new(-0.74, -0.77),
    Vec2::new(-1.0, -0.25),
    Vec2::new(-1.0, 0.25),
    Vec2::new(-0.74, 0.77),
    Vec2::new(0.0526, -0.4157),
    Vec2::new(-0.2252, 0.0),
    Vec2::new(0.0526, 0.4157),
    Vec2::new(0.36, -0.85),
    Vec2::new(1.0, 0.0),
    Vec2::new(0.36, 0.85),
];

/// A point that draws players, and how strongly, 0..1.
type Draw = (f32, f32);

/// How a set piece lays out a team's block.
#[derive(Clone, Copy, Debug)]
struct Layout {
    /// x of the rearmost and of the foremost slot, metres.
    depth: [f32; 2],
    /// Half its width, metres.
    half_width: f32,
    /// y of its middle, metres.
    middle_y: f32,
    /// The x that draws those near it.
    towards_x: Draw,
    /// The y that draws those near it.
    towards_y: Draw,
    /// The point that draws everybody near it.
    towards: (Vec2, f32),
    /// Where midfielders go, x of a slot.
    midfield: Draw,
}

/// Where the keeper waits.
pub fn keeper() -> Vec2 {
    Vec2::new(KEEPER_M - HALF.x, 0.0)
}

/// Where an outfield player of a number waits.
///
/// - `own`: whether their team takes it.
/// - `ball`: where it lies, own frame.
/// - `size`: how many players the team has.
pub fn place(mode: GameMode, own: bool, ball: Vec2, number: usize, size: usize) -> Vec2 {
    let layout = layout_of(mode, own, ball);
    let place = layout.place(slot(number, size));
    match mode {
        GameMode::FreeKick if !own => keep_off(place, ball, CIRCLE_RADIUS_M as f32),
        GameMode::Penalty => {
            let line = HALF.x - BOX_DEPTH_M as f32 - PENALTY_MARGIN_M;
            let x = math::sign_or(ball.x, 1.0) * (place.x * math::sign_or(ball.x, 1.0)).min(line);
            keep_off(Vec2::new(x, place.y), ball, CIRCLE_RADIUS_M as f32 + PENALTY_MARGIN_M)
        }
        _ => place,
    }
}

/// Where the taker waits: behind the ball, for a run-up.
pub fn taker(mode: GameMode, ball: Vec2) -> Vec2 {
    let outwards = ball.normalize_or(Vec2::NEG_X);
    ball + match mode {
        GameMode::ThrowIn => outwards * 0.3,
        GameMode::FreeKick => Vec2::new(-2.3, 0.0),
        GameMode::Penalty => Vec2::new(-3.0, 0.0),
        _ => outwards * 2.3,
    }
}

/// The slot of a number in a team of some size: without a neighbour the last of a small team stand elsewhere.
fn slot(number: usize, size: usize) -> Vec2 {
    match (size, number) {
        (3, 2) => Vec2::new(-1.0, -0.15),
        (6, 5) => Vec2::new(0.0, -0.3),
        (7, 5) => Vec2::new(0.033, -0.382),
        (7, 6) => Vec2::new(-0.153, 0.082),
        _ => SLOTS[number % TEAM_MAX],
    }
}

/// A place no nearer to the ball than so far.
fn keep_off(place: Vec2, ball: Vec2, least_m: f32) -> Vec2 {
    let away = place - ball;
    if away.length_squared() < least_m * least_m { ball + away.normalize_or(Vec2::NEG_X) * least_m } else { place }
}

fn layout_of(mode: GameMode, own: bool, ball: Vec2) -> Layout {
    let x = |x: f32| x.clamp(-HALF.x, HALF.x);
    // 0 at the own goal line, 1 at the opponents'.
    let up = ((ball.x / HALF.x).clamp(-1.0, 1.0) + 1.0) * 0.5;
    let plain = Layout {
        depth: [-0.7 * HALF.x, 0.7 * HALF.x],
        half_width: 0.7 * HALF.y,
        middle_y: 0.0,
        towards_x: (0.0, 0.0),
        towards_y: (0.0, 0.0),
        towards: (ball, 0.0),
        midfield: (0.0, 0.0),
    };
    match mode {
        GameMode::Normal | GameMode::KickOff => plain,
        GameMode::GoalKick if own => Layout { depth: [-0.5 * HALF.x, 0.2 * HALF.x], ..plain },
        GameMode::GoalKick => Layout { depth: [-0.4 * HALF.x, 0.1 * HALF.x], ..plain },
        GameMode::Corner => {
            let towards = (ball * Vec2::new(0.95, 0.1), 0.9);
            let corner = Layout { half_width: 0.6 * HALF.y, towards, ..plain };
            let y = 0.1 * ball.y;
            if own {
                let depth = [0.2 * HALF.x, 0.96 * HALF.x];
                let (towards_x, towards_y) = ((0.85 * depth[1], 0.7), (y, 0.7));
                Layout { depth, towards_x, towards_y, midfield: (0.8, 0.5), ..corner }
            } else {
                let depth = [-0.98 * HALF.x, -0.5 * HALF.x];
                let (towards_x, towards_y) = ((0.94 * depth[0], 0.8), (y, 0.9));
                Layout { depth, towards_x, towards_y, midfield: (-0.8, 0.7), ..corner }
            }
        }
        GameMode::ThrowIn => {
            let half_width = 0.75 * HALF.y;
            let near = Layout { half_width, middle_y: 0.25 * ball.y, towards: (ball, 0.7), ..plain };
            let back = x(ball.x - 30.0);
            if own {
                let (towards_x, towards_y) = ((x(ball.x + 4.0), 0.4), (0.996 * ball.y, 0.6));
                Layout { depth: [back, x(ball.x + 20.0)], towards_x, towards_y, ..near }
            } else {
                let (towards_x, towards_y) = ((x(ball.x - 16.0), 0.2), (0.95 * ball.y, 0.5));
                Layout { depth: [back, x(ball.x + 15.0)], towards_x, towards_y, ..near }
            }
        }
        GameMode::FreeKick => {
            let around = Layout { towards: (ball, 0.4), ..plain };
            if own {
                Layout {
                    depth: [HALF.x * 0.7 * (up - 1.0), HALF.x * (0.3 + 0.7 * up)],
                    towards_x: (x(ball.x + 10.0), 0.5 + 0.2 * up),
                    towards_y: (0.4 * ball.y, 0.6 + 0.2 * up),
                    ..around
                }
            } else {
                Layout {
                    depth: [-HALF.x * (1.0 - 0.6 * up), x(-HALF.x * (0.5 - 0.8 * up))],
                    towards_x: (x(ball.x - 20.0), 0.6 - 0.4 * up),
                    towards_y: (0.2 * ball.y, 0.8 - 0.4 * up),
                    ..around
                }
            }
        }
        GameMode::Penalty => {
            let wide = Layout { half_width: 0.8 * HALF.y, ..plain };
            if own {
                let depth = [x(ball.x - 50.0), x(ball.x + 10.0)];
                Layout { depth, towards_x: (ball.x, 0.6), towards_y: (0.0, 0.8), ..wide }
            } else {
                let depth = [x(ball.x - 11.0), x(ball.x + 20.0)];
                Layout { depth, towards_x: (ball.x, 1.0), towards_y: (0.0, 1.0), ..wide }
            }
        }
    }
}

impl Layout {
    /// Where a slot of the block lies.
    fn place(&self, slot: Vec2) -> Vec2 {
        let [back, front] = self.depth;
        let middle = (1.0 - 1.2 * slot.x.abs()).max(0.0);
        let moved = mix(slot.x, self.midfield.0, ease(middle) * self.midfield.1);
        let plain = Vec2::new(back + (0.5 * moved + 0.5) * (front - back), self.middle_y + slot.y * self.half_width);
        let (x, keen) = self.towards_x;
        let near = 1.0 - ((x - plain.x) / (front - back)).abs().min(1.0);
        let place_x = mix(plain.x, x, math::pow(ease(near), 0.8) * keen);
        let (y, keen) = self.towards_y;
        let near = 1.0 - ((y - plain.y) / (2.0 * self.half_width)).abs().min(1.0);
        let place_y = mix(plain.y, y, near * (0.2 + 0.8 * y.abs() / HALF.y) * keen);
        self.drawn(plain, Vec2::new(place_x, place_y))
    }

    /// Draws a place towards the point, by how near to it the slot lies.
    fn drawn(&self, plain: Vec2, place: Vec2) -> Vec2 {
        let (point, keen) = self.towards;
        let far = ((point - plain) * Vec2::new(1.0, 0.8)).length() / DRAW_M;
        if keen <= 0.0 || far >= 1.0 {
            return place;
        }
        let near = 1.0 - far;
        let beside = 0.1 * (1.0 - ((far - 0.15).abs() / 0.25).min(1.0));
        let pull = (mix(near, ease(near), 0.3) + beside).clamp(0.0, 1.0) * keen;
        let to = Vec2::new(point.x, mix(point.y, place.y, 0.4));
        place + (to - place) * pull
    }
}

/// From `a` to `b` by a share.
fn mix(a: f32, b: f32, share: f32) -> f32 {
    a + (b - a) * share
}

/// A share 0..1, slow at both ends.
fn ease(share: f32) -> f32 {
    0.5 - 0.5 * math::cos(share * std::f32::consts::PI)
}
