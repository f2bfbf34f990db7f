//! The scripts that the files name, loaded once.

use crate::problem::facts::{Files, ScriptLimit};
use crate::problem::{Problem, ScriptApi};
use crate::resolve::{Library, MAX_FILES, MAX_IMPORTED_BYTES};
use crate::source::{FileId, LoadError, Source, SourceLoader, Sources, Span};
use setpiece_scenario::bounds::SCRIPT_MAX_BYTES;
use setpiece_scenario::{MODULES_MAX, module_name};
use std::cell::Cell;
use std::sync::Arc;

/// A script that the loader was asked for.
pub(crate) struct LoadedScript {
    /// From which file.
    pub(super) from: FileId,
    /// Under which path.
    pub(super) path: String,
    /// The text's file among the sources, or why there is none.
    pub(super) found: Result<FileId, LoadError>,
}

/// A module that a script or another module imports.
struct LoadedModule {
    /// The file of the text that imports it.
    from: FileId,
    /// Its path from that file's folder.
    path: String,
    file: FileId,
}

/// A text with imports: its file, where it begins in it, and the text.
pub(crate) struct ImportingText {
    pub(crate) file: FileId,
    pub(crate) start: u32,
    pub(crate) text: Arc<str>,
}

/// Every script that the files name; loaded before anything is lowered, as the sources can't grow
/// afterwards.
#[derive(Default)]
pub(crate) struct LoadedScripts<'a> {
    pub(super) loaded: Vec<LoadedScript>,
    modules: Vec<LoadedModule>,
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
        if self.loaded.len() + self.modules.len() > MAX_FILES {
            return Some(ScriptLimit::Files(MAX_FILES));
        }
        let larger = self.bytes > MAX_IMPORTED_BYTES;
        larger.then_some(ScriptLimit::Bytes(MAX_IMPORTED_BYTES))
    }

    /// A file that was named, if the compilation came so far.
    pub(crate) fn find(&self, from: FileId, path: &str) -> Option<&Result<FileId, LoadError>> {
        let mut loaded = self.loaded.iter();
        loaded.find(|known| known.from == from && known.path == path).map(|known| &known.found)
    }

    /// Takes a script of this many bytes and modules to be checked; says why it can't be.
    pub(super) fn take(&self, bytes: usize, n_modules: usize) -> Result<(), Files> {
        if n_modules > MODULES_MAX {
            let limit = ScriptLimit::Modules(MODULES_MAX);
            return Err(Files::TooManyScripts { limit });
        }
        if bytes > SCRIPT_MAX_BYTES {
            return Err(Files::LongScript { most: SCRIPT_MAX_BYTES, has_modules: n_modules > 0 });
        }
        self.checked.set(self.checked.get() + bytes);
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

    /// Loads the modules that a script imports, and those that they import.
    pub(crate) fn load_modules(
        &mut self,
        script: &ImportingText,
        library: &mut Library,
        loader: &dyn SourceLoader,
        problems: &mut Vec<Problem>,
    ) {
        let name = library.sources.get(script.file).map(|source| source.name.clone());
        self.follow(script, &mut name.into_iter().collect(), library, loader, problems);
    }

    /// Follows the imports of a text; `chain` are the names of the files that led to it.
    fn follow(
        &mut self,
        of: &ImportingText,
        chain: &mut Vec<String>,
        library: &mut Library,
        loader: &dyn SourceLoader,
        problems: &mut Vec<Problem>,
    ) {
        let Some(api) = self.api else { return };
        for (written, range) in api.imports(&of.text) {
            let at = |offset: usize| of.start + offset as u32;
            let span = Span { file: of.file, start: at(range.start), end: at(range.end) };
            let Some(path) = module_name("", &written) else {
                problems.push(Problem::new(span, Files::NotAModule { path: written }));
                continue;
            };
            if self.modules.iter().any(|known| known.from == of.file && known.path == path) {
                continue;
            }
            if chain.len() > MODULES_MAX {
                let limit = ScriptLimit::Modules(MODULES_MAX);
                problems.push(Problem::new(span, Files::TooManyScripts { limit }));
                return;
            }
            if let Some(limit) = self.limit() {
                problems.push(Problem::new(span, Files::TooManyScripts { limit }));
                return;
            }
            let from_name = chain.last().map_or("", String::as_str);
            let source = match loader.load(&path, from_name) {
                Ok(source) => source,
                Err(error) => {
                    library.inputs.extend(error.awaited.clone());
                    let (why, similar) = (error.message, error.similar.first().cloned());
                    let fact = Files::Missing { why, similar, is_import: true };
                    problems.push(Problem::new(span, fact));
                    continue;
                }
            };
            if chain.contains(&source.name) {
                problems.push(Problem::new(span, Files::ImportsItself { path: written }));
                continue;
            }
            let (name, text) = (source.name.clone(), source.text.clone());
            let known =
                self.modules.iter().map(|known| known.file).find(|file| {
                    library.sources.get(*file).is_some_and(|known| known.name == name)
                });
            let file = known.unwrap_or_else(|| {
                self.bytes += text.len();
                if !library.inputs.contains(&name) {
                    library.inputs.push(name.clone());
                }
                library.sources.add(source)
            });
            self.modules.push(LoadedModule { from: of.file, path, file });
            chain.push(name);
            let module = ImportingText { file, start: 0, text };
            self.follow(&module, chain, library, loader, problems);
            chain.pop();
        }
    }

    /// The modules of a script, under the names by which it has them, in the order of its imports.
    pub(super) fn modules(
        &self,
        file: FileId,
        text: &str,
        sources: &Sources,
    ) -> Vec<(String, FileId)> {
        let mut found: Vec<(String, FileId)> = Vec::new();
        let add = |importer: &str, from: FileId, text: &str, found: &mut Vec<(String, FileId)>| {
            for (path, _) in self.api.map(|api| api.imports(text)).unwrap_or_default() {
                let own = module_name("", &path);
                let known = |of: &&LoadedModule| of.from == from && Some(&of.path) == own.as_ref();
                if let (Some(module), Some(name)) =
                    (self.modules.iter().find(known), module_name(importer, &path))
                    && found.iter().all(|(other, _)| *other != name)
                {
                    found.push((name, module.file));
                }
            }
        };
        add("", file, text, &mut found);
        let mut next = 0;
        while let Some((name, file)) = found.get(next).cloned() {
            let text = sources.get(file).map(|source| source.text.clone()).unwrap_or_default();
            add(&name, file, &text, &mut found);
            next += 1;
        }
        found
    }
}
