//! Where a team lines up for a set piece. (GRF's figures.)
//!
//! A player's number in the team decides the place, not the role. Each number has a slot of one
//! 4-3-3. A set piece stretches that block over a part of the pitch and draws it towards the ball.
//! All coordinates are in the team's own frame; the team attacks towards +x.

use crate::football::block::TeamBlock;
use crate::math;
use crate::state::Match;
use glam::Vec2;
use setpiece_scenario::PitchSize;
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::vocabulary::{GameMode, PitchMeasure, Team};

/// How far in front of the goal line a keeper waits, a share of half the pitch.
const KEEPER: f32 = 0.02;
/// How far everybody keeps from a penalty and its box, metres beyond the law's distance.
const PENALTY_MARGIN_M: f32 = 0.5;

/// The slot of each number in a full team: x from -1 (back) to 1 (front), y + to the right in the
/// own frame. The first is the keeper's.
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

/// Gives every player the slot of their number.
pub fn assign_slots(game: &mut Match) {
    for team in [Team::Left, Team::Right] {
        let size = game.team(team).count();
        for id in game.squad.of(team).ids() {
            let player = &mut game.players[id.index()];
            player.body.mind.slot = slot(id.in_team(), size);
            player.body.mind.fills = id;
        }
    }
}

/// Where the keeper waits.
pub fn keeper(pitch: &PitchSize) -> Vec2 {
    let half = pitch.half_length() as f32;
    Vec2::new(KEEPER * half - half, 0.0)
}

/// Where an outfield player of a number waits.
///
/// - `own`: whether their team takes it.
/// - `ball`: where it lies, own frame.
/// - `slot`: that of the number; see [`slot()`].
pub fn place(pitch: &PitchSize, mode: GameMode, own: bool, ball: Vec2, slot: Vec2) -> Vec2 {
    let half = Vec2::new(pitch.half_length() as f32, pitch.half_width() as f32);
    let [circle, depth] =
        [PitchMeasure::Circle, PitchMeasure::BoxDepth].map(|of| pitch.measure(of) as f32);
    let place = layout_of(half, mode, own, ball).place(slot, half);
    match mode {
        GameMode::FreeKick if !own => keep_off(place, ball, circle),
        GameMode::Penalty => {
            let line = half.x - depth - PENALTY_MARGIN_M;
            let x = math::sign_or(ball.x, 1.0) * (place.x * math::sign_or(ball.x, 1.0)).min(line);
            keep_off(Vec2::new(x, place.y), ball, circle + PENALTY_MARGIN_M)
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

/// The slot of a number in a team of some size. The last players of a small team stand elsewhere,
/// because they lack a neighbour.
pub fn slot(number: usize, size: usize) -> Vec2 {
    match (size, number) {
        (3, 2) => Vec2::new(-1.0, -0.15),
        (6, 5) => Vec2::new(0.0, -0.3),
        (7, 5) => Vec2::new(0.033, -0.382),
        (7, 6) => Vec2::new(-0.153, 0.082),
        _ => SLOTS[number % TEAM_MAX],
    }
}

/// Moves a place away from the ball to this distance, if it is nearer.
fn keep_off(place: Vec2, ball: Vec2, least_m: f32) -> Vec2 {
    let away = place - ball;
    if away.length_squared() < least_m * least_m {
        ball + away.normalize_or(Vec2::NEG_X) * least_m
    } else {
        place
    }
}

fn layout_of(half: Vec2, mode: GameMode, own: bool, ball: Vec2) -> TeamBlock {
    let x = |x: f32| x.clamp(-half.x, half.x);
    // 0 at the own goal line, 1 at the opponents'.
    let up = ((ball.x / half.x).clamp(-1.0, 1.0) + 1.0) * 0.5;
    let plain = TeamBlock {
        depth: [-0.7 * half.x, 0.7 * half.x],
        half_width: 0.7 * half.y,
        middle_y: 0.0,
        towards_x: (0.0, 0.0),
        towards_y: (0.0, 0.0),
        towards: (ball, 0.0),
        midfield: (0.0, 0.0),
    };
    match mode {
        GameMode::Normal | GameMode::KickOff => plain,
        GameMode::GoalKick if own => TeamBlock { depth: [-0.5 * half.x, 0.2 * half.x], ..plain },
        GameMode::GoalKick => TeamBlock { depth: [-0.4 * half.x, 0.1 * half.x], ..plain },
        GameMode::Corner => {
            let towards = (ball * Vec2::new(0.95, 0.1), 0.9);
            let corner = TeamBlock { half_width: 0.6 * half.y, towards, ..plain };
            let y = 0.1 * ball.y;
            if own {
                let depth = [0.2 * half.x, 0.96 * half.x];
                let (towards_x, towards_y) = ((0.85 * depth[1], 0.7), (y, 0.7));
                TeamBlock { depth, towards_x, towards_y, midfield: (0.8, 0.5), ..corner }
            } else {
                let depth = [-0.98 * half.x, -0.5 * half.x];
                let (towards_x, towards_y) = ((0.94 * depth[0], 0.8), (y, 0.9));
                TeamBlock { depth, towards_x, towards_y, midfield: (-0.8, 0.7), ..corner }
            }
        }
        GameMode::ThrowIn => {
            let half_width = 0.75 * half.y;
            let near =
                TeamBlock { half_width, middle_y: 0.25 * ball.y, towards: (ball, 0.7), ..plain };
            let back = x(ball.x - 30.0);
            if own {
                let (towards_x, towards_y) = ((x(ball.x + 4.0), 0.4), (0.996 * ball.y, 0.6));
                TeamBlock { depth: [back, x(ball.x + 20.0)], towards_x, towards_y, ..near }
            } else {
                let (towards_x, towards_y) = ((x(ball.x - 16.0), 0.2), (0.95 * ball.y, 0.5));
                TeamBlock { depth: [back, x(ball.x + 15.0)], towards_x, towards_y, ..near }
            }
        }
        GameMode::FreeKick => {
            let around = TeamBlock { towards: (ball, 0.4), ..plain };
            if own {
                TeamBlock {
                    depth: [half.x * 0.7 * (up - 1.0), half.x * (0.3 + 0.7 * up)],
                    towards_x: (x(ball.x + 10.0), 0.5 + 0.2 * up),
                    towards_y: (0.4 * ball.y, 0.6 + 0.2 * up),
                    ..around
                }
            } else {
                TeamBlock {
                    depth: [-half.x * (1.0 - 0.6 * up), x(-half.x * (0.5 - 0.8 * up))],
                    towards_x: (x(ball.x - 20.0), 0.6 - 0.4 * up),
                    towards_y: (0.2 * ball.y, 0.8 - 0.4 * up),
                    ..around
                }
            }
        }
        GameMode::Penalty => {
            let wide = TeamBlock { half_width: 0.8 * half.y, ..plain };
            if own {
                let depth = [x(ball.x - 50.0), x(ball.x + 10.0)];
                TeamBlock { depth, towards_x: (ball.x, 0.6), towards_y: (0.0, 0.8), ..wide }
            } else {
                let depth = [x(ball.x - 11.0), x(ball.x + 20.0)];
                TeamBlock { depth, towards_x: (ball.x, 1.0), towards_y: (0.0, 1.0), ..wide }
            }
        }
    }
}
