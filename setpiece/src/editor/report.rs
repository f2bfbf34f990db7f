//! What is wrong: the compiler's reports by file.

use super::{Analysis, FilePlace, Workspace};
use crate::dsl::problem::{Code, Problem, Severity};
use crate::dsl::source::Sources;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A problem as an editor shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// Where it is.
    pub place: FilePlace,
    /// Its stable code.
    pub code: Code,
    /// How bad it is.
    pub severity: Severity,
    /// One clause.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
    /// Further places, and what is to be said about them.
    pub related: Vec<(FilePlace, String)>,
}

impl Report {
    /// Problems in words, by file and place. One without a place in a file is left out.
    pub(super) fn all(problems: &[Problem], sources: &Sources) -> Vec<Report> {
        let mut reports: Vec<Report> =
            problems.iter().filter_map(|problem| Report::of(problem, sources)).collect();
        reports.sort_by(|one, other| {
            let key = |it: &Report| (it.place.range.start, it.code);
            one.place.path.cmp(&other.place.path).then(key(one).cmp(&key(other)))
        });
        reports
    }

    fn of(problem: &Problem, sources: &Sources) -> Option<Report> {
        let words = problem.words();
        let related = words.labels.iter().skip(1);
        Some(Report {
            place: FilePlace::of(problem.place(), sources)?,
            code: problem.code(),
            severity: problem.severity(),
            message: words.message,
            help: words.help,
            related: related
                .filter_map(|label| Some((FilePlace::of(label.span, sources)?, label.text.clone())))
                .collect(),
        })
    }
}

impl Workspace {
    /// What is wrong with the open texts and with what they import, by file. Every open text has
    /// an entry, even if nothing is wrong.
    pub fn reports(&mut self) -> BTreeMap<PathBuf, Vec<Report>> {
        let open: Vec<PathBuf> = self.paths().map(Path::to_owned).collect();
        let mut found: BTreeMap<PathBuf, Vec<Report>> = BTreeMap::new();
        for path in &open {
            found.entry(path.clone()).or_default();
            for root in self.roots(path) {
                let Some(analysis) = self.analysis(&root) else { continue };
                for report in &analysis.reports {
                    let of_file = found.entry(report.place.path.clone()).or_default();
                    if !of_file.contains(report) {
                        of_file.push(report.clone());
                    }
                }
            }
        }
        found.retain(|path, _| !super::is_in_library(path));
        found
    }

    /// The texts whose compilation tells what is wrong with a text: itself, or those that use a
    /// script.
    pub(super) fn roots(&self, path: &Path) -> Vec<PathBuf> {
        if !is_script(path) {
            return vec![path.to_owned()];
        }
        let Some(name) = path.file_name().and_then(|name| name.to_str()) else {
            return Vec::new();
        };
        let folders = path.ancestors().skip(1).take(2);
        let on_disk = folders.filter_map(|folder| std::fs::read_dir(folder).ok()).flatten();
        let files = on_disk.filter_map(|entry| Some(entry.ok()?.path()));
        let known: BTreeSet<PathBuf> =
            files.chain(self.paths().map(Path::to_owned)).filter(|it| is_scenario(it)).collect();
        let uses = |it: &PathBuf| self.file_text(it).is_some_and(|text| text.contains(name));
        known.into_iter().filter(uses).collect()
    }

    /// The text of a file, open or not.
    pub fn file_text(&self, path: &Path) -> Option<Arc<str>> {
        let open = self.text(path).cloned();
        open.or_else(|| super::analysis::closed_text(path))
    }
}

impl Analysis {
    /// The reports of the text itself.
    pub(super) fn own_reports<'a>(&'a self, path: &'a Path) -> impl Iterator<Item = &'a Report> {
        self.reports.iter().filter(move |report| report.place.path == path)
    }
}

/// Whether a file is a script.
pub(super) fn is_script(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "rhai")
}

/// Whether a file has scenarios.
pub(super) fn is_scenario(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "pitch")
}
