//! Names of files in a text, which an editor opens.

use super::Analysis;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A part of a text that leads to a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileLink {
    /// The bytes.
    pub range: Range<usize>,
    /// The file.
    pub path: PathBuf,
}

impl Analysis {
    /// The files that a text names in quotes: imports, scripts, tables.
    ///
    /// `path`: the text's own.
    pub fn links(&self, path: &Path) -> Vec<FileLink> {
        let mut links = Vec::new();
        let mut at = 0;
        for line in self.text.split_inclusive('\n') {
            for (open, close) in quotes(line) {
                let named = line.get(open + 1..close).unwrap_or_default();
                let before = line.get(..open).unwrap_or_default().trim_end();
                let is_file =
                    ["import", "script", "from"].iter().any(|word| before.ends_with(word));
                if is_file && let Some(target) = self.file_named(path, named) {
                    links.push(FileLink { range: at + open + 1..at + close, path: target });
                }
            }
            at += line.len();
        }
        links
    }

    /// One of the files that were read, by the name that the text gives it.
    pub(super) fn file_named(&self, path: &Path, named: &str) -> Option<PathBuf> {
        let wanted = match named.strip_prefix("std/") {
            Some(_) => PathBuf::from(named),
            None => crate::files::beside(path, Path::new(named)),
        };
        let known = self.sources.iter().map(|(_, source)| crate::files::path_of(&source.name));
        known.chain(self.inputs.iter().cloned()).find(|it| *it == wanted)
    }
}

/// The pairs of quotes of a line, by their bytes.
fn quotes(line: &str) -> Vec<(usize, usize)> {
    let marks: Vec<usize> = line.match_indices('"').map(|(at, _)| at).collect();
    marks.chunks_exact(2).filter_map(|pair| Some((*pair.first()?, *pair.get(1)?))).collect()
}
