//! The policies in the box: what `--agent baseline` plays, by what the scenario is.
//!
//! A policy belongs to the library's scenario of its name. It plays a scenario with the same
//! players and the same start, whatever that one is called.

mod sameness;

use crate::agent::NetworkPolicy;
use crate::error::{BaselineFault, Error};
use crate::load::load;
use serde::Deserialize;
use setpiece_dsl::CompileOutcome;
use setpiece_dsl::problem::{DryRun, Problem};
use setpiece_dsl::source::Span;
use setpiece_scenario::Scenario;
use setpiece_scenario::plan::Check;
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// How the agent is called.
pub const BASELINE: &str = "baseline";

/// The name and bytes of every policy, sorted by name.
const POLICIES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/policies.rs"));

/// The name and text of every policy's card.
const CARDS: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/cards.rs"));

/// What the card of a policy says of it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct BaselineCard {
    /// How it was measured, with its mean score.
    pub score: CardScore,
    /// What it does and its weaknesses, drawn from its episodes.
    #[serde(default)]
    pub words: CardWords,
}

/// A measured score and its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub struct CardScore {
    /// How many episodes were played.
    pub episodes: u64,
    /// The mean.
    pub mean: f64,
    /// The lower end of the interval.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// The words of a card, in sentences.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
pub struct CardWords {
    /// What the policy does.
    #[serde(default)]
    pub does: String,
    /// How its episodes end otherwise.
    #[serde(default)]
    pub weaknesses: String,
}

impl BaselineFile {
    /// Its card; none if the box has none that can be read.
    pub fn card(&self) -> Option<BaselineCard> {
        let is_own = |name: &str| name.strip_suffix(".json") == Some(self.scenario);
        let (_, text) = CARDS.iter().find(|(name, _)| is_own(name))?;
        serde_json::from_str(text).ok()
    }
}

/// A policy in the box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BaselineFile {
    /// The library's scenario that it was trained on.
    pub scenario: &'static str,
    /// Its ONNX file.
    pub bytes: &'static [u8],
}

/// The policies, in the order of their scenarios' names.
fn files() -> impl Iterator<Item = BaselineFile> {
    let stem = |name: &'static str| name.strip_suffix(".onnx");
    POLICIES
        .iter()
        .filter_map(move |(name, bytes)| Some(BaselineFile { scenario: stem(name)?, bytes }))
}

/// The library's scenarios that have a policy, in order.
pub fn baselines() -> impl Iterator<Item = &'static str> {
    files().map(|file| file.scenario)
}

/// The policy of a scenario: that of the library's scenario with the same players and start; of
/// several, that of the same name.
///
/// # Errors
/// [`Error::NoBaseline`] if there is none.
pub fn baseline_file(scenario: &Scenario) -> Result<BaselineFile, Error> {
    let mut why = BaselineFault::Unlike;
    let is_named = |file: &BaselineFile| file.scenario == scenario.name;
    let others = files().filter(|file| !is_named(file));
    for file in files().filter(is_named).chain(others) {
        let Some(trained_on) = trained_on(file.scenario) else { continue };
        match sameness::difference(scenario, trained_on) {
            None => return Ok(file),
            Some(what) if is_named(&file) => why = BaselineFault::Differs { what },
            Some(_) => {}
        }
    }
    Err(Error::NoBaseline {
        scenario: scenario.name.clone(),
        why,
        known: baselines().map(str::to_owned).collect(),
    })
}

/// The checks of a text whose agent is the policy of a scenario that has none.
pub(crate) fn unplayable(outcome: &CompileOutcome) -> Vec<Problem> {
    let checks = outcome.plans.iter().flat_map(|plans| &plans.checks);
    let played = checks.zip(&outcome.check_agents).filter(|(check, _)| check.agent == BASELINE);
    let problem = |(check, place): (&Check, &Option<Span>)| {
        let Error::NoBaseline { scenario, why, known } =
            baseline_file(&check.episodes.played.scenario).err()?
        else {
            return None;
        };
        let differs = match why {
            BaselineFault::Differs { what } => Some(what),
            BaselineFault::Unlike => None,
        };
        Some(Problem::of_dry_run((*place)?, DryRun::NoBaseline { scenario, differs, known }))
    };
    played.filter_map(problem).collect()
}

/// The library's scenario of a policy.
fn trained_on(name: &str) -> Option<&'static Scenario> {
    static LIBRARY: OnceLock<Vec<(&'static str, Arc<Scenario>)>> = OnceLock::new();
    let library = LIBRARY.get_or_init(|| {
        baselines().filter_map(|name| Some((name, load(name).ok()?.scenario))).collect()
    });
    library.iter().find(|(known, _)| *known == name).map(|(_, scenario)| &**scenario)
}

/// The policy of a scenario, ready to play.
///
/// # Errors
/// [`Error::NoBaseline`] if it has none.
pub fn baseline(scenario: &Scenario) -> Result<Arc<NetworkPolicy>, Error> {
    let file = baseline_file(scenario)?;
    let path = format!("{BASELINE}/{}.onnx", file.scenario);
    Ok(Arc::new(NetworkPolicy::from_bytes(Path::new(&path), file.bytes)?))
}
