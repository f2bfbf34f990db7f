//! Random numbers: one small generator per purpose, keyed by the seed.
//!
//! A stream's key is (seed, index of the episode, purpose), so a new draw for one purpose doesn't
//! change the others.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;

/// The purpose of a stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u64)]
pub enum Purpose {
    /// The scenario's own draws at reset.
    Draw = 1,
    /// Noise of kicks, touches and tackles.
    Play = 2,
    /// Decisions of bots.
    Bot = 3,
    /// `ctx.random()` of scripts.
    Script = 4,
    /// Agents that act at random.
    Agent = 5,
    /// `ctx.random()` of behaviour scripts.
    Behavior = 6,
    /// Parameters that are drawn from what they may be.
    Params = 7,
    /// Resampling of results.
    Resample = 8,
    /// What a source of levels chooses.
    Level = 9,
    /// Noise of observations.
    Observe = 10,
}

/// The most proposals of one draw. That all of them are rejected is less likely than a hardware
/// fault.
const ATTEMPTS_MAX: usize = 1000;

/// A stream of random numbers.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Stream(Pcg32);

impl Stream {
    /// The stream of a purpose in one episode.
    pub fn new(seed: u64, index: u64, purpose: Purpose) -> Stream {
        let state = mix(mix(seed) ^ index.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let mut bytes = [0; 16];
        bytes[..8].copy_from_slice(&state.to_le_bytes());
        bytes[8..].copy_from_slice(&mix(state ^ purpose as u64).to_le_bytes());
        Stream(Pcg32::from_seed(bytes))
    }

    /// The stream of one draw of one attempt. `key` is the draw's own, from the scenario.
    pub fn of_draw(seed: u64, index: u64, attempt: u32, key: u64) -> Stream {
        Stream::new(
            mix(seed ^ mix(key)),
            index.wrapping_add(u64::from(attempt) << 40),
            Purpose::Draw,
        )
    }

    /// The seed of a round of an episode; the first has the episode's own.
    pub fn seed_of_round(seed: u64, round: u32) -> u64 {
        if round <= 1 { seed } else { mix(seed ^ mix(u64::from(round) << 32)) }
    }

    /// The seed of what an agent's observation draws in one step.
    pub fn seed_of_observation(seed: u64, index: u64, step: u32, agent: usize) -> u64 {
        let turn = (u64::from(step) << 8) | agent as u64;
        let mut own = Stream::new(mix(seed ^ mix(turn)), index, Purpose::Observe);
        (u64::from(own.bits()) << 32) | u64::from(own.bits())
    }

    /// The next 32 bits.
    pub fn bits(&mut self) -> u32 {
        self.0.next_u32()
    }

    /// Uniform in 0..1 (1 excluded), 24 bits.
    pub fn unit(&mut self) -> f32 {
        (self.bits() >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// Uniform in 0..1 (1 excluded), 53 bits.
    pub fn unit_f64(&mut self) -> f64 {
        let bits = (u64::from(self.bits()) << 32) | u64::from(self.bits());
        (bits >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Uniform in low..high.
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// Uniform in 0..n; 0 for n = 0.
    pub fn below(&mut self, n: u32) -> u32 {
        ((u64::from(self.bits()) * u64::from(n)) >> 32) as u32
    }

    /// Standard normal (Box–Muller).
    pub fn normal(&mut self) -> f64 {
        let radius = libm::sqrt(-2.0 * libm::log(1.0 - self.unit_f64()));
        radius * libm::cos(std::f64::consts::TAU * self.unit_f64())
    }

    /// Normal, given that it lies in low..=high; NaN if the bounds are impossible.
    ///
    /// Rejection sampling from the proposal that accepts most often: normal, uniform or, in a tail,
    /// exponential. Source: C. P. Robert, Simulation of truncated normal variables, Statistics and
    /// Computing 5 (1995).
    pub fn truncated_normal(&mut self, mean: f64, sd: f64, low: f64, high: f64) -> f64 {
        if low.is_nan() || high.is_nan() || low > high || mean.is_nan() || sd.is_nan() {
            return f64::NAN;
        }
        let (a, b) = ((low - mean) / sd.abs(), (high - mean) / sd.abs());
        if low == high || sd == 0.0 {
            return mean.clamp(low, high);
        }
        // One tail is the other's mirror image.
        let z = if b < 0.0 { -self.standard_between(-b, -a) } else { self.standard_between(a, b) };
        (mean + sd.abs() * z).clamp(low, high)
    }

    /// Standard normal, given that it lies in a..b, where b >= 0.
    fn standard_between(&mut self, a: f64, b: f64) -> f64 {
        let rate = (a + libm::sqrt(a * a + 4.0)) * 0.5;
        // The width of a tail's mass; beyond it the far end hardly matters.
        let wide = if a > 0.0 { b - a > 2.0 / rate } else { b - a > 2.5 };
        for _ in 0..ATTEMPTS_MAX {
            let (z, accepted) = if wide && a > 0.5 {
                let z = a - libm::log(1.0 - self.unit_f64()) / rate;
                (z, libm::exp(-0.5 * (z - rate) * (z - rate)))
            } else if wide {
                (self.normal(), 1.0)
            } else {
                let z = a + (b - a) * self.unit_f64();
                let peak = if a > 0.0 { a } else { 0.0 };
                (z, libm::exp(0.5 * (peak * peak - z * z)))
            };
            if (a..=b).contains(&z) && (accepted >= 1.0 || self.unit_f64() < accepted) {
                return z;
            }
        }
        a
    }
}

/// Splitmix64's finaliser.
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean and standard deviation of many draws.
    fn moments(mean: f64, sd: f64, low: f64, high: f64) -> (f64, f64) {
        let mut stream = Stream::new(3, 5, Purpose::Draw);
        let draws: Vec<f64> =
            (0..20_000).map(|_| stream.truncated_normal(mean, sd, low, high)).collect();
        assert!(draws.iter().all(|draw| (low..=high).contains(draw)));
        assert!(
            draws.iter().filter(|draw| **draw == low || **draw == high).count() < 2,
            "no atom at an end"
        );
        let average = draws.iter().sum::<f64>() / draws.len() as f64;
        let spread =
            draws.iter().map(|draw| (draw - average).powi(2)).sum::<f64>() / draws.len() as f64;
        (average, spread.sqrt())
    }

    /// Against the closed form: mean φ-differences over Φ-differences, by numerical integration.
    fn expected(low: f64, high: f64) -> (f64, f64) {
        let n = 200_000;
        let (mut mass, mut first, mut second) = (0.0, 0.0, 0.0);
        let (from, to) = (low.max(-40.0), high.min(40.0));
        for i in 0..n {
            let z = from + (to - from) * (f64::from(i) + 0.5) / f64::from(n);
            // Relative to the density at the nearer end, so that a far tail doesn't vanish.
            let peak = if from > 0.0 {
                from
            } else if to < 0.0 {
                to
            } else {
                0.0
            };
            let density = libm::exp(0.5 * (peak * peak - z * z));
            mass += density;
            first += density * z;
            second += density * z * z;
        }
        let mean = first / mass;
        (mean, (second / mass - mean * mean).sqrt())
    }

    #[test]
    fn a_truncated_normal_follows_its_distribution_however_far_its_ends() {
        for (low, high) in [
            (-1.0, 1.0),
            (-3.0, 3.0),
            (-0.2, 0.1),
            (0.3, 4.0),
            (1.0, 1.2),
            (3.0, 4.0),
            (4.0, 5.0),
            (5.0, 6.0),
            (8.0, 100.0),
            (-6.0, -5.0),
            (-100.0, -2.0),
            (-0.1, 9.0),
            (0.6, 2.0),
            (30.0, 31.0),
        ] {
            let ((mean, sd), (wanted_mean, wanted_sd)) =
                (moments(0.0, 1.0, low, high), expected(low, high));
            assert!(
                (mean - wanted_mean).abs() < 0.04 * wanted_sd,
                "{low}..{high}: mean {mean}, not {wanted_mean}"
            );
            assert!((sd / wanted_sd - 1.0).abs() < 0.04, "{low}..{high}: sd {sd}, not {wanted_sd}");
        }
        let (mean, sd) = moments(10.0, 2.0, 14.0, 18.0);
        let (wanted_mean, wanted_sd) = expected(2.0, 4.0);
        assert!(
            (mean - 10.0 - 2.0 * wanted_mean).abs() < 0.05 && (sd - 2.0 * wanted_sd).abs() < 0.05
        );
    }

    #[test]
    fn a_truncated_normal_of_impossible_ends_is_none() {
        let mut stream = Stream::new(1, 2, Purpose::Draw);
        assert!(stream.truncated_normal(0.0, 1.0, 2.0, 1.0).is_nan());
        assert!(stream.truncated_normal(f64::NAN, 1.0, 0.0, 1.0).is_nan());
        assert_eq!(stream.truncated_normal(5.0, 0.0, 0.0, 1.0), 1.0);
        assert_eq!(stream.truncated_normal(0.5, 0.0, 0.0, 1.0), 0.5);
        assert_eq!(stream.truncated_normal(0.0, 1.0, 3.0, 3.0), 3.0);
    }
}
