//! Where names are declared and used, and how one is given another name.

use super::edits::Edit;
use super::edits::offset_after;
use super::outline::{Symbol, SymbolKind, flat};
use super::place::{FilePlace, is_scenario, is_script};
use super::{Analysis, TextReport, Workspace};
use crate::dsl::ast::Span;
use crate::dsl::problem::{Severity, Stage};
use crate::dsl::source::FileId;
use crate::scenario::vocabulary::Role;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Why a name can't be changed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RenameError {
    /// No name stands there, or one of the language.
    #[error("no name stands here that a file declares")]
    NoName,
    /// The library declares it.
    #[error("the standard library declares this name")]
    OfLibrary,
    /// It replaces something of the library.
    #[error("`{item}` of the standard library also declares `{name}`")]
    ReplacesLibrary {
        /// The name.
        name: String,
        /// What of the library declares it.
        item: String,
    },
    /// The new name is none.
    #[error("`{0}` is not a name: a name has letters, digits and underscores")]
    NotAName(String),
    /// A text in which the name stands has a mistake that hides what its names mean.
    #[error("`{}` can't be read as a whole; mend it first", .0.display())]
    Unreadable(PathBuf),
    /// The text would say something else.
    #[error("with the name `{0}` the text would say something else")]
    Captures(String),
}

/// A name wherever it stands.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NamePlaces {
    /// Where it is declared. What a scenario declares again for something that it inherits has one
    /// name with it.
    pub declarations: Vec<FilePlace>,
    /// Where it is used.
    pub uses: Vec<FilePlace>,
}

impl NamePlaces {
    /// All places, by file.
    pub fn all(&self) -> Vec<FilePlace> {
        let mut places: Vec<FilePlace> =
            self.declarations.iter().chain(&self.uses).cloned().collect();
        sort(&mut places);
        places
    }
}

pub(super) fn sort(places: &mut Vec<FilePlace>) {
    places
        .sort_by(|one, other| (&one.path, one.range.start).cmp(&(&other.path, other.range.start)));
    places.dedup();
}

impl Analysis {
    /// The declaration that the name at a byte refers to, or is.
    fn declared_at(&self, offset: usize) -> Option<Span> {
        let holds =
            |span: Span| self.own(span).is_some_and(|own| own.start <= offset && offset <= own.end);
        let uses = self.index.uses().filter(|(at, _)| holds(*at));
        // Between two names the one that begins there is meant.
        let nearest = uses.min_by_key(|(at, _)| (at.end as usize == offset, at.end - at.start));
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
        nearest
            .map(|(_, declared)| declared)
            .or_else(|| self.index.declarations().find(|span| holds(*span)))
            .or_else(declared)
            .or_else(unused)
    }

    /// The declaration that the name at a byte of a script refers to.
    fn declared_from(&self, script: &Path, offset: usize) -> Option<FilePlace> {
        let is_here = |at: Span| {
            self.place(at).is_some_and(|place| {
                let own = place.range;
                place.path == script && own.start <= offset && offset <= own.end
            })
        };
        let (_, declared) = self.index.uses().find(|(at, _)| is_here(*at))?;
        self.place(declared)
    }

    /// The declarations that stand for each other.
    pub(super) fn related(&self) -> Vec<(FilePlace, FilePlace)> {
        let pairs = self.index.related();
        pairs.filter_map(|(one, other)| Some((self.place(one)?, self.place(other)?))).collect()
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

    /// The files and bytes of the declarations that stand for each other.
    fn relations(&self) -> BTreeSet<[(PathBuf, usize); 2]> {
        let key = |place: FilePlace| (place.path, place.range.start);
        self.related().into_iter().map(|(one, other)| [key(one), key(other)]).collect()
    }

    /// How many errors there are.
    pub(super) fn errors(&self) -> usize {
        let is_error = |report: &&TextReport| report.severity == Severity::Error;
        self.reports.iter().filter(is_error).count()
    }

    /// Whether the text has a mistake of syntax, so that a part of it isn't known.
    fn is_unreadable(&self, path: &Path) -> bool {
        let is_syntax = |it: &TextReport| it.code.stage() == Stage::Syntax;
        self.reports
            .iter()
            .any(|it| it.severity == Severity::Error && is_syntax(it) && it.place.path == path)
    }
}

impl Workspace {
    /// Where the name at a byte of a text is declared.
    pub fn declaration(&mut self, path: &Path, offset: usize) -> Option<FilePlace> {
        if is_script(path) {
            // What a script reads by name is declared by the texts that use it.
            let roots = self.roots(path);
            return roots.iter().find_map(|root| self.analysis(root)?.declared_from(path, offset));
        }
        let analysis = self.analysis(path)?;
        analysis.place(analysis.declared_at(offset)?)
    }

    /// Every place where the name at a byte is used or declared, by path: in the open texts and in
    /// the files near them.
    pub fn references(&mut self, path: &Path, offset: usize) -> Vec<FilePlace> {
        self.places_of(path, offset).all()
    }

    /// Where the name at a byte is declared and used: in the open texts and in the files near them.
    pub fn places_of(&mut self, path: &Path, offset: usize) -> NamePlaces {
        let Some(declaration) = self.declaration(path, offset) else {
            return NamePlaces::default();
        };
        let names = self.word(&declaration).into_iter().collect();
        self.uses(&names).places(declaration)
    }

    fn word(&self, place: &FilePlace) -> Option<String> {
        self.file_text(&place.path)?.get(place.range.clone()).map(str::to_owned)
    }

    /// What gives the name at a byte another name, in the open texts and the files near them.
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
        let places = self.places_of(path, offset);
        if let Some(replaced) = places.declarations.iter().find(|it| it.is_in_library()) {
            let item = self.item_around(replaced).unwrap_or_default();
            let name = self.word(replaced).unwrap_or_default();
            return Err(RenameError::ReplacesLibrary { name, item });
        }
        // The name of a scenario may begin with a digit.
        let is_of_scenario =
            self.node(path, offset).is_some_and(|node| node.kind == SymbolKind::Scenario);
        let is_letter = |letter: char| letter.is_alphanumeric() || letter == '_';
        let begins = |letter: char| is_letter(letter) && (is_of_scenario || !letter.is_numeric());
        let has_letter = name.chars().any(|letter| !letter.is_numeric());
        if !name.starts_with(begins) || !name.chars().all(is_letter) || !has_letter {
            return Err(RenameError::NotAName(name.to_owned()));
        }
        let edits: Vec<Edit> =
            places.all().into_iter().map(|place| Edit { place, text: name.to_owned() }).collect();
        for edit in &edits {
            let path = &edit.place.path;
            // A script is read with the scenarios that name it.
            if is_scenario(path)
                && self.analysis(path).is_some_and(|analysis| analysis.is_unreadable(path))
            {
                return Err(RenameError::Unreadable(path.clone()));
            }
        }
        if self.keeps_meaning(&edits) {
            Ok(edits)
        } else {
            Err(RenameError::Captures(name.to_owned()))
        }
    }

    /// The places of the name at a byte that may be typed at once: all of them, if they are of one
    /// text and the name can be changed.
    pub fn linked(&mut self, path: &Path, offset: usize) -> Vec<Range<usize>> {
        let Some(text) = self.file_text(path) else { return Vec::new() };
        let Some(word) = self.declaration(path, offset).and_then(|it| self.word(&it)) else {
            return Vec::new();
        };
        let mut fresh = format!("{word}_");
        while text.contains(&fresh) {
            fresh.push('_');
        }
        let edits = self.rename(path, offset, &fresh).unwrap_or_default();
        if edits.len() < 2 || edits.iter().any(|edit| edit.place.path != path) {
            return Vec::new();
        }
        edits.into_iter().map(|edit| edit.place.range).collect()
    }

    /// The name of the item in which a declaration stands.
    fn item_around(&self, place: &FilePlace) -> Option<String> {
        let items = self.items_of(&place.path);
        let around = items.into_iter().find(|it| it.whole.contains(&place.range.start))?;
        Some(around.name)
    }

    /// Whether every name of the texts in sight refers to the same place after some edits, and
    /// nothing else is wrong.
    fn keeps_meaning(&mut self, edits: &[Edit]) -> bool {
        let mut after = self.after(edits);
        let moved = |path: &Path, offset: usize| offset_after(path, offset, edits);
        let edited = edits.iter().map(|edit| edit.place.path.clone()).collect();
        self.files_that_read(edited).iter().all(|path| {
            let (Some(was), Some(is)) = (self.analysis(path), after.analysis(path)) else {
                return false;
            };
            let there = |(file, at): (PathBuf, usize)| {
                let at = moved(&file, at);
                (file, at)
            };
            let expected: BTreeMap<usize, (PathBuf, usize)> = was
                .meanings()
                .into_iter()
                .map(|(at, declared)| (moved(path, at), there(declared)))
                .collect();
            let related = was.relations().into_iter().map(|pair| pair.map(there)).collect();
            is.meanings() == expected && is.relations() == related && is.errors() <= was.errors()
        })
    }
}
