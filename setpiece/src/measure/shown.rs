//! Measured values in words.

use super::Estimate;
use setpiece_scenario::pitch::STEPS_PER_S;
use setpiece_scenario::plan::{Measure, Quantity};

/// A value and its interval: `97.0 % [84.7, 99.5]`.
pub fn shown(measure: &Measure, measured: &Estimate) -> String {
    let (scale, unit, decimals) = unit(measure);
    let number = |value: f64| format!("{:.decimals$}", value * scale);
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let (value, low, high) = (number(measured.value), number(measured.low), number(measured.high));
    format!("{value}{unit} [{low}, {high}]")
}

/// How a measure is shown: its scale, its unit and its decimals.
fn unit(measure: &Measure) -> (f64, String, usize) {
    match measure {
        Measure::SuccessRate | Measure::Rate(_) => (100.0, "%".to_owned(), 1),
        Measure::Mean(quantity)
        | Measure::Min(quantity)
        | Measure::Max(quantity)
        | Measure::Quantile(quantity, _) => match quantity {
            Quantity::Length => (STEPS_PER_S, "steps".to_owned(), 1),
            Quantity::Record(_, unit) => (1.0, unit.to_string(), 3),
            Quantity::Return | Quantity::Score | Quantity::Term(_) => (1.0, String::new(), 3),
        },
        Measure::Steps | Measure::Episodes => (1.0, String::new(), 3),
    }
}
