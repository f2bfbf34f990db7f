//! The results of a suite: a row per entry, for one agent or two side by side.

mod table;

pub use table::SuiteTable;

use crate::agent::ChosenAgent;
use crate::baseline::baselines;
use crate::error::Error;
use crate::evaluate::{Results, environment_of, play};
use crate::measure::{Estimate, differences, measure};
use serde::Serialize;
use setpiece_engine::batch::EpisodeSummary;
use setpiece_engine::digest;
use setpiece_engine::environment::EnvironmentOptions;
use setpiece_scenario::Verdict;
use setpiece_scenario::plan::{Measure, PlannedEpisodes, Quantity};

/// An entry of a suite and how its agents did.
#[derive(Clone, Debug, Serialize)]
pub struct SuiteRow {
    /// The scenario and the parameters that differ from their defaults.
    pub entry: String,
    /// How many episodes each agent played.
    pub episodes: u64,
    /// The seed.
    pub seed: u64,
    /// One per agent.
    pub agents: Vec<SuiteAgent>,
    /// The second agent less the first, episode by episode; for two agents alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub difference: Option<Difference>,
}

/// How an agent did in an entry.
#[derive(Clone, Debug, Serialize)]
pub struct SuiteAgent {
    /// The agent's name.
    pub agent: String,
    /// The share of successes.
    pub success_rate: Estimate,
    /// The mean return of its slots.
    pub mean_return: Estimate,
    /// The mean of the left team's goals less the right one's.
    pub score: Estimate,
    /// The mean length, seconds.
    pub length: Estimate,
    /// The fingerprint of all episodes' final states.
    pub digest: String,
}

/// How much better the second of two agents did on the same episodes.
#[derive(Clone, Debug, Serialize)]
pub struct Difference {
    /// Of the shares of successes.
    pub success_rate: Estimate,
    /// Of the mean returns.
    pub mean_return: Estimate,
}

/// Plays an entry with each agent.
///
/// # Errors
/// Like [`play`].
pub fn row(
    entry: &PlannedEpisodes,
    environment: &EnvironmentOptions,
    agents: &[ChosenAgent],
    threads: usize,
    after: impl Fn() + Sync,
) -> Result<SuiteRow, Error> {
    let results = agents
        .iter()
        .map(|agent| play(entry, environment, agent, false, threads, &after))
        .collect::<Result<Vec<_>, _>>()?;
    let rows = agents.iter().zip(&results);
    let rows = rows.map(|(agent, results)| agent_row(agent.name(), results)).collect();
    let difference = match results.as_slice() {
        [first, second] => Some(Difference {
            success_rate: differences(&successes(second), &successes(first)),
            mean_return: differences(&returns(second), &returns(first)),
        }),
        _ => None,
    };
    Ok(SuiteRow { agents: rows, difference, ..blank(entry) })
}

/// Makes sure that agents can play every entry, before anything is played.
///
/// # Errors
/// [`Error::NoBaseline`] if the only entry has none, [`Error::NoBaselines`] with all entries that
/// have none, or what else [`play`] would report of an agent.
pub fn refuse_unplayable(
    entries: &[PlannedEpisodes],
    environment: &EnvironmentOptions,
    agents: &[ChosenAgent],
) -> Result<(), Error> {
    let mut without: Vec<String> = Vec::new();
    for entry in entries {
        let fitted = fit_all(entry, environment, agents);
        match fitted {
            Err(Error::NoBaseline { .. }) if entries.len() > 1 => {
                without.push(entry.played.label());
            }
            fitted => fitted?,
        }
    }
    if without.is_empty() {
        return Ok(());
    }
    let (of, known) = (entries.len(), baselines().map(str::to_owned).collect());
    Err(Error::NoBaselines { entries: without, of, known })
}

fn fit_all(
    entry: &PlannedEpisodes,
    environment: &EnvironmentOptions,
    agents: &[ChosenAgent],
) -> Result<(), Error> {
    let environment = environment_of(&entry.played, environment, entry.played.bindings.clone())?;
    agents.iter().try_for_each(|agent| agent.fit(&environment).map(|_| ()))
}

/// The row of an entry that one agent has played.
pub fn row_of(entry: &PlannedEpisodes, agent: &str, results: &Results) -> SuiteRow {
    SuiteRow { agents: vec![agent_row(agent, results)], ..blank(entry) }
}

fn blank(entry: &PlannedEpisodes) -> SuiteRow {
    let (label, episodes, seed) = (entry.played.label(), entry.count, entry.seed);
    SuiteRow { entry: label, episodes, seed, agents: Vec::new(), difference: None }
}

/// The row of an agent's results.
fn agent_row(agent: &str, results: &Results) -> SuiteAgent {
    let episodes: Vec<&EpisodeSummary> = results.episodes.iter().collect();
    let nothing = Estimate { value: 0.0, low: 0.0, high: 0.0, episodes: 0 };
    let of = |what: Measure| measure(&what, &episodes, &results.terms).unwrap_or(nothing);
    let digest = digest::of_all(episodes.iter().map(|episode| episode.digest));
    SuiteAgent {
        agent: agent.to_owned(),
        success_rate: of(Measure::SuccessRate),
        mean_return: of(Measure::Mean(Quantity::Return)),
        score: of(Measure::Mean(Quantity::Score)),
        length: of(Measure::Mean(Quantity::Length)),
        digest: format!("{digest:016x}"),
    }
}

fn successes(results: &Results) -> Vec<f64> {
    let success = |episode: &EpisodeSummary| episode.verdict == Some(Verdict::Success);
    results.episodes.iter().map(|episode| f64::from(u8::from(success(episode)))).collect()
}

fn returns(results: &Results) -> Vec<f64> {
    let number = |episode: &EpisodeSummary| {
        crate::measure::number(&Quantity::Return, episode, &results.terms).unwrap_or_default()
    };
    results.episodes.iter().map(number).collect()
}
