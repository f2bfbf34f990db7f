//! Where a shot goes and how hard.

use crate::football::body::KickPlan;
use crate::football::noise;
use crate::math;
use crate::state::{Match, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::pitch::{GOAL_HALF_WIDTH_M, HALF_LENGTH_M};
use setpiece_scenario::vocabulary::{GameMode, Role, Stat};

/// A held direction further off the goal than this, about half of what is between two directions, is not meant for it;
/// radians. Measured: such a shot goes along it.
const MEANT_FOR_GOAL_RAD: f32 = 0.4;
/// A held direction nearer to the middle of the goal than this names no side; radians.
const STRAIGHT_RAD: f32 = 0.2;
/// With how much a shot falls, its backspin reckoned in, m/s². Measured.
const FALL_MPS2: f32 = 7.4;
/// How far off the middle a shot is placed beside the keeper: at least, and how much further at most, metres.
const PLACED_M: [f32; 2] = [0.4, 2.0];

/// The point that a shot aims at: the bot's, or what the held direction means.
fn aim(game: &mut Match, id: PlayerId, from: Vec2, plan: &KickPlan) -> Vec2 {
    let side = id.team().side() as f32;
    match (plan.point, plan.dir) {
        (Some(point), _) => point,
        (None, Some(dir)) if penalty(game) => beside_middle(from, side, off_goal(from, side, dir)),
        (None, Some(dir)) if off_goal(from, side, dir).abs() > STRAIGHT_RAD => aim_of(from, side, plan.dir),
        (None, _) => beside_keeper(game, id, from, goal_of(side)),
    }
}

/// Whether the shot is a penalty: then a held direction names the side of the goal, however far it points beside it.
fn penalty(game: &Match) -> bool {
    game.mode == GameMode::Penalty
}

/// The middle of the goal that a side attacks.
fn goal_of(side: f32) -> Vec2 {
    Vec2::new(HALF_LENGTH_M as f32 * side, 0.0)
}

/// The angle from the way to the goal's middle to a world direction, radians.
fn off_goal(from: Vec2, side: f32, dir: Vec2) -> f32 {
    let way = goal_of(side) - from;
    math::atan2(way.perp_dot(dir), way.dot(dir))
}

/// The point that a shot with a held world direction aims at, whatever the keeper does.
pub fn aim_of(from: Vec2, side: f32, dir: Option<Vec2>) -> Vec2 {
    let goal = goal_of(side);
    let Some(dir) = dir else { return goal };
    let angle = off_goal(from, side, dir);
    if angle.abs() > MEANT_FOR_GOAL_RAD {
        return from + dir * 30.0;
    }
    beside_middle(from, side, angle)
}

/// The point of the goal mouth that a direction means which is so far off its middle, radians. (GRF's.)
fn beside_middle(from: Vec2, side: f32, angle: f32) -> Vec2 {
    let goal = goal_of(side);
    // The sign of the angle tells the side of the goal in the shooter's own view.
    let angle = angle.clamp(-std::f32::consts::FRAC_PI_2, std::f32::consts::FRAC_PI_2);
    let turn = 2.0 * angle / std::f32::consts::PI;
    let shift = libm::powf(turn.abs(), 0.7) * math::sign_or(turn, 1.0);
    Vec2::new(goal.x, shift * math::sign_or(goal.x - from.x, side) * GOAL_HALF_WIDTH_M as f32 * 0.9)
}

/// A point of the goal mouth on the side that the keeper leaves open.
fn beside_keeper(game: &mut Match, id: PlayerId, from: Vec2, goal: Vec2) -> Vec2 {
    let side = id.team().side() as f32;
    let keeper = game.team(id.team().other()).find(|(_, rival)| rival.role == Role::GK).map(|(_, rival)| rival.pos);
    let (chosen, far) = (noise::roll(game), noise::roll(game));
    // Where he stands off the line to the middle, own frame, metres.
    let off = keeper.map_or(0.0, |keeper| (goal - from).normalize_or_zero().perp_dot(keeper - from));
    let open = if off.abs() > 0.1 { -math::sign_or(off, 1.0) } else { math::sign_or(chosen - 0.5, 1.0) };
    Vec2::new(goal.x, open * side * (PLACED_M[0] + PLACED_M[1] * far))
}

/// The velocity of a shot; `rough` 0..1 is how awkward it is.
pub fn velocity(game: &mut Match, id: PlayerId, plan: &KickPlan, rough: f32) -> Vec3 {
    let player = *game.player(id);
    let side = id.team().side() as f32;
    let from = game.ball.pos.truncate();
    let target = aim(game, id, from, plan);
    let way = (target - from).normalize_or(Vec2::new(side, 0.0));
    let run_up = (player.vel.dot(way) / 5.0).clamp(0.0, 1.0);
    let power = 0.55 + 0.45 * plan.power;
    let skill = player.skill(Stat::Shot);
    let strength = 0.8 + 0.2 * player.skill(Stat::ShotPower);
    let speed = (28.3 + 4.4 * run_up + 8.0 * plan.power.max(0.0)) * strength * (1.0 - 0.3 * rough);
    // Squarely to the run is worst: a shot across the body.
    let across =
        if player.vel.length_squared() > 4.0 { 1.0 - player.vel.normalize_or_zero().dot(way).max(0.0) } else { 0.0 };
    let awkward = (rough + 0.5 * across).clamp(0.0, 1.0);
    let wild = (0.028 + 0.20 * awkward) * (1.45 - skill) * (0.6 + 0.4 * power);
    let aside = noise::bell(game) * wild;
    // Without a run-up the foot gets under the ball.
    let under = 1.0 - run_up;
    let rise = 0.062
        + noise::bell(game) * (0.018 + 0.03 * under + wild * 0.45)
        + (0.08 * awkward + 0.075 * under) * noise::roll(game);
    let flat = (way + Vec2::new(-way.y, way.x) * aside) * speed;
    flat.extend(speed * rise.clamp(0.0, 0.7))
}

/// The velocity of a free kick at goal: slower and higher, so that it comes down behind the wall.
///
/// The rise is the one with which a ball of that speed crosses the goal line at 1.2 m.
pub fn over_wall(game: &mut Match, id: PlayerId, plan: &KickPlan) -> Vec3 {
    let from = game.ball.pos.truncate();
    let way = aim(game, id, from, plan) - from;
    let distance = way.length().max(1.0);
    let ahead = way / distance;
    let speed = (20.5 + 0.12 * distance) * (0.9 + 0.1 * game.player(id).skill(Stat::ShotPower));
    // On average over its way it keeps nine tenths of its speed.
    let time = distance / (0.9 * speed);
    let rise = (1.1 + 0.5 * FALL_MPS2 * time * time) / (speed * time);
    let wild = 0.05 * (1.5 - game.player(id).skill(Stat::Shot));
    let flat = (ahead + Vec2::new(-ahead.y, ahead.x) * (noise::bell(game) * wild)) * speed;
    flat.extend(speed * (rise * (1.0 + noise::bell(game) * 2.0 * wild)).clamp(0.02, 0.7))
}
