//! Bodies don't pass through each other: circles of 0.36 m are pushed apart. Who is pushed plays worse for a moment, and
//! may fall.

use crate::event::Events;
use crate::football::body::Pose;
use crate::football::rows::{ROWS, WIDTH};
use crate::football::{foul, frame};
use crate::state::{Match, PlayerId};
use arrayvec::ArrayVec;
use glam::Vec2;
use setpiece_scenario::pitch::{PLAYERS_MAX, RIM_X_M, RIM_Y_M};
use setpiece_scenario::vocabulary::Stat;
use wide::f32x4;

/// Distance at which two bodies touch, metres.
pub const CONTACT_M: f32 = 0.72;
/// How near one comes to a man who lies, metres; chosen.
const LYING_M: f32 = 0.5;
/// Most that one meeting moves a body in two ticks, metres. (GRF's: 0.08 a tick.)
const PUSH_MAX_M: f32 = 0.16;
/// However hard others press, a meeting leaves two bodies no nearer than this, metres; chosen so that they never change
/// sides before they meet again.
const PRESSED_M: f32 = 0.2;

/// How far who slips by is moved aside in two ticks, metres, and what share of their pace they keep; chosen.
const SLIP_M: f32 = 0.05;
const SLIPS_AT: f32 = 0.93;

/// The most that pushes add up to, metres. (GRF's.)
const SHOVE_MAX_M: f32 = 0.1;
/// Share of a push that is left after two ticks: 0.95 a tick.
const SHOVE_LEFT: f32 = 0.9025;

/// Where nobody is, metres.
const FAR_M: f32 = 1.0e6;

/// Pushes overlapping bodies apart and keeps everyone within the rim and out of the goals' frames.
pub fn separate(game: &mut Match, events: &mut Events) {
    // Places beyond the last lie too far off to meet anybody.
    let mut xs = [[FAR_M; WIDTH]; ROWS];
    let mut ys = [[0.0; WIDTH]; ROWS];
    let mut ids: ArrayVec<PlayerId, PLAYERS_MAX> = ArrayVec::new();
    for id in game.order() {
        let player = &mut game.players[id.index()];
        player.body.push_m *= SHOVE_LEFT;
        if player.active {
            let (row, at) = (ids.len() / WIDTH, ids.len() % WIDTH);
            (xs[row][at], ys[row][at]) = (player.pos.x, player.pos.y);
            ids.push(id);
        }
    }
    let near = f32x4::splat(CONTACT_M * CONTACT_M);
    for i in 0..ids.len() {
        let (x, y) = (f32x4::splat(xs[i / WIDTH][i % WIDTH]), f32x4::splat(ys[i / WIDTH][i % WIDTH]));
        for row in i / WIDTH..ids.len().div_ceil(WIDTH) {
            let (dx, dy) = (f32x4::new(xs[row]) - x, f32x4::new(ys[row]) - y);
            let mut meets = (dx * dx + dy * dy).simd_lt(near).to_bitmask();
            while meets != 0 {
                let j = row * WIDTH + meets.trailing_zeros() as usize;
                meets &= meets - 1;
                if j > i {
                    part(game, events, ids[i], ids[j]);
                }
            }
        }
    }
    let (x, y) = (RIM_X_M as f32, RIM_Y_M as f32);
    for id in ids {
        let player = &mut game.players[id.index()];
        if !player.active {
            continue;
        }
        player.pos = player.pos.clamp(Vec2::new(-x, -y), Vec2::new(x, y));
        frame::keep_out(&mut player.pos, &mut player.vel);
    }
}

/// Who comes to a man on the ground goes round him; `away`: from that man to him.
fn go_round(game: &mut Match, id: PlayerId, away: Vec2, distance: f32) {
    let player = &mut game.players[id.index()];
    player.pos += away * (LYING_M - distance).clamp(0.0, PUSH_MAX_M);
    player.vel -= away * player.vel.dot(away).min(0.0);
}

/// Who runs past a wrong-footed opponent slips by at the side, a little slower.
fn slip_by(game: &mut Match, id: PlayerId, away: Vec2, distance: f32) {
    let player = &mut game.players[id.index()];
    let ahead = player.vel.normalize_or(away);
    let left = Vec2::new(-ahead.y, ahead.x);
    let side = if left.dot(away) < 0.0 { -left } else { left };
    player.pos += side * (CONTACT_M - distance).clamp(0.0, SLIP_M);
    player.vel *= SLIPS_AT;
}

/// Pushes two bodies apart; the better balanced one yields less.
fn part(game: &mut Match, events: &mut Events, i: PlayerId, j: PlayerId) {
    let (a, b) = (*game.player(i), *game.player(j));
    let between = b.pos - a.pos;
    let distance = between.length();
    // Exactly on one spot: they part sideways, the first to his left.
    let away = if distance > 1e-4 { between / distance } else { Vec2::new(0.0, i.team().side() as f32) };
    match (a.body.pose == Pose::Down, b.body.pose == Pose::Down) {
        (false, false) => {}
        (true, false) => return go_round(game, j, away, distance),
        (false, true) => return go_round(game, i, -away, distance),
        (true, true) => return,
    }
    if i.team() != j.team() && distance > PRESSED_M {
        match (a.is_wrong_footed(), b.is_wrong_footed()) {
            (true, false) => return slip_by(game, j, away, distance),
            (false, true) => return slip_by(game, i, -away, distance),
            _ => {}
        }
    }
    let overlap = (CONTACT_M - distance).max(0.0);
    let mut share = 0.5 + 0.25 * (a.skill(Stat::Balance) - b.skill(Stat::Balance));
    if game.owner == Some(i) {
        share += 0.15;
    } else if game.owner == Some(j) {
        share -= 0.15;
    }
    let share = share.clamp(0.1, 0.9);
    let step = overlap.min(PUSH_MAX_M).max(PRESSED_M - distance);
    let closing = (b.vel - a.vel).dot(away).min(0.0);
    let first = &mut game.players[i.index()];
    first.pos -= away * (step * (1.0 - share));
    first.vel += away * (closing * (1.0 - share));
    first.body.push_m = (first.body.push_m + step * (1.0 - share)).min(SHOVE_MAX_M);
    let second = &mut game.players[j.index()];
    second.pos += away * (step * share);
    second.vel -= away * (closing * share);
    second.body.push_m = (second.body.push_m + step * share).min(SHOVE_MAX_M);
    if i.team() != j.team() && closing < -1.0 {
        let victim = if a.body.facing.dot(away) < b.body.facing.dot(-away) { i } else { j };
        foul::shove(game, events, if victim == i { j } else { i }, victim, -closing);
    }
}
