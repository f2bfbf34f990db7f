//! Sources of levels: what plays next, where many episodes follow each other.
//!
//! A batch asks its source for the level of every environment that begins, and reports every level
//! that has ended. It does both in the order of its environments, so that results don't depend on
//! the number of threads. Choices come from streams whose keys are the source's seed and the number
//! of the level: a source's whole memory is plain data, which can be saved and restored.

mod curriculum;
mod listed;
mod prioritized;
mod randomized;

pub use curriculum::CurriculumRun;
pub use listed::ListedLevels;
pub use prioritized::{LevelScore, PrioritizedLevels, ReplayOptions};
pub use randomized::RandomizedLevels;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use setpiece_engine::batch::EpisodeSummary;
use setpiece_scenario::{Bindings, Scenario};
use std::sync::Arc;

/// A level that a source has chosen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChosenLevel {
    /// The scenario's place among those of the source.
    pub scenario: usize,
    /// The values of its parameters.
    pub bindings: Bindings,
    /// The seed.
    pub seed: u64,
    /// The episode's index under the seed.
    pub episode: u64,
    /// What the source knows the level by, when its result comes.
    pub tag: u64,
}

/// A scenario that a source plays.
#[derive(Clone, Debug)]
pub struct SourcedScenario {
    /// Where the source plays it, in words: "stage `walk`".
    pub place: String,
    /// The scenario.
    pub scenario: Arc<Scenario>,
}

/// Whatever chooses levels.
pub trait LevelSource: Send {
    /// The scenarios of its levels.
    fn scenarios(&self) -> Vec<SourcedScenario>;

    /// The next level.
    fn next(&mut self) -> ChosenLevel;

    /// Learns how a level has ended. `terms` are the names of the terms, in the order of the
    /// summary.
    fn report(&mut self, level: &ChosenLevel, episode: &EpisodeSummary, terms: &[String]);

    /// How it numbers its levels.
    fn numbering(&mut self) -> &mut Numbering;

    /// Everything that it remembers, as JSON.
    fn save(&self) -> String;

    /// Takes back what [`Self::save`] has returned.
    ///
    /// # Errors
    /// Why it can't, in words; then nothing has changed.
    fn restore(&mut self, state: &str) -> Result<(), String>;
}

/// The seed of a source, and how many levels it has chosen under it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Numbering {
    /// The seed; 0 if nobody has given one.
    pub seed: Option<u64>,
    /// The number of the next level.
    pub next: u64,
}

impl Numbering {
    /// Counts from 0 under a seed.
    pub fn of(seed: Option<u64>) -> Numbering {
        Numbering { seed, next: 0 }
    }

    /// Seed and number of a new level.
    fn take(&mut self) -> (u64, u64) {
        let number = self.next;
        self.next = number.wrapping_add(1);
        (self.seed.unwrap_or_default(), number)
    }
}

/// A state as JSON.
fn write(state: &impl Serialize) -> String {
    // Numbers, texts and lists of them always have a form.
    serde_json::to_string(state).unwrap_or_default()
}

/// Reads a saved state.
fn read<T: DeserializeOwned>(state: &str) -> Result<T, String> {
    serde_json::from_str(state).map_err(|why| why.to_string())
}
