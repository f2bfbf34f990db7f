//! Measures how fast a scenario is played on this machine: many matches in parallel, one episode
//! after another.

mod once;
mod scaling;

pub use once::{ONCE_NAMES, once};
pub use scaling::scaling;

use crate::Error;
use crate::agent::{ActingAgent, ChosenAgent};
use crate::pixels::PixelEye;
use cpu_time::ProcessTime;
use setpiece_engine::batch::{Batch, EpisodeError, Policy};
use setpiece_engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece_engine::laps::{Laps, Phase};
use setpiece_engine::observe::{Floats, SMM_HEIGHT, SMM_WIDTH, smm, smm_size};
use setpiece_render::Pixels;
use setpiece_scenario::Scenario;
use setpiece_scenario::vocabulary::Action;
use std::hint::black_box;
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// What to measure.
#[derive(Clone, Debug)]
pub struct BenchOptions {
    /// How many matches are stepped together.
    pub matches: usize,
    /// The number of threads.
    pub threads: usize,
    /// How long to measure.
    pub duration: Duration,
    /// The agent that plays every slot.
    pub agent: ChosenAgent,
    /// The observation that every agent gets after every step.
    pub observation: BenchObservation,
    /// Match k plays the episodes of the seed `seed + k`.
    pub seed: u64,
    /// Parameters, physics.
    pub environment: EnvironmentOptions,
}

/// The observation of an agent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BenchObservation {
    /// Nothing.
    None,
    /// GRF's 115 floats.
    Simple115v2,
    /// GRF's super mini map, 72 by 96 by 4 bytes.
    Smm,
    /// A picture, 72 by 96 by 3 bytes.
    Pixels,
    /// A picture in gray, 72 by 96 bytes.
    PixelsGray,
}

impl BenchObservation {
    /// The shape of a picture; none for other observations.
    fn pixels(self) -> Option<Pixels> {
        match self {
            BenchObservation::Pixels => Some(Pixels::SMALL),
            BenchObservation::PixelsGray => Some(Pixels::SMALL_GRAY),
            _ => None,
        }
    }
}

/// The result of a measurement.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Steps played by all matches; the time includes resets.
    pub steps: u64,
    /// Episodes started during that time.
    pub resets: u64,
    /// Wall time.
    pub wall: Duration,
    /// CPU time of the process.
    pub cpu: Duration,
}

impl Measured {
    /// Steps per second of wall time.
    pub fn per_second(&self) -> f64 {
        self.steps as f64 / self.wall.as_secs_f64()
    }

    /// Steps per second of CPU time.
    pub fn per_cpu_second(&self) -> f64 {
        self.steps as f64 / self.cpu.as_secs_f64()
    }
}

/// Plays many matches on threads for a while.
///
/// # Errors
/// [`Error`] if the environment or the threads can't be created, or if an episode fails.
pub fn measure(scenario: &Arc<Scenario>, options: &BenchOptions) -> Result<Measured, Error> {
    let threads = |why: setpiece_engine::batch::BatchError| Error::Threads(why.to_string());
    let mut batch = Batch::new(lanes(scenario, options)?, options.threads).map_err(threads)?;
    let mut play = |until: Duration, staggered: bool| -> Result<Measured, Error> {
        let counted = |batch: &Batch<BenchLane>| {
            let lanes = batch.lanes().iter();
            lanes.fold((0, 0), |(steps, resets), lane| (steps + lane.steps, resets + lane.resets))
        };
        let before = counted(&batch);
        let (wall, cpu) = (Instant::now(), ProcessTime::now());
        let mut round = 0;
        while wall.elapsed() < until {
            let least = if staggered { round % options.matches } else { 0 };
            batch.each(vec![(); options.matches], |number, lane, (), scratch| {
                if number >= least {
                    lane.advance(scratch);
                }
            });
            round += 1;
        }
        let (wall, cpu) = (wall.elapsed(), cpu.elapsed());
        let after = counted(&batch);
        match batch.lanes_mut().iter_mut().find_map(|lane| lane.failed.take()) {
            Some(error) => Err(Error::Episode(error)),
            None => {
                Ok(Measured { steps: after.0 - before.0, resets: after.1 - before.1, wall, cpu })
            }
        }
    };
    // Warm-up: everything has begun, every buffer has its size, every page is touched. Matches with
    // higher numbers are further along, so that the measurement doesn't cover the same minute of
    // all matches.
    play(options.duration, true)?;
    play(options.duration, false)
}

/// The microseconds of a step, by phase, on one thread.
///
/// # Errors
/// Like [`measure`].
pub fn phases(
    scenario: &Arc<Scenario>,
    options: &BenchOptions,
) -> Result<Vec<(Phase, f64)>, Error> {
    let mut lanes = lanes(scenario, options)?;
    let mut scratch = Scratch::default();
    let reading = reading_ns();
    let mut steps = 0;
    for (until, measured) in [(options.duration, false), (options.duration, true)] {
        if measured {
            steps = lanes.iter().map(|lane| lane.steps).sum();
            *scratch.laps() = Laps::with(now_ns);
        }
        let (begun, mut round) = (Instant::now(), 0);
        while begun.elapsed() < until {
            // Staggers the matches as in [`measure`], before the clock starts.
            let least = if measured { 0 } else { round % options.matches };
            for lane in lanes.iter_mut().skip(least) {
                lane.advance(&mut scratch);
            }
            round += 1;
        }
    }
    if let Some(error) = lanes.iter_mut().find_map(|lane| lane.failed.take()) {
        return Err(Error::Episode(error));
    }
    let steps = lanes.iter().map(|lane| lane.steps).sum::<u64>() - steps;
    let per_step = |(phase, _): (Phase, &str)| {
        let (ns, times) = scratch.laps().of(phase);
        (phase, (ns as f64 - times as f64 * reading).max(0.0) / 1e3 / steps.max(1) as f64)
    };
    Ok(Phase::NAMED.map(per_step).to_vec())
}

/// Nanoseconds since the first reading.
fn now_ns() -> u64 {
    static BEGUN: OnceLock<Instant> = OnceLock::new();
    BEGUN.get_or_init(Instant::now).elapsed().as_nanos() as u64
}

/// The cost of reading the clock, nanoseconds.
///
/// The quickest of several rounds: whatever interrupts a round isn't the clock's cost, and a cost
/// that is too high would take whole phases away.
fn reading_ns() -> f64 {
    const ROUNDS: u32 = 32;
    const READINGS: u32 = 512;
    let round = || {
        let begun = now_ns();
        for _ in 0..READINGS {
            black_box(now_ns());
        }
        now_ns() - begun
    };
    let quickest = (0..ROUNDS).map(|_| round()).min().unwrap_or(0);
    quickest as f64 / f64::from(READINGS)
}

/// A match, its player and its observation buffers.
struct BenchLane {
    environment: Environment,
    agent: ActingAgent,
    seed: u64,
    actions: Vec<Action>,
    observation: BenchObservation,
    floats: Vec<f32>,
    map: Vec<u8>,
    eye: Option<PixelEye>,
    steps: u64,
    resets: u64,
    failed: Option<Box<EpisodeError>>,
}

fn lanes(scenario: &Arc<Scenario>, options: &BenchOptions) -> Result<Vec<BenchLane>, Error> {
    let prototype = Environment::new(scenario.clone(), options.environment.clone())
        .map_err(Error::Environment)?;
    let agent = options.agent.fit(&prototype)?;
    let (floats, map) = match options.observation {
        BenchObservation::None => (0, 0),
        BenchObservation::Simple115v2 => (prototype.layout(Floats::Simple115v2).len(), 0),
        BenchObservation::Smm => (0, smm_size(SMM_WIDTH, SMM_HEIGHT)),
        BenchObservation::Pixels => (0, Pixels::SMALL.len()),
        BenchObservation::PixelsGray => (0, Pixels::SMALL_GRAY.len()),
    };
    let lane = |at: usize| BenchLane {
        environment: prototype.clone(),
        agent: agent.player(),
        seed: options.seed.wrapping_add(at as u64),
        actions: vec![Action::Idle; prototype.n_agents()],
        observation: options.observation,
        floats: vec![0.0; floats],
        map: vec![0; map],
        // The sides of small pictures can always be drawn.
        eye: options.observation.pixels().and_then(|pixels| PixelEye::new(pixels).ok()),
        steps: 0,
        resets: 0,
        failed: None,
    };
    Ok((0..options.matches).map(lane).collect())
}

impl BenchLane {
    /// Plays a step of the match, or starts the next episode if it has ended; no-op after a
    /// failure.
    fn advance(&mut self, scratch: &mut Scratch) {
        if self.failed.is_none()
            && let Err(error) = self.try_advance(scratch)
        {
            self.failed = Some(Box::new(error));
        }
    }

    fn try_advance(&mut self, scratch: &mut Scratch) -> Result<(), EpisodeError> {
        if !self.environment.is_running() {
            scratch.laps().start();
            let index =
                self.environment.has_begun().then(|| self.environment.index().wrapping_add(1));
            self.environment.reset(Some(self.seed), Some(index.unwrap_or(0)))?;
            self.agent.begin(&self.environment);
            self.resets += 1;
            scratch.laps().end(Phase::Draw);
        }
        for (agent, action) in self.actions.iter_mut().enumerate() {
            *action = self.agent.act(&self.environment, agent);
        }
        self.environment.step(&self.actions, scratch)?;
        self.steps += 1;
        for agent in 0..self.actions.len() {
            // Buffers have the sizes of their observations.
            let _ = match self.observation {
                BenchObservation::None => Ok(()),
                BenchObservation::Pixels | BenchObservation::PixelsGray => match &mut self.eye {
                    Some(eye) => eye.write(&self.environment, agent, &mut self.map),
                    None => Ok(()),
                },
                BenchObservation::Simple115v2 => {
                    self.environment.observe(Floats::Simple115v2, agent, &mut self.floats)
                }
                BenchObservation::Smm => {
                    smm(self.environment.state(), agent, SMM_WIDTH, SMM_HEIGHT, &mut self.map)
                }
            };
            black_box((&self.floats, &self.map));
        }
        scratch.laps().end(Phase::Observe);
        Ok(())
    }
}
