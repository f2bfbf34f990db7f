//! The library's files for editors: they open files on disk only.

use crate::files::FileLoader;
use std::path::{Path, PathBuf};

/// The folder of the library's files.
fn folder() -> PathBuf {
    std::env::temp_dir().join(concat!("setpiece-", env!("CARGO_PKG_VERSION"), "-library"))
}

/// The file on disk that has the text of a library's file; none for other files, or if it can't be
/// written.
pub(super) fn on_disk(path: &Path) -> Option<PathBuf> {
    if !path.starts_with("std") {
        return None;
    }
    let mut texts = FileLoader::library_texts();
    let (name, text) = texts.find(|(name, _)| Path::new(name) == path)?;
    let file = folder().join(name);
    if std::fs::read_to_string(&file).is_ok_and(|known| *known == *text) {
        return Some(file);
    }
    std::fs::create_dir_all(file.parent()?).ok()?;
    std::fs::write(&file, &*text).ok()?;
    Some(file)
}

/// The library's name of such a file; none for other files.
pub(super) fn name_of(path: &Path) -> Option<PathBuf> {
    path.strip_prefix(folder()).ok().map(Path::to_owned)
}
