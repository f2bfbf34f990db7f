//! Places in files.

use crate::dsl::source::{Sources, Span};
use crate::files::path_of;
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
        is_in_library(&self.path)
    }
}

/// Whether a path is of a file of the library, which nobody edits.
pub(super) fn is_in_library(path: &Path) -> bool {
    path.starts_with("std")
}

/// The endings of files' names: scenarios, scripts, and tables.
pub(super) const SCENARIOS: &str = "pitch";
pub(super) const SCRIPTS: &str = "rhai";
pub(super) const TABLES: &str = "csv";

/// Whether a file is a script.
pub(super) fn is_script(path: &Path) -> bool {
    ends_in(path, SCRIPTS)
}

/// Whether a file has scenarios.
pub(super) fn is_scenario(path: &Path) -> bool {
    ends_in(path, SCENARIOS)
}

/// Whether a file's name has this ending.
pub(super) fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|own| own == ending)
}
