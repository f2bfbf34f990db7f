//! Where names are declared and used, and how one is given another name.

use super::{Analysis, Workspace};
use crate::dsl::ast::Span;
use crate::dsl::problem::Severity;
use crate::dsl::source::FileId;
use crate::files::path_of;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A range of bytes of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilePlace {
    /// The file. One of the library has the path `std/…`.
    pub path: PathBuf,
    /// The bytes.
    pub range: Range<usize>,
}

impl FilePlace {
    /// Whether it lies in the library, which nobody edits.
    pub fn is_in_library(&self) -> bool {
        self.path.starts_with("std")
    }
}

/// A text put in the place of another one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced.
    pub place: FilePlace,
    /// What stands there then.
    pub text: String,
}

/// Why a name can't be changed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RenameError {
    /// No name stands there, or one of the language.
    #[error("no name stands here that a file declares")]
    NoName,
    /// The library declares it.
    #[error("the standard library declares this name")]
    OfLibrary,
    /// The new name is none.
    #[error("`{0}` is not a name: a name has letters, digits and underscores")]
    NotAName(String),
    /// The text would say something else.
    #[error("with the name `{0}` the text would say something else")]
    Captures(String),
}

impl Analysis {
    /// The declaration that the name at a byte refers to, or is.
    fn declared_at(&self, offset: usize) -> Option<Span> {
        let holds =
            |span: Span| self.own(span).is_some_and(|own| own.start <= offset && offset <= own.end);
        let uses = self.index.uses().filter(|(at, _)| holds(*at));
        let nearest = uses.min_by_key(|(at, _)| at.end - at.start);
        let declared = || self.index.uses().map(|(_, declared)| declared).find(|span| holds(*span));
        nearest.map(|(_, declared)| declared).or_else(declared)
    }

    /// A place in one of its files.
    fn place(&self, span: Span) -> Option<FilePlace> {
        let source = self.sources.get(span.file)?;
        Some(FilePlace {
            path: path_of(&source.name),
            range: span.start as usize..span.end as usize,
        })
    }

    /// Where a declaration of a file is used in this text. In a dotted name its last part counts.
    fn uses_of(&self, declaration: &FilePlace) -> Vec<Range<usize>> {
        let length = declaration.range.len();
        let is_meant = |span: Span| self.place(span).as_ref() == Some(declaration);
        let uses = self.index.uses().filter(|(_, declared)| is_meant(*declared));
        let mut places: Vec<Range<usize>> = uses
            .filter_map(|(at, _)| self.own(at))
            .map(|at| at.end.saturating_sub(length)..at.end)
            .collect();
        places.sort_by_key(|place| place.start);
        places.dedup();
        places
    }

    /// What every name of this text refers to, by its place.
    fn meanings(&self) -> BTreeMap<usize, (PathBuf, usize)> {
        let own = self.index.uses().filter(|(at, _)| at.file == FileId(0));
        own.filter_map(|(at, declared)| {
            let declared = self.place(declared)?;
            Some((at.end as usize, (declared.path, declared.range.start)))
        })
        .collect()
    }

    fn errors(&self) -> usize {
        let is_error = |severity| severity == Severity::Error;
        self.problems.iter().filter(|problem| is_error(problem.severity())).count()
    }
}

impl Workspace {
    /// Where the name at a byte of a text is declared.
    pub fn declaration(&mut self, path: &Path, offset: usize) -> Option<FilePlace> {
        let analysis = self.analysis(path)?;
        analysis.place(analysis.declared_at(offset)?)
    }

    /// Every place of the open texts, by path, where the name at a byte is used or declared.
    pub fn references(&mut self, path: &Path, offset: usize) -> Vec<FilePlace> {
        let Some(declaration) = self.declaration(path, offset) else { return Vec::new() };
        let paths: Vec<PathBuf> = self.paths().map(Path::to_owned).collect();
        let mut places = vec![declaration.clone()];
        for path in paths {
            let Some(analysis) = self.analysis(&path) else { continue };
            let used = analysis.uses_of(&declaration).into_iter();
            places.extend(used.map(|range| FilePlace { path: path.clone(), range }));
        }
        places.sort_by(|one, other| {
            (&one.path, one.range.start).cmp(&(&other.path, other.range.start))
        });
        places.dedup();
        places
    }

    /// What gives the name at a byte another name, everywhere in the open texts.
    ///
    /// # Errors
    /// [`RenameError`], also if another name would be meant somewhere afterwards.
    pub fn rename(
        &mut self,
        path: &Path,
        offset: usize,
        name: &str,
    ) -> Result<Vec<Edit>, RenameError> {
        let declaration = self.declaration(path, offset).ok_or(RenameError::NoName)?;
        if declaration.is_in_library() {
            return Err(RenameError::OfLibrary);
        }
        let mut letters = name.chars();
        let begins = letters.next().is_some_and(|first| first.is_alphabetic() || first == '_');
        if !begins || !letters.all(|letter| letter.is_alphanumeric() || letter == '_') {
            return Err(RenameError::NotAName(name.to_owned()));
        }
        let edits: Vec<Edit> = self
            .references(path, offset)
            .into_iter()
            .map(|place| Edit { place, text: name.to_owned() })
            .collect();
        if self.keeps_meaning(&edits) {
            Ok(edits)
        } else {
            Err(RenameError::Captures(name.to_owned()))
        }
    }

    /// Whether every name of the open texts refers to the same place after some edits, and nothing
    /// else is wrong.
    fn keeps_meaning(&mut self, edits: &[Edit]) -> bool {
        let mut after = Workspace::default();
        let paths: BTreeSet<PathBuf> = self.paths().map(Path::to_owned).collect();
        for path in &paths {
            let Some(text) = self.text(path) else { continue };
            after.set(path, &edited(text, path, edits));
        }
        let moved = |path: &Path, offset: usize| offset_after(path, offset, edits);
        paths.iter().all(|path| {
            let (Some(was), Some(is)) = (self.analysis(path), after.analysis(path)) else {
                return false;
            };
            let expected: BTreeMap<usize, (PathBuf, usize)> = was
                .meanings()
                .into_iter()
                .map(|(at, (file, declared))| {
                    let declared = moved(&file, declared);
                    (moved(path, at), (file, declared))
                })
                .collect();
            is.meanings() == expected && is.errors() <= was.errors()
        })
    }
}

/// A text with the edits of its file made.
fn edited(text: &str, path: &Path, edits: &[Edit]) -> String {
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
fn offset_after(path: &Path, offset: usize, edits: &[Edit]) -> usize {
    let before =
        edits.iter().filter(|edit| edit.place.path == path && edit.place.range.end <= offset);
    let moved: isize =
        before.map(|edit| edit.text.len() as isize - edit.place.range.len() as isize).sum();
    offset.saturating_add_signed(moved)
}
