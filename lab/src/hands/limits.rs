//! How far our figures may lie from recorded ones.

use crate::figure::Part;
use crate::pitch::{deviation, mean};

/// Rows of theirs in which fewer episodes have a value say too little.
pub(super) const FEWEST: u64 = 5;

/// What a figure measures, which says how far ours may be off beside what chance does to the two means.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    /// A share of the episodes.
    Share,
    /// A share of an episode's steps: ±0.05.
    Part,
    /// A count in an episode: ±0.25.
    Count,
    /// Steps: ±1.
    Steps,
    /// m/s: ±8 %.
    Speed,
    /// Degrees: ±3.
    Degrees,
    /// Degrees round the circle: ±3, by the shorter way.
    Way,
    /// Metres of height: ±25 %, at least 0.3.
    Height,
    /// Metres: ±8 %, at least 0.5.
    Metres,
    /// A place in Google Research Football's coordinates: ±0.03.
    Place,
}

/// A figure as recorded; without a mean where no episode has a value.
#[derive(serde::Deserialize)]
pub(super) struct Measured {
    pub(super) mean: Option<f64>,
    pub(super) sd: Option<f64>,
    pub(super) n: u64,
}

/// A figure beside theirs.
pub(super) fn part(name: &str, kind: Kind, theirs: &Measured, ours: &[f64]) -> Option<Part> {
    let middle = theirs.mean?;
    let n = ours.len().max(1) as u64;
    let chance = 1.96 * theirs.sd.unwrap_or_default() * (1.0 / theirs.n as f64 + 1.0 / n as f64).sqrt();
    let give = match kind {
        Kind::Share => share_give(middle, theirs.n, n),
        Kind::Part => 0.05 + chance,
        Kind::Count => 0.25 + chance,
        Kind::Steps => 1.0 + chance,
        Kind::Speed => 0.08 * middle + chance,
        Kind::Degrees | Kind::Way => 3.0 + chance,
        Kind::Height => (0.25 * middle).max(0.3) + chance,
        Kind::Metres => (0.08 * middle).max(0.5) + chance,
        Kind::Place => 0.03 + chance,
    };
    let ours = match kind {
        Kind::Way => middle + wrapped(kind.mean(ours) - middle),
        _ => mean(ours),
    };
    Some(Part::around(name, middle, give, ours))
}

impl Kind {
    /// The mean of some values.
    pub(super) fn mean(self, of: &[f64]) -> f64 {
        let Kind::Way = self else { return mean(of) };
        let along = |part: fn(f64) -> f64| of.iter().map(|way| part(way.to_radians())).sum::<f64>();
        along(f64::sin).atan2(along(f64::cos)).to_degrees()
    }

    /// Their standard deviation.
    pub(super) fn deviation(self, of: &[f64]) -> f64 {
        let Kind::Way = self else { return deviation(of) };
        let middle = self.mean(of);
        // Around a middle of 0 the deviations are what they are round the circle.
        let off: Vec<f64> = of.iter().map(|way| wrapped(way - middle)).collect();
        deviation(&off)
    }
}

/// An angle in -180 to 180 degrees.
fn wrapped(degrees: f64) -> f64 {
    (degrees + 180.0).rem_euclid(360.0) - 180.0
}

/// How far two shares may be apart: what chance does to samples of `theirs` and `ours` in nineteen cases of twenty, and a
/// tenth more.
pub(super) fn share_give(share: f64, theirs: u64, ours: u64) -> f64 {
    // Agresti and Coull's two successes and two failures keep shares of 0 and 1 from looking certain.
    let n = theirs as f64;
    let p = (share * n + 2.0) / (n + 4.0);
    1.96 * (p * (1.0 - p) * (1.0 / (n + 4.0) + 1.0 / ours as f64)).sqrt() + 0.1
}
