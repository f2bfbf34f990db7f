//! What is done once an episode, or once an observation: to create, to reset, to keep a state and go back to it, to look.

use super::BenchOptions;
use crate::Error;
use setpiece_engine::batch::EpisodeError;
use setpiece_engine::environment::{Environment, Scratch};
use setpiece_engine::observe::{Floats, SMM_HEIGHT, SMM_WIDTH, smm, smm_size};
use setpiece_scenario::Scenario;
use setpiece_scenario::vocabulary::Action;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// How many times each is tried to find the quickest run of it, which no other work has disturbed.
const RUNS: u32 = 20;

/// What [`once`] measures, in its order:
/// - `create`: an environment from a loaded scenario, and its first reset;
/// - `reset`: a later one;
/// - `memory`: the state copied to another environment and back;
/// - `to_bytes`, `from_bytes`: a snapshot taken, and gone back to;
/// - `simple115v2`, `smm`: the first agent's observation written, 115 floats or 72 by 96 by 4 bytes; 0 without agents.
pub const ONCE_NAMES: [&str; 7] = ["create", "reset", "memory", "to_bytes", "from_bytes", "simple115v2", "smm"];

/// Microseconds of each of [`ONCE_NAMES`]: the least of some runs' means, wall time on one thread.
///
/// # Errors
/// As [`super::measure`].
pub fn once(scenario: &Arc<Scenario>, options: &BenchOptions) -> Result<[f64; ONCE_NAMES.len()], Error> {
    let create = || Environment::new(scenario.clone(), options.environment.clone()).map_err(Error::Environment);
    let told = |why: EpisodeError| Error::Episode(Box::new(why));
    let mut played = create()?;
    let mut seed = options.seed;
    let mut reset = |environment: &mut Environment| {
        seed = seed.wrapping_add(1);
        environment.reset(Some(seed), None).map_err(|why| told(why.into()))
    };
    // In the midst of an episode, so that there is something to keep.
    reset(&mut played)?;
    let (idle, mut scratch) = (vec![Action::Idle; played.n_agents()], Scratch::default());
    for _ in 0..20 {
        if !played.is_running() {
            reset(&mut played)?;
        }
        played.step(&idle, &mut scratch).map_err(|why| told(why.into()))?;
    }
    let mut kept = played.clone();
    let bytes = played.snapshot().map_err(Error::Snapshot)?;
    let mut floats = vec![0.0; played.layout(Floats::Simple115v2).len()];
    let mut map = vec![0; smm_size(SMM_WIDTH, SMM_HEIGHT)];
    let mut later = create()?;
    let each = options.duration / ONCE_NAMES.len() as u32;
    let looks = played.n_agents() > 0;
    Ok([
        timed(each, || reset(&mut create()?))?,
        timed(each, || reset(&mut later))?,
        timed(each, || {
            kept.clone_from(&played);
            played.clone_from(&kept);
            black_box((&kept, &played));
            Ok(())
        })?,
        timed(each, || played.snapshot().map(|bytes| drop(black_box(bytes))).map_err(Error::Snapshot))?,
        timed(each, || kept.restore(black_box(&bytes)).map_err(Error::Snapshot))?,
        timed(if looks { each } else { Duration::ZERO }, || {
            // The buffer has the size that the observation asks for.
            let _ = black_box(&mut played).observe(Floats::Simple115v2, 0, &mut floats);
            black_box(&floats);
            Ok(())
        })?,
        timed(if looks { each } else { Duration::ZERO }, || {
            let _ = smm(black_box(played.state()), 0, SMM_WIDTH, SMM_HEIGHT, &mut map);
            black_box(&map);
            Ok(())
        })?,
    ])
}

/// Does something for a while; the microseconds that it takes, 0 for no while.
fn timed(duration: Duration, mut act: impl FnMut() -> Result<(), Error>) -> Result<f64, Error> {
    if duration.is_zero() {
        return Ok(0.0);
    }
    let mut least = f64::INFINITY;
    for _ in 0..RUNS {
        let (begun, mut times) = (Instant::now(), 0u32);
        // In tens, so that the clock is no part of it.
        while times == 0 || begun.elapsed() < duration / RUNS {
            for _ in 0..10 {
                act()?;
            }
            times += 10;
        }
        least = least.min(begun.elapsed().as_secs_f64() * 1e6 / f64::from(times));
    }
    Ok(least)
}
