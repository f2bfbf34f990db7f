//! Problems as plain data: what JSON and Python show.

use super::sorted;
use crate::problem::{Label, Problem, Severity};
use crate::source::Sources;
use serde::{Deserialize, Serialize};

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
    let make = |problem: &&Problem| {
        let words = problem.words();
        Diagnostic {
            code: problem.code().to_string(),
            severity: severity(problem.severity()).to_owned(),
            message: words.message,
            help: words.help,
            labels: words.labels.iter().map(|it| label(it, sources)).collect(),
        }
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

fn label(label: &Label, sources: &Sources) -> DiagnosticLabel {
    let span = label.span;
    let source = sources.get(span.file);
    let place = |at: u32| source.map_or((1, 1), |source| source.line_column(at));
    let ((line, column), (end_line, end_column)) = (place(span.start), place(span.end));
    let file = source.map_or_else(|| "<unknown>".to_owned(), |source| source.name.clone());
    DiagnosticLabel {
        file,
        line,
        column,
        end_line,
        end_column,
        start: span.start,
        end: span.end,
        text: label.text.clone(),
    }
}
