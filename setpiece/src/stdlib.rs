//! The standard library: the `.pitch` files of this repository, embedded.

use setpiece_dsl::source::Source;

/// Path below `stdlib-scenarios/` and text of every file, sorted by path.
const FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/stdlib.rs"));

/// A file by its path below the library: `rewards.pitch`.
pub(crate) fn file(path: &str) -> Option<Source> {
    FILES.iter().find(|(name, _)| *name == path).map(|&(name, text)| source(name, text))
}

/// The paths of every file.
pub(crate) fn paths() -> impl Iterator<Item = &'static str> {
    FILES.iter().map(|(name, _)| *name)
}

/// The file of a scenario's name: the one with that stem, in one of the folders.
pub(crate) fn scenario(name: &str) -> Option<Source> {
    scenarios().find(|(stem, _)| *stem == name).map(|(_, source)| source)
}

/// Stem and file of everything in the library's folders: runnable scenarios and abstract parents.
pub(crate) fn scenarios() -> impl Iterator<Item = (&'static str, Source)> {
    FILES.iter().filter_map(|&(path, text)| {
        let (_, file) = path.rsplit_once('/')?;
        Some((file.strip_suffix(".pitch")?, source(path, text)))
    })
}

fn source(path: &str, text: &str) -> Source {
    Source { name: format!("std/{path}"), text: text.into() }
}
