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
fn unit(measure: &Measure) -> (f64, &'static str, usize) {
    match measure {
        Measure::SuccessRate | Measure::Rate(_) => (100.0, "%", 1),
        Measure::Mean(Quantity::Length)
        | Measure::Min(Quantity::Length)
        | Measure::Max(Quantity::Length)
        | Measure::Quantile(Quantity::Length, _) => (STEPS_PER_S, "steps", 1),
        _ => (1.0, "", 3),
    }
}
