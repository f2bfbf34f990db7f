//! Changes of texts.

use super::Workspace;
use super::place::FilePlace;
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A text put in the place of another one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced.
    pub place: FilePlace,
    /// What stands there then.
    pub text: String,
}

impl Edit {
    /// Replaces some bytes of a file.
    pub(super) fn replace(path: &Path, range: Range<usize>, text: impl Into<String>) -> Edit {
        Edit { place: FilePlace { path: path.to_owned(), range }, text: text.into() }
    }
}

/// A text with the edits of its file made.
pub(super) fn edited(text: &str, path: &Path, edits: &[Edit]) -> String {
    let mut own: Vec<&Edit> = edits.iter().filter(|edit| edit.place.path == path).collect();
    own.sort_by_key(|edit| std::cmp::Reverse(edit.place.range.start));
    let mut edited = text.to_owned();
    for edit in own {
        if edited.get(edit.place.range.clone()).is_some() {
            edited.replace_range(edit.place.range.clone(), &edit.text);
        }
    }
    edited
}

/// Where a byte of a file lies after some edits: the start of one stays, its end moves.
pub(super) fn offset_after(path: &Path, offset: usize, edits: &[Edit]) -> usize {
    let before =
        edits.iter().filter(|edit| edit.place.path == path && edit.place.range.end <= offset);
    let moved: isize =
        before.map(|edit| edit.text.len() as isize - edit.place.range.len() as isize).sum();
    offset.saturating_add_signed(moved)
}

impl Workspace {
    /// The texts after some edits; those that were edited are open then.
    pub(super) fn after(&self, edits: &[Edit]) -> Workspace {
        let mut after = self.clone();
        let paths: BTreeSet<&PathBuf> = edits.iter().map(|edit| &edit.place.path).collect();
        for path in paths {
            let Some(text) = self.file_text(path) else { continue };
            after.set(path, &edited(&text, path, edits));
        }
        after
    }
}
