//! Rows of recorded scenes in the common form: scene, keys, and figures that are means over
//! jittered starts.

use super::keys::KeyPlan;
pub(super) use super::limits::FigureKind;
use super::limits::{FEWEST, RecordedFigure, part};
use super::stage::RecordedScene;
use super::trace::{Take, TraceMoment, play};
use crate::figure::{FigurePart, Section};
use crate::pitch::LabError;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::PathBuf;

/// Episodes of every row.
const EPISODES: u64 = 48;
/// A figure's name and kind.
pub(super) type FigureColumn = (&'static str, FigureKind);

/// Related figures that form one row of the report: their meaning, and the columns.
pub(super) type Group = (&'static str, &'static [&'static str]);

/// A topic: its file and how its figures are read from an episode.
pub(super) struct Topic {
    /// What its rows cover.
    pub(super) name: &'static str,
    /// In `lab/data`.
    pub(super) file: &'static str,
    pub(super) columns: &'static [FigureColumn],
    /// Every column once, in groups.
    pub(super) groups: &'static [Group],
    /// The figures of an episode in the order of the columns.
    pub(super) read: fn(&[TraceMoment], &RecordedRow) -> Vec<Option<f64>>,
}

/// A file as recorded.
#[derive(serde::Deserialize)]
pub(super) struct RecordedFile {
    scenes: BTreeMap<String, RecordedScene>,
    plans: BTreeMap<String, Vec<KeyPlan>>,
    pub(super) rows: Vec<RecordedRow>,
}

impl RecordedFile {
    /// The scene of a row.
    pub(super) fn scene(&self, row: &RecordedRow) -> Result<&RecordedScene, LabError> {
        self.scenes.get(&row.scene).ok_or_else(|| format!("no scene `{}`", row.scene))
    }

    /// An episode of a row in our game, step by step.
    pub(super) fn play(
        &self,
        row: &RecordedRow,
        episode: u64,
    ) -> Result<Vec<TraceMoment>, LabError> {
        let take = Take {
            scene: self.scene(row)?,
            plans: self.plans.get(&row.plan).ok_or_else(|| format!("no plan `{}`", row.plan))?,
            difficulty: [row.left, row.right],
            steps: row.steps,
            stop: &row.stop,
        };
        play(&take, episode).map_err(|why| format!("{}, {}: {why}", row.scene, row.plan))
    }
}

/// A row as recorded.
#[derive(serde::Deserialize)]
pub(super) struct RecordedRow {
    pub(super) scene: String,
    pub(super) plan: String,
    #[serde(default = "one")]
    left: f64,
    #[serde(default = "usual")]
    right: f64,
    steps: u32,
    #[serde(default)]
    stop: Vec<String>,
    /// The origin of the figures' count, if a topic has several.
    #[serde(default)]
    pub(super) event: String,
    /// One entry per column.
    pub(super) figures: BTreeMap<String, RecordedFigure>,
}

fn one() -> f64 {
    1.0
}

fn usual() -> f64 {
    0.6
}

/// The figures of a row by column: a value for each episode that has one.
pub(super) type Values = Vec<Vec<f64>>;

impl Topic {
    /// The topic's file as recorded.
    pub(super) fn recorded(&self) -> Result<RecordedFile, LabError> {
        let text = std::fs::read_to_string(self.path()).map_err(|why| self.named(why))?;
        serde_json::from_str(&text).map_err(|why| self.named(why))
    }

    /// The path of the topic's file.
    pub(super) fn path(&self) -> PathBuf {
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("data").join(self.file)
    }

    /// An error in the topic's file.
    pub(super) fn named(&self, why: impl Display) -> LabError {
        format!("lab/data/{}: {why}", self.file)
    }

    /// Adds the figures of an episode to those of its row.
    pub(super) fn add(&self, values: &mut Values, trace: &[TraceMoment], row: &RecordedRow) {
        values.resize(self.columns.len(), Vec::new());
        for (values, value) in values.iter_mut().zip((self.read)(trace, row)) {
            values.extend(value);
        }
    }

    /// The rows of the report for a recorded row: our figures and the recorded ones.
    pub(super) fn compare(
        &self,
        row: &RecordedRow,
        values: &Values,
    ) -> Vec<(String, Vec<FigurePart>)> {
        let about = match [row.left, row.right] {
            [left, right] if left != one() => format!(", difficulties {left} and {right}"),
            [_, right] if right != usual() => format!(", difficulty {right}"),
            _ => String::new(),
        };
        let title = format!("{}: {}, {}{about}", self.name, row.scene, row.plan);
        let mut rows = Vec::new();
        for (group, columns) in self.groups {
            let mut names = Vec::new();
            let mut parts = Vec::new();
            for (&(name, kind), ours) in self.columns.iter().zip(values) {
                let theirs = row.figures.get(name).filter(|theirs| theirs.n >= FEWEST);
                let Some(theirs) = theirs.filter(|_| columns.contains(&name)) else { continue };
                let name = name.replace('_', " ");
                if let Some(part) = part(&name, kind, theirs, ours) {
                    names.push(name);
                    parts.push(part);
                }
            }
            if !parts.is_empty() {
                rows.push((format!("{title}: {group} ({})", names.join(" · ")), parts));
            }
        }
        rows
    }
}

/// Measures every row of a topic.
pub(super) fn measure(
    section: &mut Section,
    topic: &Topic,
    count: Option<u64>,
) -> Result<(), LabError> {
    let file = topic.recorded()?;
    for row in &file.rows {
        let mut values = Values::new();
        for episode in 0..count.unwrap_or(EPISODES) {
            let trace = file.play(row, episode).map_err(|why| topic.named(why))?;
            topic.add(&mut values, &trace, row);
        }
        for (what, parts) in topic.compare(row, &values) {
            section.row(what, parts);
        }
    }
    Ok(())
}
