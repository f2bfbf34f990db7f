//! The lines of a Python file: joined where a bracket is open, and apart in words and signs.

use crate::dsl::parse::statement_words;
use std::ops::Range;

/// How many lines of a file are joined to one.
const JOINED_MAX: usize = 100;

/// A word, number, string or sign of Python.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PyToken<'t> {
    /// A name or keyword.
    Word(&'t str),
    /// A whole number.
    Whole(i64),
    /// A number with a point or an exponent.
    Number(f64),
    /// A string; what it holds is of no use here.
    Text,
    /// A sign, such as `(` or `==`.
    Sign(&'t str),
    /// Anything else.
    Odd,
}

/// A line as Python counts them, or a comment.
#[derive(Clone, Debug)]
pub(super) struct PyLine<'t> {
    /// Its bytes, without the end of the last line.
    pub(super) range: Range<usize>,
    /// Blanks before it; a tab ends at a multiple of eight.
    pub(super) indent: usize,
    /// What it consists of; empty for a comment.
    pub(super) tokens: Vec<PyToken<'t>>,
}

/// Signs of two and three characters.
const LONG_SIGNS: &[&str] = &[
    "**=", "//=", ">>=", "<<=", "...", "==", "!=", "<=", ">=", "->", ":=", "+=", "-=", "*=", "/=",
    "%=", "**", "//", "<<", ">>", "&=", "|=", "^=", "@=",
];

impl<'t> PyLine<'t> {
    /// The line that begins at a byte, which is the start of a line of the text. One whose bracket
    /// or string isn't closed ends where it is written, and has one odd token.
    pub(super) fn at(text: &'t str, start: usize) -> PyLine<'t> {
        let within = |end: usize| PyLine::joined(text.get(..end).unwrap_or_default(), start);
        let rest = text.get(start..).unwrap_or_default();
        let written = rest.split('\n').next().unwrap_or_default();
        // Most lines are closed where they are written.
        let alone = within((start + written.len() + 1).min(text.len()));
        alone.or_else(|| within(end_of_joined(text, start))).unwrap_or_else(|| {
            let blanks = written.len() - written.trim_start().len();
            PyLine {
                range: start..start + written.trim_end().len(),
                indent: indent_of(written.get(..blanks).unwrap_or_default()),
                tokens: vec![PyToken::Odd],
            }
        })
    }

    /// The line that begins at a byte; none if a bracket or string isn't closed, or it goes on
    /// behind the text.
    fn joined(text: &'t str, start: usize) -> Option<PyLine<'t>> {
        let mut line = PyLine { range: start..start, indent: 0, tokens: Vec::new() };
        let rest = text.get(start..).unwrap_or_default();
        let blanks = rest.len() - rest.trim_start_matches([' ', '\t', '\u{c}']).len();
        line.indent = indent_of(rest.get(..blanks).unwrap_or_default());
        let (mut at, mut open, mut is_ended) = (start + blanks, 0_usize, true);
        while let Some(rest) = text.get(at..)
            && let Some(sign) = rest.chars().next()
        {
            let goes_on = rest.strip_prefix('\\').is_some_and(|it| it.starts_with(['\n', '\r']));
            is_ended = !goes_on;
            if sign == '\n' || goes_on {
                if open == 0 && !goes_on {
                    break;
                }
                at += rest.find('\n').map_or(rest.len(), |it| it + 1);
            } else if sign.is_whitespace() {
                at += sign.len_utf8();
            } else if sign == '#' {
                at += rest.find('\n').unwrap_or(rest.len());
            } else {
                let (token, length) = token(rest)?;
                match token {
                    PyToken::Sign("(" | "[" | "{") => open += 1,
                    PyToken::Sign(")" | "]" | "}") => open = open.saturating_sub(1),
                    _ => {}
                }
                line.tokens.push(token);
                at += length;
            }
        }
        let written = text.get(start..at).unwrap_or_default();
        line.range.end = start + written.trim_end().len();
        (is_ended && open == 0).then_some(line)
    }

    /// Whether nothing is written in it.
    pub(super) fn is_blank(&self) -> bool {
        self.range.is_empty()
    }

    /// Its first word; empty if it begins otherwise.
    pub(super) fn word(&self) -> &'t str {
        match self.tokens.first() {
            Some(PyToken::Word(word)) => word,
            _ => "",
        }
    }
}

/// Where a line that begins at a byte has to have its end: before the language goes on, and before
/// too many lines.
fn end_of_joined(text: &str, start: usize) -> usize {
    let mut end = start;
    for (count, line) in text.get(start..).unwrap_or_default().split_inclusive('\n').enumerate() {
        if count > JOINED_MAX || (count > 0 && begins_item(line)) {
            break;
        }
        end += line.len();
    }
    end
}

/// Whether a line is one of the language, which no line of Python can be.
pub(super) fn begins_item(line: &str) -> bool {
    let line = line.trim_start();
    let word = line.split(|sign: char| !sign.is_alphanumeric()).next().unwrap_or_default();
    let behind = line.get(word.len()..).unwrap_or_default();
    let is_named = behind.starts_with([' ', '\t'])
        && behind.trim_start().starts_with(|sign: char| sign.is_alphabetic() || sign == '"');
    let is_item = || word != "import" && statement_words("").contains(&word);
    line.starts_with("//") || (is_named && is_item())
}

/// How deep blanks are; a tab ends at a multiple of eight.
fn indent_of(blanks: &str) -> usize {
    blanks
        .chars()
        .fold(0, |indent, sign| if sign == '\t' { indent / 8 * 8 + 8 } else { indent + 1 })
}

/// The first token of a text, and its length in bytes; none if it is a string that isn't closed.
fn token(text: &str) -> Option<(PyToken<'_>, usize)> {
    let is_word = |sign: char| sign.is_alphanumeric() || sign == '_';
    let first = text.chars().next().unwrap_or_default();
    let digit = |it: &str| it.starts_with(|sign: char| sign.is_ascii_digit());
    if digit(text) || text.strip_prefix('.').is_some_and(digit) {
        return Some(number(text));
    }
    let length = text.len() - text.trim_start_matches(is_word).len();
    let (word, behind) = text.split_at(length);
    let is_prefix = length <= 2 && word.chars().all(|sign| "rRbBuUfF".contains(sign));
    if is_prefix && behind.starts_with(['"', '\'']) {
        return Some((PyToken::Text, length + string(behind)?));
    }
    if length > 0 {
        return Some((PyToken::Word(word), length));
    }
    if let Some(sign) = LONG_SIGNS.iter().find(|sign| text.starts_with(**sign)) {
        return Some((PyToken::Sign(sign), sign.len()));
    }
    let length = first.len_utf8();
    Some(match text.get(..length) {
        Some(sign) if first.is_ascii_punctuation() => (PyToken::Sign(sign), length),
        _ => (PyToken::Odd, length.max(1)),
    })
}

/// The length of the string at the start of a text; none if it isn't closed.
fn string(text: &str) -> Option<usize> {
    let quote = text.chars().next().filter(|sign| matches!(sign, '"' | '\''))?;
    let three = quote.to_string().repeat(3);
    let (close, is_long) =
        if text.starts_with(&three) { (three.as_str(), true) } else { (text.get(..1)?, false) };
    let mut at = close.len();
    while let Some(rest) = text.get(at..)
        && let Some(sign) = rest.chars().next()
    {
        if rest.starts_with(close) {
            return Some(at + close.len());
        }
        if sign == '\n' && !is_long {
            return None;
        }
        at += sign.len_utf8();
        if sign == '\\' {
            at += rest.chars().nth(1).map_or(0, char::len_utf8);
        }
    }
    None
}

/// The number at the start of a text, and its length in bytes.
fn number(text: &str) -> (PyToken<'_>, usize) {
    let mut length = 0;
    let mut before = ' ';
    for sign in text.chars() {
        let is_exponent = matches!(before, 'e' | 'E') && matches!(sign, '+' | '-');
        if !(sign.is_alphanumeric() || matches!(sign, '_' | '.') || is_exponent) {
            break;
        }
        length += sign.len_utf8();
        before = sign;
    }
    let written = text.get(..length).unwrap_or_default();
    let digits = written.replace('_', "");
    let is_whole = digits.bytes().all(|byte| byte.is_ascii_digit());
    let token = match digits.parse::<i64>() {
        Ok(whole) if is_whole => PyToken::Whole(whole),
        _ => match digits.parse::<f64>() {
            Ok(value) if !is_whole && value.is_finite() => PyToken::Number(value),
            _ => PyToken::Odd,
        },
    };
    (token, length)
}
