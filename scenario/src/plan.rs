//! What a file says about many episodes: suites, checks and curricula, as plain data.
//!
//! A [`Played`] scenario with a seed and an index is a *level*: it decides an episode's start and
//! chance.

use crate::{Bindings, Dimension, Scenario};
use std::sync::Arc;

/// An entry of a suite and a check play this many episodes at most.
pub const EPISODES_MAX: u64 = 1_000_000;

/// Everything that a file says about many episodes.
#[derive(Clone, Debug, Default)]
pub struct Plans {
    /// In source order.
    pub suites: Vec<Suite>,
    /// In source order.
    pub checks: Vec<Check>,
    /// In source order.
    pub curricula: Vec<Curriculum>,
}

impl Plans {
    /// Whether the file says nothing about many episodes.
    pub fn is_empty(&self) -> bool {
        self.suites.is_empty() && self.checks.is_empty() && self.curricula.is_empty()
    }
}

/// A scenario with the values of its parameters.
#[derive(Clone, Debug)]
pub struct Played {
    /// The scenario.
    pub scenario: Arc<Scenario>,
    /// The values of its parameters.
    pub bindings: Bindings,
}

impl Played {
    /// The scenario's name and the values that differ from its defaults:
    /// `academy_corner{difficulty=0.8}`.
    pub fn label(&self) -> String {
        let mut label = self.scenario.name.clone();
        let mut separator = '{';
        for (param, &value) in self.scenario.params.iter().zip(&self.bindings.0) {
            if value != param.default {
                label += &format!("{separator}{}={}", param.name, param.write(value));
                separator = ',';
            }
        }
        if separator == ',' {
            label.push('}');
        }
        label
    }
}

/// Frozen episodes, the same for everyone.
#[derive(Clone, Debug)]
pub struct Suite {
    /// Its name.
    pub name: String,
    /// The documentation above it.
    pub doc: String,
    /// Its entries, every `each` written out.
    pub entries: Vec<PlannedEpisodes>,
}

impl Suite {
    /// The first line of the documentation.
    pub fn title(&self) -> &str {
        self.doc.lines().next().unwrap_or_default()
    }

    /// How many episodes its entries have together.
    pub fn episodes(&self) -> u64 {
        self.entries.iter().map(|entry| entry.count).sum()
    }
}

/// Some episodes of a scenario.
#[derive(Clone, Debug)]
pub struct PlannedEpisodes {
    /// What is played.
    pub played: Played,
    /// How many.
    pub count: u64,
    /// The seed; the episodes are its first ones.
    pub seed: u64,
}

/// Something that a scenario's author expects of it.
#[derive(Clone, Debug)]
pub struct Check {
    /// What holds, in words.
    pub name: String,
    /// What is played.
    pub episodes: PlannedEpisodes,
    /// The name of the agent that plays every slot.
    pub agent: String,
    /// Whether every episode draws the parameters with a range or a list of values.
    pub over_params: bool,
    /// What is expected.
    pub expectations: Vec<Expectation>,
}

/// What a check expects.
#[derive(Clone, Debug)]
pub struct Expectation {
    /// As the author wrote it, on one line.
    pub text: String,
    /// The measure and its bound.
    pub goal: MeasureGoal,
}

/// A measure and its bound.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasureGoal {
    /// What is measured.
    pub measure: Measure,
    /// Over how many of the latest episodes; all of them if absent.
    pub last: Option<u32>,
    /// How the measure compares with the bound.
    pub comparison: Comparison,
    /// The bound, in SI units.
    pub bound: f64,
}

/// What is measured of some episodes.
#[derive(Clone, Debug, PartialEq)]
pub enum Measure {
    /// The share of episodes that ended with success.
    SuccessRate,
    /// The share of episodes with an outcome.
    Rate(String),
    /// The mean.
    Mean(Quantity),
    /// The least.
    Min(Quantity),
    /// The greatest.
    Max(Quantity),
    /// The value that this share of the episodes doesn't exceed.
    Quantile(Quantity, f64),
    /// The steps that were played; of curricula only.
    Steps,
    /// The episodes that were played; of curricula only.
    Episodes,
}

/// A number that every episode has.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// Its duration, seconds.
    Length,
    /// The mean return of its agents.
    Return,
    /// Goals of the left team less those of the right one.
    Score,
    /// A record's value, in SI units, and its unit.
    Record(String, Dimension),
    /// The mean return of its agents by a term.
    Term(String),
}

/// How two numbers compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// `<`
    Less,
    /// `<=`
    LessEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterEqual,
    /// `==`
    Equal,
    /// `!=`
    NotEqual,
}

impl Comparison {
    /// Reads a sign.
    pub fn from_sign(sign: &str) -> Option<Comparison> {
        Some(match sign {
            "<" => Comparison::Less,
            "<=" => Comparison::LessEqual,
            ">" => Comparison::Greater,
            ">=" => Comparison::GreaterEqual,
            "==" => Comparison::Equal,
            "!=" => Comparison::NotEqual,
            _ => return None,
        })
    }

    /// Whether it holds.
    pub fn holds(self, value: f64, bound: f64) -> bool {
        match self {
            Comparison::Less => value < bound,
            Comparison::LessEqual => value <= bound,
            Comparison::Greater => value > bound,
            Comparison::GreaterEqual => value >= bound,
            Comparison::Equal => value == bound,
            Comparison::NotEqual => value != bound,
        }
    }
}

/// Stages from easy to hard.
#[derive(Clone, Debug)]
pub struct Curriculum {
    /// Its name.
    pub name: String,
    /// The documentation above it.
    pub doc: String,
    /// The stages, in order.
    pub stages: Vec<CurriculumStage>,
    /// The share of episodes of the present stage, 0 to 1; the others are of earlier stages.
    pub current: f64,
}

/// A stage of a curriculum.
#[derive(Clone, Debug)]
pub struct CurriculumStage {
    /// Its name.
    pub name: String,
    /// What is played.
    pub played: Played,
    /// What ends it.
    pub how: StageHow,
}

/// What ends a stage, or how it adapts.
#[derive(Clone, Debug)]
pub enum StageHow {
    /// Nothing ends it.
    Forever,
    /// The first goal that is reached ends it.
    Until(Vec<MeasureGoal>),
    /// Parameters move so that a measure stays in a band.
    Adapt(Adapt),
}

/// Parameters that move so that a measure stays in a band.
#[derive(Clone, Debug)]
pub struct Adapt {
    /// The parameters' places among the scenario's.
    pub params: Vec<usize>,
    /// Where they begin, in SI units.
    pub from: f64,
    /// Where they lead, in SI units.
    pub to: f64,
    /// What is measured.
    pub measure: Measure,
    /// Over how many of the latest episodes.
    pub last: Option<u32>,
    /// Where the measure is kept.
    pub band: (f64, f64),
}
