//! The scripts that the files name, loaded once.

use crate::problem::ScriptApi;
use crate::problem::facts::{Files, ScriptLimit};
use crate::resolve::{MAX_FILES, MAX_IMPORTED_BYTES};
use crate::source::{FileId, LoadError, Source, SourceLoader};
use setpiece_scenario::bounds::SCRIPT_MAX_BYTES;
use std::cell::Cell;

/// A script that the loader was asked for.
pub(crate) struct LoadedScript {
    /// From which file.
    pub(super) from: FileId,
    /// Under which path.
    pub(super) path: String,
    /// The text's file among the sources, or why there is none.
    pub(super) found: Result<FileId, LoadError>,
}

/// Every script that the files name; loaded before anything is lowered, as the sources can't grow
/// afterwards.
#[derive(Default)]
pub(crate) struct LoadedScripts<'a> {
    pub(super) loaded: Vec<LoadedScript>,
    /// Bytes of all of them.
    bytes: usize,
    /// Bytes that were checked, each script as often as it is used.
    checked: Cell<usize>,
    pub(super) api: Option<&'a dyn ScriptApi>,
}

impl<'a> LoadedScripts<'a> {
    /// With the API that scripts are checked against.
    pub(crate) fn new(api: Option<&'a dyn ScriptApi>) -> LoadedScripts<'a> {
        LoadedScripts { api, ..LoadedScripts::default() }
    }

    /// Why no more scripts may be loaded, if none may.
    pub(crate) fn limit(&self) -> Option<ScriptLimit> {
        if self.loaded.len() > MAX_FILES {
            return Some(ScriptLimit::Files(MAX_FILES));
        }
        let larger = self.bytes > MAX_IMPORTED_BYTES;
        larger.then_some(ScriptLimit::Bytes(MAX_IMPORTED_BYTES))
    }

    /// A file that was named, if the compilation came so far.
    pub(super) fn find(&self, from: FileId, path: &str) -> Option<&Result<FileId, LoadError>> {
        let mut loaded = self.loaded.iter();
        loaded.find(|known| known.from == from && known.path == path).map(|known| &known.found)
    }

    /// Takes a script to be checked; says why it can't be.
    pub(super) fn take(&self, text: &str) -> Result<(), Files> {
        if text.len() > SCRIPT_MAX_BYTES {
            return Err(Files::LongScript { most: SCRIPT_MAX_BYTES });
        }
        self.checked.set(self.checked.get() + text.len());
        if self.checked.get() > MAX_IMPORTED_BYTES {
            let limit = ScriptLimit::Bytes(MAX_IMPORTED_BYTES);
            return Err(Files::TooManyScripts { limit });
        }
        Ok(())
    }

    /// Loads a script that a file names, once; says which file it would be where there is none.
    pub(crate) fn load(
        &mut self,
        from: FileId,
        from_name: &str,
        path: &str,
        loader: &dyn SourceLoader,
        add: &mut dyn FnMut(Source) -> FileId,
    ) -> Option<String> {
        if self.loaded.iter().any(|script| script.from == from && script.path == path) {
            return None;
        }
        let found = loader.load(path, from_name);
        self.bytes += found.as_ref().map_or(0, |source| source.text.len());
        let found = found.map(add);
        let awaited = found.as_ref().err().and_then(|error| error.awaited.clone());
        self.loaded.push(LoadedScript { from, path: path.to_owned(), found });
        awaited
    }
}
