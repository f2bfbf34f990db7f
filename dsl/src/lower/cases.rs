//! Whether conditions exclude each other, by cases: every value that matters of everything that
//! they compare with numbers.

use super::builder::Builder;
use setpiece_scenario::{BinaryOp, Instr, Reg, UnaryOp};

/// Conditions with more parts exclude nothing.
const PARTS_MAX: usize = 64;
/// The most cases that are tried.
const CASES_MAX: usize = 2_048;

/// Whether two conditions never hold together.
pub(super) fn exclude(code: &Builder, one: Reg, other: Reg) -> bool {
    let mut compared = Vec::new();
    let mut left = PARTS_MAX;
    for condition in [one, other] {
        if find(code, condition, &mut compared, &mut left).is_none() {
            return false;
        }
    }
    let values: Vec<(Reg, Vec<f64>)> =
        compared.into_iter().map(|(reg, with)| (reg, cases(with))).collect();
    let total = values
        .iter()
        .try_fold(1_usize, |total, (_, values)| total.checked_mul(values.len()))
        .filter(|total| *total <= CASES_MAX);
    let Some(total) = total else { return false };
    (0..total).all(|mut case| {
        let mut digit = |(reg, values): &(Reg, Vec<f64>)| {
            let nth = case % values.len();
            case /= values.len();
            (*reg, values[nth])
        };
        let case: Vec<(Reg, f64)> = values.iter().map(&mut digit).collect();
        !(holds(code, one, &case) && holds(code, other, &case))
    })
}

/// What a part of a condition is.
enum ConditionPart {
    Not(Reg),
    And(Reg, Reg),
    Or(Reg, Reg),
    If(Reg, Reg, Reg),
    /// A comparison with a number; what is 1 where it holds is compared with 0.
    Compared(BinaryOp, Reg, f64),
}

fn part(code: &Builder, condition: Reg) -> ConditionPart {
    let itself = ConditionPart::Compared(BinaryOp::Ne, condition, 0.0);
    match code.instr(condition) {
        Some(&Instr::Unary(UnaryOp::Not, of)) => ConditionPart::Not(of),
        Some(&Instr::Select(condition, then, otherwise)) => {
            ConditionPart::If(condition, then, otherwise)
        }
        Some(&Instr::Binary(BinaryOp::And, a, b)) => ConditionPart::And(a, b),
        Some(&Instr::Binary(BinaryOp::Or, a, b)) => ConditionPart::Or(a, b),
        Some(&Instr::Binary(op, a, b)) => {
            // Which side the number stands on doesn't matter.
            match (turned(op), code.constant_of(a), code.constant_of(b)) {
                (Some(_), _, Some(number)) => ConditionPart::Compared(op, a, number),
                (Some(turned), Some(number), _) => ConditionPart::Compared(turned, b, number),
                _ => itself,
            }
        }
        _ => itself,
    }
}

/// A comparison with its sides exchanged; `None` of any other operator.
fn turned(op: BinaryOp) -> Option<BinaryOp> {
    Some(match op {
        BinaryOp::Lt => BinaryOp::Gt,
        BinaryOp::Le => BinaryOp::Ge,
        BinaryOp::Gt => BinaryOp::Lt,
        BinaryOp::Ge => BinaryOp::Le,
        BinaryOp::Eq | BinaryOp::Ne => op,
        _ => return None,
    })
}

/// Notes what a condition compares, and with which numbers; `None` if it has too many parts.
fn find(
    code: &Builder,
    condition: Reg,
    compared: &mut Vec<(Reg, Vec<f64>)>,
    left: &mut usize,
) -> Option<()> {
    *left = left.checked_sub(1)?;
    match part(code, condition) {
        ConditionPart::Not(of) => find(code, of, compared, left),
        ConditionPart::And(a, b) | ConditionPart::Or(a, b) => {
            find(code, a, compared, left)?;
            find(code, b, compared, left)
        }
        ConditionPart::If(of, then, otherwise) => {
            find(code, of, compared, left)?;
            find(code, then, compared, left)?;
            find(code, otherwise, compared, left)
        }
        ConditionPart::Compared(_, reg, number) => {
            match compared.iter_mut().find(|(known, _)| *known == reg) {
                Some((_, with)) => with.push(number),
                None => compared.push((reg, vec![number])),
            }
            Some(())
        }
    }
}

/// The numbers themselves, one between each two, one on either side, and none at all.
fn cases(mut numbers: Vec<f64>) -> Vec<f64> {
    numbers.sort_by(f64::total_cmp);
    numbers.dedup();
    let between = numbers.windows(2).map(|two| f64::midpoint(two[0], two[1]));
    let between: Vec<f64> = between.collect();
    numbers.extend(between);
    numbers.extend([f64::NEG_INFINITY, f64::INFINITY, f64::NAN]);
    numbers
}

/// Whether a condition holds in a case. (With an undefined value no comparison does.)
fn holds(code: &Builder, condition: Reg, case: &[(Reg, f64)]) -> bool {
    let of = |reg: Reg| holds(code, reg, case);
    match part(code, condition) {
        ConditionPart::Not(a) => !of(a),
        ConditionPart::And(a, b) => of(a) && of(b),
        ConditionPart::Or(a, b) => of(a) || of(b),
        ConditionPart::If(a, then, otherwise) => of(if of(a) { then } else { otherwise }),
        ConditionPart::Compared(op, reg, number) => {
            let value = case.iter().find(|(known, _)| *known == reg).map_or(f64::NAN, |it| it.1);
            match op {
                BinaryOp::Lt => value < number,
                BinaryOp::Le => value <= number,
                BinaryOp::Gt => value > number,
                BinaryOp::Ge => value >= number,
                BinaryOp::Eq => value == number,
                _ => !value.is_nan() && value != number,
            }
        }
    }
}
