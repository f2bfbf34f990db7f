//! Set pieces: who takes one and where everybody stands.

use crate::football::offside;
use crate::football::play::Restart;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::Ai;
use setpiece_scenario::pitch::{
    BOX_DEPTH_M, BOX_HALF_WIDTH_M, CIRCLE_RADIUS_M, HALF_LENGTH_M, HALF_WIDTH_M, PLAYERS_MAX,
};
use setpiece_scenario::vocabulary::{GameMode, Role, Rule, Team};

/// How far a wall stands from the ball, metres. Laws.
const WALL_M: f32 = CIRCLE_RADIUS_M as f32;
/// How far everybody keeps from a penalty, metres. (GRF's, and a little for who is pushed aside.)
const PENALTY_M: f32 = 9.65 + 0.4;
/// A wall is built for free kicks nearer to goal than this, metres (GRF's).
pub const WALL_WITHIN_M: f32 = 40.0;
/// How near two men stand at a set piece at the nearest, metres: about a body's breadth.
const APART_M: f32 = 0.74;
/// How far behind the offside line attackers wait for a free kick, metres; chosen: they may be moved apart yet.
const ONSIDE_M: f32 = 1.0;
/// Times that a crowd is gone through until nobody stands in anybody.
const SPREAD_PASSES: usize = 8;
/// How high the ball is held before a throw-in, metres; chosen.
const OVERHEAD_M: f32 = 1.9;
/// From one man of a wall to the next, metres.
const WALL_SPACING_M: f32 = 0.75;

/// Who takes a set piece: the nearest, but the keeper for goal kicks and nobody but an outfielder else, and who is lazy
/// only where everybody is.
pub fn taker(game: &Match, restart: Restart) -> Option<PlayerId> {
    let mut best: Option<(f32, PlayerId)> = None;
    for (id, player) in game.team(restart.team) {
        let keeper = player.role == Role::GK;
        let misplaced = if keeper == (restart.mode == GameMode::GoalKick) { 0.0 } else { 1.0e4 };
        let unwilling = if player.ai == Ai::Lazy { 1.0e5 } else { 0.0 };
        let distance = player.pos.distance(restart.spot) + misplaced + unwilling;
        if best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, id));
        }
    }
    best.map(|(_, id)| id)
}

/// Places everyone for a set piece other than a kick-off.
pub fn arrange(game: &mut Match, restart: Restart, taker: PlayerId) {
    for i in 0..PLAYERS_MAX {
        let id = PlayerId(i as u8);
        let player = &game.players[i];
        if !player.active || id == taker {
            continue;
        }
        let own = id.team() == restart.team;
        let place = if player.role == Role::GK {
            Vec2::new(-53.9 * id.team().side() as f32, 0.0)
        } else {
            place_of(restart, id.team(), own, player.body.mind.slot, id.in_team())
        };
        game.players[i].pos = place;
    }
    keep_distance(game, restart);
    build_wall(game, restart);
    if restart.mode == GameMode::FreeKick && game.rule(Rule::Offside) {
        keep_onside(game, restart.team);
    }
    let side = restart.team.side() as f32;
    let behind = match restart.mode {
        GameMode::ThrowIn => Vec2::new(0.0, 0.35 * restart.spot.y.signum()),
        GameMode::Corner => Vec2::new(0.35 * side, 0.35 * restart.spot.y.signum()),
        _ => Vec2::new(-0.7 * side, 0.0),
    };
    game.players[taker.index()].pos = restart.spot + behind;
    if restart.mode == GameMode::ThrowIn {
        game.ball.pos.z = OVERHEAD_M;
    }
    spread_out(game, taker);
}

/// Nobody of the team that takes a free kick waits in an offside position.
fn keep_onside(game: &mut Match, team: Team) {
    let side = team.side() as f32;
    let line = offside::line(game, team) - ONSIDE_M;
    game.each(game.squad.of(team), |player| {
        if player.pos.x * side > line {
            player.pos.x = line * side;
        }
    });
}

/// Moves those apart who would stand inside each other; the taker and keepers stay. Returns whether anybody was moved.
pub fn spread_out(game: &mut Match, taker: PlayerId) -> bool {
    for pass in 0..SPREAD_PASSES {
        let mut moved = false;
        for a in game.order() {
            for b in game.order() {
                let (first, second) = (game.player(a), game.player(b));
                let between = second.pos - first.pos;
                let near = between.length_squared() < APART_M * APART_M;
                let stays = b == taker || second.role == Role::GK;
                if !near || a == b || stays || !first.active || !second.active {
                    continue;
                }
                let distance = between.length();
                let away = if distance > 1e-3 { between / distance } else { Vec2::new(0.0, a.team().side() as f32) };
                game.players[b.index()].pos = first.pos + away * (APART_M + 0.01);
                moved = true;
            }
        }
        if !moved {
            return pass > 0;
        }
    }
    true
}

/// Where a player of a slot stands: his slot stretched over the part of the pitch that the set piece is about.
fn place_of(restart: Restart, team: Team, own: bool, slot: Vec2, index: usize) -> Vec2 {
    let side = team.side() as f32;
    let (half_x, half_y) = (HALF_LENGTH_M as f32, HALF_WIDTH_M as f32);
    // The ball in the own frame of the player's team.
    let ball = restart.spot * side;
    let share = (slot.x + 1.0) * 0.5;
    let (back, front, width, pull_x, focus_x, pull_y) = match restart.mode {
        GameMode::GoalKick if own => (-0.62 * half_x, 0.15 * half_x, 0.85, 0.0, 0.0, 0.0),
        GameMode::GoalKick => (-0.45 * half_x, 0.40 * half_x, 0.7, 0.0, 0.0, 0.0),
        GameMode::Corner if own => (0.05 * half_x, 0.92 * half_x, 0.40, 0.65, 0.86 * half_x, 0.1),
        GameMode::Corner => (-0.95 * half_x, -0.55 * half_x, 0.42, 0.7, -0.88 * half_x, 0.1),
        GameMode::ThrowIn if own => (ball.x - 30.0, ball.x + 20.0, 0.8, 0.25, ball.x + 4.0, 0.45),
        GameMode::ThrowIn => (ball.x - 30.0, ball.x + 15.0, 0.8, 0.25, ball.x - 10.0, 0.4),
        GameMode::Penalty if own => (-0.2 * half_x, 0.65 * half_x, 0.7, 0.0, 0.0, 0.0),
        GameMode::Penalty => (-0.66 * half_x, 0.2 * half_x, 0.7, 0.0, 0.0, 0.0),
        _ if own => (ball.x - 32.0, ball.x + 22.0, 0.8, 0.1, ball.x + 8.0, 0.25),
        _ => ((ball.x - 34.0).max(-46.0), (ball.x + 12.0).max(-30.0), 0.75, 0.2, (ball.x - 14.0).max(-42.0), 0.3),
    };
    let x = back + share * (front - back);
    let x = x + (focus_x - x) * pull_x;
    let y = slot.y * width * half_y;
    let y = y + (ball.y - y) * pull_y;
    // Two men of one slot stand a little apart.
    let apart = ((index * 7) % 5) as f32 * 0.35 - 0.7;
    let place = Vec2::new(x.clamp(-half_x + 1.0, half_x - 1.0), (y + apart).clamp(-half_y + 1.0, half_y - 1.0));
    place * side
}

/// The three nearest defenders stand in the way of a free kick near their goal, as near as they may.
fn build_wall(game: &mut Match, restart: Restart) {
    let goal = Vec2::new(HALF_LENGTH_M as f32 * restart.team.side() as f32, 0.0);
    let way = goal - restart.spot;
    let distance = way.length();
    if restart.mode != GameMode::FreeKick || !(WALL_M + 1.5..WALL_WITHIN_M).contains(&distance) {
        return;
    }
    let ahead = way / distance;
    let aside = Vec2::new(-ahead.y, ahead.x);
    let middle = restart.spot + ahead * WALL_M;
    let mut taken = 0u32;
    for place in [0.0, 1.0, -1.0] {
        let mut best: Option<(f32, PlayerId)> = None;
        for (id, player) in game.team(restart.team.other()) {
            let away = player.pos.distance_squared(middle);
            let free = player.role != Role::GK && taken & (1 << id.0) == 0;
            if free && best.is_none_or(|(least, _)| away < least) {
                best = Some((away, id));
            }
        }
        let Some((_, id)) = best else { return };
        taken |= 1 << id.0;
        game.players[id.index()].pos = middle + aside * (place * WALL_SPACING_M);
    }
}

/// Opponents keep their distance; at a penalty everyone keeps out of the box.
fn keep_distance(game: &mut Match, restart: Restart) {
    let apart = match restart.mode {
        GameMode::ThrowIn => 3.0,
        _ => CIRCLE_RADIUS_M as f32,
    };
    let line = (HALF_LENGTH_M - BOX_DEPTH_M) as f32;
    let side = restart.team.side() as f32;
    for (i, player) in game.players.iter_mut().enumerate() {
        if !player.active || player.role == Role::GK {
            continue;
        }
        let own = PlayerId(i as u8).team() == restart.team;
        let least = match restart.mode {
            GameMode::Penalty => PENALTY_M,
            _ if own => 2.5,
            _ => apart,
        };
        let away = player.pos - restart.spot;
        if away.length() < least {
            let inward = Vec2::new(-restart.spot.x, -restart.spot.y).normalize_or(Vec2::new(-side, 0.0));
            player.pos = restart.spot + away.normalize_or(inward) * least;
            let (x, y) = (HALF_LENGTH_M as f32, HALF_WIDTH_M as f32);
            if player.pos.x.abs() > x || player.pos.y.abs() > y {
                player.pos = restart.spot + inward * least;
            }
        }
        let in_box = player.pos.x.abs() > line - 0.5 && player.pos.y.abs() < BOX_HALF_WIDTH_M as f32 + 0.5;
        let that_box = player.pos.x * restart.spot.x > 0.0;
        if restart.mode == GameMode::Penalty && in_box && that_box {
            player.pos.x = (line - 1.0) * restart.spot.x.signum();
        }
        if restart.mode == GameMode::GoalKick && !own && in_box && that_box {
            player.pos.x = (line - 1.0) * restart.spot.x.signum();
        }
    }
}
