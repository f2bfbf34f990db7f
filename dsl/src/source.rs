//! Sources: files of text, and places in them.

use std::sync::Arc;

/// A file, by its place in [`Sources`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(pub u32);

/// A range of bytes of a file, on char boundaries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// Which file.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// Behind the last byte.
    pub end: u32,
}

impl Span {
    /// Whether another span lies in it.
    pub fn holds(self, inner: Span) -> bool {
        self.file == inner.file && self.start <= inner.start && inner.end <= self.end
    }

    /// The least span that holds both; they must be of one file.
    #[must_use]
    pub fn to(self, other: Span) -> Span {
        Span { file: self.file, start: self.start.min(other.start), end: self.end.max(other.end) }
    }
}

/// A file of text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// How it is called in reports: a path, `std/rewards.pitch`, or `<text>`.
    pub name: String,
    /// Its text.
    pub text: Arc<str>,
}

impl Source {
    /// Line and column of a byte, in characters and from 1.
    pub fn line_column(&self, offset: u32) -> (u32, u32) {
        let before = self.text.get(..offset as usize).unwrap_or(&self.text);
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let column = before
            .get(line_start..)
            .map_or(0, |line| line.chars().filter(|char| *char != '\u{FEFF}').count());
        (before.matches('\n').count() as u32 + 1, column as u32 + 1)
    }
}

/// Finds the sources that a file names; the compiler itself reads no file.
pub trait SourceLoader {
    /// Loads what `path` names, seen from the file called `from`: an `import` (relative, or
    /// `std/…`) or a script.
    ///
    /// # Errors
    /// A [`LoadError`] that the report shows.
    fn load(&self, path: &str, from: &str) -> Result<Source, LoadError>;

    /// Names of scenarios that every file may extend without an import, with the path each is
    /// loaded by.
    fn scenarios(&self) -> Vec<(String, String)> {
        Vec::new()
    }
}

/// Why a source can't be loaded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoadError {
    /// One clause: "no file `x.pitch`".
    pub message: String,
    /// Names that may have been meant.
    pub similar: Vec<String>,
    /// The name it would have, were it there: what a watcher waits for.
    pub awaited: Option<String>,
}

/// Every file of a compilation, in the order they were loaded.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: Vec<Source>,
}

impl Sources {
    /// Adds a file.
    pub fn add(&mut self, source: Source) -> FileId {
        self.files.push(source);
        FileId(self.files.len() as u32 - 1)
    }

    /// A file.
    pub fn get(&self, id: FileId) -> Option<&Source> {
        self.files.get(id.0 as usize)
    }

    /// The text of a span; empty if the span is of no file.
    pub fn text(&self, span: Span) -> &str {
        self.get(span.file)
            .and_then(|file| file.text.get(span.start as usize..span.end as usize))
            .unwrap_or_default()
    }

    /// Every file with its id.
    pub fn iter(&self) -> impl Iterator<Item = (FileId, &Source)> {
        self.files.iter().enumerate().map(|(i, file)| (FileId(i as u32), file))
    }
}
