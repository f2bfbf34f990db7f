//! The gain from more threads, relative to their gain in a loop of bare arithmetic on the same
//! machine at the same time.

use super::{BenchOptions, measure};
use crate::Error;
use setpiece_scenario::Scenario;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Rounds in which the four measurements take turns.
const ROUNDS: usize = 5;

/// The gain of `options.threads` threads over one (with at most one thread per match), as a share
/// of the gain of bare arithmetic: the median of several rounds.
///
/// # Errors
/// Like [`measure`].
pub fn scaling(scenario: &Arc<Scenario>, options: &BenchOptions) -> Result<f64, Error> {
    let each = options.duration / ROUNDS as u32;
    // A match uses one thread at a time.
    let threads = options.threads.min(options.matches);
    let steps = |threads| {
        let options = BenchOptions { threads, duration: each, ..options.clone() };
        measure(scenario, &options).map(|measured| measured.per_second())
    };
    let mut shares = Vec::new();
    for _ in 0..ROUNDS {
        let gain = steps(threads)? / steps(1)?;
        shares.push(gain / (arithmetic(threads, each) / arithmetic(1, each)));
    }
    shares.sort_by(f64::total_cmp);
    Ok(shares[ROUNDS / 2])
}

/// Rounds per second of a loop without memory access, on this many threads.
fn arithmetic(threads: usize, duration: Duration) -> f64 {
    let work = || {
        let (begun, mut rounds, mut value) = (Instant::now(), 0u64, 1u64);
        while begun.elapsed() < duration {
            for _ in 0..10_000 {
                value = value
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
            }
            black_box(value);
            rounds += 1;
        }
        rounds as f64 / begun.elapsed().as_secs_f64()
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        threads.into_iter().filter_map(|thread| thread.join().ok()).sum()
    })
}
