//! What the compiler finds out about one text.

use super::text::Lines;
use crate::dsl::ast::{File, ItemKind, Span};
use crate::dsl::index::Index;
use crate::dsl::problem::{Code, Problem};
use crate::dsl::source::{FileId, Source, Sources};
use crate::dsl::{CompileOptions, compile, parse};
use crate::files::{FileLoader, name_of};
use crate::load::compile_options;
use std::collections::BTreeMap;
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
    /// What is wrong with it and with what it imports, by file and place.
    pub problems: Vec<Problem>,
    /// The files that were read; the text is the first.
    pub sources: Sources,
    /// What names refer to, and the types of expressions.
    pub index: Index,
}

impl Analysis {
    /// Compiles a text. `texts`: the open ones, which stand for their files.
    pub(super) fn of(path: &Path, text: Arc<str>, texts: &BTreeMap<PathBuf, Arc<str>>) -> Analysis {
        let source = Source { name: name_of(path), text: text.clone() };
        let tree = parse::parse(&source, FileId(0), &mut Vec::new());
        let loader = FileLoader::beside(&source.name).with_texts(texts.clone());
        let options = CompileOptions { index: true, plans_suffice: true, ..compile_options() };
        let mut outcome = compile(source, &loader, &options);
        // A file of rewards or formations alone is for others to import.
        let is_scenario = |kind: &ItemKind| matches!(kind, ItemKind::Scenario(_));
        let has_items = tree.items.iter().any(|item| !matches!(item.kind, ItemKind::Import { .. }));
        if has_items && !tree.items.iter().any(|item| is_scenario(&item.kind)) {
            outcome.problems.retain(|problem| problem.code() != Code::NoScenario);
        }
        Analysis {
            lines: Lines::of(&text),
            text,
            tree,
            problems: outcome.problems,
            sources: outcome.sources,
            index: outcome.index,
        }
    }

    /// The bytes of a span of this text; none if it is of another file.
    pub(super) fn own(&self, span: Span) -> Option<std::ops::Range<usize>> {
        (span.file == FileId(0)).then_some(span.start as usize..span.end as usize)
    }
}
