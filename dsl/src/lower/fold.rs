//! The operators on constants, as the engine computes them.

use setpiece_scenario::{BinaryOp, UnaryOp};
use std::f64::consts::PI;

/// An operator of one operand; `None` where only the engine knows (players on the pitch) or its arithmetic is used.
///
/// Transcendental functions are left to the engine, so that a constant is the same bits as a computed value.
pub(crate) fn unary(op: UnaryOp, a: f64) -> Option<f64> {
    Some(match op {
        UnaryOp::Neg => -a,
        UnaryOp::Not => truth(a == 0.0),
        UnaryOp::Abs => a.abs(),
        UnaryOp::Sqrt => a.sqrt(),
        UnaryOp::Floor => a.floor(),
        UnaryOp::Ceil => a.ceil(),
        UnaryOp::Round => a.round(),
        UnaryOp::Side if a == 0.0 => 1.0,
        UnaryOp::Side if a == 1.0 => -1.0,
        UnaryOp::OtherTeam => {
            if a == 0.0 {
                1.0
            } else if a == 1.0 {
                0.0
            } else {
                -1.0
            }
        }
        UnaryOp::TeamOf => {
            if a < 0.0 {
                -1.0
            } else {
                (a / setpiece_scenario::pitch::TEAM_MAX as f64).floor()
            }
        }
        UnaryOp::Wrap if (-PI..=PI).contains(&a) => a,
        UnaryOp::Side | UnaryOp::Exists | UnaryOp::Exp | UnaryOp::Log | UnaryOp::Sin | UnaryOp::Cos | UnaryOp::Wrap => {
            return None;
        }
    })
}

/// An operator of two operands; `None` where the engine's own arithmetic is used.
pub(crate) fn binary(op: BinaryOp, a: f64, b: f64) -> Option<f64> {
    Some(match op {
        BinaryOp::Add => a + b,
        BinaryOp::Sub => a - b,
        BinaryOp::Mul => a * b,
        BinaryOp::Div => a / b,
        BinaryOp::Mod => a - b * (a / b).floor(),
        BinaryOp::Min => a.min(b),
        BinaryOp::Max => a.max(b),
        BinaryOp::Lt => truth(a < b),
        BinaryOp::Le => truth(a <= b),
        BinaryOp::Gt => truth(a > b),
        BinaryOp::Ge => truth(a >= b),
        BinaryOp::Eq => truth(a == b),
        BinaryOp::Ne => truth(a != b),
        BinaryOp::And => truth(a != 0.0 && b != 0.0),
        BinaryOp::Or => truth(a != 0.0 || b != 0.0),
        BinaryOp::Pow | BinaryOp::Hypot | BinaryOp::Atan2 => return None,
    })
}

fn truth(value: bool) -> f64 {
    f64::from(u8::from(value))
}
