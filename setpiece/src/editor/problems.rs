//! What is wrong with the open texts, by file.

use super::place::{is_in_library, is_scenario, is_script};
use super::{Analysis, TextReport, Workspace};
use crate::dsl::problem::Severity;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

impl Workspace {
    /// What is wrong with the open texts and with what they import, by file. Every open text has
    /// an entry, even if nothing is wrong.
    pub fn reports(&mut self) -> BTreeMap<PathBuf, Vec<TextReport>> {
        let open: Vec<PathBuf> = self.paths().map(Path::to_owned).collect();
        let mut found: BTreeMap<PathBuf, Vec<TextReport>> = BTreeMap::new();
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
        found.retain(|path, _| !is_in_library(path));
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
    pub(super) fn own_reports<'a>(
        &'a self,
        path: &'a Path,
    ) -> impl Iterator<Item = &'a TextReport> {
        self.reports.iter().filter(move |report| report.place.path == path)
    }

    /// Whether an error touches some bytes of the text.
    pub(super) fn errors_at(&self, path: &Path, within: &Range<usize>) -> bool {
        self.own_reports(path).any(|it| it.severity == Severity::Error && it.touches(within))
    }
}
