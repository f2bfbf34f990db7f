//! Reports: problems in words and pictures, for people, editors and programs.

mod diagnostic;
mod human;

pub use diagnostic::{Diagnostic, DiagnosticLabel, diagnostics};

use crate::problem::{Problem, Severity};
use crate::source::Sources;
use std::fmt::Write as _;

/// A report shows this many problems in full and counts the rest.
pub const MAX_SHOWN: usize = 20;

/// The form of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Source lines with the places marked.
    Human {
        /// Whether to use ANSI colours.
        color: bool,
        /// Columns to wrap at.
        width: usize,
    },
    /// An array of [`Diagnostic`]s; every problem is in it.
    Json,
    /// A line per problem: `file:line:column: error SP0203: message`.
    Short,
}

/// Renders problems, sorted by file, place and code. Empty if there are none (`[]` in JSON).
pub fn render(problems: &[Problem], sources: &Sources, format: Format) -> String {
    let sorted = sorted(problems);
    match format {
        Format::Human { color, width } => human::render(&sorted, sources, color, width),
        Format::Json => {
            serde_json::to_string_pretty(&diagnostics(problems, sources)).unwrap_or_else(|_| "[]".to_owned())
        }
        Format::Short => short(&sorted, sources),
    }
}

/// Problems by file, place and code.
fn sorted(problems: &[Problem]) -> Vec<&Problem> {
    let mut sorted: Vec<&Problem> = problems.iter().collect();
    sorted
        .sort_by_key(|problem| (problem.labels.first().map(|label| (label.span.file, label.span.start)), problem.code));
    sorted
}

fn short(problems: &[&Problem], sources: &Sources) -> String {
    let mut text = String::new();
    let owned: Vec<Problem> = problems.iter().take(MAX_SHOWN).map(|problem| (*problem).clone()).collect();
    for diagnostic in diagnostics(&owned, sources) {
        if let Some(label) = diagnostic.labels.first() {
            let _ = write!(text, "{}:{}:{}: ", label.file, label.line, label.column);
        }
        let _ = writeln!(text, "{} {}: {}", diagnostic.severity, diagnostic.code, diagnostic.message);
    }
    text.push_str(&count(problems));
    text
}

/// "3 errors and 1 warning; 2 more are not shown", with a newline; empty without problems.
fn count(problems: &[&Problem]) -> String {
    let errors = problems.iter().filter(|problem| problem.severity() == Severity::Error).count();
    let warnings = problems.len() - errors;
    let say = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let told = match (errors, warnings) {
        (0, 0) => return String::new(),
        (_, 0) => say(errors, "error"),
        (0, _) => say(warnings, "warning"),
        _ => format!("{} and {}", say(errors, "error"), say(warnings, "warning")),
    };
    match problems.len().saturating_sub(MAX_SHOWN) {
        0 => format!("{told}\n"),
        more => format!("{told}; {more} of them not shown\n"),
    }
}
