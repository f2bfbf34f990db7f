//! The lines of a Python file: joined where a bracket is open, and apart in words and signs.

use std::ops::Range;

/// How many lines of a file are joined to one.
const JOINED_MAX: usize = 400;

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
    /// The line that begins at a byte, which is the start of a line of the text.
    pub(super) fn at(text: &'t str, start: usize) -> PyLine<'t> {
        let mut line = PyLine { range: start..start, indent: 0, tokens: Vec::new() };
        let rest = text.get(start..).unwrap_or_default();
        let blanks = rest.len() - rest.trim_start_matches([' ', '\t', '\u{c}']).len();
        for sign in rest.get(..blanks).unwrap_or_default().chars() {
            line.indent = if sign == '\t' { line.indent / 8 * 8 + 8 } else { line.indent + 1 };
        }
        let (mut at, mut open, mut joined) = (start + blanks, 0_usize, 0);
        while let Some(rest) = text.get(at..)
            && let Some(sign) = rest.chars().next()
        {
            let goes_on = rest.strip_prefix('\\').is_some_and(|it| it.starts_with(['\n', '\r']));
            if sign == '\n' || goes_on {
                if (open == 0 && !goes_on) || joined == JOINED_MAX {
                    break;
                }
                joined += 1;
                at += rest.find('\n').map_or(rest.len(), |it| it + 1);
            } else if sign.is_whitespace() {
                at += sign.len_utf8();
            } else if sign == '#' {
                at += rest.find('\n').unwrap_or(rest.len());
            } else {
                let (token, length) = token(rest);
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
        line
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

/// The first token of a text, and its length in bytes.
fn token(text: &str) -> (PyToken<'_>, usize) {
    let is_word = |sign: char| sign.is_alphanumeric() || sign == '_';
    let first = text.chars().next().unwrap_or_default();
    let digit = |it: &str| it.starts_with(|sign: char| sign.is_ascii_digit());
    if digit(text) || text.strip_prefix('.').is_some_and(digit) {
        return number(text);
    }
    let length = text.len() - text.trim_start_matches(is_word).len();
    let (word, behind) = text.split_at(length);
    let is_prefix = length <= 2 && word.chars().all(|sign| "rRbBuUfF".contains(sign));
    if is_prefix && let Some(quoted) = string(behind) {
        return (PyToken::Text, length + quoted);
    }
    if length > 0 {
        return (PyToken::Word(word), length);
    }
    if let Some(sign) = LONG_SIGNS.iter().find(|sign| text.starts_with(**sign)) {
        return (PyToken::Sign(sign), sign.len());
    }
    let length = first.len_utf8();
    match text.get(..length) {
        Some(sign) if first.is_ascii_punctuation() => (PyToken::Sign(sign), length),
        _ => (PyToken::Odd, length.max(1)),
    }
}

/// The length of the string at the start of a text; none if there is none. What isn't closed ends
/// with its line, or with the text.
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
            return Some(at);
        }
        at += sign.len_utf8();
        if sign == '\\' {
            at += rest.chars().nth(1).map_or(0, char::len_utf8);
        }
    }
    Some(text.len())
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
