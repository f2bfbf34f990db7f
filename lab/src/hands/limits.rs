//! The tolerance between our figures and recorded ones.

use crate::figure::FigurePart;
use crate::pitch::{deviation, mean};

/// Rows in which fewer of their episodes have a value say too little.
pub(super) const FEWEST: u64 = 5;

/// What a figure measures. It decides the tolerance in addition to the random error of the two
/// means.
#[derive(Clone, Copy)]
pub(super) enum FigureKind {
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
    /// Degrees around the circle: ±3, the shorter way.
    Way,
    /// Metres of height: ±25 %, at least 0.3.
    Height,
    /// Metres: ±8 %, at least 0.5.
    Metres,
    /// A place in Google Research Football's coordinates: ±0.03.
    Place,
}

/// A figure as recorded; without a mean if no episode has a value.
#[derive(serde::Deserialize)]
pub(super) struct RecordedFigure {
    pub(super) mean: Option<f64>,
    pub(super) sd: Option<f64>,
    pub(super) n: u64,
}

impl RecordedFigure {
    /// The figure from these episodes' values.
    pub(super) fn of(kind: FigureKind, values: &[f64]) -> RecordedFigure {
        let some = !values.is_empty();
        let [mean, sd] =
            [kind.mean(values), kind.deviation(values)].map(|it| Some(it).filter(|_| some));
        RecordedFigure { mean, sd, n: values.len() as u64 }
    }

    /// Combines these episodes with others.
    pub(super) fn with(self, kind: FigureKind, other: &RecordedFigure) -> RecordedFigure {
        let (Some(mean), Some(theirs)) = (self.mean, other.mean) else {
            return if self.mean.is_some() { self } else { RecordedFigure { ..*other } };
        };
        let apart = match kind {
            FigureKind::Way => wrapped(theirs - mean),
            _ => theirs - mean,
        };
        let (n, m) = (self.n as f64, other.n as f64);
        let squares = |sd: Option<f64>, n: f64| sd.unwrap_or_default().powi(2) * (n - 1.0);
        let sum = squares(self.sd, n) + squares(other.sd, m) + apart * apart * n * m / (n + m);
        let sd = (sum / (n + m - 1.0)).sqrt();
        RecordedFigure { mean: Some(mean + apart * m / (n + m)), sd: Some(sd), n: self.n + other.n }
    }
}

/// Compares our figure with theirs.
pub(super) fn part(
    name: &str,
    kind: FigureKind,
    theirs: &RecordedFigure,
    ours: &[f64],
) -> Option<FigurePart> {
    let middle = theirs.mean?;
    let n = ours.len().max(1) as u64;
    // Events that a few episodes happen not to show aren't impossible: adds one to their total.
    let least =
        if let FigureKind::Count = kind { (middle + 1.0 / theirs.n as f64).sqrt() } else { 0.0 };
    let chance = 1.96
        * theirs.sd.unwrap_or_default().max(least)
        * (1.0 / theirs.n as f64 + 1.0 / n as f64).sqrt();
    let give = match kind {
        FigureKind::Share => share_give(middle, theirs.n, n),
        FigureKind::Part => 0.05 + chance,
        FigureKind::Count => 0.25 + chance,
        FigureKind::Steps => 1.0 + chance,
        FigureKind::Speed => 0.08 * middle + chance,
        FigureKind::Degrees | FigureKind::Way => 3.0 + chance,
        FigureKind::Height => (0.25 * middle).max(0.3) + chance,
        FigureKind::Metres => (0.08 * middle).max(0.5) + chance,
        FigureKind::Place => 0.03 + chance,
    };
    let ours = match kind {
        FigureKind::Way => middle + wrapped(kind.mean(ours) - middle),
        _ => mean(ours),
    };
    Some(FigurePart::around(name, middle, give, ours))
}

impl FigureKind {
    /// The mean of some values.
    pub(super) fn mean(self, of: &[f64]) -> f64 {
        let FigureKind::Way = self else { return mean(of) };
        let along = |part: fn(f64) -> f64| of.iter().map(|way| part(way.to_radians())).sum::<f64>();
        along(f64::sin).atan2(along(f64::cos)).to_degrees()
    }

    /// Their standard deviation.
    pub(super) fn deviation(self, of: &[f64]) -> f64 {
        let FigureKind::Way = self else { return deviation(of) };
        let middle = self.mean(of);
        // Around a middle of 0 the deviations are the same as around the circle.
        let off: Vec<f64> = of.iter().map(|way| wrapped(way - middle)).collect();
        deviation(&off)
    }
}

/// An angle in -180 to 180 degrees.
fn wrapped(degrees: f64) -> f64 {
    (degrees + 180.0).rem_euclid(360.0) - 180.0
}

/// The tolerance between two shares: the random error of samples of `theirs` and `ours` in nineteen
/// cases of twenty, plus a tenth.
pub(super) fn share_give(share: f64, theirs: u64, ours: u64) -> f64 {
    // Agresti and Coull's two successes and two failures keep shares of 0 and 1 from looking
    // certain.
    let n = theirs as f64;
    let p = (share * n + 2.0) / (n + 4.0);
    1.96 * (p * (1.0 - p) * (1.0 / (n + 4.0) + 1.0 / ours as f64)).sqrt() + 0.1
}

#[cfg(test)]
mod tests {
    use super::{FigureKind, RecordedFigure};

    #[test]
    fn two_recordings_together_are_one_of_all_their_episodes() {
        for kind in [FigureKind::Steps, FigureKind::Way] {
            let all = [170.0, 178.0, 175.0, 179.0, 168.0, 176.0, 171.0];
            let together = RecordedFigure::of(kind, &all[..3])
                .with(kind, &RecordedFigure::of(kind, &all[3..]));
            let whole = RecordedFigure::of(kind, &all);
            assert_eq!(together.n, whole.n);
            assert!(
                (together.mean.unwrap_or_default() - whole.mean.unwrap_or_default()).abs() < 0.1
            );
            assert!((together.sd.unwrap_or_default() - whole.sd.unwrap_or_default()).abs() < 0.1);
        }
    }
}
