//! Measures what is done once per episode or once per observation: creating, resetting, saving and
//! restoring a state, observing.

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

/// Runs per measurement. The fastest counts, because other work has disturbed it least.
const RUNS: u32 = 20;

/// What [`once`] measures, in order:
/// - `create`: an environment from a loaded scenario, and its first reset;
/// - `reset`: a later reset;
/// - `memory`: copying the state to another environment and back;
/// - `to_bytes`, `from_bytes`: taking and restoring a snapshot;
/// - `simple115v2`, `smm`: writing the first agent's observation, 115 floats or 72 by 96 by 4
///   bytes; 0 without agents.
pub const ONCE_NAMES: [&str; 7] =
    ["create", "reset", "memory", "to_bytes", "from_bytes", "simple115v2", "smm"];

/// Microseconds of each of [`ONCE_NAMES`]: the least of several runs' means, wall time on one
/// thread.
///
/// # Errors
/// Like [`super::measure`].
pub fn once(
    scenario: &Arc<Scenario>,
    options: &BenchOptions,
) -> Result<[f64; ONCE_NAMES.len()], Error> {
    let create = || {
        Environment::new(scenario.clone(), options.environment.clone()).map_err(Error::Environment)
    };
    let failed = |why: EpisodeError| Error::Episode(Box::new(why));
    let mut played = create()?;
    let mut seed = options.seed;
    let mut reset = |environment: &mut Environment| {
        seed = seed.wrapping_add(1);
        environment.reset(Some(seed), None).map_err(|why| failed(why.into()))
    };
    // In the middle of an episode, so that there is something to save.
    reset(&mut played)?;
    let (idle, mut scratch) = (vec![Action::Idle; played.n_agents()], Scratch::default());
    for _ in 0..20 {
        if !played.is_running() {
            reset(&mut played)?;
        }
        played.step(&idle, &mut scratch).map_err(|why| failed(why.into()))?;
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
        timed(each, || {
            played.snapshot().map(|bytes| drop(black_box(bytes))).map_err(Error::Snapshot)
        })?,
        timed(each, || kept.restore(black_box(&bytes)).map_err(Error::Snapshot))?,
        timed(if looks { each } else { Duration::ZERO }, || {
            // The buffer has the size of the observation.
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

/// Repeats an action for a while and returns its microseconds; 0 for a zero duration.
fn timed(duration: Duration, mut act: impl FnMut() -> Result<(), Error>) -> Result<f64, Error> {
    if duration.is_zero() {
        return Ok(0.0);
    }
    let mut least = f64::INFINITY;
    for _ in 0..RUNS {
        let (begun, mut times) = (Instant::now(), 0u32);
        // In tens, so that reading the clock doesn't count.
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
