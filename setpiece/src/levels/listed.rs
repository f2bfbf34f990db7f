//! The levels of a list, one after the other.

use super::{ChosenLevel, LevelSource, Numbering, SourcedScenario, read, write};
use setpiece_engine::batch::EpisodeSummary;

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
}

impl LevelSource for ListedLevels {
    fn scenarios(&self) -> Vec<SourcedScenario> {
        self.scenarios.clone()
    }

    fn next(&mut self) -> ChosenLevel {
        let (_, number) = self.numbering.take();
        let at = number % self.levels.len() as u64;
        self.levels[at as usize].clone()
    }

    fn report(&mut self, _: &ChosenLevel, _: &EpisodeSummary, _: &[String]) {}

    fn numbering(&mut self) -> &mut Numbering {
        &mut self.numbering
    }

    fn save(&self) -> String {
        write(&self.numbering)
    }

    fn restore(&mut self, state: &str) -> Result<(), String> {
        self.numbering = read(state)?;
        Ok(())
    }
}
