//! What an editor asks of a text: problems, what names mean, what may stand at a place.
//!
//! Questions and answers are plain data, without a protocol: [`Workspace`] has the open texts, and
//! each question is a file. `setpiece lsp` speaks for it over the Language Server Protocol.

mod actions;
mod alone;
mod analysis;
mod areas;
mod closing;
mod complete;
mod completion;
mod cursor;
mod declared;
mod defaults;
mod edits;
mod elsewhere;
mod fix_all;
mod fixes;
mod fold;
mod grf;
mod hierarchy;
mod hints;
mod hover;
mod keywords;
mod layout;
mod lenses;
mod links;
mod meant;
mod names;
mod near;
mod outline;
mod paid;
mod parents;
mod place;
mod preview;
mod probed;
mod problems;
mod refused;
mod removable;
mod report;
mod script;
mod select;
mod senses;
mod settings;
mod signature;
pub mod text;
mod tokens;
mod uses;
mod within;
mod words;

pub use actions::{Action, ActionKind};
pub use analysis::Analysis;
pub use completion::{Completion, CompletionKind};
pub use edits::Edit;
pub use fold::{FoldedKind, FoldedLines};
pub use hierarchy::{ItemNode, ItemUses};
pub use hints::InlayHint;
pub use hover::Hover;
pub use lenses::{Lens, LensKind};
pub use links::FileLink;
pub use names::{NamePlaces, RenameError};
pub use outline::{Symbol, SymbolKind};
pub use place::FilePlace;
pub use preview::{AskedOfStart, PlacedThing, Preview, StartPicture};
pub use probed::{StartFindings, StartNote};
pub use report::{TextReport, TextRewrite};
pub use signature::Signature;
pub use tokens::{Token, TokenKind};

use crate::files::{FileLoader, name_of};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The texts that are open in an editor, over the files on disk.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    texts: BTreeMap<PathBuf, Arc<str>>,
    /// Whether imports and scripts may be outside a text's folder.
    allow_outside: bool,
    /// The folders that an editor has open.
    folders: Vec<PathBuf>,
    /// What was found out about a text as it is now; dropped when a file that it reads changes.
    known: BTreeMap<PathBuf, Arc<Analysis>>,
}

impl Workspace {
    /// Nothing is open yet. `allow_outside`: whether imports and scripts may be outside a text's
    /// folder.
    pub fn new(allow_outside: bool) -> Workspace {
        Workspace { allow_outside, ..Workspace::default() }
    }

    /// What reads the files that a text imports: the open texts stand for theirs.
    fn loader(&self, path: &Path) -> FileLoader {
        let loader = if self.allow_outside {
            FileLoader::anywhere()
        } else {
            FileLoader::beside(&name_of(path))
        };
        loader.with_texts(self.texts.clone())
    }

    /// Opens a text, or takes its new content.
    pub fn set(&mut self, path: &Path, text: &str) {
        if self.text(path).is_some_and(|known| **known == *text) {
            return;
        }
        self.texts.insert(path.to_owned(), text.into());
        self.forget(path);
    }

    /// Closes a text: its file on disk counts again.
    pub fn close(&mut self, path: &Path) {
        self.texts.remove(path);
        self.forget(path);
    }

    /// Forgets what was read of files that are not open: they have changed on disk.
    pub fn refresh(&mut self) {
        self.known.clear();
    }

    /// Forgets what follows from a file.
    fn forget(&mut self, path: &Path) {
        self.known.retain(|known, analysis| known != path && !analysis.inputs.contains(path));
    }

    /// The paths of the open texts, in order.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.texts.keys().map(PathBuf::as_path)
    }

    /// An open text.
    pub fn text(&self, path: &Path) -> Option<&Arc<str>> {
        self.texts.get(path)
    }

    /// What is known of a text, open or not; none if there is no such file.
    pub fn analysis(&mut self, path: &Path) -> Option<Arc<Analysis>> {
        if let Some(known) = self.known.get(path) {
            return Some(known.clone());
        }
        let text = self.file_text(path)?;
        let analysis = Arc::new(Analysis::of(path, text, &self.loader(path)));
        self.known.insert(path.to_owned(), analysis.clone());
        Some(analysis)
    }
}
