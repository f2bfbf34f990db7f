//! Reports: problems in words and pictures, for people, editors and programs.

mod diagnostic;
mod human;

pub use diagnostic::{Diagnostic, DiagnosticLabel, diagnostics};

use crate::problem::{Problem, Severity};
use crate::source::Sources;
use std::borrow::Cow;
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
        Format::Json => serde_json::to_string_pretty(&diagnostics(problems, sources))
            .unwrap_or_else(|_| "[]".to_owned()),
        Format::Short => short(&sorted, sources),
    }
}

/// A text as a terminal may show it: control characters become their pictures, `␛`, but for ends of
/// lines, tabs and, where colours are wanted, the sequences that set them.
pub fn printable(text: &str, colours: bool) -> Cow<'_, str> {
    let is_plain = |char: char| !is_control(char);
    if text.chars().all(is_plain) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(char) = rest.chars().next() {
        let length = if colours { colour_sequence(rest) } else { 0 };
        let (head, tail) = rest.split_at(length.max(char.len_utf8()));
        match char {
            _ if length > 0 || is_plain(char) => shown.push_str(head),
            _ => shown.push(picture(char)),
        }
        rest = tail;
    }
    Cow::Owned(shown)
}

/// Whether a character steers a terminal, or the direction of its text.
fn is_control(char: char) -> bool {
    let directs =
        matches!(char, '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}' | '\u{200E}' | '\u{200F}');
    directs || (char.is_control() && !matches!(char, '\n' | '\t'))
}

/// What is shown of a control character.
fn picture(char: char) -> char {
    match char as u32 {
        code @ 0..=0x1F => char::from_u32(0x2400 + code).unwrap_or('\u{FFFD}'),
        0x7F => '\u{2421}',
        _ => '\u{FFFD}',
    }
}

/// The length of the sequence at the start of a text that sets a colour; 0 if it is none.
fn colour_sequence(text: &str) -> usize {
    let Some(parameters) = text.strip_prefix("\u{1B}[") else { return 0 };
    let end = parameters.find(|char: char| !(char.is_ascii_digit() || char == ';'));
    match end {
        Some(end) if parameters.get(end..).is_some_and(|rest| rest.starts_with('m')) => end + 3,
        _ => 0,
    }
}

/// Problems by file, place and code.
fn sorted(problems: &[Problem]) -> Vec<&Problem> {
    let mut sorted: Vec<&Problem> = problems.iter().collect();
    sorted.sort_by_key(|problem| (problem.place().file, problem.place().start, problem.code()));
    sorted
}

fn short(problems: &[&Problem], sources: &Sources) -> String {
    let mut text = String::new();
    let owned: Vec<Problem> =
        problems.iter().take(MAX_SHOWN).map(|problem| (*problem).clone()).collect();
    for diagnostic in diagnostics(&owned, sources) {
        if let Some(label) = diagnostic.labels.first() {
            let _ =
                write!(text, "{}:{}:{}: ", printable(&label.file, false), label.line, label.column);
        }
        let message = printable(&diagnostic.message, false);
        let _ = writeln!(text, "{} {}: {message}", diagnostic.severity, diagnostic.code);
    }
    text.push_str(&count(problems));
    text
}

/// "3 errors and 1 warning; 2 more are not shown", with a newline; empty without problems.
fn count(problems: &[&Problem]) -> String {
    let errors = problems.iter().filter(|problem| problem.severity() == Severity::Error).count();
    let warnings = problems.len() - errors;
    let say =
        |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let reported = match (errors, warnings) {
        (0, 0) => return String::new(),
        (_, 0) => say(errors, "error"),
        (0, _) => say(warnings, "warning"),
        _ => format!("{} and {}", say(errors, "error"), say(warnings, "warning")),
    };
    match problems.len().saturating_sub(MAX_SHOWN) {
        0 => format!("{reported}\n"),
        more => format!("{reported}; {more} of them not shown\n"),
    }
}
