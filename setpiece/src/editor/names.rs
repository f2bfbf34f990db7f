//! Where names are declared and used, and how one is given another name.

use super::edits::offset_after;
use super::report::is_scenario;
use super::symbols::flat;
use super::{Analysis, Edit, Report, Symbol, SymbolKind, Workspace};
use crate::dsl::ast::Span;
use crate::dsl::problem::Severity;
use crate::dsl::source::{FileId, Sources};
use crate::files::path_of;
use crate::scenario::vocabulary::Role;
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
    /// The place of a span.
    pub(super) fn of(span: Span, sources: &Sources) -> Option<FilePlace> {
        let path = path_of(&sources.get(span.file)?.name);
        Some(FilePlace { path, range: span.start as usize..span.end as usize })
    }

    /// Whether it lies in the library, which nobody edits.
    pub fn is_in_library(&self) -> bool {
        super::is_in_library(&self.path)
    }
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
        let unused = || {
            // A player without a name stands under the role, a word of the language.
            let is_role =
                |it: &Symbol| it.kind == SymbolKind::Player && Role::from_name(&it.name).is_some();
            let named = flat(self.symbols())
                .into_iter()
                .filter(|it| it.kind != SymbolKind::Team && !is_role(it));
            let mut here = named.filter(|it| it.range.start <= offset && offset <= it.range.end);
            here.next().map(|it| Span {
                file: FileId(0),
                start: it.range.start as u32,
                end: it.range.end as u32,
            })
        };
        nearest.map(|(_, declared)| declared).or_else(declared).or_else(unused)
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

    /// How many errors there are.
    pub(super) fn errors(&self) -> usize {
        let is_error = |report: &&Report| report.severity == Severity::Error;
        self.reports.iter().filter(is_error).count()
    }
}

impl Workspace {
    /// Where the name at a byte of a text is declared.
    pub fn declaration(&mut self, path: &Path, offset: usize) -> Option<FilePlace> {
        let analysis = self.analysis(path)?;
        analysis.place(analysis.declared_at(offset)?)
    }

    /// Every place where the name at a byte is used or declared, by path: in the open texts and in
    /// the files beside them.
    pub fn references(&mut self, path: &Path, offset: usize) -> Vec<FilePlace> {
        let Some(declaration) = self.declaration(path, offset) else { return Vec::new() };
        let mut places = vec![declaration.clone()];
        for path in self.files_with(&declaration) {
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

    /// The open texts, and the files beside them, that have the word of a declaration.
    fn files_with(&self, declaration: &FilePlace) -> Vec<PathBuf> {
        let declaring = self.file_text(&declaration.path);
        let name = declaring.as_deref().and_then(|text| text.get(declaration.range.clone()));
        let Some(name) = name else { return Vec::new() };
        let mut files: BTreeSet<PathBuf> = self.paths().map(Path::to_owned).collect();
        let folders: BTreeSet<PathBuf> =
            files.iter().filter_map(|path| path.parent().map(Path::to_owned)).collect();
        let entries = folders.iter().filter_map(|folder| std::fs::read_dir(folder).ok()).flatten();
        files.extend(
            entries.filter_map(|entry| Some(entry.ok()?.path())).filter(|path| is_scenario(path)),
        );
        let has_name =
            |path: &PathBuf| self.file_text(path).is_some_and(|text| text.contains(name));
        files.into_iter().filter(has_name).collect()
    }

    /// What gives the name at a byte another name, in the open texts and the files beside them.
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
        let mut after = self.after(edits);
        let paths: Vec<PathBuf> = after.paths().map(Path::to_owned).collect();
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
