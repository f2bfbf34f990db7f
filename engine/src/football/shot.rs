//! Where a shot goes and how hard.

use crate::football::noise;
use crate::football::pace::WALKS_FROM_MPS;
use crate::football::pass::{self, Struck};
use crate::math;
use crate::state::player::KickPlan;
use crate::state::{Match, Player, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::PitchSize;
use setpiece_scenario::vocabulary::Stat;

/// Backspin of a shot, rad/s. At 25 m/s it falls with 8 m/s², or with 11.5 m/s² if the spin is
/// turned. Measured.
const SHOT_BACKSPIN: f32 = 11.0;
/// Side spin of a shot across the body that bends it back, rad/s per radian; chosen.
const CURL: f32 = 420.0;
/// The most side spin that a shot gets by chance, rad/s; chosen.
const STRAY_SPIN: f32 = 8.0;
/// Fall of a shot without spin, m/s².
const FALL_MPS2: f32 = 9.81;
/// A player's own movement counts in the aim for this long, seconds. (GRF's.)
const AHEAD_S: f32 = 0.12;
/// The angle to the run at which a shot is easiest, radians: across the body. (GRF's.)
const IDEAL_RAD: f32 = 0.2 * std::f32::consts::PI;
/// Bounds of the speed at which a player strikes, m/s. Fitted to the measured speeds of standing
/// and sprinting shots.
const STEP_MPS: f32 = 1.6;
const BRAKED_MPS: f32 = 4.5;
/// The share of the hardest shot that is left without a run-up. Measured.
const STANDING: f32 = 0.765;
/// How much a hard shot is lifted (GRF's), and how much more the hardest one is. Fitted to the
/// measured heights.
const LIFT: f32 = 0.7;
const LIFTS: f32 = 1.25;
/// The speed at which a shot is easiest (GRF's), and the most speed that a runner has left at the
/// strike, m/s. Fitted to the measured heights.
const EASIEST_MPS: f32 = 3.5;
const LEFT_MPS: f32 = 3.8;
/// Above this speed running makes aiming no harder, m/s. Fitted to how far shots on the run go
/// astray.
const HARDEST_MPS: f32 = 4.4;
/// Difficulty of the easiest shot. Fitted to the measured directions.
const LEAST_HARD: f32 = 0.07;
/// How much a hard shot is pulled towards the run, for each radian between them, and at most
/// (GRF's). A shooter turns in the swing, so small angles hardly count. Fitted to the directions of
/// shots across the run.
const PULL_PER_RAD: f32 = 0.6;
const PULL_MOST: f32 = 0.8;
/// The factor from GRF's ball speed at the foot to ours. GRF brakes the ball before it can first be
/// observed.
const GIVEN: f32 = 1.015;

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

/// Whether a player runs, as opposed to setting off or standing.
pub fn runs(player: &Player) -> bool {
    player.vel.length_squared() >= WALKS_FROM_MPS * WALKS_FROM_MPS
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

/// A shot from the ground or in the air. `rough` (0..1) is how much opponents hamper it.
///
/// GRF's: what makes a shot hard (the angle to the run, speed, a moving ball, its own power); how
/// that pulls it towards the run, lifts and weakens it; and how chance mixes the best shot with the
/// worst.
pub fn struck(game: &mut Match, id: PlayerId, plan: &KickPlan, rough: f32) -> Struck {
    let player = *game.player(id);
    let from = game.ball.pos.truncate();
    let way = (aim(game, id, plan) - from).normalize_or(Vec2::new(id.team().side() as f32, 0.0));
    let run = if player.vel.length() > 1.0 { player.vel.normalize() } else { player.body.facing };
    // Whoever shoots backwards has turned round in the swing.
    let run = if pass::is_behind(&player, way) { way } else { run };
    // A standing player takes a step, and a sprinter brakes for the ball.
    let pace = player.vel.length().clamp(STEP_MPS, BRAKED_MPS);
    let off = math::atan2(run.perp_dot(way), run.dot(way)).abs();
    let across = eased(1.0 - (off - IDEAL_RAD).abs() / std::f32::consts::PI, 0.8).max(0.0);
    let across = libm::powf(across, 0.8);
    let pushed = (player.body.push_m / 0.1).clamp(0.0, 1.0);
    let meeting = ((player.vel.extend(0.0) - game.ball.vel).length() / 10.0).clamp(0.0, 1.0);
    let wanted =
        if plan.power > 0.0 { plan.power } else { libm::powf(plan.gauge(), 0.6).max(0.01) };

    let foot = (0.7 + 0.3 * across)
        * (0.7 + 0.3 * libm::powf((pace / 8.0).clamp(0.0, 1.0), 0.3))
        * (1.0 - 0.6 * pushed)
        * (45.0 * (0.7 + 0.3 * wanted.sqrt()));
    let strides = ((player.vel.length() - STEP_MPS) / 1.2).clamp(0.0, 1.0);
    let most =
        (32.0 + 13.0 * player.skill(Stat::ShotPower)) * (STANDING + (1.0 - STANDING) * strides);
    let power = foot.min(most) * (1.0 + 0.2 * meeting);

    let ease = (0.4 + 0.6 * across)
        * (1.0 - 0.7 * pushed)
        * (1.0 - 0.4 * meeting * (0.5 - 0.3 * player.skill(Stat::Volley)))
        * (0.6 + 0.4 * eased(1.0 - ((power - 30.0) / 70.0).clamp(0.0, 1.0), 1.0))
        * (1.0 - 0.5 * rough);
    let hard_at = |pace: f32| {
        let easy = 1.0 - 0.3 * ((pace - EASIEST_MPS).abs() / 4.0).clamp(0.0, 1.0);
        (1.0 - ease * easy).clamp(LEAST_HARD, 1.0)
    };
    // A swing that began before the run strikes the ball from a step.
    let steps = plan.swing.is_some_and(|swing| !swing.runs);
    let pace = if steps { STEP_MPS } else { pace };
    let hard = hard_at(if steps { pace } else { player.vel.length().clamp(STEP_MPS, HARDEST_MPS) });
    let harder = libm::powf(hard, 0.7);
    let lifts = libm::powf(hard_at(pace.min(LEFT_MPS)), 0.7);

    let best = way.extend(0.05).normalize() * power;
    let pull = (PULL_PER_RAD * off).min(PULL_MOST);
    let pulled = (way + (run - way) * (pull * hard)).normalize_or(way);
    let (on, aside, up) = (noise::spread(game), noise::spread(game), noise::spread(game));
    let shaken = (way * on + way.perp() * aside).extend(up) * (0.5 * hard);
    let worst = (pulled.extend(0.0) + shaken).normalize_or(way.extend(0.0));
    let worst = (worst + Vec3::Z * (LIFT * libm::powf(eased(lifts, 0.7), LIFTS))).normalize()
        * (power * (1.0 - 0.5 * harder));
    let luck = libm::powf(noise::roll(game), 0.7 * player.skill(Stat::Shot));
    let ball = best + (worst - best) * luck;

    let lag = pass::curl(player.body.facing, ball.truncate(), ball.length());
    let flat = math::unit(lag).rotate(ball.truncate());
    let backspin = Vec3::new(way.y, -way.x, 0.0) * SHOT_BACKSPIN;
    let twist = -CURL * lag + noise::spread(game) * STRAY_SPIN;
    Struck { velocity: flat.extend(ball.z) * GIVEN, spin: backspin.with_z(twist) }
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
    Struck { velocity, spin: Vec3::new(ahead.y, -ahead.x, 0.0) * SHOT_BACKSPIN }
}
