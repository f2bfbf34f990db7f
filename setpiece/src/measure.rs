//! Measures of some episodes, with 95 % intervals.
//!
//! A rate has Wilson's interval (Wilson 1927), as has a mean score of nothing but 0 and 1.
//! Everything else has that of the bootstrap's percentiles (Efron 1979), resampled by a stream of
//! its own: the same episodes give the same interval.

mod shown;

pub use shown::shown;

use setpiece_engine::batch::EpisodeSummary;
use setpiece_engine::random::{Purpose, Stream};
use setpiece_scenario::Verdict;
use setpiece_scenario::pitch::STEPS_PER_S;
use setpiece_scenario::plan::{Measure, MeasureGoal, Quantity};

/// The 97.5 % quantile of the normal distribution.
const Z: f64 = 1.959_963_984_540_054;
/// How often episodes are resampled.
const RESAMPLES: usize = 1_000;
/// The interval's share.
const SHARE: f64 = 0.95;

/// A measured value.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Estimate {
    /// The value, in SI units.
    pub value: f64,
    /// The lower end of its 95 % interval.
    pub low: f64,
    /// The upper end.
    pub high: f64,
    /// How many episodes have the number.
    pub episodes: usize,
}

impl Estimate {
    /// Whether a bound lies inside the interval, so that more episodes may decide otherwise.
    pub fn is_unsure_of(&self, bound: f64) -> bool {
        self.low < bound && bound < self.high
    }
}

/// Measures some episodes; `None` if no episode has the number. `terms` are the names of the terms,
/// in the order of the summaries.
pub fn measure(
    measure: &Measure,
    episodes: &[&EpisodeSummary],
    terms: &[String],
) -> Option<Estimate> {
    if episodes.is_empty() {
        return None;
    }
    let samples: Vec<f64> =
        episodes.iter().filter_map(|episode| sample(measure, episode, terms)).collect();
    match measure {
        Measure::SuccessRate | Measure::Rate(_) => {
            let successes = samples.iter().filter(|sample| **sample > 0.0).count();
            Some(wilson(successes, samples.len()))
        }
        // A mean of goals is a rate if nobody scores more than once. Resampled, the same score of
        // every episode would be known for certain.
        Measure::Mean(Quantity::Score) if samples.iter().all(|it| *it == 0.0 || *it == 1.0) => {
            Some(wilson(samples.iter().filter(|it| **it == 1.0).count(), samples.len()))
        }
        Measure::Steps | Measure::Episodes => Some(exactly(samples.iter().sum())),
        _ => resampled(&samples, |sorted| statistic(measure, sorted)),
    }
}

/// What a measure takes of one episode: 1 or 0 for a rate. `None` if it could not be computed.
pub fn sample(measure: &Measure, episode: &EpisodeSummary, terms: &[String]) -> Option<f64> {
    let truth = |holds: bool| Some(f64::from(u8::from(holds)));
    match measure {
        Measure::SuccessRate => truth(episode.verdict == Some(Verdict::Success)),
        Measure::Rate(outcome) => truth(episode.outcome == *outcome),
        Measure::Mean(quantity)
        | Measure::Min(quantity)
        | Measure::Max(quantity)
        | Measure::Quantile(quantity, _) => number(quantity, episode, terms),
        Measure::Steps => Some(f64::from(episode.length)),
        Measure::Episodes => Some(1.0),
    }
}

/// A measure of what it took of some episodes, sorted.
pub fn statistic(measure: &Measure, sorted: &[f64]) -> f64 {
    match measure {
        Measure::SuccessRate | Measure::Rate(_) | Measure::Mean(_) => mean(sorted),
        Measure::Min(_) => quantile(sorted, 0.0),
        Measure::Max(_) => quantile(sorted, 1.0),
        Measure::Quantile(_, share) => quantile(sorted, *share),
        Measure::Steps | Measure::Episodes => sorted.iter().sum(),
    }
}

/// The number that an episode has; `None` if it could not be computed.
pub fn number(quantity: &Quantity, episode: &EpisodeSummary, terms: &[String]) -> Option<f64> {
    let by_agent = |of: &dyn Fn(usize) -> f64| {
        let agents = episode.returns.len();
        // The sum of nothing is -0.
        (0..agents).map(of).sum::<f64>() / agents.max(1) as f64 + 0.0
    };
    match quantity {
        Quantity::Length => Some(f64::from(episode.length) / STEPS_PER_S),
        Quantity::Return => {
            Some(by_agent(&|agent| episode.returns.get(agent).copied().unwrap_or_default()))
        }
        Quantity::Score => {
            let [left, right] = episode.score;
            Some(f64::from(left) - f64::from(right))
        }
        Quantity::Record(name, _) => {
            let (_, value) = episode.records.iter().find(|(known, _)| known == name)?;
            value.number()
        }
        Quantity::Term(name) => {
            let at = terms.iter().position(|known| known == name)?;
            let of = |agent: usize| episode.terms.get(agent).and_then(|terms| terms.get(at));
            Some(by_agent(&|agent| of(agent).copied().unwrap_or_default()))
        }
    }
}

/// The episode that speaks most against a goal, by its place in the list.
pub fn worst(goal: &MeasureGoal, episodes: &[&EpisodeSummary], terms: &[String]) -> Option<usize> {
    use setpiece_scenario::plan::Comparison::{
        Equal, Greater, GreaterEqual, Less, LessEqual, NotEqual,
    };
    // How far it is on the wrong side.
    let against = |value: f64| match goal.comparison {
        Less | LessEqual => value,
        Greater | GreaterEqual => -value,
        Equal => (value - goal.bound).abs(),
        NotEqual => -(value - goal.bound).abs(),
    };
    let scored = episodes.iter().enumerate();
    let scored = scored
        .filter_map(|(at, episode)| Some((at, against(sample(&goal.measure, episode, terms)?))));
    scored.reduce(|worst, next| if next.1 > worst.1 { next } else { worst }).map(|(at, _)| at)
}

fn exactly(value: f64) -> Estimate {
    Estimate { value, low: value, high: value, episodes: 0 }
}

/// A rate with Wilson's interval.
pub fn wilson(successes: usize, trials: usize) -> Estimate {
    let n = trials.max(1) as f64;
    let share = successes as f64 / n;
    let spread = Z * (share * (1.0 - share) / n + Z * Z / (4.0 * n * n)).sqrt();
    let (centre, scale) = (share + Z * Z / (2.0 * n), 1.0 + Z * Z / n);
    // Rounding must not leave the rate itself outside.
    let low = ((centre - spread) / scale).clamp(0.0, share);
    let high = ((centre + spread) / scale).clamp(share, 1.0);
    Estimate { value: share, low, high, episodes: trials }
}

/// A statistic of sorted numbers with the interval of its bootstrap.
fn resampled(numbers: &[f64], statistic: impl Fn(&[f64]) -> f64) -> Option<Estimate> {
    if numbers.is_empty() {
        return None;
    }
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    let value = statistic(&sorted);
    let mut stream = Stream::new(0, sorted.len() as u64, Purpose::Resample);
    let mut sample = vec![0.0; sorted.len()];
    let mut values: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            for number in &mut sample {
                let drawn = stream.below(sorted.len() as u32) as usize;
                *number = sorted.get(drawn).copied().unwrap_or(value);
            }
            sample.sort_by(f64::total_cmp);
            statistic(&sample)
        })
        .collect();
    values.sort_by(f64::total_cmp);
    Some(Estimate {
        value,
        low: quantile(&values, (1.0 - SHARE) / 2.0),
        high: quantile(&values, f64::midpoint(1.0, SHARE)),
        episodes: sorted.len(),
    })
}

/// The mean of the differences of paired numbers.
pub fn differences(numbers: &[f64], less: &[f64]) -> Estimate {
    let pairs: Vec<f64> = numbers.iter().zip(less).map(|(a, b)| a - b).collect();
    resampled(&pairs, mean).unwrap_or(exactly(0.0))
}

fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len().max(1) as f64
}

/// The least of the sorted numbers that this share of them doesn't exceed.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.clamp(1, sorted.len().max(1)) - 1).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilsons_interval_is_the_published_one() {
        // Newcombe 1998, table I: 15 of 148, 0 of 20, 1 of 29.
        for (successes, trials, low, high) in
            [(15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)]
        {
            let measured = wilson(successes, trials);
            assert!((measured.low - low).abs() < 5e-5, "{measured:?}");
            assert!((measured.high - high).abs() < 5e-5, "{measured:?}");
        }
    }

    #[test]
    fn the_bootstrap_of_a_mean_is_as_wide_as_its_standard_error_says() {
        let numbers: Vec<f64> = (0..400).map(|n| f64::from(n % 20)).collect();
        let measured = resampled(&numbers, mean).unwrap();
        // The deviation of 0..19 is 5.77, that of the mean of 400 of them 0.288.
        assert_eq!(measured.value, 9.5);
        let half = f64::midpoint(measured.high, -measured.low);
        assert!((half - Z * 0.288).abs() < 0.06, "{measured:?}");
        assert_eq!(Some(measured), resampled(&numbers, mean), "it is the same each time");
    }

    #[test]
    fn quantiles_are_values_that_occur() {
        let sorted = [1.0, 2.0, 3.0, 4.0];
        let of = |share| quantile(&sorted, share);
        assert_eq!([of(0.0), of(0.25), of(0.26), of(0.5), of(1.0)], [1.0, 1.0, 2.0, 2.0, 4.0]);
    }
}
