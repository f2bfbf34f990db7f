//! What every conversion from pairs to the tree shares: spans, names, problems and depth.

use super::scan::Scan;
use super::{LEAST_EFFORT, MAX_BLOCKS, MAX_LIST, MAX_PROBLEMS, span};
use crate::ast::{Ident, Spanned};
use crate::check::names::{owner_of_call, owner_of_value};
use crate::problem::Problem;
use crate::problem::facts::{Names, Syntax};
use crate::source::{FileId, Span};
use pest::error::InputLocation;
use pest::iterators::{Pair, Pairs};
use setpiece_grammar::Rule;
use std::collections::BTreeSet;
use std::iter::Peekable;
use std::ops::Range;

/// A node of the concrete tree.
pub(super) type CstNode<'i> = Pair<'i, Rule>;

/// The children of a node.
pub(super) struct CstNodes<'i>(Peekable<Pairs<'i, Rule>>);

impl<'i> CstNodes<'i> {
    /// The children of a node.
    pub(super) fn of(node: CstNode<'i>) -> CstNodes<'i> {
        CstNodes(node.into_inner().peekable())
    }

    /// The next child, if it is of this rule.
    pub(super) fn want(&mut self, rule: Rule) -> Option<CstNode<'i>> {
        self.0.next_if(|node| node.as_rule() == rule)
    }

    /// Whether the next child is of this rule; takes it.
    pub(super) fn eat(&mut self, rule: Rule) -> bool {
        self.want(rule).is_some()
    }

    /// The first child of this rule; those before it are dropped.
    pub(super) fn seek(&mut self, rule: Rule) -> Option<CstNode<'i>> {
        self.0.find(|node| node.as_rule() == rule)
    }

    /// The rule of the next child.
    pub(super) fn peek(&mut self) -> Option<Rule> {
        self.0.peek().map(Pair::as_rule)
    }

    /// The range of the next child, blanks included, from where its text begins.
    pub(super) fn peek_range(&mut self) -> Option<Range<usize>> {
        self.0.peek().map(|node| node.as_span().start()..node.as_span().end())
    }
}

impl<'i> Iterator for CstNodes<'i> {
    type Item = CstNode<'i>;

    fn next(&mut self) -> Option<CstNode<'i>> {
        self.0.next()
    }
}

/// Turns pairs into the tree and collects what is wrong.
pub(super) struct Reader<'t> {
    file: FileId,
    /// The author's text.
    original: &'t str,
    /// The mended text that the pairs come from.
    pub(super) text: &'t str,
    comments: &'t [Range<usize>],
    /// Disjoint and in order.
    reported: Vec<Range<usize>>,
    problems: Vec<Problem>,
    /// Where the lines of the text begin, but for the first.
    lines: Vec<usize>,
    /// Where the text under conversion begins: 0 but for re-read parts.
    pub(super) base: usize,
    /// Operators on the way from the root of the current expression.
    pub(super) operators: u32,
    /// Blocks around the current statement.
    blocks: u32,
    /// Bytes that may still be read again to say what was expected.
    effort: usize,
    /// Names that are declared where the text could not be read.
    pub(super) lost: BTreeSet<String>,
    /// Words of the language that were declared as names.
    misnamed: BTreeSet<String>,
}

/// Blanks that count as indentation.
const INDENT_MAX: usize = 1_000;

impl<'t> Reader<'t> {
    pub(super) fn new(file: FileId, original: &'t str, scan: &'t Scan<'_>) -> Reader<'t> {
        let (text, comments) = (&*scan.text, &*scan.comments);
        let (reported, problems) = (disjoint(scan.reported.clone()), Vec::new());
        let newlines = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Reader {
            file,
            original,
            text,
            comments,
            reported,
            problems,
            lines: newlines.map(|(at, _)| at + 1).collect(),
            base: 0,
            operators: 0,
            blocks: 0,
            effort: LEAST_EFFORT + 2 * original.len(),
            lost: BTreeSet::new(),
            misnamed: BTreeSet::new(),
        }
    }

    /// The problems, and the names that are declared where the text could not be read.
    pub(super) fn finish(self) -> (Vec<Problem>, BTreeSet<String>) {
        (self.problems, self.lost)
    }

    /// Reports a problem, unless one that explains it was reported before.
    pub(super) fn push(&mut self, problem: Problem) {
        let start = problem.place().start as usize;
        if !self.is_reported(&(start..start + 1)) && self.problems.len() < MAX_PROBLEMS {
            self.problems.push(problem);
        }
    }

    /// Whether nothing that stands in a range would be reported.
    pub(super) fn is_reported(&self, range: &Range<usize>) -> bool {
        let index = self.reported.partition_point(|reported| reported.end <= range.start);
        self.reported
            .get(index)
            .is_some_and(|reported| reported.start <= range.start && range.end <= reported.end)
    }

    /// Whether more problems can be reported.
    pub(super) fn is_full(&self) -> bool {
        self.problems.len() >= MAX_PROBLEMS
    }

    /// Whether so many bytes may be read again; takes them from what is left.
    pub(super) fn spend(&mut self, bytes: usize) -> bool {
        // A short text costs something too.
        let left = self.effort.checked_sub(bytes + 64);
        self.effort = left.unwrap_or(self.effort);
        left.is_some()
    }

    /// A node's range in the text, without the blanks and comments that its last optional parts
    /// swallowed.
    pub(super) fn range(&self, node: &CstNode<'_>) -> Range<usize> {
        let (start, end) = (node.as_span().start() + self.base, node.as_span().end() + self.base);
        start..self.trimmed_end(start, end)
    }

    /// The end of `start..end` without trailing blanks and comments.
    pub(super) fn trimmed_end(&self, start: usize, mut end: usize) -> usize {
        loop {
            let text = self.text.get(start..end).unwrap_or_default();
            let trimmed = start
                + text.trim_end_matches([' ', '\t', '\r', '\n', ';', '\u{FEFF}', '\u{A0}']).len();
            let index = self.comments.partition_point(|comment| comment.end < trimmed);
            match self.comments.get(index) {
                Some(comment) if comment.end == trimmed && comment.start > start => {
                    end = comment.start;
                }
                _ => return trimmed,
            }
        }
    }

    /// A node's span.
    pub(super) fn span(&self, node: &CstNode<'_>) -> Span {
        let range = self.range(node);
        self.between(range.start, range.end)
    }

    /// A span of the author's text, cut where the mended text is longer.
    pub(super) fn between(&self, start: usize, end: usize) -> Span {
        let len = self.original.len();
        let (mut start, mut end) = (start.min(len), end.min(len));
        while !self.original.is_char_boundary(start) {
            start -= 1;
        }
        while !self.original.is_char_boundary(end) {
            end += 1;
        }
        span(self.file, start, end)
    }

    /// The span of the word or sign at an offset.
    pub(super) fn at(&self, at: usize) -> Span {
        let rest = self.original.get(at..).unwrap_or_default();
        self.between(at, at + token(rest).len())
    }

    /// Where the line of an offset begins.
    pub(super) fn line_start(&self, at: usize) -> usize {
        let index = self.lines.partition_point(|line| *line <= at);
        index.checked_sub(1).and_then(|index| self.lines.get(index)).copied().unwrap_or_default()
    }

    /// The indentation of the line of an offset.
    pub(super) fn indent(&self, at: usize) -> usize {
        let line = self.text.get(self.line_start(at)..at).unwrap_or_default();
        line.bytes().take(INDENT_MAX).take_while(|byte| matches!(byte, b' ' | b'\t')).count()
    }

    /// Whether a list may take one more; reports the first that it may not.
    pub(super) fn has_room(&mut self, taken: usize, more: Span, what: &str) -> bool {
        if taken == MAX_LIST {
            self.push(Problem::new(
                more,
                Syntax::TooLongList { what: what.to_owned(), most: MAX_LIST },
            ));
        }
        taken < MAX_LIST
    }

    /// The nodes of a list, as many as it may have; reports the first that is too many.
    pub(super) fn bounded<'i>(
        &mut self,
        nodes: impl Iterator<Item = CstNode<'i>>,
        what: &str,
    ) -> Vec<CstNode<'i>> {
        let mut list: Vec<CstNode<'i>> = nodes.take(MAX_LIST + 1).collect();
        if let Some(more) = list.get(MAX_LIST).map(|more| self.span(more)) {
            self.has_room(MAX_LIST, more, what);
            list.truncate(MAX_LIST);
        }
        list
    }

    /// The author's text.
    pub(super) fn original(&self) -> &'t str {
        self.original
    }

    /// The end of the comment that begins at an offset.
    pub(super) fn comment_at(&self, at: usize) -> Option<usize> {
        let index = self.comments.partition_point(|comment| comment.start < at);
        self.comments.get(index).filter(|comment| comment.start == at).map(|comment| comment.end)
    }

    /// Where pest met its error.
    pub(super) fn offset_of(&self, location: &InputLocation) -> usize {
        let (InputLocation::Pos(at) | InputLocation::Span((at, _))) = location;
        at + self.base
    }

    /// A name as written.
    pub(super) fn ident(&self, node: &CstNode<'_>) -> Ident {
        Ident { node: node.as_str().to_owned(), span: self.span(node) }
    }

    /// A name that expressions may use: it can't be an event's, nor hide a value of the language.
    pub(super) fn value_name(&mut self, node: &CstNode<'_>) -> Ident {
        let name = self.ident(node);
        if let Some(owner) = owner_of_value(&name.node) {
            self.misnamed.insert(name.node.clone());
            self.push(reserved(&name.node, name.span, owner));
        }
        name
    }

    /// The name of what is assigned; where it was declared, it has been reported if it can't be a
    /// name.
    pub(super) fn assigned_name(&mut self, node: &CstNode<'_>) -> Ident {
        let name = self.ident(node);
        if self.misnamed.contains(&name.node) { name } else { self.value_name(node) }
    }

    /// The name of what is called: it can't be a function's, either.
    pub(super) fn callable_name(&mut self, node: &CstNode<'_>) -> Ident {
        let name = self.value_name(node);
        if let Some(owner) = owner_of_call(&name.node) {
            self.push(reserved(&name.node, name.span, owner));
        }
        name
    }

    /// The words between quotes.
    pub(super) fn string(&self, node: &CstNode<'_>) -> Spanned<String> {
        let text = node.as_str();
        let inner = text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text);
        let mut words = String::with_capacity(inner.len());
        let mut chars = inner.chars().peekable();
        while let Some(char) = chars.next() {
            match (char, chars.peek()) {
                ('\\', Some(&escaped @ ('"' | '\\'))) => {
                    words.push(escaped);
                    chars.next();
                }
                _ => words.push(char),
            }
        }
        Spanned { node: words, span: self.span(node) }
    }

    /// Runs `read` one block deeper, or reports that this is too deep.
    pub(super) fn nested<T>(&mut self, at: Span, read: impl FnOnce(&mut Self) -> T) -> Option<T> {
        if self.blocks >= MAX_BLOCKS {
            self.push(Problem::new(at, Syntax::NestedBlocks { most: MAX_BLOCKS }));
            return None;
        }
        self.blocks += 1;
        let result = read(self);
        self.blocks -= 1;
        Some(result)
    }
}

/// Ranges in order, those that overlap or touch made one.
fn disjoint(mut ranges: Vec<Range<usize>>) -> Vec<Range<usize>> {
    ranges.sort_by_key(|range| range.start);
    let mut merged: Vec<Range<usize>> = Vec::new();
    for range in ranges {
        match merged.last_mut() {
            Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
            _ => merged.push(range),
        }
    }
    merged
}

/// A reserved word used as a name.
pub(super) fn reserved(name: &str, span: Span, whose: &str) -> Problem {
    Problem::new(span, Names::Reserved { name: name.to_owned(), whose: whose.to_owned() })
}

/// Signs of two characters, the language's and others'.
const SIGNS: &[&str] = &[
    "==", "!=", "<=", ">=", "..", "->", "//", "&&", "||", "**", "++", "--", "+=", "-=", "*=", "/=",
    ":=",
];

/// The word, number or sign at the start of a text.
pub(super) fn token(text: &str) -> &str {
    let word = |char: char| char.is_alphanumeric() || char == '_';
    let end = match text.chars().next() {
        Some(first) if word(first) => text.find(|char| !word(char)).unwrap_or(text.len()),
        Some(first) => {
            if text.starts_with("///") {
                return "///";
            }
            let two = SIGNS.iter().any(|sign| text.starts_with(sign));
            if two { 2 } else { first.len_utf8() }
        }
        None => 0,
    };
    text.get(..end).unwrap_or_default()
}
