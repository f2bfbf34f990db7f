//! Random numbers: one small generator per purpose, keyed by the seed.
//!
//! A stream is keyed by (seed, index of the episode, purpose), so a new draw in one purpose shifts no other.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;

/// What a stream is for.
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
    /// `ctx.random()` of scripts that play a player.
    Behavior = 6,
}

/// A stream of random numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
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

    /// The stream of one draw of one attempt: `key` is the draw's own, from the scenario.
    pub fn of_draw(seed: u64, index: u64, attempt: u32, key: u64) -> Stream {
        Stream::new(mix(seed ^ mix(key)), index.wrapping_add(u64::from(attempt) << 40), Purpose::Draw)
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
}

/// Splitmix64's finaliser.
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
