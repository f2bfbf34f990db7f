//! Problems as plain data: what JSON and Python show.

use super::sorted;
use crate::problem::{Label, Problem, Severity};
use crate::source::{FileId, Sources};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A problem as plain data.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Diagnostic {
    /// The stable code: `SP0203`.
    pub code: String,
    /// `error` or `warning`.
    pub severity: String,
    /// One clause.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
    /// Where; the first is the primary one.
    pub labels: Vec<DiagnosticLabel>,
}

/// A place of a [`Diagnostic`].
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct DiagnosticLabel {
    /// The file's name.
    pub file: String,
    /// Line of the first character, from 1.
    pub line: u32,
    /// Column of the first character, from 1, in characters.
    pub column: u32,
    /// Line behind the last character.
    pub end_line: u32,
    /// Column behind the last character.
    pub end_column: u32,
    /// Offset of the first byte.
    pub start: u32,
    /// Offset behind the last byte.
    pub end: u32,
    /// What is to be said about it; may be empty.
    pub text: String,
}

/// Problems as plain data, sorted by file, place and code.
pub fn diagnostics(problems: &[Problem], sources: &Sources) -> Vec<Diagnostic> {
    let mut lines = Lines { sources, starts: BTreeMap::new() };
    let make = |problem: &&Problem| Diagnostic {
        code: problem.code.to_string(),
        severity: severity(problem.severity()).to_owned(),
        message: problem.message.clone(),
        help: problem.help.clone(),
        labels: problem.labels.iter().map(|label| lines.label(label)).collect(),
    };
    sorted(problems).iter().map(make).collect()
}

/// The word for a severity.
pub(super) fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Warning => "warning",
        Severity::Error => "error",
    }
}

/// The beginnings of lines, per file.
struct Lines<'s> {
    sources: &'s Sources,
    starts: BTreeMap<FileId, Vec<usize>>,
}

impl Lines<'_> {
    fn label(&mut self, label: &Label) -> DiagnosticLabel {
        let span = label.span;
        let file = self.sources.get(span.file).map_or_else(|| "<unknown>".to_owned(), |source| source.name.clone());
        let (line, column) = self.place(span.file, span.start as usize);
        let (end_line, end_column) = self.place(span.file, span.end as usize);
        let text = label.text.clone();
        DiagnosticLabel { file, line, column, end_line, end_column, start: span.start, end: span.end, text }
    }

    /// Line and column of an offset, from 1.
    fn place(&mut self, file: FileId, at: usize) -> (u32, u32) {
        let text = self.sources.get(file).map_or("", |source| &source.text);
        let starts = self.starts.entry(file).or_insert_with(|| {
            let newlines = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(i, _)| i + 1);
            std::iter::once(0).chain(newlines).collect()
        });
        let line = starts.partition_point(|start| *start <= at);
        let start = starts.get(line.saturating_sub(1)).copied().unwrap_or_default();
        let column = text.get(start..at).map_or(0, |before| before.chars().filter(|char| *char != '\u{FEFF}').count());
        (line as u32, column as u32 + 1)
    }
}
