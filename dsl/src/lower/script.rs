//! Rhai scripts: loaded, checked against the engine's hooks, embedded.

use super::World;
use crate::ast::{ScriptRef, ScriptSource, Span};
use crate::problem::{Code, Problem, ScriptApi};
use crate::source::{FileId, LoadError, Source, SourceLoader};
use setpiece_scenario::Script;
use std::cell::RefCell;

/// A script that the loader was asked for.
pub(crate) struct LoadedScript {
    /// From which file.
    from: FileId,
    /// Under which path.
    path: String,
    /// The text's file among the sources, or why there is none.
    found: Result<FileId, LoadError>,
}

/// Every script that the files name; loaded before anything is lowered, as the sources can't grow afterwards.
#[derive(Default)]
pub(crate) struct Scripts<'a> {
    loaded: Vec<LoadedScript>,
    api: Option<&'a dyn ScriptApi>,
    checked: RefCell<Vec<(FileId, &'static str)>>,
}

impl<'a> Scripts<'a> {
    /// With the API that scripts are checked against.
    pub(crate) fn new(api: Option<&'a dyn ScriptApi>) -> Scripts<'a> {
        Scripts { loaded: Vec::new(), api, checked: RefCell::default() }
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
        let found = loader.load(path, from_name).map(add);
        let awaited = found.as_ref().err().and_then(|error| error.awaited.clone());
        self.loaded.push(LoadedScript { from, path: path.to_owned(), found });
        awaited
    }
}

/// Embeds a script and gives its place in the scenario; `None` after a report.
pub(crate) fn embed(world: &World<'_>, script: &ScriptRef, hook: &'static str) -> Option<u32> {
    let (name, source, text_at) = match &script.source {
        ScriptSource::File(path) => {
            let loaded = world.scripts_loaded.loaded.iter();
            let found = loaded.into_iter().find(|known| known.from == path.span.file && known.path == path.node)?;
            match &found.found {
                Ok(file) => {
                    let source = world.library.sources.get(*file)?;
                    (path.node.clone(), source.clone(), (*file, 0))
                }
                Err(error) => {
                    let problem = Problem::new(Code::FileMissing, path.span, error.message.clone(), "named here");
                    world.report(match error.similar.first() {
                        Some(similar) => problem.help(format!("did you mean `{similar}`?")),
                        None => problem,
                    });
                    return None;
                }
            }
        }
        ScriptSource::Inline(text) => {
            let name =
                format!("inline in {}", world.library.sources.get(text.span.file).map_or("", |f| f.name.as_str()));
            let source = Source { name: name.clone(), text: text.node.as_str().into() };
            (name, source, (text.span.file, text.span.start))
        }
    };
    check(world, &source, text_at, hook);
    let mut scripts = world.scripts.borrow_mut();
    let embedded = Script { name, source: source.text.to_string() };
    let known = scripts.iter().position(|script| *script == embedded);
    let index = known.unwrap_or_else(|| {
        scripts.push(embedded);
        scripts.len() - 1
    });
    Some(index as u32)
}

fn check(world: &World<'_>, source: &Source, (file, offset): (FileId, u32), hook: &'static str) {
    let Some(api) = world.scripts_loaded.api else { return };
    let whole_file = offset == 0;
    let mut checked = world.scripts_loaded.checked.borrow_mut();
    if whole_file && checked.contains(&(file, hook)) {
        return;
    }
    checked.push((file, hook));
    for found in api.check(source, hook) {
        let span = Span {
            file,
            start: offset + found.range.start as u32,
            end: offset + found.range.end.max(found.range.start) as u32,
        };
        let problem = Problem::new(found.code, span, found.message, "");
        world.report(match found.help {
            Some(help) => problem.help(help),
            None => problem,
        });
    }
}
