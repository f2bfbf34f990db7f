//! How hard, how high and with what spin a pass or a throw-in leaves a player.
//!
//! `pass_target` decides its target, and `kick` its direction.

use crate::football::noise;
use crate::math;
use crate::physics::constants::MAGNUS;
use crate::state::player::{KickKind, KickPlan};
use crate::state::{Match, Player, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::Stat;

/// Speed of the hardest ground pass at a resting ball, m/s. Measured.
const GROUND_MPS: f32 = 27.6;
/// The most that running adds to it, m/s (measured), and how much of the ball's speed does
/// (GRF's).
const STRIDE_MPS: f32 = 2.0;
const MOMENTUM: f32 = 0.5;
/// Speed of the hardest pass behind the player's back, m/s. Measured.
const HEEL_MPS: f32 = 16.8;
/// Speed of the hardest lofted pass behind the player's back, m/s. Measured.
const HIGH_HEEL_MPS: f32 = 33.0;
/// The most that a pass to the side loses, m/s. Measured.
const ASIDE_LESS_MPS: f32 = 2.0;
/// How much faster the ball rises when played to the side, and behind the back, m/s. Measured.
const ASIDE_UP_MPS: f32 = 0.3;
const HEEL_UP_MPS: f32 = 0.4;
/// From this angle to the run on, a kick goes behind the back, and a pass is played with the heel,
/// degrees; chosen.
pub const BEHIND_DEG: f32 = 135.0;
/// Topspin of a ground pass and backspin of a lofted one, rad/s per m/s, and the speed up to which
/// they grow. (GRF's ratios; fitted to the measured heights.)
const TOPSPIN_PER_MPS: f32 = 4.0;
const BACKSPIN_PER_MPS: f32 = 1.5;
const SPUN_MPS: f32 = 15.0;
/// Speed of a throw-in at any distance, m/s. Measured.
const THROW_MPS: f32 = 17.4;
/// How much faster a throw-in rises per metre of its way, 1/s. Measured.
const THROW_UP_PER_S: f32 = 0.115;
/// Longest aim of a throw-in, metres; chosen.
const THROW_M: f32 = 30.0;

/// A ball as it leaves the foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Struck {
    /// m/s.
    pub velocity: Vec3,
    /// rad/s.
    pub spin: Vec3,
}

/// Strikes a pass along a way, metres; its side spin bends it back to that way.
///
/// GRF's: how hard a pass of a length is struck, how hard a foot can strike at most, and that
/// missing speed becomes height.
pub fn struck(
    game: &mut Match,
    id: PlayerId,
    plan: &KickPlan,
    way: Vec2,
    rough: f32,
    by_hand: bool,
) -> Struck {
    let player = *game.player(id);
    let kind = plan.kind;
    let stat = if kind == KickKind::High { Stat::HighPass } else { Stat::ShortPass };
    let skill = player.skill(stat);
    let distance = way.length().clamp(1.0, 60.0);
    let far = libm::powf(distance / 60.0, 1.4);
    let degrees = off_run(&player, way);
    let strides = (player.vel.length() / 2.0).min(1.0);
    let aside = (degrees / 30.0).min(1.0);
    let heel = is_behind(&player, way);
    let (level, up) = if kind == KickKind::High {
        // A pass to the side is struck a little harder.
        let rise = 0.45 - 0.15 * distance / 60.0;
        let speed = (0.97 * 36.0 * (1.15 * far + 0.3)).min(if heel { HIGH_HEEL_MPS } else { 36.0 })
            * (1.0 + 0.05 * aside);
        let level = speed / libm::sqrtf(1.0 + rise * rise);
        (level, level * rise)
    } else {
        let wanted = 0.97 * 36.0 * (1.8 * far + 0.3);
        let most = match (by_hand, heel) {
            (true, _) => 15.0,
            (_, true) => HEEL_MPS,
            _ => {
                let rolls = game.ball.vel.truncate().length();
                GROUND_MPS - ASIDE_LESS_MPS * aside + STRIDE_MPS * strides + MOMENTUM * rolls
            }
        };
        let level = wanted.min(most);
        let lifted = ASIDE_UP_MPS * aside + if heel { HEEL_UP_MPS } else { 0.0 };
        (level, level * 0.11 + 0.25 * (wanted - level).clamp(0.0, 10.0) + lifted)
    };
    // Measured: passes without pressure hardly scatter; awkward passes and those of poor passers
    // do.
    let wild = (0.015 + 0.26 * rough + 0.02 * (1.0 - player.body.level)) * (1.2 - 0.8 * skill);
    let aside = noise::bell(game) * wild;
    let power = 1.0 + noise::bell(game) * wild * 0.8;
    let ahead = way.normalize_or(player.body.facing);
    let lag =
        curl(player.body.facing, ahead, level) * if kind == KickKind::High { 0.2 } else { 1.0 };
    let ahead = math::unit(lag).rotate(ahead);
    let flat = (ahead + Vec2::new(-ahead.y, ahead.x) * aside) * (level * power);
    let velocity = flat.extend(up * power * (1.0 + noise::bell(game) * wild));
    let per_mps = if kind == KickKind::High { BACKSPIN_PER_MPS } else { -TOPSPIN_PER_MPS };
    let spin = across(velocity) * (per_mps * velocity.length().min(SPUN_MPS));
    Struck { velocity, spin: spin.with_z(-2.0 * lag / (distance * MAGNUS)) }
}

/// The angle by which a ball leaves closer to where the body faces than the kick is meant, radians.
/// (GRF's.)
pub fn curl(facing: Vec2, way: Vec2, speed_mps: f32) -> f32 {
    let turn = math::atan2(facing.perp_dot(way), facing.dot(way)) / std::f32::consts::PI;
    let turn = if turn.abs() > 0.5 { (1.0 - turn.abs()) * math::sign_or(turn, 1.0) } else { turn };
    -0.5 * turn * (0.4 + 0.6 * (speed_mps / 70.0).clamp(0.0, 1.0))
}

/// A throw-in: the speed is the same for any distance, and longer ones rise more.
pub fn thrown(game: &mut Match, id: PlayerId, way: Vec2) -> Struck {
    let rise = THROW_UP_PER_S * way.length().clamp(2.0, THROW_M);
    let ahead = way.normalize_or(game.player(id).body.facing);
    let aside = Vec2::new(-ahead.y, ahead.x) * (noise::bell(game) * 0.02);
    Struck { velocity: ((ahead + aside) * THROW_MPS).extend(rise), spin: Vec3::ZERO }
}

/// The horizontal unit axis of backspin for a velocity.
fn across(velocity: Vec3) -> Vec3 {
    let flat = velocity.truncate().normalize_or_zero();
    Vec3::new(flat.y, -flat.x, 0.0)
}

/// Whether a way leads behind a player's back.
pub fn is_behind(player: &Player, way: Vec2) -> bool {
    off_run(player, way) > BEHIND_DEG
}

/// The angle between the way a player runs (or faces) and another way, degrees.
pub fn off_run(player: &Player, way: Vec2) -> f32 {
    let ahead = player.vel.normalize_or(player.body.facing);
    math::atan2(ahead.perp_dot(way), ahead.dot(way)).abs().to_degrees()
}
