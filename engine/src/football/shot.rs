//! Where a shot goes and how hard.

use crate::football::pace::SPRINT_MPS;
use crate::football::pass::{self, Struck};
use crate::football::{noise, swing};
use crate::math;
use crate::state::player::KickPlan;
use crate::state::{Match, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::PitchSize;
use setpiece_scenario::vocabulary::Stat;

/// Backspin of a shot, and the most that chance adds to it about every axis, rad/s. (GRF's.)
const SPIN: f32 = 14.0;
/// Side spin of a shot that leaves off the way its body faces, rad/s per radian; and the share of
/// chance in it. (GRF's.)
const CURL: f32 = 294.0;
const STRAY_CURL: f32 = 0.7;
/// How much of its own spin a ball keeps in a shot. (GRF's.)
const KEPT_SPIN: f32 = 0.3;
/// Fall of a shot without spin, m/s².
const FALL_MPS2: f32 = 9.81;
/// A player's own movement counts in the aim for this long, seconds. (GRF's.)
const AHEAD_S: f32 = 0.12;
/// The angle to the run at which a shot is easiest, radians: across the body. (GRF's.)
const IDEAL_RAD: f32 = 0.2 * std::f32::consts::PI;
/// What every swing has of the hardest shot. (GRF's.)
const ANY_SWING: f32 = 0.2;
/// How much the hardest shot is lifted. (GRF's.)
const LIFT: f32 = 0.7;
/// The speed at which a shot is easiest, m/s. (GRF's.)
const EASIEST_MPS: f32 = 3.5;
/// How much the hardest shot is pulled towards the run. (GRF's.)
const PULL: f32 = 0.8;

/// The point that a shot aims at now: the bot's choice, or what the held direction means.
pub fn meant(game: &Match, id: PlayerId, plan: &KickPlan) -> Vec2 {
    let player = game.player(id);
    let dir = plan.dir.unwrap_or(player.body.facing);
    plan.point.unwrap_or_else(|| {
        let from = player.pos + player.vel * AHEAD_S;
        aim_of(&game.pitch, from, id.team().side() as f32, Some(dir))
    })
}

/// The point that a shot aims at: fixed when the swing began, or chosen by the bot.
fn aim(game: &Match, id: PlayerId, plan: &KickPlan) -> Vec2 {
    let settled = plan.swing.and_then(|swing| swing.way).map(|way| game.ball.pos.truncate() + way);
    settled.unwrap_or_else(|| meant(game, id, plan))
}

/// The middle of the goal that a side attacks.
fn goal_of(pitch: &PitchSize, side: f32) -> Vec2 {
    Vec2::new(pitch.half_length() as f32 * side, 0.0)
}

/// The angle from the way to the goal's middle to a world direction, radians.
fn off_goal(goal: Vec2, from: Vec2, dir: Vec2) -> f32 {
    let way = goal - from;
    math::atan2(way.perp_dot(dir), way.dot(dir))
}

/// The point of the goal mouth that a held world direction means, whatever the keeper does. The
/// further it points off the middle, the closer it is to the post. (GRF's.)
pub fn aim_of(pitch: &PitchSize, from: Vec2, side: f32, dir: Option<Vec2>) -> Vec2 {
    let goal = goal_of(pitch, side);
    let Some(dir) = dir else { return goal };
    // The sign of the angle gives the side of the goal in the shooter's own view.
    let angle = off_goal(goal, from, dir);
    let turn = (2.0 * angle / std::f32::consts::PI).clamp(-1.0, 1.0);
    let shift = libm::powf(turn.abs(), 0.7) * math::sign_or(turn, 1.0);
    let post = pitch.goal_half_width() as f32;
    Vec2::new(goal.x, shift * math::sign_or(goal.x - from.x, side) * post * 0.9)
}

/// A smooth step from 0 to 1, mixed with a linear one.
fn eased(share: f32, smooth: f32) -> f32 {
    let curve = 0.5 - 0.5 * math::cos(share * std::f32::consts::PI);
    curve * smooth + share * (1.0 - smooth)
}

/// A shot from the ground or in the air.
///
/// GRF's: what makes a shot hard (the angle to the run, speed, a push, a moving ball, its own
/// power); how that pulls it towards the run, lifts and weakens it; and how chance mixes the best
/// shot with the worst.
pub fn struck(game: &mut Match, id: PlayerId, plan: &KickPlan) -> Struck {
    let player = *game.player(id);
    let from = game.ball.pos.truncate();
    let way = (aim(game, id, plan) - from).normalize_or(Vec2::new(id.team().side() as f32, 0.0));
    let stroke = plan
        .swing
        .and_then(|swing| swing.stroke)
        .unwrap_or_else(|| swing::stroke(&player, plan.kind, way));
    let mps = stroke.body.length();
    let run = stroke.body.normalize_or(player.body.facing);
    let off = math::atan2(run.perp_dot(way), run.dot(way)).abs();
    let across = eased(1.0 - (off - IDEAL_RAD).abs() / std::f32::consts::PI, 0.8).max(0.0);
    let across = libm::powf(across, 0.8);
    let pushed = (player.body.push_m / 0.1).clamp(0.0, 1.0);
    let meeting = ((stroke.body.extend(0.0) - game.ball.vel).length() / 10.0).clamp(0.0, 1.0);
    let wanted =
        if plan.power > 0.0 { plan.power } else { libm::powf(plan.gauge(), 0.6).max(0.01) };

    let foot = (0.7 + 0.3 * across)
        * (0.7 + 0.3 * libm::powf((mps / SPRINT_MPS).clamp(0.0, 1.0), 0.3))
        * (1.0 - 0.6 * pushed)
        * (45.0 * (0.7 + 0.3 * wanted.sqrt()));
    let most = (32.0 + 13.0 * player.skill(Stat::ShotPower))
        * (ANY_SWING + (1.0 - ANY_SWING) * stroke.power);
    let power = foot.min(most) * (1.0 + 0.2 * meeting);

    let ease = (0.4 + 0.6 * across)
        * (1.0 - 0.3 * ((mps - EASIEST_MPS).abs() / 4.0).clamp(0.0, 1.0))
        * (1.0 - 0.7 * pushed)
        * (1.0 - 0.4 * meeting * (0.5 - 0.3 * player.skill(Stat::Volley)))
        * (0.6 + 0.4 * eased(1.0 - ((power - 30.0) / 70.0).clamp(0.0, 1.0), 1.0));
    let hard = (1.0 - ease).clamp(0.0, 1.0);
    let harder = libm::powf(hard, 0.7);

    let best = way.extend(0.05).normalize() * power;
    let pulled = way.lerp(run, PULL * hard).normalize_or(way);
    let mut stray = || noise::spread(game);
    let (on, aside, up) = (stray(), stray(), stray());
    let shaken = (way * on + way.perp() * aside).extend(up) * (0.5 * hard);
    let worst = (pulled.extend(0.0) + shaken).normalize_or(way.extend(0.0));
    let worst = (worst + Vec3::Z * (LIFT * eased(harder, 0.7))).normalize()
        * (power * (1.0 - 0.5 * harder));
    let luck = libm::powf(noise::roll(game), 0.7 * player.skill(Stat::Shot));
    let ball = best + (worst - best) * luck;

    let off = pass::off_body(player.body.facing, ball.truncate());
    let flat = math::unit(-pass::lag(off, ball.length())).rotate(ball.truncate());
    let mut stray = || noise::spread(game);
    let (over, aside, twist) = (stray(), stray(), stray());
    let spin = way * aside + way.perp() * over;
    let level = SPIN * (spin * (0.3 + 0.7 * luck) - way.perp());
    Struck {
        velocity: flat.extend(ball.z),
        spin: level.extend(CURL * off + SPIN * STRAY_CURL * twist),
        kept_spin: KEPT_SPIN,
    }
}

/// A free kick at goal: slower and higher, so that it comes down behind the wall.
///
/// The rise is chosen so that a ball of that speed crosses the goal line at 1.2 m.
pub fn over_wall(game: &mut Match, id: PlayerId, plan: &KickPlan) -> Struck {
    let from = game.ball.pos.truncate();
    let way = aim(game, id, plan) - from;
    let distance = way.length().max(1.0);
    let ahead = way / distance;
    let speed = (20.5 + 0.12 * distance) * (0.9 + 0.1 * game.player(id).skill(Stat::ShotPower));
    // On average over its way it keeps nine tenths of its speed.
    let time = distance / (0.9 * speed);
    let rise = (1.1 + 0.5 * FALL_MPS2 * time * time) / (speed * time);
    let wild = 0.05 * (1.5 - game.player(id).skill(Stat::Shot));
    let flat = (ahead + Vec2::new(-ahead.y, ahead.x) * (noise::bell(game) * wild)) * speed;
    let velocity =
        flat.extend(speed * (rise * (1.0 + noise::bell(game) * 2.0 * wild)).clamp(0.02, 0.7));
    Struck { velocity, spin: Vec3::new(ahead.y, -ahead.x, 0.0) * SPIN, kept_spin: KEPT_SPIN }
}
