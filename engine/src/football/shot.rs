//! Where a shot goes and how hard.

use crate::football::body::KickPlan;
use crate::football::noise;
use crate::math;
use crate::state::{Match, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::pitch::{GOAL_HALF_WIDTH_M, HALF_LENGTH_M};
use setpiece_scenario::vocabulary::Stat;

/// A held direction further off the goal than this is not meant for it; radians.
const MEANT_FOR_GOAL_RAD: f32 = 0.5;

/// The point of the goal mouth that a shot aims at.
fn aim(pos: Vec2, side: f32, plan: &KickPlan) -> Vec2 {
    plan.point.unwrap_or_else(|| aim_of(pos, side, plan.dir))
}

/// The point that a shot with a held world direction aims at.
pub fn aim_of(pos: Vec2, side: f32, dir: Option<Vec2>) -> Vec2 {
    let goal = Vec2::new(HALF_LENGTH_M as f32 * side, 0.0);
    let Some(dir) = dir else { return goal };
    let way = (goal - pos).normalize_or_zero();
    let angle = math::atan2(way.perp_dot(dir), way.dot(dir));
    if angle.abs() > MEANT_FOR_GOAL_RAD {
        return pos + dir * 30.0;
    }
    // The sign of the angle tells the side of the goal in the shooter's own view.
    let turn = (2.0 * angle / std::f32::consts::PI).clamp(-1.0, 1.0);
    let shift = libm::powf(turn.abs(), 0.7) * turn.signum();
    let across = Vec2::new(-way.y, way.x).y.signum();
    Vec2::new(goal.x, shift * across * GOAL_HALF_WIDTH_M as f32 * 0.9)
}

/// The velocity of a shot; `rough` 0..1 is how awkward it is.
pub fn velocity(game: &mut Match, id: PlayerId, plan: &KickPlan, rough: f32) -> Vec3 {
    let player = *game.player(id);
    let side = id.team().side() as f32;
    let from = game.ball.pos.truncate();
    let target = aim(from, side, plan);
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
    let rise = 0.067
        + noise::bell(game) * (0.018 + 0.03 * under + wild * 0.45)
        + (0.08 * awkward + 0.075 * under) * noise::roll(game);
    let flat = (way + Vec2::new(-way.y, way.x) * aside) * speed;
    flat.extend(speed * rise.clamp(0.0, 0.7))
}

/// The velocity of a free kick at goal: slower and higher, so that it comes down behind the wall.
///
/// The rise is the one with which a ball of that speed crosses the goal line at 1.2 m.
pub fn over_wall(game: &mut Match, id: PlayerId, plan: &KickPlan) -> Vec3 {
    let side = id.team().side() as f32;
    let from = game.ball.pos.truncate();
    let way = aim(from, side, plan) - from;
    let distance = way.length().max(1.0);
    let ahead = way / distance;
    let speed = (20.5 + 0.12 * distance) * (0.9 + 0.1 * game.player(id).skill(Stat::ShotPower));
    // On average over its way it keeps nine tenths of its speed.
    let time = distance / (0.9 * speed);
    let rise = (1.1 + 0.5 * FALL_MPS2 * time * time) / (speed * time);
    let wild = 0.05 * (1.5 - player_skill(game, id));
    let flat = (ahead + Vec2::new(-ahead.y, ahead.x) * (noise::bell(game) * wild)) * speed;
    flat.extend(speed * (rise * (1.0 + noise::bell(game) * 2.0 * wild)).clamp(0.02, 0.7))
}

/// With how much a shot falls, its backspin reckoned in, m/s². Measured.
const FALL_MPS2: f32 = 7.4;

fn player_skill(game: &Match, id: PlayerId) -> f32 {
    game.player(id).skill(Stat::Shot)
}
