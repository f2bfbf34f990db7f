//! Ratings from matches.
//!
//! The model is that of Bradley and Terry (1952): an agent with 400 points more than another wins
//! ten times as often as it loses. A draw counts as half a win for both. Each pair has one more
//! drawn match than it played, so that who won everything has a rating too. The likeliest ratings
//! are found by minorisation and maximisation (Hunter 2004).
//!
//! An interval is between percentiles of ratings for results that are drawn again: the shares of
//! wins, draws and defeats of each pair come from their posterior distribution, a Dirichlet's with
//! half a match of each kind before the first (Jeffreys 1946). A bootstrap would draw nothing but
//! defeats for who lost every match, and know them for certain.

use serde::Serialize;
use setpiece_engine::random::{Purpose, Stream};

/// The mean of all ratings.
const MEAN: f64 = 1_000.0;
/// Points for ten times the odds.
const SCALE: f64 = 400.0;
/// How often results are drawn again.
const RESAMPLES: usize = 1_000;
/// The most rounds of the search, which ends before.
const ROUNDS: usize = 10_000;
/// The search ends when no strength changes by more than this share.
const PRECISION: f64 = 1e-10;

/// A rating.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Elo {
    /// Points; the mean of all agents is 1000.
    pub value: f64,
    /// The lower end of the 95 % interval.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// The matches of two agents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairScore {
    /// Their places.
    pub agents: [usize; 2],
    /// What the first won, drew and lost.
    pub results: [u32; 3],
}

/// The matches of two agents, which may be parts.
type Shares = ([usize; 2], [f64; 3]);

/// The drawn matches that each pair has more than it played, and that drawn results don't need:
/// their shares are never none.
const ONE_MORE: f64 = 1.0;
const AS_DRAWN: f64 = 0.0;

/// Rates some agents by their matches.
pub fn elo(agents: usize, pairs: &[PairScore]) -> Vec<Elo> {
    let played: Vec<Shares> =
        pairs.iter().map(|pair| (pair.agents, pair.results.map(f64::from))).collect();
    let found = ratings(agents, &played, ONE_MORE);
    let mut resampled: Vec<Vec<f64>> = vec![Vec::with_capacity(RESAMPLES); agents];
    for resample in 0..RESAMPLES {
        let mut stream = Stream::new(0, resample as u64, Purpose::Resample);
        let drawn: Vec<Shares> = pairs.iter().map(|pair| drawn_again(pair, &mut stream)).collect();
        for (ratings, rating) in resampled.iter_mut().zip(ratings(agents, &drawn, AS_DRAWN)) {
            ratings.push(rating);
        }
    }
    let end = |sorted: &[f64], share: f64| {
        let rank = (share * sorted.len() as f64).ceil() as usize;
        sorted.get(rank.max(1) - 1).copied()
    };
    let each = found.into_iter().zip(resampled.iter_mut()).map(|(value, ratings)| {
        ratings.sort_by(f64::total_cmp);
        // The interval holds what was measured.
        let low = end(ratings, 0.025).unwrap_or(value).min(value);
        let high = end(ratings, 0.975).unwrap_or(value).max(value);
        Elo { value, low, high }
    });
    each.collect()
}

/// As many matches, with shares of wins, draws and defeats from their posterior distribution.
fn drawn_again(pair: &PairScore, stream: &mut Stream) -> Shares {
    let weights = pair.results.map(|count| gamma(count, stream));
    let matches = f64::from(pair.results.iter().sum::<u32>());
    let sum: f64 = weights.iter().sum();
    (pair.agents, weights.map(|weight| matches * weight / sum.max(f64::MIN_POSITIVE)))
}

/// Draws from the gamma distribution with the shape `count` + 1/2: a sum of exponential numbers,
/// and half the square of a normal one.
fn gamma(count: u32, stream: &mut Stream) -> f64 {
    let normal = stream.normal();
    let whole: f64 = (0..count).map(|_| -libm::log(1.0 - stream.unit_f64())).sum();
    whole + normal * normal / 2.0
}

/// The likeliest ratings, with this many more drawn matches of each pair.
fn ratings(agents: usize, pairs: &[Shares], more: f64) -> Vec<f64> {
    let mut points = vec![0.0; agents];
    for &([first, second], [won, drawn, lost]) in pairs {
        let half = 0.5 * (drawn + more);
        points[first] += won + half;
        points[second] += lost + half;
    }
    let mut strengths = vec![1.0; agents];
    for _ in 0..ROUNDS {
        let mut expected = vec![0.0; agents];
        for &([first, second], results) in pairs {
            let matches = results.iter().sum::<f64>() + more;
            let share = matches / (strengths[first] + strengths[second]);
            expected[first] += share;
            expected[second] += share;
        }
        let mut next: Vec<f64> = points
            .iter()
            .zip(&expected)
            .map(|(points, expected)| if *expected > 0.0 { points / expected } else { 1.0 })
            .collect();
        // Only ratios matter: their logarithms have the mean 0.
        let mean = next.iter().map(|it| libm::log(*it)).sum::<f64>() / agents.max(1) as f64;
        let unit = libm::exp(mean);
        for strength in &mut next {
            *strength /= unit;
        }
        let change = next.iter().zip(&strengths).map(|(new, old)| (new / old - 1.0).abs());
        let change = change.fold(0.0, f64::max);
        strengths = next;
        if change < PRECISION {
            break;
        }
    }
    strengths.iter().map(|it| MEAN + SCALE * libm::log10(*it)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(first: usize, second: usize, results: [u32; 3]) -> PairScore {
        PairScore { agents: [first, second], results }
    }

    /// Of 100 matches and the drawn one 91.5 points against 9.5: 400 log10(91.5 / 9.5) apart.
    #[test]
    fn two_agents_are_as_far_apart_as_their_odds() {
        let found = elo(2, &[pair(0, 1, [91, 0, 9])]);
        let apart = found[0].value - found[1].value;
        assert!((apart - 400.0 * (91.5_f64 / 9.5).log10()).abs() < 1e-6, "{apart}");
        assert!((found[0].value + found[1].value - 2_000.0).abs() < 1e-6);
        // About twice the standard error of a share, in points.
        let width = found[0].high - found[0].low;
        assert!((60.0..160.0).contains(&width), "{found:?}");
    }

    #[test]
    fn draws_are_half_a_win_and_equals_are_equal() {
        let drawn = elo(2, &[pair(0, 1, [0, 10, 0])]);
        let split = elo(2, &[pair(0, 1, [5, 0, 5])]);
        assert!((drawn[0].value - 1_000.0).abs() < 1e-9 && (split[0].value - 1_000.0).abs() < 1e-9);
        // Ten draws say more than five wins on each side.
        let [narrow, wide] = [&drawn, &split].map(|it| it[0].high - it[0].low);
        assert!(10.0 < narrow && narrow < wide / 1.5, "{narrow} {wide}");
    }

    #[test]
    fn who_wins_everything_has_a_finite_rating_above_all() {
        let pairs = [pair(0, 1, [8, 0, 0]), pair(0, 2, [8, 0, 0]), pair(1, 2, [6, 1, 1])];
        let found = elo(3, &pairs);
        assert!(found.iter().all(|elo| elo.value.is_finite() && elo.low <= elo.high), "{found:?}");
        assert!(found[0].value > found[1].value && found[1].value > found[2].value, "{found:?}");
    }

    #[test]
    fn who_loses_everything_isnt_known_for_certain() {
        let [few, many] = [4, 100].map(|n| elo(2, &[pair(0, 1, [0, 0, n])])[0]);
        assert!(few.high - few.low > 80.0, "{few:?}");
        assert!(many.high < few.value, "{many:?} {few:?}");
    }

    #[test]
    fn the_same_matches_have_the_same_intervals() {
        let pairs = [pair(0, 1, [3, 2, 1]), pair(0, 2, [4, 0, 2]), pair(1, 2, [2, 2, 2])];
        assert_eq!(elo(3, &pairs), elo(3, &pairs));
    }

    #[test]
    fn whoever_wins_everything_may_be_any_better() {
        let found = elo(2, &[pair(0, 1, [20, 0, 0])]);
        assert!(found[0].high > found[0].value + 100.0, "{found:?}");
        assert!(found[1].low < found[1].value - 100.0, "{found:?}");
    }

    #[test]
    fn an_interval_holds_the_truth_about_as_often_as_it_says() {
        // 95 of 100 matches won: 511 points apart.
        let apart = SCALE * libm::log10(19.0);
        let mut held = 0;
        for seed in 0..60 {
            let mut stream = Stream::new(seed, 0, Purpose::Resample);
            let won = (0..40).filter(|_| stream.unit_f64() < 0.95).count() as u32;
            let found = elo(2, &[pair(0, 1, [won, 0, 40 - won])]);
            held += u32::from((found[0].low..=found[0].high).contains(&(MEAN + apart / 2.0)));
        }
        assert!(held >= 52, "{held} of 60");
    }
}
