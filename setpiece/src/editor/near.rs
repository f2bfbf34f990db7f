//! The files that belong to the open texts: those near them that may import them.

use super::Workspace;
use super::place::{SCENARIOS, ends_in, is_scenario};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// How deep the folders of an editor are searched, and how many files are looked at in them.
const DEPTH_MAX: usize = 8;
const FILES_MAX: usize = 5000;

impl Workspace {
    /// The same over the folders that an editor has open.
    #[must_use]
    pub fn with_folders(self, folders: Vec<PathBuf>) -> Workspace {
        Workspace { folders, ..self }
    }

    /// The open texts and the files near them: those of the editor's folders, and those beside a
    /// text, one folder above and one below.
    pub(super) fn files_near(&self) -> BTreeSet<PathBuf> {
        let mut files = BTreeSet::new();
        for folder in &self.folders {
            search(folder, DEPTH_MAX, SCENARIOS, &mut files);
        }
        let folders: BTreeSet<&Path> = self.paths().filter_map(Path::parent).collect();
        for folder in folders {
            search(folder, 1, SCENARIOS, &mut files);
            if let Some(above) = folder.parent() {
                search(above, 0, SCENARIOS, &mut files);
            }
        }
        files.extend(self.paths().filter(|path| is_scenario(path)).map(Path::to_owned));
        files
    }

    /// The files with this ending of a folder and of those in it, and the open texts there.
    pub(super) fn files_in(&self, folder: &Path, ending: &str) -> BTreeSet<PathBuf> {
        let mut files = BTreeSet::new();
        search(folder, DEPTH_MAX, ending, &mut files);
        let open = self.paths().filter(|it| it.starts_with(folder) && ends_in(it, ending));
        files.extend(open.map(Path::to_owned));
        files
    }

    /// The files near the open texts that read some of them, with the open texts and themselves.
    pub(super) fn files_that_read(&mut self, changed: BTreeSet<PathBuf>) -> BTreeSet<PathBuf> {
        let mut known = changed;
        let mut others: Vec<PathBuf> =
            self.files_near().into_iter().filter(|path| !known.contains(path)).collect();
        // A file names what it imports, so most needn't be compiled to know that they don't.
        loop {
            let stems: Vec<String> = known
                .iter()
                .filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()))
                .collect();
            let names_one = |path: &PathBuf| {
                self.file_text(path)
                    .is_some_and(|text| stems.iter().any(|stem| text.contains(stem.as_str())))
            };
            let (naming, rest): (Vec<PathBuf>, Vec<PathBuf>) =
                others.into_iter().partition(names_one);
            others = rest;
            if naming.is_empty() {
                break;
            }
            known.extend(naming);
        }
        known.extend(self.paths().map(Path::to_owned));
        known.retain(|path| is_scenario(path));
        known
    }
}

/// Adds the scenarios' files of a folder, and of the folders in it as deep as is asked.
fn search(folder: &Path, depth: usize, ending: &str, files: &mut BTreeSet<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    // In one order, so that the same files are left out where there are too many.
    let mut entries: Vec<_> = entries.flatten().collect();
    entries.sort_by_key(std::fs::DirEntry::path);
    for entry in entries {
        if files.len() >= FILES_MAX {
            return;
        }
        let path = entry.path();
        let is_hidden = entry.file_name().to_string_lossy().starts_with('.');
        match entry.file_type() {
            Ok(kind) if kind.is_dir() && depth > 0 && !is_hidden => {
                search(&path, depth - 1, ending, files);
            }
            Ok(kind) if kind.is_dir() => {}
            _ if ends_in(&path, ending) => drop(files.insert(path)),
            _ => {}
        }
    }
}
