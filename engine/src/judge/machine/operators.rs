//! Operators on registers, lane by lane. Every transcendental function is libm's, so results are the same bits
//! everywhere.

use crate::judge::view::{Sight, player_index, team_of_number};
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::vocabulary::Team;
use setpiece_scenario::{BinaryOp, UnaryOp};
use std::array;
use std::f64::consts::{PI, TAU};

/// Whether a number counts as true: neither 0 nor impossible.
#[inline]
pub fn truth(value: f64) -> bool {
    value != 0.0 && !value.is_nan()
}

#[inline]
fn map<const N: usize>(a: [f64; N], f: impl Fn(f64) -> f64) -> [f64; N] {
    array::from_fn(|lane| f(a[lane]))
}

#[inline]
fn zip<const N: usize>(a: [f64; N], b: [f64; N], f: impl Fn(f64, f64) -> f64) -> [f64; N] {
    array::from_fn(|lane| f(a[lane], b[lane]))
}

#[inline]
pub(super) fn unary<const N: usize>(op: UnaryOp, a: [f64; N], now: Option<Sight<'_>>) -> [f64; N] {
    match op {
        UnaryOp::Neg => map(a, |a| -a),
        UnaryOp::Not => map(a, |a| (!truth(a)).into()),
        UnaryOp::Abs => map(a, f64::abs),
        UnaryOp::Sqrt => map(a, root),
        UnaryOp::Exp => map(a, libm::exp),
        UnaryOp::Log => map(a, |a| if a > 0.0 { libm::log(a) } else { f64::NAN }),
        UnaryOp::Floor => map(a, libm::floor),
        UnaryOp::Ceil => map(a, libm::ceil),
        UnaryOp::Round => map(a, libm::round),
        UnaryOp::Sin => map(a, libm::sin),
        UnaryOp::Cos => map(a, libm::cos),
        UnaryOp::Side => map(a, |a| team_of_number(a).map_or(f64::NAN, Team::side)),
        UnaryOp::OtherTeam => map(a, |a| team_of_number(a).map_or(-1.0, |team| team.other().index() as f64)),
        UnaryOp::TeamOf => map(a, |a| player_index(a).map_or(-1.0, |index| (index / TEAM_MAX) as f64)),
        UnaryOp::Exists => map(a, |a| now.is_some_and(|now| now.exists(a)).into()),
        UnaryOp::Wrap => map(a, wrap),
    }
}

#[inline]
pub(super) fn binary<const N: usize>(op: BinaryOp, a: [f64; N], b: [f64; N]) -> [f64; N] {
    match op {
        BinaryOp::Add => zip(a, b, |a, b| a + b),
        BinaryOp::Sub => zip(a, b, |a, b| a - b),
        BinaryOp::Mul => zip(a, b, |a, b| a * b),
        BinaryOp::Div => zip(a, b, quotient),
        BinaryOp::Mod => zip(a, b, modulo),
        BinaryOp::Pow => zip(a, b, libm::pow),
        BinaryOp::Min => zip(a, b, least),
        BinaryOp::Max => zip(a, b, most),
        BinaryOp::Hypot => zip(a, b, length),
        BinaryOp::Atan2 => zip(a, b, libm::atan2),
        BinaryOp::Lt => zip(a, b, |a, b| (a < b).into()),
        BinaryOp::Le => zip(a, b, |a, b| (a <= b).into()),
        BinaryOp::Gt => zip(a, b, |a, b| (a > b).into()),
        BinaryOp::Ge => zip(a, b, |a, b| (a >= b).into()),
        BinaryOp::Eq => zip(a, b, |a, b| (a == b).into()),
        BinaryOp::Ne => zip(a, b, |a, b| (a != b && !a.is_nan() && !b.is_nan()).into()),
        BinaryOp::And => zip(a, b, |a, b| (truth(a) & truth(b)).into()),
        BinaryOp::Or => zip(a, b, |a, b| (truth(a) | truth(b)).into()),
    }
}

/// The quotient; NaN for a zero divisor.
#[inline]
pub(super) fn quotient(a: f64, b: f64) -> f64 {
    if b == 0.0 { f64::NAN } else { a / b }
}

/// The lesser. The standard library's drops a NaN; here it must flow.
#[inline]
pub(super) fn least(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else if b < a {
        b
    } else {
        a
    }
}

/// The greater; NaN where one is.
#[inline]
pub(super) fn most(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else if b > a {
        b
    } else {
        a
    }
}

/// √(a² + b²). Lengths on a pitch neither overflow nor vanish: the square root alone is exact enough, and quick.
#[inline]
pub(super) fn length(a: f64, b: f64) -> f64 {
    root(a * a + b * b)
}

/// The square root, which IEEE 754 rounds the same everywhere.
#[inline]
fn root(a: f64) -> f64 {
    a.sqrt()
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
