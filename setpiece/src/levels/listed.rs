//! The levels of a list, one after the other.

use super::{ChosenLevel, LevelSource, Numbering, SourcedScenario};
use setpiece_scenario::Bindings;
use setpiece_scenario::plan::{PlannedEpisodes, Suite};

/// A level of a list.
#[derive(Clone, Debug)]
pub struct ListedLevel {
    /// The scenario's place among those of the list.
    pub scenario: usize,
    /// The values of its parameters.
    pub bindings: Bindings,
    /// Seed and index of its episode; without them another one every time, numbered under the seed
    /// of the source.
    pub episode: Option<(u64, u64)>,
}

/// Plays a list of levels in its order, again and again.
#[derive(Clone, Debug)]
pub struct ListedLevels {
    scenarios: Vec<SourcedScenario>,
    levels: Vec<ListedLevel>,
    numbering: Numbering,
}

impl ListedLevels {
    /// A list; `None` if it is empty, or names a scenario that isn't there.
    pub fn new(scenarios: Vec<SourcedScenario>, levels: Vec<ListedLevel>) -> Option<ListedLevels> {
        let known = |level: &ListedLevel| level.scenario < scenarios.len();
        let usable = !levels.is_empty() && levels.iter().all(known);
        // Who says every episode needs no seed.
        let seed = levels.iter().all(|level| level.episode.is_some()).then_some(0);
        usable.then(|| ListedLevels { scenarios, levels, numbering: Numbering::of(seed) })
    }

    /// The episodes of all entries of a suite; `None` if it has none.
    pub fn of_suite(suite: &Suite) -> Option<ListedLevels> {
        let mut levels = Vec::new();
        for (scenario, entry) in suite.entries.iter().enumerate() {
            levels.extend((0..entry.count).map(|episode| ListedLevel {
                scenario,
                bindings: entry.played.bindings.clone(),
                episode: Some((entry.seed, episode)),
            }));
        }
        let sourced = |entry: &PlannedEpisodes| SourcedScenario {
            place: format!("entry `{}` of `{}`", entry.played.label(), suite.name),
            scenario: entry.played.scenario.clone(),
        };
        ListedLevels::new(suite.entries.iter().map(sourced).collect(), levels)
    }
}

impl LevelSource for ListedLevels {
    fn scenarios(&self) -> Vec<SourcedScenario> {
        self.scenarios.clone()
    }

    fn next(&mut self) -> Option<ChosenLevel> {
        let (seed, number) = self.numbering.take();
        let level = &self.levels[(number % self.levels.len() as u64) as usize];
        let (seed, episode) = level.episode.unwrap_or((seed, number));
        let bindings = level.bindings.clone();
        Some(ChosenLevel { scenario: level.scenario, bindings, seed, episode, tag: number })
    }

    fn numbering(&self) -> Numbering {
        self.numbering
    }

    fn set_numbering(&mut self, numbering: Numbering) {
        self.numbering = numbering;
    }

    fn kind(&self) -> &'static str {
        "list"
    }
}
