//! What has been measured since a stage began, or since its value moved.

use crate::measure::{sample, statistic};
use serde::{Deserialize, Serialize};
use setpiece_engine::batch::EpisodeSummary;
use setpiece_scenario::plan::{Measure, Quantity, StageHow};
use std::collections::VecDeque;

/// A measure without `last: N` is of so many of the latest episodes.
const LAST: u32 = 100;
/// A full window is measured so often while it is replaced once: then a report costs the same
/// whatever the window's size.
const LOOKS: u64 = 50;

/// What has been measured of a phase.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StagePhase {
    /// How many episodes have ended.
    episodes: u64,
    /// Their steps.
    steps: u64,
    /// What each measure of the stage took of the latest episodes, the oldest first.
    windows: Vec<Window>,
}

/// What a measure took of the latest episodes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Window {
    /// How many episodes it has taken something of.
    taken: u64,
    samples: VecDeque<f64>,
}

/// What an episode means for its stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StageVerdict {
    /// Too few episodes have ended.
    Open,
    /// A goal is reached.
    Reached,
    /// The measure is above its band.
    TooEasy,
    /// The measure is below its band.
    TooHard,
    /// The measure is in its band.
    Kept,
}

impl StagePhase {
    /// A phase of a stage, before its first episode.
    pub(super) fn of(how: &StageHow) -> StagePhase {
        let windows = measures(how).map(|_| Window::default()).collect();
        StagePhase { episodes: 0, steps: 0, windows }
    }

    /// Whether it may be a phase of a stage.
    pub(super) fn fits(&self, how: &StageHow) -> bool {
        let whole = |(window, (measure, last)): (&Window, (&Measure, u32))| {
            window.samples.len() <= last as usize
                && window.samples.iter().all(|sample| can_be(measure, *sample))
        };
        self.windows.len() == measures(how).count()
            && self.windows.iter().zip(measures(how)).all(whole)
    }

    /// Takes an episode of the stage.
    pub(super) fn note(
        &mut self,
        how: &StageHow,
        episode: &EpisodeSummary,
        terms: &[String],
    ) -> StageVerdict {
        self.episodes = self.episodes.saturating_add(1);
        self.steps = self.steps.saturating_add(u64::from(episode.length));
        let (episodes, steps) = (self.episodes as f64, self.steps as f64);
        let taken = self.windows.iter_mut().zip(measures(how));
        let measured: Vec<Option<f64>> = taken
            .map(|(window, (measure, last))| match measure {
                Measure::Steps => Some(steps),
                Measure::Episodes => Some(episodes),
                _ => window.measure(measure, last, sample(measure, episode, terms)),
            })
            .collect();
        match how {
            StageHow::Forever => StageVerdict::Open,
            StageHow::Until(goals) => {
                let mut goals = goals.iter().zip(&measured);
                let reached = goals.any(|(goal, measured)| {
                    measured.is_some_and(|value| goal.comparison.holds(value, goal.bound))
                });
                if reached { StageVerdict::Reached } else { StageVerdict::Open }
            }
            StageHow::Adapt(adapt) => match measured.first().copied().flatten() {
                None => StageVerdict::Open,
                Some(value) if value > adapt.band.1 => StageVerdict::TooEasy,
                Some(value) if value < adapt.band.0 => StageVerdict::TooHard,
                Some(_) => StageVerdict::Kept,
            },
        }
    }
}

impl Window {
    /// Adds a sample; the measure, if the window is full and it is time to look.
    fn measure(&mut self, measure: &Measure, last: u32, sample: Option<f64>) -> Option<f64> {
        self.samples.push_back(sample?);
        self.taken = self.taken.saturating_add(1);
        if self.samples.len() > last as usize {
            self.samples.pop_front();
        }
        let every = u64::from(last).div_ceil(LOOKS);
        let is_time = self.taken.saturating_sub(u64::from(last)).is_multiple_of(every);
        if self.samples.len() < last as usize || !is_time {
            return None;
        }
        let mut sorted: Vec<f64> = self.samples.iter().copied().collect();
        sorted.sort_by(f64::total_cmp);
        Some(statistic(measure, &sorted))
    }
}

/// Whether a measure can have taken a sample of an episode.
fn can_be(measure: &Measure, sample: f64) -> bool {
    match measure {
        Measure::SuccessRate | Measure::Rate(_) => sample == 0.0 || sample == 1.0,
        _ => sample.is_finite(),
    }
}

/// The reward terms that a stage measures.
pub(super) fn measured_terms(how: &StageHow) -> impl Iterator<Item = &String> {
    measures(how).filter_map(|(measure, _)| match measure {
        Measure::Mean(Quantity::Term(name))
        | Measure::Min(Quantity::Term(name))
        | Measure::Max(Quantity::Term(name))
        | Measure::Quantile(Quantity::Term(name), _) => Some(name),
        _ => None,
    })
}

/// What a stage measures, and over how many episodes.
fn measures(how: &StageHow) -> impl Iterator<Item = (&Measure, u32)> {
    let (goals, adapt) = match how {
        StageHow::Forever => (&[][..], None),
        StageHow::Until(goals) => (&goals[..], None),
        StageHow::Adapt(adapt) => (&[][..], Some(adapt)),
    };
    let goals = goals.iter().map(|goal| (&goal.measure, goal.last));
    let adapt = adapt.into_iter().map(|adapt| (&adapt.measure, adapt.last));
    goals.chain(adapt).map(|(measure, last)| (measure, last.unwrap_or(LAST)))
}
