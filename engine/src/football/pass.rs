//! How hard, how high and with what spin a pass or a throw-in leaves a player.
//!
//! `pass_target` decides its target, and `kick` its direction.

use crate::football::{awkward, noise, swing};
use crate::math;
use crate::state::player::{KickKind, KickPlan};
use crate::state::{Match, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::Stat;

/// How hard a pass is meant, in shares of `MEANT_MPS`: `LEAST`, and so much more over `MEANT_M`
/// metres, by that power of the way; of ground passes and of lofted ones. (GRF's.)
const MEANT: [f32; 2] = [1.8, 1.15];
const LEAST: f32 = 0.3;
const MEANT_MPS: f32 = 36.0;
const MEANT_M: f32 = 60.0;
const MEANT_BY: f32 = 1.4;
/// How much a ground pass rises, and a lofted one over the least and the longest way. (GRF's.)
const RISES: f32 = 0.11;
const LOFTED: [f32; 2] = [0.45, 0.3];
/// The hardest ground pass and lofted pass, m/s; what every swing has of that; how much a push
/// takes off, per metre and at most; and how much of the ball's speed adds to it. (GRF's.)
const MOST_MPS: [f32; 2] = [30.0, 42.0];
const ANY_SWING: f32 = 0.3;
const PUSHED_PER_M: f32 = 2.5;
const PUSHED_MOST: f32 = 0.25;
const MOMENTUM: f32 = 0.5;
/// How much of the speed that is missing becomes height, and up to which. (GRF's.)
const LACKS: f32 = 0.25;
const LACKS_MPS: f32 = 10.0;
/// How much skill takes off a hard swing, and how much a ball that is far, high, moving or hard to
/// swing at goes the swing's own way instead; and how much all that counts. (GRF's.)
const SKILLED: f32 = 0.5;
const NATURAL: [f32; 4] = [0.15, 0.15, 0.3, 0.5];
const NATURALLY: f32 = 1.5;
/// A higher ball is headed, metres; chosen.
const HEADED_M: f32 = 1.4;
/// How hard a lofted pass is at least; chosen, so that skill at it has an effect.
const LOFT_HARD: f32 = 0.04;
/// What an awkward ball does to a pass: the share of its speed that a far one loses; how fast it
/// rises, m/s: a far one, a high one (and how much of its own rise it keeps), and a hard swing at
/// most. (GRF's.)
const FAR_LOSES: f32 = 0.3;
const FAR_UP_MPS: f32 = 1.5;
const HIGH_UP_MPS: f32 = 1.0;
const HIGH_KEEPS: f32 = 0.5;
const HARD_UP_MPS: f32 = 5.0;
/// Speed of the hardest pass out of the hands, m/s. Measured.
const HANDS_MPS: f32 = 15.0;
/// Topspin of a ground pass and backspin of a lofted one, rad/s per m/s, and the speed up to which
/// they grow. (GRF's.)
const TOPSPIN_PER_MPS: f32 = 3.15;
const BACKSPIN_PER_MPS: f32 = 1.17;
const SPUN_MPS: f32 = 15.0;
/// Side spin of a pass that leaves off the way its body faces, rad/s per radian, and how much of
/// that a lofted one has. (GRF's.)
const CURL: f32 = 306.0;
const LOFTED_CURL: f32 = 0.2;
/// How much of its own spin a ball keeps in a pass. (GRF's.)
const KEPT_SPIN: f32 = 0.1;
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
    /// What the foot gives it, rad/s.
    pub spin: Vec3,
    /// The share of its own spin that it keeps beside that.
    pub kept_spin: f32,
}

/// Strikes a pass along a way, metres.
///
/// GRF's: how hard a pass of a length is meant, how hard a leg can strike at most (missing speed
/// becomes height), and what an awkward ball makes of it.
pub fn struck(game: &mut Match, id: PlayerId, plan: &KickPlan, way: Vec2, by_hand: bool) -> Struck {
    let lofted = plan.kind == KickKind::High;
    let kind = usize::from(lofted);
    let distance = way.length().clamp(1.0, MEANT_M);
    let share = distance / MEANT_M;
    let ahead = way.normalize_or(game.player(id).body.facing);
    let rise = if lofted { LOFTED[0] + (LOFTED[1] - LOFTED[0]) * share } else { RISES };
    let meant = MEANT_MPS * (MEANT[kind] * libm::powf(share, MEANT_BY) + LEAST);
    let meant = ahead.extend(rise).normalize() * meant;
    let ball =
        if by_hand { meant.clamp_length_max(HANDS_MPS) } else { best(game, id, plan, meant) };
    let off = off_body(game.player(id).body.facing, ball.truncate());
    let off = if lofted { LOFTED_CURL * off } else { off };
    let flat = math::unit(-lag(off, ball.length())).rotate(ball.truncate());
    let velocity = flat.extend(ball.z);
    let per_mps = if lofted { BACKSPIN_PER_MPS } else { -TOPSPIN_PER_MPS };
    let spin = across(velocity) * (per_mps * velocity.length().min(SPUN_MPS));
    Struck { velocity, spin: spin.with_z(CURL * off), kept_spin: KEPT_SPIN }
}

/// The best that a player's leg can make of a pass that is meant to leave like this, m/s. (GRF's.)
fn best(game: &mut Match, id: PlayerId, plan: &KickPlan, meant: Vec3) -> Vec3 {
    let player = *game.player(id);
    let stroke = plan
        .swing
        .and_then(|swing| swing.stroke)
        .unwrap_or_else(|| swing::stroke(&player, plan.kind, meant.truncate()));
    let lofted = plan.kind == KickKind::High;
    let skill = player.skill(match lofted {
        _ if game.ball.pos.z > HEADED_M => Stat::Header,
        true => Stat::HighPass,
        false => Stat::ShortPass,
    });
    let most = MOST_MPS[usize::from(lofted)]
        * (ANY_SWING + (1.0 - ANY_SWING) * stroke.power)
        * (1.0 - (PUSHED_PER_M * player.body.push_m).min(PUSHED_MOST))
        + MOMENTUM * game.ball.vel.length();
    let lacks = (meant.length() - most).clamp(0.0, LACKS_MPS);
    let ball = meant.clamp_length_max(most) + Vec3::Z * (LACKS * lacks);
    let awkward = awkward::to(game, id);
    let hard = stroke.hard.max(if lofted { LOFT_HARD } else { 0.0 }) * (1.0 - SKILLED * skill);
    let bias = NATURALLY
        * (NATURAL[0] * awkward.far
            + NATURAL[1] * awkward.high
            + NATURAL[2] * awkward.kept
            + NATURAL[3] * hard);
    let natural = (stroke.natural * ball.length()).extend(ball.z);
    let mut ball = ball.lerp(natural, bias.min(1.0)) * (1.0 - FAR_LOSES * awkward.far);
    ball.z +=
        FAR_UP_MPS * awkward.far + (HIGH_UP_MPS + HIGH_KEEPS * game.ball.vel.z) * awkward.high;
    let mut ball = ball.lerp(game.ball.vel, awkward.kept);
    ball.z += HARD_UP_MPS * hard * (0.2 + 0.8 * noise::roll(game));
    ball
}

/// How far a kick leaves off the way that the body faces, or its back, radians: at most a quarter,
/// for one across the body. (GRF's.)
pub fn off_body(facing: Vec2, way: Vec2) -> f32 {
    let turn = math::atan2(facing.perp_dot(way), facing.dot(way)) / std::f32::consts::PI;
    let turn = if turn.abs() > 0.5 { (1.0 - turn.abs()) * math::sign_or(turn, 1.0) } else { turn };
    0.5 * turn
}

/// The angle by which a ball lags behind its kick, radians. (GRF's.)
pub fn lag(off: f32, speed_mps: f32) -> f32 {
    off * (0.4 + 0.6 * (speed_mps / 70.0).clamp(0.0, 1.0))
}

/// A throw-in: the speed is the same for any distance, and longer ones rise more.
pub fn thrown(game: &mut Match, id: PlayerId, way: Vec2) -> Struck {
    let rise = THROW_UP_PER_S * way.length().clamp(2.0, THROW_M);
    let ahead = way.normalize_or(game.player(id).body.facing);
    let aside = Vec2::new(-ahead.y, ahead.x) * (noise::bell(game) * 0.02);
    Struck {
        velocity: ((ahead + aside) * THROW_MPS).extend(rise),
        spin: Vec3::ZERO,
        kept_spin: KEPT_SPIN,
    }
}

/// The horizontal unit axis of backspin for a velocity.
fn across(velocity: Vec3) -> Vec3 {
    let flat = velocity.truncate().normalize_or_zero();
    Vec3::new(flat.y, -flat.x, 0.0)
}
