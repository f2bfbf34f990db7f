//! What an editor asks of a text: problems, what names mean, what may stand at a place.
//!
//! Questions and answers are plain data, without a protocol: [`Workspace`] has the open texts, and
//! each question is a file. `setpiece lsp` speaks for it over the Language Server Protocol.

mod actions;
mod analysis;
mod complete;
mod hover;
mod names;
mod symbols;
pub mod text;
mod words;

pub use actions::Fix;
pub use analysis::Analysis;
pub use complete::{Completion, CompletionKind};
pub use hover::Hover;
pub use names::{Edit, FilePlace, RenameError};
pub use symbols::{Symbol, SymbolKind};

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The texts that are open in an editor, over the files on disk.
#[derive(Debug, Default)]
pub struct Workspace {
    texts: BTreeMap<PathBuf, Arc<str>>,
    /// What was found out about a text as it is now; dropped when any open text changes.
    known: BTreeMap<PathBuf, Arc<Analysis>>,
}

impl Workspace {
    /// Opens a text, or takes its new content.
    pub fn set(&mut self, path: &Path, text: &str) {
        self.texts.insert(path.to_owned(), text.into());
        // A file that imports this one says something else now.
        self.known.clear();
    }

    /// Closes a text: its file on disk counts again.
    pub fn close(&mut self, path: &Path) {
        self.texts.remove(path);
        self.known.clear();
    }

    /// Forgets what was read of files that are not open: they have changed on disk.
    pub fn refresh(&mut self) {
        self.known.clear();
    }

    /// The paths of the open texts, in order.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.texts.keys().map(PathBuf::as_path)
    }

    /// An open text.
    pub fn text(&self, path: &Path) -> Option<&Arc<str>> {
        self.texts.get(path)
    }

    /// What is known of an open text; none if it isn't open.
    pub fn analysis(&mut self, path: &Path) -> Option<Arc<Analysis>> {
        if let Some(known) = self.known.get(path) {
            return Some(known.clone());
        }
        let text = self.texts.get(path)?.clone();
        let analysis = Arc::new(Analysis::of(path, text, &self.texts));
        self.known.insert(path.to_owned(), analysis.clone());
        Some(analysis)
    }
}
