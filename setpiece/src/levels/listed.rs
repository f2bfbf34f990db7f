//! The levels of a list, one after the other.

use super::{ChosenLevel, LevelSource, Numbering, SourcedScenario};
use setpiece_scenario::plan::{PlannedEpisodes, Suite};

/// Plays a list of levels in its order, again and again.
#[derive(Clone, Debug)]
pub struct ListedLevels {
    scenarios: Vec<SourcedScenario>,
    levels: Vec<ChosenLevel>,
    numbering: Numbering,
}

impl ListedLevels {
    /// A list; `None` if it is empty, or names a scenario that isn't there.
    pub fn new(scenarios: Vec<SourcedScenario>, levels: Vec<ChosenLevel>) -> Option<ListedLevels> {
        let known = |level: &ChosenLevel| level.scenario < scenarios.len();
        let usable = !levels.is_empty() && levels.iter().all(known);
        usable.then(|| ListedLevels { scenarios, levels, numbering: Numbering::of(Some(0)) })
    }

    /// The episodes of all entries of a suite; `None` if it has none.
    pub fn of_suite(suite: &Suite) -> Option<ListedLevels> {
        let mut levels = Vec::new();
        for (scenario, entry) in suite.entries.iter().enumerate() {
            levels.extend((0..entry.count).map(|episode| ChosenLevel {
                scenario,
                bindings: entry.played.bindings.clone(),
                seed: entry.seed,
                episode,
                tag: 0,
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
        let (_, number) = self.numbering.take();
        let at = number % self.levels.len() as u64;
        Some(self.levels[at as usize].clone())
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
