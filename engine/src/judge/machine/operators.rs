//! Operators on registers. Every transcendental function is libm's, so results are the same bits everywhere.

use crate::judge::view::{View, player_index, team_of_number};
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::vocabulary::Team;
use setpiece_scenario::{BinaryOp, UnaryOp};
use std::f64::consts::{PI, TAU};

/// Whether a number counts as true: neither 0 nor impossible.
pub fn truth(value: f64) -> bool {
    value != 0.0 && !value.is_nan()
}

pub(super) fn unary(op: UnaryOp, a: f64, now: &View) -> f64 {
    match op {
        UnaryOp::Neg => -a,
        UnaryOp::Not => (!truth(a)).into(),
        UnaryOp::Abs => a.abs(),
        UnaryOp::Sqrt => libm::sqrt(a),
        UnaryOp::Exp => libm::exp(a),
        UnaryOp::Log if a > 0.0 => libm::log(a),
        UnaryOp::Log => f64::NAN,
        UnaryOp::Floor => libm::floor(a),
        UnaryOp::Ceil => libm::ceil(a),
        UnaryOp::Round => libm::round(a),
        UnaryOp::Sin => libm::sin(a),
        UnaryOp::Cos => libm::cos(a),
        UnaryOp::Side => team_of_number(a).map_or(f64::NAN, Team::side),
        UnaryOp::OtherTeam => team_of_number(a).map_or(-1.0, |team| team.other().index() as f64),
        UnaryOp::TeamOf => player_index(a).map_or(-1.0, |index| (index / TEAM_MAX) as f64),
        UnaryOp::Exists => now.player(a).is_some_and(|player| player.active).into(),
        UnaryOp::Wrap => wrap(a),
    }
}

pub(super) fn binary(op: BinaryOp, a: f64, b: f64) -> f64 {
    match op {
        BinaryOp::Add => a + b,
        BinaryOp::Sub => a - b,
        BinaryOp::Mul => a * b,
        BinaryOp::Div if b == 0.0 => f64::NAN,
        BinaryOp::Div => a / b,
        BinaryOp::Mod => modulo(a, b),
        BinaryOp::Pow => libm::pow(a, b),
        // The standard library's drop a NaN; here it must flow.
        BinaryOp::Min | BinaryOp::Max if a.is_nan() || b.is_nan() => f64::NAN,
        BinaryOp::Min => {
            if b < a {
                b
            } else {
                a
            }
        }
        BinaryOp::Max => {
            if b > a {
                b
            } else {
                a
            }
        }
        // Lengths on a pitch neither overflow nor vanish: the square root alone is exact enough, and quick.
        BinaryOp::Hypot => libm::sqrt(a * a + b * b),
        BinaryOp::Atan2 => libm::atan2(a, b),
        BinaryOp::Lt => (a < b).into(),
        BinaryOp::Le => (a <= b).into(),
        BinaryOp::Gt => (a > b).into(),
        BinaryOp::Ge => (a >= b).into(),
        BinaryOp::Eq => (a == b).into(),
        BinaryOp::Ne => (a != b && !a.is_nan() && !b.is_nan()).into(),
        BinaryOp::And => (truth(a) && truth(b)).into(),
        BinaryOp::Or => (truth(a) || truth(b)).into(),
    }
}

/// The remainder with the divisor's sign; NaN for a zero divisor.
fn modulo(a: f64, b: f64) -> f64 {
    if b == 0.0 {
        return f64::NAN;
    }
    let rest = libm::fmod(a, b);
    if rest != 0.0 && (rest < 0.0) != (b < 0.0) { rest + b } else { rest }
}

/// An angle wrapped to -π..π.
fn wrap(angle_rad: f64) -> f64 {
    let turned = modulo(angle_rad + PI, TAU) - PI;
    // The end belongs to both sides; the positive one is the natural answer for half a turn.
    if turned == -PI { PI } else { turned }
}
