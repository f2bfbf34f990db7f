//! Rows of recorded scenes in the common form: scene, keys, and figures that are means over jittered starts.

use super::keys::Plan;
use super::share_give;
use super::stage::Scene;
use super::trace::{Take, View, play};
use crate::figure::{Part, Section};
use crate::pitch::{Failure, mean};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Episodes of every row.
const EPISODES: u64 = 48;
/// Rows of theirs in which fewer episodes have a value say too little.
const FEWEST: u64 = 5;

/// What a figure measures, which says how far ours may be off beside what chance does to the two means.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    /// A share of the episodes.
    Share,
    /// A share of an episode's steps: ±0.05.
    Part,
    /// A count in an episode: ±0.25.
    Count,
    /// Steps: ±1.
    Steps,
    /// m/s: ±8 %.
    Speed,
    /// Degrees: ±3.
    Degrees,
    /// Metres of height: ±25 %, at least 0.3.
    Height,
    /// Metres: ±8 %, at least 0.5.
    Metres,
    /// A place in Google Research Football's coordinates: ±0.03.
    Place,
}

/// A figure's name and kind.
pub(super) type Column = (&'static str, Kind);

/// Related figures, which make one row of the report: what they say, and the columns.
pub(super) type Group = (&'static str, &'static [&'static str]);

/// A topic: its file and how its figures are read from an episode.
pub(super) struct Topic {
    /// What its rows are about.
    pub(super) name: &'static str,
    /// In `lab/data`.
    pub(super) file: &'static str,
    pub(super) columns: &'static [Column],
    /// Every column once, a few in each.
    pub(super) groups: &'static [Group],
    /// The figures of an episode in the order of the columns.
    pub(super) read: fn(&[View], &Row) -> Vec<Option<f64>>,
}

#[derive(serde::Deserialize)]
struct File {
    scenes: BTreeMap<String, Scene>,
    plans: BTreeMap<String, Vec<Plan>>,
    rows: Vec<Row>,
}

/// A row as recorded.
#[derive(serde::Deserialize)]
pub(super) struct Row {
    pub(super) scene: String,
    pub(super) plan: String,
    #[serde(default = "one")]
    left: f64,
    #[serde(default = "usual")]
    right: f64,
    steps: u32,
    #[serde(default)]
    stop: Vec<String>,
    /// What the figures count from, where a topic has several.
    #[serde(default)]
    pub(super) event: String,
    figures: BTreeMap<String, Measured>,
}

fn one() -> f64 {
    1.0
}

fn usual() -> f64 {
    0.6
}

/// A figure as recorded; without a mean where no episode has a value.
#[derive(serde::Deserialize)]
struct Measured {
    mean: Option<f64>,
    sd: Option<f64>,
    n: u64,
}

/// Measures every row of a topic.
pub(super) fn measure(section: &mut Section, topic: &Topic, count: Option<u64>) -> Result<(), Failure> {
    let named = |why: String| format!("lab/data/{}: {why}", topic.file);
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("data").join(topic.file);
    let text = std::fs::read_to_string(&path).map_err(|why| named(why.to_string()))?;
    let file: File = serde_json::from_str(&text).map_err(|why| named(why.to_string()))?;
    let episodes = count.unwrap_or(EPISODES);
    for row in &file.rows {
        let take = Take {
            scene: file.scenes.get(&row.scene).ok_or_else(|| named(format!("no scene `{}`", row.scene)))?,
            plans: file.plans.get(&row.plan).ok_or_else(|| named(format!("no plan `{}`", row.plan)))?,
            difficulty: [row.left, row.right],
            steps: row.steps,
            stop: &row.stop,
        };
        let mut values = vec![Vec::new(); topic.columns.len()];
        for episode in 0..episodes {
            let trace = play(&take, episode).map_err(|why| named(format!("{}, {}: {why}", row.scene, row.plan)))?;
            for (values, value) in values.iter_mut().zip((topic.read)(&trace, row)) {
                values.extend(value);
            }
        }
        let about = match [row.left, row.right] {
            [left, right] if left != one() => format!(", difficulties {left} and {right}"),
            [_, right] if right != usual() => format!(", difficulty {right}"),
            _ => String::new(),
        };
        let title = format!("{}: {}, {}{about}", topic.name, row.scene, row.plan);
        for (group, columns) in topic.groups {
            let mut names = Vec::new();
            let mut parts = Vec::new();
            for (&(name, kind), ours) in topic.columns.iter().zip(&values) {
                let theirs = row.figures.get(name).filter(|theirs| theirs.n >= FEWEST);
                let Some(theirs) = theirs.filter(|_| columns.contains(&name)) else { continue };
                if let Some(part) = part(kind, theirs, ours) {
                    names.push(name.replace('_', " "));
                    parts.push(part);
                }
            }
            if !parts.is_empty() {
                section.row(format!("{title}: {group} ({})", names.join(" · ")), parts);
            }
        }
    }
    Ok(())
}

/// A figure beside theirs.
fn part(kind: Kind, theirs: &Measured, ours: &[f64]) -> Option<Part> {
    let middle = theirs.mean?;
    let n = ours.len().max(1) as u64;
    let chance = 1.96 * theirs.sd.unwrap_or_default() * (1.0 / theirs.n as f64 + 1.0 / n as f64).sqrt();
    let give = match kind {
        Kind::Share => share_give(middle, theirs.n, n),
        Kind::Part => 0.05 + chance,
        Kind::Count => 0.25 + chance,
        Kind::Steps => 1.0 + chance,
        Kind::Speed => 0.08 * middle + chance,
        Kind::Degrees => 3.0 + chance,
        Kind::Height => (0.25 * middle).max(0.3) + chance,
        Kind::Metres => (0.08 * middle).max(0.5) + chance,
        Kind::Place => 0.03 + chance,
    };
    Some(Part::around(middle, give, mean(ours)))
}
