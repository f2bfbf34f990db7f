//! Domain randomisation: every level draws parameters from what they may be.

use super::{ChosenLevel, LevelSource, Numbering, SourcedScenario};
use setpiece_engine::draw::draw_params;
use setpiece_scenario::plan::Played;
use setpiece_scenario::{Bindings, Param};

/// Plays a scenario with parameters that every level draws.
#[derive(Clone, Debug)]
pub struct RandomizedLevels {
    played: Played,
    varied: Vec<usize>,
    numbering: Numbering,
}

impl RandomizedLevels {
    /// Levels of a scenario; `varied` are the places of the parameters that are drawn, among the
    /// scenario's. The others keep their values.
    pub fn new(played: Played, varied: Vec<usize>, seed: Option<u64>) -> RandomizedLevels {
        RandomizedLevels { played, varied, numbering: Numbering::of(seed) }
    }

    /// What is played.
    pub fn played(&self) -> &Played {
        &self.played
    }

    /// The scenario's parameters.
    pub fn params(&self) -> &[Param] {
        &self.played.scenario.params
    }

    /// The places of the parameters that are drawn.
    pub fn varied(&self) -> &[usize] {
        &self.varied
    }

    /// The values of a level.
    fn draw(&self, seed: u64, episode: u64) -> Bindings {
        let drawn = draw_params(self.params(), &self.played.bindings, seed, episode);
        let mut bindings = self.played.bindings.clone();
        for &at in &self.varied {
            if let (Some(value), Some(drawn)) = (bindings.0.get_mut(at), drawn.0.get(at)) {
                *value = *drawn;
            }
        }
        bindings
    }
}

impl LevelSource for RandomizedLevels {
    fn scenarios(&self) -> Vec<SourcedScenario> {
        let scenario = self.played.scenario.clone();
        vec![SourcedScenario { place: format!("`{}`", scenario.name), scenario }]
    }

    fn next(&mut self) -> Option<ChosenLevel> {
        let (seed, episode) = self.numbering.take();
        let bindings = self.draw(seed, episode);
        Some(ChosenLevel { scenario: 0, bindings, seed, episode, tag: 0 })
    }

    fn numbering(&self) -> Numbering {
        self.numbering
    }

    fn set_numbering(&mut self, numbering: Numbering) {
        self.numbering = numbering;
    }

    fn kind(&self) -> &'static str {
        "domain randomisation"
    }
}
