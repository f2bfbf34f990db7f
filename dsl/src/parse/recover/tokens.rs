//! The tokens of a part that can't be read, and the names that it would declare.

use super::expect::is_reserved;
use super::text;
use crate::parse::reader::{Reader, token};
use std::ops::Range;

/// Words behind which a name is declared.
const DECLARING: &[&str] = &[
    "let",
    "const",
    "param",
    "state",
    "fn",
    "region",
    "ending",
    "reward",
    "behavior",
    "formation",
    "scenario",
    "record",
];

impl<'t> Reader<'t> {
    /// The tokens of a range with their offsets; a string or a number is one token.
    pub(super) fn tokens(&self, range: Range<usize>) -> Vec<(usize, &'t str)> {
        let mut tokens = Vec::new();
        let mut at = self.next_token(range.start);
        while at < range.end {
            let rest = text(self.text, at..range.end);
            let found = rest.get(..length(rest)).unwrap_or_default();
            tokens.push((at, found));
            at = self.next_token(at + found.len().max(1));
        }
        tokens
    }

    /// The offset of the next token behind blanks and comments.
    pub(super) fn next_token(&self, mut at: usize) -> usize {
        loop {
            let rest = text(self.text, at..self.text.len());
            let blank = rest.len()
                - rest.trim_start_matches([' ', '\t', '\r', '\n', ';', '\u{FEFF}', '\u{A0}']).len();
            at += blank;
            match self.comment_at(at) {
                Some(end) => at = end,
                None => return at,
            }
        }
    }

    /// Notes the names that a part which can't be read would declare, so that their uses are no
    /// problems.
    pub(super) fn lose(&mut self, range: Range<usize>) {
        let tokens = self.tokens(range);
        let mut in_list = false;
        for (index, (_, word)) in tokens.iter().enumerate() {
            let next = tokens.get(index + 1).map_or("", |(_, next)| *next);
            let last = index
                .checked_sub(1)
                .and_then(|last| tokens.get(last))
                .map_or("", |(_, last)| *last);
            in_list = if in_list { *word != ")" } else { last == "let" && *word == "(" };
            let declared = in_list
                || matches!(next, ":" | "=")
                || (index == 1 && !is_reserved(last))
                || DECLARING.contains(&last);
            if declared && word.starts_with(|char: char| char.is_alphanumeric() || char == '_') {
                self.lost.insert((*word).to_owned());
            }
        }
    }
}

/// The length of the token at the start of a text.
fn length(text: &str) -> usize {
    let word = token(text);
    let behind = |at: usize| text.get(at..).unwrap_or_default();
    if text.starts_with("\"\"\"") {
        return behind(3).find("\"\"\"").map_or(text.len(), |end| end + 6);
    }
    if word == "\"" {
        let mut escaped = false;
        let end = behind(1).find(|char| {
            let plain = !std::mem::take(&mut escaped);
            escaped = plain && char == '\\';
            plain && char == '"'
        });
        return end.map_or(text.len(), |end| end + 2);
    }
    let rest = behind(word.len());
    let digits = |text: &str| text.starts_with(|char: char| char.is_ascii_digit());
    if digits(word) && rest.starts_with('.') && digits(behind(word.len() + 1)) {
        return word.len() + 1 + token(behind(word.len() + 1)).len();
    }
    word.len()
}
