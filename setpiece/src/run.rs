//! Runs episodes of a scenario with a ready-made agent, and summarises the results.

pub mod faults;

use crate::agent::ChosenAgent;
use crate::error::Error;
use crate::evaluate::refuse_endless;
use setpiece_engine::batch::{EpisodeError, EpisodeSummary, run_episodes};
use setpiece_engine::digest;
use setpiece_engine::environment::{Environment, EnvironmentOptions};
use setpiece_engine::statistics::{MatchMeans, MatchStatistics};
use setpiece_scenario::vocabulary::{Team, Verdict};
use setpiece_scenario::{Dimension, Record, Scenario};
use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

/// The outcome of an episode that failed.
const BROKEN: &str = "error";

/// What to run.
#[derive(Clone, Debug)]
pub struct RunOptions {
    /// The episodes' indices under the seed; each is the same whatever came before it.
    pub episodes: Range<u64>,
    /// The seed.
    pub seed: u64,
    /// The agent that plays every slot.
    pub agent: ChosenAgent,
    /// Threads; the results don't depend on them.
    pub threads: usize,
    /// Parameters, rewards, physics.
    pub environment: EnvironmentOptions,
}

/// The mean of a record over the episodes that have a number for it.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordMean {
    /// Its name.
    pub name: String,
    /// The mean, in SI units.
    pub mean: f64,
    /// Its unit.
    pub unit: Dimension,
}

/// The results of some episodes.
#[derive(Clone, Debug)]
pub struct Summary {
    /// The episodes, in order. The error of a failed one (a script, a draw) takes its place.
    pub episodes: Vec<Result<EpisodeSummary, EpisodeError>>,
    /// Outcomes with their verdicts and counts, most frequent first.
    pub outcomes: Vec<(String, Option<Verdict>, u32)>,
    /// Mean goals, left and right.
    pub score: [f64; 2],
    /// Mean return of an agent.
    pub mean_return: f64,
    /// The same of each side's agents, if both sides have some: left and right.
    pub by_side: Option<[SideMeans; 2]>,
    /// Mean length, steps.
    pub mean_length: f64,
    /// Share of successes.
    pub success_rate: f64,
    /// Mean return of an agent by term.
    pub terms: Vec<(String, f64)>,
    /// Steps per second of wall time.
    pub steps_per_second: f64,
    /// Mean of each numeric record over the episodes that have it; for one value per agent, their
    /// mean.
    pub records: Vec<RecordMean>,
    /// Values paid by rewards that weren't finite and were dropped, over all episodes.
    pub faults: u64,
    /// Digest of all episodes' final states, in order.
    pub digest: u64,
    /// The average figures of the matches.
    pub match_stats: MatchMeans,
}

/// What the agents of a side were paid.
#[derive(Clone, Debug, PartialEq)]
pub struct SideMeans {
    /// Mean return of an agent.
    pub mean_return: f64,
    /// Mean return of an agent by term, in the order of [`Summary::terms`].
    pub terms: Vec<f64>,
}

/// Plays the episodes. `progress` is called with the length of each finished episode, from any
/// thread.
///
/// # Errors
/// [`Error::Environment`] if the options don't fit the scenario, [`Error::Policy`] if the agent
/// doesn't, [`Error::Threads`] if threads can't be started.
pub fn run(
    scenario: &Arc<Scenario>,
    options: &RunOptions,
    progress: impl Fn(u32) + Sync,
) -> Result<Summary, Error> {
    refuse_endless(scenario)?;
    let environment = Environment::new(scenario.clone(), options.environment.clone())
        .map_err(Error::Environment)?;
    let agent = options.agent.fit(&environment)?;
    let begin = Instant::now();
    let players = || agent.player();
    let episodes = run_episodes(
        &environment,
        options.seed,
        options.episodes.clone(),
        options.threads.min(options.episodes.clone().count().max(1)),
        |_| None,
        players,
        |episode: &Result<EpisodeSummary, EpisodeError>| {
            progress(episode.as_ref().map_or(0, |episode| episode.length));
        },
    )
    .map_err(|why| Error::Threads(why.to_string()))?;
    Ok(summarise(episodes, &environment, begin.elapsed().as_secs_f64()))
}

/// Summarises episodes that an environment like this one has played.
pub(crate) fn summarise(
    episodes: Vec<Result<EpisodeSummary, EpisodeError>>,
    environment: &Environment,
    seconds: f64,
) -> Summary {
    let names = environment.term_names();
    let mut outcomes: Vec<(String, Option<Verdict>, u32)> = Vec::new();
    for episode in &episodes {
        let (label, verdict) =
            episode.as_ref().map_or((BROKEN, None), |episode| (&episode.outcome, episode.verdict));
        match outcomes.iter_mut().find(|(known, of, _)| known == label && *of == verdict) {
            Some((_, _, count)) => *count += 1,
            None => outcomes.push((label.to_owned(), verdict, 1)),
        }
    }
    outcomes.sort_by(|a, b| b.2.cmp(&a.2).then_with(|| a.0.cmp(&b.0)));
    let played: Vec<&EpisodeSummary> = episodes.iter().flatten().collect();
    let n = played.len().max(1) as f64;
    // An empty sum of floats is -0.
    let mean = |of: &dyn Fn(&EpisodeSummary) -> f64| {
        played.iter().map(|episode| of(episode)).sum::<f64>() / n + 0.0
    };
    let teams: Vec<Team> = environment.roster().agents.iter().map(|(team, _)| *team).collect();
    let of_side = |side: Option<Team>| -> Vec<usize> {
        let agents = 0..teams.len();
        agents.filter(|&agent| side.is_none_or(|side| teams.get(agent) == Some(&side))).collect()
    };
    let by_agent = |agents: &[usize], of: &dyn Fn(usize) -> f64| {
        agents.iter().map(|&agent| of(agent)).sum::<f64>() / agents.len().max(1) as f64
    };
    let steps: u64 = played.iter().map(|episode| u64::from(episode.length)).sum();
    let statistics: Vec<MatchStatistics> =
        played.iter().map(|episode| episode.statistics.clone()).collect();
    let term = |agents: &[usize], index: usize| {
        mean(&|episode| {
            by_agent(agents, &|agent| {
                episode.terms.get(agent).and_then(|of| of.get(index)).copied().unwrap_or_default()
            })
        })
    };
    let paid = |agents: &[usize]| {
        mean(&|episode| {
            by_agent(agents, &|agent| episode.returns.get(agent).copied().unwrap_or_default())
        })
    };
    let all = of_side(None);
    let sides = [of_side(Some(Team::Left)), of_side(Some(Team::Right))];
    let by_side = sides.iter().all(|side| !side.is_empty()).then(|| {
        sides.each_ref().map(|agents| SideMeans {
            mean_return: paid(agents),
            terms: (0..names.len()).map(|index| term(agents, index)).collect(),
        })
    });
    Summary {
        outcomes,
        score: [0, 1].map(|side| mean(&|episode| f64::from(episode.score[side]))),
        mean_return: paid(&all),
        by_side,
        mean_length: mean(&|episode| f64::from(episode.length)),
        success_rate: mean(&|episode| {
            f64::from(u8::from(episode.verdict == Some(Verdict::Success)))
        }),
        terms: names
            .iter()
            .enumerate()
            .map(|(index, name)| (name.clone(), term(&all, index)))
            .collect(),
        steps_per_second: if seconds > 0.0 { steps as f64 / seconds } else { 0.0 },
        records: record_means(&played, &environment.scenario().records),
        faults: played.iter().map(|episode| u64::from(episode.faults)).sum(),
        digest: digest::of_all(played.iter().map(|episode| episode.digest)),
        match_stats: MatchStatistics::mean(&statistics),
        episodes,
    }
}

fn record_means(played: &[&EpisodeSummary], records: &[Record]) -> Vec<RecordMean> {
    let mut means = Vec::new();
    for (which, record) in records.iter().enumerate() {
        let numbers: Vec<f64> =
            played.iter().filter_map(|episode| episode.records.get(which)?.1.number()).collect();
        if !numbers.is_empty() {
            let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
            means.push(RecordMean { name: record.name.clone(), mean, unit: record.unit });
        }
    }
    means
}

/// The error of the first failed episode, if any.
pub fn first_error(summary: &Summary) -> Option<Error> {
    summary
        .episodes
        .iter()
        .find_map(|episode| episode.as_ref().err())
        .map(|why| Error::Episode(Box::new(why.clone())))
}
