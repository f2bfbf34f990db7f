//! Sources of levels: what plays next, where many episodes follow each other.
//!
//! A batch asks its source for the level of every environment that begins, and reports every level
//! that has ended. It does both in the order of its environments, so that results don't depend on
//! the number of threads. Choices come from streams whose keys are the source's seed and the number
//! of the level: a source's whole memory is plain data, which can be saved and restored.

mod curriculum;
mod listed;
mod planned;
mod prioritized;
mod randomized;

pub use curriculum::CurriculumRun;
pub use listed::{ListedLevel, ListedLevels};
pub use planned::PlannedLevels;
pub use prioritized::{LevelScore, PrioritizedLevels, ReplayOptions};
pub use randomized::RandomizedLevels;

use serde::{Deserialize, Serialize};
use serde_json::Value;
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

    /// The next level; `None` if there are no more.
    fn next(&mut self) -> Option<ChosenLevel>;

    /// Learns how a level has ended. `terms` are the names of the terms, in the order of the
    /// summary. Most sources choose the same levels whatever the results.
    fn report(&mut self, level: &ChosenLevel, episode: &EpisodeSummary, terms: &[String]) {
        let _ = (level, episode, terms);
    }

    /// What of a scenario it would measure in vain, in words: `terms` are those that are paid.
    fn unmeasured(&self, scenario: usize, terms: &[String]) -> Option<String> {
        let _ = (scenario, terms);
        None
    }

    /// How it numbers its levels.
    fn numbering(&self) -> Numbering;

    /// Numbers its next levels in another way.
    fn set_numbering(&mut self, numbering: Numbering);

    /// What kind of source it is, in a saved state.
    fn kind(&self) -> &'static str;

    /// What it remembers besides the numbering.
    fn memory(&self) -> Value {
        Value::Null
    }

    /// Takes back what [`Self::memory`] has returned.
    ///
    /// # Errors
    /// Why it can't, in words; then nothing has changed.
    fn remember(&mut self, memory: Value) -> Result<(), String> {
        if memory.is_null() { Ok(()) } else { Err("it remembers nothing else".to_owned()) }
    }

    /// Everything that it remembers, as JSON.
    fn save(&self) -> String {
        let (kind, scenarios) = (self.kind().to_owned(), names(&self.scenarios()));
        let (numbering, memory) = (self.numbering(), self.memory());
        // Numbers, texts and lists of them always have a form.
        let state = SavedSource { kind, scenarios, numbering, memory };
        serde_json::to_string(&state).unwrap_or_default()
    }

    /// Takes back what [`Self::save`] has returned.
    ///
    /// # Errors
    /// Why it can't, in words; then nothing has changed.
    fn restore(&mut self, state: &str) -> Result<(), String> {
        let state: SavedSource = serde_json::from_str(state).map_err(|why| why.to_string())?;
        if state.kind != self.kind() {
            return Err(format!("it is one of a {}, and this is a {}", state.kind, self.kind()));
        }
        let own = names(&self.scenarios());
        if state.scenarios != own {
            let listed = |names: &[String]| format!("`{}`", names.join("`, `"));
            return Err(format!(
                "it plays {}, and this {}",
                listed(&state.scenarios),
                listed(&own)
            ));
        }
        self.remember(state.memory)?;
        self.set_numbering(state.numbering);
        Ok(())
    }
}

/// A source's whole memory.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedSource {
    kind: String,
    /// The names of its scenarios.
    scenarios: Vec<String>,
    numbering: Numbering,
    memory: Value,
}

fn names(scenarios: &[SourcedScenario]) -> Vec<String> {
    scenarios.iter().map(|sourced| sourced.scenario.name.clone()).collect()
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
