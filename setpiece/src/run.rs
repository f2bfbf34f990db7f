//! Running: episodes of a scenario, played by a ready-made agent, and what came of them.

use crate::error::Error;
use setpiece_engine::control::agents::Agent;
use setpiece_engine::digest;
use setpiece_engine::environment::{Environment, EnvironmentOptions, Scratch, StepError};
use setpiece_engine::random::{Purpose, Stream};
use setpiece_engine::statistics::{MatchMeans, MatchStatistics};
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{Action, Verdict};
use setpiece_scenario::Scenario;
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Instant;

/// What to run.
#[derive(Clone, Debug)]
pub struct RunOptions {
    /// How many episodes.
    pub episodes: u32,
    /// The seed; episode k is the same whatever came before it.
    pub seed: u64,
    /// Who plays for every agent.
    pub agent: Agent,
    /// Threads; the results don't depend on them.
    pub threads: usize,
    /// Parameters, rewards, physics.
    pub environment: EnvironmentOptions,
}

/// One episode.
#[derive(Clone, Debug)]
pub struct Episode {
    /// How it ended: a label, `limit`, or `error`.
    pub outcome: Arc<str>,
    /// Whether that is a success or a failure.
    pub verdict: Option<Verdict>,
    /// Goals, left and right.
    pub score: [u16; 2],
    /// Steps.
    pub length: u32,
    /// The rewards' sum, averaged over agents.
    pub total: f64,
    /// By term, in the order of [`Summary::terms`].
    pub terms: Vec<f64>,
    /// What the match was like.
    pub statistics: MatchStatistics,
    /// Of the state at its end.
    pub digest: u64,
    /// Why it broke off, if it did.
    pub error: Option<Error>,
}

/// What came of some episodes.
#[derive(Clone, Debug)]
pub struct Summary {
    /// The episodes, in order.
    pub episodes: Vec<Episode>,
    /// Outcomes with their verdicts and counts, the most frequent first.
    pub outcomes: Vec<(Arc<str>, Option<Verdict>, u32)>,
    /// Mean goals, left and right.
    pub score: [f64; 2],
    /// Mean return.
    pub mean_return: f64,
    /// Mean length, steps.
    pub mean_length: f64,
    /// Share of successes.
    pub success_rate: f64,
    /// Mean return by term.
    pub terms: Vec<(String, f64)>,
    /// Steps per second of wall time.
    pub steps_per_second: f64,
    /// Of all episodes' final states, in order.
    pub digest: u64,
    /// What the matches were like, on average.
    pub match_stats: MatchMeans,
}

/// Plays the episodes. `progress` is called with the length of each that is done.
///
/// # Errors
/// [`Error::Environment`] where the options don't fit the scenario. What breaks one episode off (a script, a draw) is
/// kept in that [`Episode`].
pub fn run(scenario: &Arc<Scenario>, options: &RunOptions, progress: &(dyn Fn(u32) + Sync)) -> Result<Summary, Error> {
    run_from(scenario, options, 0, progress)
}

/// Plays the episodes from the index `first` on.
///
/// # Errors
/// As [`run`].
pub fn run_from(
    scenario: &Arc<Scenario>,
    options: &RunOptions,
    first: u64,
    progress: &(dyn Fn(u32) + Sync),
) -> Result<Summary, Error> {
    let environment = Environment::new(scenario.clone(), options.environment.clone()).map_err(Error::Environment)?;
    let names = environment.term_names().to_vec();
    let begin = Instant::now();
    let play = |(environment, scratch): &mut (Environment, Scratch), index: u32| {
        let episode = play_episode(environment, scratch, options, first + u64::from(index));
        progress(episode.length);
        episode
    };
    let worker = || (environment.clone(), Scratch::default());
    let episodes: Vec<Episode> = match rayon::ThreadPoolBuilder::new().num_threads(options.threads).build() {
        Ok(pool) if options.threads > 1 => {
            pool.install(|| (0..options.episodes).into_par_iter().map_init(worker, play).collect())
        }
        // One thread needs no pool; where no threads are to be had, one must do.
        _ => {
            let mut own = worker();
            (0..options.episodes).map(|index| play(&mut own, index)).collect()
        }
    };
    Ok(summarise(episodes, names, begin.elapsed().as_secs_f64()))
}

/// Plays one episode to its end.
pub fn play_episode(environment: &mut Environment, scratch: &mut Scratch, options: &RunOptions, index: u64) -> Episode {
    let mut stream = Stream::new(options.seed, index, Purpose::Agent);
    let mut error = environment.reset(Some(options.seed), Some(index)).err().map(Error::Draw);
    let mut actions = [Action::Idle; PLAYERS_MAX];
    let n = environment.n_agents().min(PLAYERS_MAX);
    while environment.is_running() {
        for (slot, action) in actions[..n].iter_mut().enumerate() {
            *action = options.agent.act(environment.state(), slot, &mut stream);
        }
        match environment.step(&actions[..n], scratch) {
            Ok(_) => {}
            Err(StepError::Script(why)) => error = Some(Error::Script(why)),
            // Neither can happen: the loop asks whether it runs, and acts for every agent.
            Err(StepError::NotRunning { .. } | StepError::Actions { .. }) => break,
        }
    }
    let n_terms = environment.term_names().len();
    let mut terms = vec![0.0; n_terms];
    for agent in 0..n {
        for (sum, term) in terms.iter_mut().zip(environment.term_sums(agent)) {
            *sum += term / n as f64;
        }
    }
    let outcome = environment.outcome();
    Episode {
        outcome: outcome.map_or_else(|| "error".into(), |outcome| outcome.label.clone()),
        verdict: outcome.and_then(|outcome| outcome.verdict),
        score: environment.score(),
        length: environment.steps(),
        total: terms.iter().sum(),
        terms,
        statistics: environment.statistics().summary(),
        digest: environment.digest(),
        error,
    }
}

fn summarise(episodes: Vec<Episode>, names: Vec<String>, seconds: f64) -> Summary {
    let n = episodes.len().max(1) as f64;
    let mean = |of: &dyn Fn(&Episode) -> f64| episodes.iter().map(of).sum::<f64>() / n;
    let mut outcomes: Vec<(Arc<str>, Option<Verdict>, u32)> = Vec::new();
    for episode in &episodes {
        match outcomes.iter_mut().find(|(label, verdict, _)| *label == episode.outcome && *verdict == episode.verdict) {
            Some((_, _, count)) => *count += 1,
            None => outcomes.push((episode.outcome.clone(), episode.verdict, 1)),
        }
    }
    outcomes.sort_by(|a, b| b.2.cmp(&a.2).then_with(|| a.0.cmp(&b.0)));
    let steps: u64 = episodes.iter().map(|episode| u64::from(episode.length)).sum();
    let statistics: Vec<MatchStatistics> = episodes.iter().map(|episode| episode.statistics.clone()).collect();
    Summary {
        outcomes,
        score: [0, 1].map(|side| mean(&|episode| f64::from(episode.score[side]))),
        mean_return: mean(&|episode| episode.total),
        mean_length: mean(&|episode| f64::from(episode.length)),
        success_rate: mean(&|episode| f64::from(u8::from(episode.verdict == Some(Verdict::Success)))),
        terms: names
            .into_iter()
            .enumerate()
            .map(|(i, name)| (name, mean(&|episode| episode.terms.get(i).copied().unwrap_or_default())))
            .collect(),
        steps_per_second: if seconds > 0.0 { steps as f64 / seconds } else { 0.0 },
        digest: digest::of_all(episodes.iter().map(|episode| episode.digest)),
        match_stats: MatchStatistics::mean(&statistics),
        episodes,
    }
}
