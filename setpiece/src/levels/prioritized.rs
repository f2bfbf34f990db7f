//! Prioritized level replay: levels that still teach something are played again.
//!
//! Sources: M. Jiang et al., Prioritized Level Replay, 2021 (ranks, staleness); A. Rutherford
//! et al., No Regrets, 2024 (learnability); J. Parker-Holder et al., Evolving Curricula
//! with Regret-Based Environment Design, 2022 (edited levels).

use super::{ChosenLevel, LevelSource, Numbering, RandomizedLevels, SourcedScenario};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use setpiece_engine::batch::EpisodeSummary;
use setpiece_engine::draw::mutate_params;
use setpiece_engine::math::pow;
use setpiece_engine::random::{Purpose, Stream};
use setpiece_scenario::{Bindings, Verdict};

/// Levels are played again once this share of the places is taken.
const FULL_ENOUGH: f64 = 0.5;

/// How levels are kept and played again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReplayOptions {
    /// How many levels are kept, at least 1.
    pub capacity: usize,
    /// The share of levels that are played again, once enough are kept.
    pub replay: f64,
    /// The share of those that are chosen because they weren't played for long.
    pub staleness: f64,
    /// How flat the choice by rank is: the level of rank r has the weight (1/r)^(1/temperature).
    pub temperature: f64,
    /// The share of levels played again whose parameters are changed.
    pub edit: f64,
    /// How far parameters are changed, in parts of their ranges.
    pub scale: f64,
    /// Where scores come from.
    pub score: LevelScore,
}

/// Where the scores of levels come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelScore {
    /// The learner gives them.
    Given,
    /// The chance of success p gives p(1-p). After s successes of n episodes p is (s+1)/(n+2).
    Learnability,
}

/// Plays levels with drawn parameters, and those again that have a high score.
#[derive(Clone, Debug)]
pub struct PrioritizedLevels {
    fresh: RandomizedLevels,
    options: ReplayOptions,
    state: ReplayState,
    /// The sums of the ranks' weights.
    weights: Vec<f64>,
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReplayState {
    /// The tag of the newest kept level.
    tag: u64,
    /// By falling score.
    kept: Vec<KeptLevel>,
}

/// A level that may be played again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct KeptLevel {
    tag: u64,
    bindings: Bindings,
    seed: u64,
    episode: u64,
    score: f64,
    /// The number of the level when it was last chosen.
    chosen: u64,
    played: u32,
    successes: u32,
}

impl PrioritizedLevels {
    /// Keeps the best of the levels that `fresh` draws.
    pub fn new(fresh: RandomizedLevels, options: ReplayOptions) -> PrioritizedLevels {
        let mut sum = 0.0;
        let exponent = (1.0 / options.temperature) as f32;
        let weights = (1..=options.capacity.max(1)).map(|rank| {
            sum += f64::from(pow(1.0 / rank as f32, exponent));
            sum
        });
        let weights = weights.collect();
        PrioritizedLevels { fresh, options, state: ReplayState::default(), weights }
    }

    /// How many levels are kept.
    pub fn kept(&self) -> usize {
        self.state.kept.len()
    }

    /// Gives a level its score; the least of the kept ones makes way for it.
    pub fn score(&mut self, bindings: &Bindings, seed: u64, episode: u64, score: f64) {
        let is_it = |kept: &KeptLevel| {
            kept.seed == seed && kept.episode == episode && kept.bindings == *bindings
        };
        let place = self.state.kept.iter().position(is_it);
        let level = self.taken(place, bindings, seed, episode);
        self.keep(KeptLevel { score, ..level });
    }

    /// Takes a level from its place, or begins to know a new one.
    fn taken(
        &mut self,
        place: Option<usize>,
        bindings: &Bindings,
        seed: u64,
        episode: u64,
    ) -> KeptLevel {
        if let Some(at) = place {
            return self.state.kept.remove(at);
        }
        KeptLevel {
            tag: 0,
            bindings: bindings.clone(),
            seed,
            episode,
            score: 0.0,
            chosen: self.fresh.numbering().next,
            played: 0,
            successes: 0,
        }
    }

    fn keep(&mut self, mut level: KeptLevel) {
        let kept = &mut self.state.kept;
        if kept.len() >= self.weights.len() {
            if kept.last().is_some_and(|least| least.score >= level.score) {
                return;
            }
            kept.pop();
        }
        if level.tag == 0 {
            self.state.tag = self.state.tag.saturating_add(1);
            level.tag = self.state.tag;
        }
        let at = kept.partition_point(|other| other.score >= level.score);
        kept.insert(at, level);
    }

    /// The place of a kept level that is played again.
    fn choose(&self, stream: &mut Stream, now: u64) -> usize {
        let kept = &self.state.kept;
        let age = |level: &KeptLevel| now.saturating_sub(level.chosen) as f64;
        let at = if stream.unit_f64() < self.options.staleness {
            let mut left = stream.unit_f64() * kept.iter().map(age).sum::<f64>();
            let passed = |level: &KeptLevel| {
                left -= age(level);
                left < 0.0
            };
            kept.iter().position(passed)
        } else {
            let whole = self.weights.get(kept.len() - 1).copied().unwrap_or_default();
            let drawn = stream.unit_f64() * whole;
            Some(self.weights.partition_point(|sum| *sum <= drawn))
        };
        at.unwrap_or_default().min(kept.len() - 1)
    }
}

impl LevelSource for PrioritizedLevels {
    fn scenarios(&self) -> Vec<SourcedScenario> {
        self.fresh.scenarios()
    }

    fn next(&mut self) -> Option<ChosenLevel> {
        let fresh = self.fresh.next()?;
        let number = fresh.episode;
        let mut stream = Stream::new(fresh.seed, number, Purpose::Level);
        let enough = (FULL_ENOUGH * self.weights.len() as f64).max(1.0);
        let is_again = stream.unit_f64() < self.options.replay;
        if !is_again || (self.kept() as f64) < enough {
            return Some(fresh);
        }
        let at = self.choose(&mut stream, number);
        let Some(level) = self.state.kept.get_mut(at) else { return Some(fresh) };
        let KeptLevel { tag, bindings, seed, episode, .. } = level.clone();
        if stream.unit_f64() < self.options.edit {
            let (params, varied) = (self.fresh.params(), self.fresh.varied());
            let edited = mutate_params(params, &bindings, varied, self.options.scale, &mut stream);
            // An edit that changes nothing plays the level again.
            if edited != bindings {
                let bindings = edited;
                return Some(ChosenLevel { scenario: 0, bindings, seed, episode, tag: 0 });
            }
        }
        level.chosen = number;
        Some(ChosenLevel { scenario: 0, bindings, seed, episode, tag })
    }

    fn report(&mut self, level: &ChosenLevel, episode: &EpisodeSummary, _: &[String]) {
        if self.options.score != LevelScore::Learnability {
            return;
        }
        let place = self.state.kept.iter().position(|kept| kept.tag == level.tag);
        if level.tag != 0 && place.is_none() {
            return;
        }
        let mut kept = self.taken(place, &level.bindings, level.seed, level.episode);
        kept.played = kept.played.saturating_add(1);
        let success = u32::from(episode.verdict == Some(Verdict::Success));
        kept.successes = kept.successes.saturating_add(success);
        let chance = (f64::from(kept.successes) + 1.0) / (f64::from(kept.played) + 2.0);
        kept.score = chance * (1.0 - chance);
        self.keep(kept);
    }

    fn numbering(&self) -> Numbering {
        self.fresh.numbering()
    }

    fn set_numbering(&mut self, numbering: Numbering) {
        self.fresh.set_numbering(numbering);
    }

    fn kind(&self) -> &'static str {
        "prioritized level replay"
    }

    fn memory(&self) -> Value {
        serde_json::to_value(&self.state).unwrap_or_default()
    }

    fn remember(&mut self, memory: Value) -> Result<(), String> {
        let state: ReplayState = serde_json::from_value(memory).map_err(|why| why.to_string())?;
        let params = self.fresh.params();
        let allowed = |kept: &KeptLevel| {
            kept.bindings.0.len() == params.len()
                && params.iter().zip(&kept.bindings.0).all(|(it, value)| it.admit(*value).is_ok())
        };
        if let Some(at) = state.kept.iter().position(|kept| !allowed(kept)) {
            return Err(format!("level {at} has values that the scenario doesn't allow"));
        }
        if state.kept.len() > self.weights.len() {
            return Err(format!("{} levels are more than the capacity", state.kept.len()));
        }
        self.state = state;
        self.state.kept.sort_by(|a, b| b.score.total_cmp(&a.score));
        Ok(())
    }
}
