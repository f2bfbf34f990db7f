//! What the compiler finds out about one text.

use super::outline::{Symbol, move_all, of_file};
use super::place::FilePlace;
use super::report::TextReport;
use super::text::{Lines, closed};
use crate::Loaded;
use crate::baseline::unplayable;
use crate::dsl::ast::{File, Span};
use crate::dsl::index::Index;
use crate::dsl::problem::Problem;
use crate::dsl::source::{FileId, Source, SourceLoader, Sources};
use crate::dsl::{CompileOptions, compile};
use crate::files::{FileLoader, name_of, path_of};
use crate::load::{compile_options, user_of_parts};
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What is known of a text, whole or broken.
#[derive(Debug)]
pub struct Analysis {
    /// Its text.
    pub text: Arc<str>,
    /// Where its lines begin.
    pub lines: Lines,
    /// Its syntax tree.
    pub tree: File,
    /// What it declares, also where brackets are still open.
    pub(super) outline: Vec<Symbol>,
    /// What is wrong with it and with what it imports, by file and place.
    pub reports: Vec<TextReport>,
    /// The files that were read; the text is the first.
    pub sources: Sources,
    /// What names refer to, and the types of expressions.
    pub index: Index,
    /// The last scenario of the text, if nothing is wrong with it.
    pub loaded: Option<Loaded>,
    /// The files that were read or looked for.
    pub(super) inputs: BTreeSet<PathBuf>,
}

impl Analysis {
    /// Compiles a text.
    pub(super) fn of(path: &Path, text: Arc<str>, loader: &FileLoader) -> Analysis {
        let source = Source { name: name_of(path), text: text.clone() };
        let mut outcome = compile(source.clone(), loader, &options(None));
        let tree = outcome.tree.take().unwrap_or_else(|| File {
            id: FileId(0),
            items: Vec::new(),
            lost: BTreeSet::new(),
        });
        let mut outline = of_file(&tree);
        // Behind a bracket that is still open nothing can be read: what names and values are is
        // found in the text as it will be.
        if let Some(closed) = closed(&text) {
            let mended = Source { name: source.name.clone(), text: closed.text.as_str().into() };
            let outcome_of_mended = compile(mended, loader, &options(None));
            outline = outcome_of_mended.tree.as_ref().map(of_file).unwrap_or_default();
            let bytes = |range: &Range<usize>| closed.before(range.start)..closed.before(range.end);
            move_all(&mut outline, &bytes);
            let place = |span: Span| match span.file {
                FileId(0) => {
                    let own = bytes(&(span.start as usize..span.end as usize));
                    Span { file: span.file, start: own.start as u32, end: own.end as u32 }
                }
                _ => span,
            };
            outcome.index = outcome_of_mended.index.moved(place);
        }
        let mut reports = TextReport::all(&outcome.problems, &outcome.sources);
        let mut inputs: BTreeSet<PathBuf> = outcome.inputs.iter().map(|it| path_of(it)).collect();
        if outcome.problems.iter().any(Problem::misses_scenario)
            && let Some(user) = user_of_parts(&source, loader, &outcome.problems)
        {
            reports = TextReport::all(&user.problems, &user.sources);
            reports.retain(|report| !report.place.path.starts_with("<check>"));
            inputs.extend(user.inputs.iter().map(|it| path_of(it)));
        }
        let unplayable = unplayable(&outcome);
        let loaded = outcome.scenario.take().map(|scenario| Loaded {
            scenario: scenario.into(),
            warnings: Vec::new(),
            sources: outcome.sources.clone(),
            origin: outcome.origins.scenario,
            origins: outcome.origins,
            inputs: Vec::new(),
            behaviors: outcome.behaviors,
            unplayable,
        });
        Analysis {
            lines: Lines::of(&text),
            text,
            tree,
            outline,
            reports,
            sources: outcome.sources,
            index: outcome.index,
            loaded,
            inputs,
        }
    }

    /// The bytes of a span of this text; none if it is of another file.
    #[allow(clippy::unused_self, reason = "a span belongs to the files of an analysis")]
    pub(super) fn own(&self, span: Span) -> Option<Range<usize>> {
        (span.file == FileId(0)).then_some(span.start as usize..span.end as usize)
    }

    /// What the text declares, in order.
    pub fn symbols(&self) -> &[Symbol] {
        &self.outline
    }

    /// A place in one of its files.
    pub(super) fn place(&self, span: Span) -> Option<FilePlace> {
        FilePlace::of(span, &self.sources)
    }
}

/// A scenario of a text, of which the whole is sound; none otherwise.
pub(super) fn scenario_of(
    path: &Path,
    text: &Arc<str>,
    loader: &FileLoader,
    name: &str,
) -> Option<Loaded> {
    let source = Source { name: name_of(path), text: text.clone() };
    let outcome = compile(source, loader, &options(Some(name.to_owned())));
    let unplayable = unplayable(&outcome);
    Some(Loaded {
        scenario: outcome.scenario?.into(),
        warnings: Vec::new(),
        sources: outcome.sources,
        origin: outcome.origins.scenario,
        origins: outcome.origins,
        inputs: Vec::new(),
        behaviors: outcome.behaviors,
        unplayable,
    })
}

fn options(scenario: Option<String>) -> CompileOptions<'static> {
    CompileOptions {
        index: true,
        plans_suffice: true,
        regions: true,
        scenario,
        ..compile_options()
    }
}

/// The text of a file that isn't open: one of the library, or on disk.
pub(super) fn closed_text(path: &Path) -> Option<Arc<str>> {
    let loader = FileLoader::anywhere();
    loader.load(&name_of(path), "").ok().map(|source| source.text)
}
