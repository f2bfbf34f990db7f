//! Where the scripts of a text are.

use super::lines::{PyLine, PyToken, begins_item};
use std::ops::Range;

/// The name of a script's function.
const SCRIPT: &str = "build_scenario";

/// The scripts of a text, each from its first line to its last indented one. A text in the language
/// may stand before, between and behind them.
pub fn scripts(text: &str) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    if !text.contains(SCRIPT) {
        return found;
    }
    let mut part: Option<PyPart> = None;
    let (mut at, mut quotes) = (text.len() - text.trim_start_matches('\u{feff}').len(), 0);
    while at < text.len() {
        let rest = text.get(at..).unwrap_or_default();
        let written = rest.split('\n').next().unwrap_or_default();
        let mut next = at + written.len() + 1;
        let goes_on = part.is_some()
            && !begins_item(written)
            && (written.trim().is_empty() || written.starts_with([' ', '\t', '#']));
        // In the language three quotes also end a script in Rhai.
        let may_quote = part.is_some() || quotes % 2 == 0;
        if goes_on || is_start(written, part.is_some(), may_quote) {
            let line = PyLine::at(text, at);
            next = next.max(line.range.end + 1);
            let mut mine = part.take().unwrap_or_else(|| PyPart::at(at));
            if mine.has_script && line.indent == 0 && begins_file(&line) {
                found.push(mine.start..mine.code_end);
                mine = PyPart::at(mine.tail.unwrap_or(at));
            }
            mine.add(&line);
            part = Some(mine);
        } else {
            found.extend(part.take().and_then(PyPart::script));
        }
        quotes += text.get(at..next.min(text.len())).unwrap_or_default().matches("\"\"\"").count();
        at = next;
    }
    found.extend(part.and_then(PyPart::script));
    found
}

/// A part of a text that is Python.
struct PyPart {
    start: usize,
    /// Where its last line ends.
    end: usize,
    /// Where its last line that isn't a comment ends.
    code_end: usize,
    /// Where the comments behind that line begin.
    tail: Option<usize>,
    has_script: bool,
}

impl PyPart {
    fn at(start: usize) -> PyPart {
        PyPart { start, end: start, code_end: start, tail: None, has_script: false }
    }

    fn add(&mut self, line: &PyLine<'_>) {
        self.has_script |= is_script(line);
        if line.is_blank() {
            return;
        }
        self.end = line.range.end;
        if line.tokens.is_empty() {
            self.tail.get_or_insert(line.range.start);
        } else {
            (self.code_end, self.tail) = (line.range.end, None);
        }
    }

    fn script(self) -> Option<Range<usize>> {
        self.has_script.then_some(self.start..self.end)
    }
}

/// Whether a line begins another script, or the head of another file.
fn begins_file(line: &PyLine<'_>) -> bool {
    let is_comment = line.tokens == [PyToken::Text];
    is_script(line) || is_comment || matches!(line.word(), "from" | "import")
}

/// Whether a line begins `build_scenario`.
pub(super) fn is_script(line: &PyLine<'_>) -> bool {
    line.indent == 0
        && line.tokens.starts_with(&[
            PyToken::Word("def"),
            PyToken::Word(SCRIPT),
            PyToken::Sign("("),
        ])
}

/// The lines of a script.
pub(super) fn lines(text: &str) -> Vec<PyLine<'_>> {
    let (mut lines, mut at) = (Vec::new(), 0);
    while at < text.len() {
        let line = PyLine::at(text, at);
        let end = line.range.end;
        at = text.get(end..).and_then(|rest| rest.find('\n')).map_or(text.len(), |it| end + it + 1);
        if !line.is_blank() {
            lines.push(line);
        }
    }
    lines
}

/// What the comments and texts in quotes say at the head of a script and of its function.
pub(super) fn comments(text: &str, lines: &[PyLine<'_>]) -> Vec<String> {
    let is_quoted = |line: &&PyLine<'_>| line.tokens == [PyToken::Text];
    let head = lines.iter().take_while(|line| line.tokens.is_empty() || is_quoted(line));
    let first = lines.iter().position(is_script).and_then(|at| lines.get(at + 1));
    let all = head.chain(first.filter(is_quoted));
    all.flat_map(|line| {
        let written = text.get(line.range.clone()).unwrap_or_default().trim();
        if line.tokens.is_empty() { comment(written) } else { quoted(written) }
    })
    .collect()
}

/// What a comment says; nothing if it is for a program.
fn comment(written: &str) -> Vec<String> {
    let said = written.trim_start_matches('#');
    let is_setting = said.starts_with('!') || said.contains("coding:") || said.contains("coding=");
    let said = super::plain(said.strip_prefix(' ').unwrap_or(said));
    if is_setting { Vec::new() } else { vec![said] }
}

/// The lines of a text in quotes that say something.
fn quoted(written: &str) -> Vec<String> {
    let inside = written.trim_start_matches(char::is_alphabetic);
    let inside = inside.trim_matches(|sign| matches!(sign, '"' | '\''));
    let lines = inside.lines().map(str::trim).filter(|line| !line.is_empty());
    lines.map(super::plain).collect()
}

/// Whether a line at the left margin belongs to a Python file, and not to the language.
///
/// - `goes_on`: the line before is Python.
/// - `may_quote`: a quote here opens a string.
fn is_start(line: &str, goes_on: bool, may_quote: bool) -> bool {
    const ASSIGNS: [&str; 6] = ["=", "+=", "-=", "*=", "/=", "["];
    let is_name = |sign: char| sign.is_alphanumeric() || sign == '_';
    let word = line.split(|sign: char| !is_name(sign)).next().unwrap_or_default();
    let rest = line.get(word.len()..).unwrap_or_default();
    let behind = rest.trim_start();
    match word {
        "from" => rest.starts_with([' ', '\t']),
        // The language names a file in quotes.
        "import" => behind.starts_with(is_name),
        "async" | "class" | "def" | "for" | "if" | "try" | "while" | "with" => line.contains(':'),
        "elif" | "else" | "except" | "finally" => goes_on && line.contains(':'),
        "" => line.starts_with(['#', '@']) || (may_quote && line.starts_with(['"', '\''])),
        _ => {
            let is_assigned = ASSIGNS.iter().any(|sign| behind.starts_with(sign));
            let is_typed = behind.starts_with(':') && behind.contains('=');
            let is_used = rest.starts_with(['(', '.']);
            !word.starts_with(char::is_numeric) && (is_assigned || is_typed || is_used)
        }
    }
}
