//! Where the names of some files are declared and used, gathered in one pass over the files.

use super::names::{NamePlaces, sort};
use super::place::{FilePlace, is_scenario};
use super::{Analysis, Workspace};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A place by its file and bytes.
type PlaceKey = (PathBuf, usize, usize);

fn key(place: &FilePlace) -> PlaceKey {
    (place.path.clone(), place.range.start, place.range.end)
}

/// Where names are used.
#[derive(Debug, Default)]
pub(super) struct NameUses {
    /// By the declaration that is meant.
    of: BTreeMap<PlaceKey, Vec<FilePlace>>,
    /// The declarations that stand for a declaration, both ways.
    related: BTreeMap<PlaceKey, Vec<FilePlace>>,
}

impl NameUses {
    /// Where a declaration, and what stands for it, is declared and used.
    pub(super) fn places(&self, declaration: FilePlace) -> NamePlaces {
        let mut seen = BTreeSet::from([key(&declaration)]);
        let mut declarations = vec![declaration];
        let mut next = 0;
        while let Some(known) = declarations.get(next).map(key) {
            next += 1;
            for other in self.related.get(&known).into_iter().flatten() {
                if seen.insert(key(other)) {
                    declarations.push(other.clone());
                }
            }
        }
        let uses = declarations.iter().filter_map(|it| self.of.get(&key(it))).flatten();
        let mut uses: Vec<FilePlace> =
            uses.filter(|it| !seen.contains(&key(it))).cloned().collect();
        sort(&mut declarations);
        sort(&mut uses);
        NamePlaces { declarations, uses }
    }

    /// Adds what a text and the scripts that it names use.
    fn add(&mut self, path: &Path, analysis: &Analysis) {
        for (at, declared) in analysis.index.uses() {
            let place = match analysis.own(at) {
                Some(range) => Some(FilePlace { path: path.to_owned(), range }),
                None => analysis.place(at).filter(|place| !is_scenario(&place.path)),
            };
            if let (Some(place), Some(declared)) = (place, analysis.place(declared)) {
                self.of.entry(key(&declared)).or_default().push(place);
            }
        }
        for (one, other) in analysis.related() {
            self.related.entry(key(&one)).or_default().push(other.clone());
            self.related.entry(key(&other)).or_default().push(one);
        }
    }
}

impl Workspace {
    /// Where names are used: in the open texts, and the files near them, that have one of these
    /// words.
    pub(super) fn uses(&mut self, names: &BTreeSet<String>) -> NameUses {
        let has_name = |path: &PathBuf| {
            self.file_text(path).is_some_and(|text| {
                let is_word = |sign: char| sign.is_alphanumeric() || sign == '_';
                text.split(|sign: char| !is_word(sign)).any(|word| names.contains(word))
            })
        };
        let files: Vec<PathBuf> = self.files_near().into_iter().filter(has_name).collect();
        let mut uses = NameUses::default();
        for path in files {
            if let Some(analysis) = self.analysis(&path) {
                uses.add(&path, &analysis);
            }
        }
        uses
    }
}
