//! The episodes of a suite's entry, each once.

use super::{ChosenLevel, LevelSource, Numbering, SourcedScenario};
use crate::evaluate::Results;
use setpiece_engine::batch::EpisodeSummary;
use setpiece_scenario::plan::PlannedEpisodes;

/// Plays the episodes of an entry in their order, and keeps how they ended.
#[derive(Clone, Debug)]
pub struct PlannedLevels {
    plan: PlannedEpisodes,
    numbering: Numbering,
    /// By the index of the episode.
    ended: Vec<Option<EpisodeSummary>>,
    n_unfinished: usize,
    terms: Vec<String>,
}

impl PlannedLevels {
    /// The levels of an entry.
    pub fn new(plan: PlannedEpisodes) -> PlannedLevels {
        let ended = vec![None; usize::try_from(plan.count).unwrap_or_default()];
        PlannedLevels {
            numbering: Numbering::of(Some(plan.seed)),
            plan,
            n_unfinished: ended.len(),
            ended,
            terms: Vec::new(),
        }
    }

    /// The results in the order of the episodes; `None` until the last of them has ended.
    pub fn results(&self) -> Option<Results> {
        let episodes: Option<Vec<EpisodeSummary>> = self.ended.iter().cloned().collect();
        Some(Results { episodes: episodes?, terms: self.terms.clone() })
    }

    /// How many episodes have not ended yet.
    pub fn n_unfinished(&self) -> usize {
        self.n_unfinished
    }
}

impl LevelSource for PlannedLevels {
    fn scenarios(&self) -> Vec<SourcedScenario> {
        let scenario = self.plan.played.scenario.clone();
        vec![SourcedScenario { place: format!("`{}`", self.plan.played.label()), scenario }]
    }

    fn next(&mut self) -> Option<ChosenLevel> {
        if self.numbering.next >= self.plan.count {
            return None;
        }
        let (seed, episode) = self.numbering.take();
        let bindings = self.plan.played.bindings.clone();
        Some(ChosenLevel { scenario: 0, bindings, seed, episode, tag: episode })
    }

    fn report(&mut self, level: &ChosenLevel, episode: &EpisodeSummary, terms: &[String]) {
        if self.terms.is_empty() {
            self.terms = terms.to_vec();
        }
        let place = usize::try_from(level.tag).ok().and_then(|at| self.ended.get_mut(at));
        if let Some(place) = place
            && place.replace(episode.clone()).is_none()
        {
            self.n_unfinished -= 1;
        }
    }

    fn numbering(&self) -> Numbering {
        self.numbering
    }

    fn set_numbering(&mut self, numbering: Numbering) {
        self.numbering = numbering;
    }

    fn kind(&self) -> &'static str {
        "suite"
    }
}
