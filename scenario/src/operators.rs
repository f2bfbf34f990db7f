//! The operators of programs, shared by constant folding and the machine.
//!
//! Transcendental functions are libm's, so results have the same bits on every machine. A truth
//! value is 1 or 0. An impossible value is NaN, which propagates, and compares false.

use crate::pitch::{PLAYERS_MAX, TEAM_MAX};
use crate::program::{BinaryOp, UnaryOp};
use crate::vocabulary::Team;
use std::f64::consts::{PI, TAU};

impl UnaryOp {
    /// Every unary operator.
    pub const ALL: &'static [UnaryOp] = &[
        UnaryOp::Neg,
        UnaryOp::Not,
        UnaryOp::Abs,
        UnaryOp::Sqrt,
        UnaryOp::Exp,
        UnaryOp::Log,
        UnaryOp::Floor,
        UnaryOp::Ceil,
        UnaryOp::Round,
        UnaryOp::Sin,
        UnaryOp::Cos,
        UnaryOp::Side,
        UnaryOp::OtherTeam,
        UnaryOp::TeamOf,
        UnaryOp::Exists,
        UnaryOp::Wrap,
    ];

    /// The result for an operand. `exists` tells whether a player with this number is on the pitch.
    #[inline]
    pub fn apply(self, a: f64, exists: impl Fn(f64) -> bool) -> f64 {
        match self {
            UnaryOp::Neg => -a,
            UnaryOp::Not => (!truth(a)).into(),
            UnaryOp::Abs => a.abs(),
            // IEEE 754 rounds it the same everywhere.
            UnaryOp::Sqrt => a.sqrt(),
            UnaryOp::Exp => libm::exp(a),
            UnaryOp::Log if a > 0.0 => libm::log(a),
            UnaryOp::Log => f64::NAN,
            UnaryOp::Floor => libm::floor(a),
            UnaryOp::Ceil => libm::ceil(a),
            UnaryOp::Round => libm::round(a),
            UnaryOp::Sin => libm::sin(a),
            UnaryOp::Cos => libm::cos(a),
            UnaryOp::Side => team_of_number(a).map_or(f64::NAN, Team::side),
            UnaryOp::OtherTeam => {
                team_of_number(a).map_or(-1.0, |team| team.other().index() as f64)
            }
            UnaryOp::TeamOf => player_index(a).map_or(-1.0, |index| (index / TEAM_MAX) as f64),
            UnaryOp::Exists => exists(a).into(),
            UnaryOp::Wrap => wrap(a),
        }
    }

    /// The result for a constant; `None` if it depends on the match.
    pub fn fold(self, a: f64) -> Option<f64> {
        (self != UnaryOp::Exists).then(|| self.apply(a, |_| false))
    }
}

impl BinaryOp {
    /// Every binary operator.
    pub const ALL: &'static [BinaryOp] = &[
        BinaryOp::Add,
        BinaryOp::Sub,
        BinaryOp::Mul,
        BinaryOp::Div,
        BinaryOp::Mod,
        BinaryOp::Pow,
        BinaryOp::Min,
        BinaryOp::Max,
        BinaryOp::Hypot,
        BinaryOp::Atan2,
        BinaryOp::Lt,
        BinaryOp::Le,
        BinaryOp::Gt,
        BinaryOp::Ge,
        BinaryOp::Eq,
        BinaryOp::Ne,
        BinaryOp::And,
        BinaryOp::Or,
    ];

    /// The result for two operands.
    #[inline]
    pub fn apply(self, a: f64, b: f64) -> f64 {
        match self {
            BinaryOp::Add => a + b,
            BinaryOp::Sub => a - b,
            BinaryOp::Mul => a * b,
            BinaryOp::Div if b == 0.0 => f64::NAN,
            BinaryOp::Div => a / b,
            BinaryOp::Mod => modulo(a, b),
            BinaryOp::Pow => libm::pow(a, b),
            // The standard library's functions drop a NaN; here it must propagate.
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
            // Lengths on a pitch neither overflow nor vanish, so a plain square root is exact
            // enough, and fast.
            BinaryOp::Hypot => (a * a + b * b).sqrt(),
            BinaryOp::Atan2 => libm::atan2(a, b),
            BinaryOp::Lt => (a < b).into(),
            BinaryOp::Le => (a <= b).into(),
            BinaryOp::Gt => (a > b).into(),
            BinaryOp::Ge => (a >= b).into(),
            BinaryOp::Eq => (a == b).into(),
            BinaryOp::Ne => (a != b && !a.is_nan() && !b.is_nan()).into(),
            BinaryOp::And => (truth(a) & truth(b)).into(),
            BinaryOp::Or => (truth(a) | truth(b)).into(),
        }
    }
}

/// Whether a number counts as true: neither 0 nor impossible.
#[inline]
pub fn truth(value: f64) -> bool {
    value != 0.0 && !value.is_nan()
}

/// A player id as an index; `None` for -1 and other values that aren't ids.
#[inline]
pub fn player_index(id: f64) -> Option<usize> {
    let index = id as i64;
    (index as f64 == id && (0..PLAYERS_MAX as i64).contains(&index)).then_some(index as usize)
}

/// The team that a program's number means.
#[inline]
pub fn team_of_number(number: f64) -> Option<Team> {
    if number == 0.0 {
        Some(Team::Left)
    } else if number == 1.0 {
        Some(Team::Right)
    } else {
        None
    }
}

/// The remainder with the divisor's sign; NaN for a zero divisor. It is exact: `mod(1m, 0.1m)` is
/// 0.0999…, because the number nearest to 0.1 goes 9 times into 1.
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
    // Both ends are the same angle; the positive one is the natural answer for half a turn.
    if turned == -PI { PI } else { turned }
}
