//! A text taken apart: its tokens and comments, each with the line breaks before it.

use pest::Parser;
use pest::iterators::Pair;
use setpiece_grammar::{PitchParser, Rule};
use std::borrow::Cow;

/// What a piece is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PieceKind {
    /// A token, by the rule that reads it.
    Token(Rule),
    /// `// …`, to the end of its line.
    LineComment,
    /// `/* … */`
    BlockComment,
}

/// A token or a comment.
#[derive(Clone, Debug)]
pub(super) struct SourcePiece<'t> {
    /// What it is.
    pub(super) kind: PieceKind,
    /// As it is printed.
    pub(super) text: Cow<'t, str>,
    /// The rule that it is a direct part of.
    pub(super) within: Rule,
    /// Line breaks before it in the author's text.
    pub(super) newlines: usize,
    /// Blanks before it on its line.
    pub(super) blanks: usize,
    /// Whether a statement of a block, or an item of the file, begins here.
    pub(super) begins: bool,
    /// Whether it is a comma between two such.
    pub(super) separates: bool,
}

impl SourcePiece<'_> {
    /// Whether it is this token.
    pub(super) fn is(&self, rule: Rule) -> bool {
        self.kind == PieceKind::Token(rule)
    }

    /// Whether it is a comment; a `///` line is a token.
    pub(super) fn is_comment(&self) -> bool {
        matches!(self.kind, PieceKind::LineComment | PieceKind::BlockComment)
    }

    /// Whether nothing may follow it on its line.
    pub(super) fn ends_line(&self) -> bool {
        self.kind == PieceKind::LineComment || self.is(Rule::doc)
    }

    pub(super) fn opens(&self) -> bool {
        matches!(
            self.kind,
            PieceKind::Token(Rule::brace_open | Rule::paren_open | Rule::bracket_open)
        )
    }

    pub(super) fn closes(&self) -> bool {
        matches!(
            self.kind,
            PieceKind::Token(Rule::brace_close | Rule::paren_close | Rule::bracket_close)
        )
    }
}

/// The pieces of a text that parses; `None` where it doesn't.
pub(super) fn pieces(text: &str) -> Option<Vec<SourcePiece<'_>>> {
    read(Rule::file, text)
}

/// The same of an expression alone.
pub(super) fn of_expression(text: &str) -> Option<Vec<SourcePiece<'_>>> {
    read(Rule::expr, text)
}

fn read(rule: Rule, text: &str) -> Option<Vec<SourcePiece<'_>>> {
    let whole = PitchParser::parse(rule, text).ok()?.next()?;
    let mut reader = PieceReader { text, at: 0, pieces: Vec::new() };
    reader.walk(whole, rule, false);
    reader.gap(text.len());
    Some(reader.pieces)
}

struct PieceReader<'t> {
    text: &'t str,
    /// Behind the last piece.
    at: usize,
    pieces: Vec<SourcePiece<'t>>,
}

impl<'t> PieceReader<'t> {
    fn walk(&mut self, pair: Pair<'t, Rule>, within: Rule, begins: bool) {
        let rule = pair.as_rule();
        let mut inner = pair.clone().into_inner().peekable();
        if rule == Rule::quantity || inner.peek().is_none() {
            self.token(&pair, within, begins);
            return;
        }
        let mut in_list = rule == Rule::file;
        for (index, child) in inner.enumerate() {
            match child.as_rule() {
                Rule::brace_open => in_list = true,
                Rule::brace_close => in_list = false,
                Rule::comma if in_list => {
                    self.token(&child, rule, false);
                    if let Some(comma) = self.pieces.last_mut() {
                        comma.separates = true;
                    }
                    continue;
                }
                _ if in_list => {
                    self.walk(child, rule, true);
                    continue;
                }
                _ => {}
            }
            self.walk(child, rule, begins && index == 0);
        }
    }

    fn token(&mut self, pair: &Pair<'t, Rule>, within: Rule, begins: bool) {
        let text = pair.as_str().trim();
        if text.is_empty() || pair.as_rule() == Rule::EOI {
            return;
        }
        let (newlines, blanks) = self.gap(pair.as_span().start());
        self.at = pair.as_span().start() + text.len();
        let text =
            if pair.as_rule() == Rule::quantity { quantity(pair) } else { Cow::Borrowed(text) };
        let kind = PieceKind::Token(pair.as_rule());
        self.pieces.push(SourcePiece {
            kind,
            text,
            within,
            newlines,
            blanks,
            begins,
            separates: false,
        });
    }

    /// Reads the comments up to `end`; the line breaks and blanks behind the last of them.
    fn gap(&mut self, end: usize) -> (usize, usize) {
        let (mut newlines, mut blanks, mut semicolon) = (0, 0, false);
        while let Some(rest) = self.text.get(self.at..end).filter(|rest| !rest.is_empty()) {
            let comment = if rest.starts_with("//") {
                Some((PieceKind::LineComment, rest.find('\n').unwrap_or(rest.len())))
            } else if rest.starts_with("/*") {
                Some((PieceKind::BlockComment, rest.find("*/").map_or(rest.len(), |at| at + 2)))
            } else {
                None
            };
            if let Some((kind, length)) = comment {
                let text = Cow::Borrowed(rest.get(..length).unwrap_or(rest).trim_end());
                let newlines = newlines.max(usize::from(semicolon));
                let (within, begins, separates) = (Rule::COMMENT, false, false);
                self.pieces.push(SourcePiece {
                    kind,
                    text,
                    within,
                    newlines,
                    blanks,
                    begins,
                    separates,
                });
                self.at += length;
            } else {
                let sign = rest.chars().next().unwrap_or(' ');
                match sign {
                    '\n' => (newlines, blanks) = (newlines + 1, 0),
                    ';' => semicolon = true,
                    _ => blanks += 1,
                }
                self.at += sign.len_utf8();
                continue;
            }
            (newlines, blanks, semicolon) = (0, 0, false);
        }
        (newlines.max(usize::from(semicolon)), blanks)
    }
}

/// A number with its unit: a long unit stands one blank behind it.
fn quantity<'t>(pair: &Pair<'t, Rule>) -> Cow<'t, str> {
    let parts: Vec<Pair<'t, Rule>> = pair.clone().into_inner().collect();
    match parts.as_slice() {
        [number, unit] if unit.as_rule() == Rule::long_unit => {
            Cow::Owned(format!("{} {}", number.as_str(), unit.as_str()))
        }
        _ => Cow::Borrowed(pair.as_str().trim()),
    }
}
