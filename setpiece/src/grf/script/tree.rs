//! The blocks of a script: a line and the deeper lines below it.

use super::lines::{PyLine, PyToken};
use std::ops::Range;

/// How deep blocks are found; deeper lines belong to the block around.
const DEPTH_MAX: usize = 40;

/// A line with its block.
#[derive(Debug)]
pub(super) struct PyNode<'t> {
    /// The line.
    pub(super) line: PyLine<'t>,
    /// The lines below it that stand deeper.
    pub(super) body: Vec<PyNode<'t>>,
}

impl<'t> PyNode<'t> {
    /// The blocks of some lines, without comments.
    pub(super) fn all(lines: Vec<PyLine<'t>>) -> Vec<PyNode<'t>> {
        let mut lines = lines.into_iter().filter(|line| !line.tokens.is_empty()).peekable();
        PyNode::block(&mut lines, 0, 0)
    }

    fn block(
        lines: &mut std::iter::Peekable<impl Iterator<Item = PyLine<'t>>>,
        indent: usize,
        depth: usize,
    ) -> Vec<PyNode<'t>> {
        let mut nodes: Vec<PyNode<'t>> = Vec::new();
        while let Some(line) = lines.next_if(|line| line.indent >= indent || depth == 0) {
            let deeper = line.indent + 1;
            let goes_down = depth < DEPTH_MAX && lines.peek().is_some_and(|it| it.indent >= deeper);
            let body = if goes_down { PyNode::block(lines, deeper, depth + 1) } else { Vec::new() };
            nodes.push(PyNode { line, body });
        }
        nodes
    }

    /// The bytes of the line and its block.
    pub(super) fn range(&self) -> Range<usize> {
        let end = self.body.last().map_or(self.line.range.end, |last| last.range().end);
        self.line.range.start..end
    }

    /// What stands before the colon of a compound statement, and what behind it in the line.
    pub(super) fn parts(&self) -> (&[PyToken<'t>], &[PyToken<'t>]) {
        let tokens = self.line.tokens.as_slice();
        match top_level(tokens).find(|(_, token)| **token == PyToken::Sign(":")) {
            Some((at, _)) => {
                let (head, rest) = tokens.split_at(at);
                (head, rest.get(1..).unwrap_or_default())
            }
            None => (tokens, &[]),
        }
    }

    /// Every token of the line and its block.
    pub(super) fn tokens(&self) -> Vec<PyToken<'t>> {
        let mut tokens = self.line.tokens.clone();
        for node in &self.body {
            // Between two statements, so that none goes on in the next.
            tokens.push(PyToken::Sign(";"));
            tokens.extend(node.tokens());
        }
        tokens
    }
}

/// The tokens outside of brackets, with their indices.
pub(super) fn top_level<'a, 't>(
    tokens: &'a [PyToken<'t>],
) -> impl Iterator<Item = (usize, &'a PyToken<'t>)> {
    let mut open = 0_usize;
    tokens.iter().enumerate().filter(move |(_, token)| {
        match token {
            PyToken::Sign("(" | "[" | "{") => open += 1,
            PyToken::Sign(")" | "]" | "}") => {
                open = open.saturating_sub(1);
                return false;
            }
            _ => {}
        }
        open == 0
    })
}

/// The parts between a sign that stands outside of brackets.
pub(super) fn split<'a, 't>(tokens: &'a [PyToken<'t>], sign: &str) -> Vec<&'a [PyToken<'t>]> {
    let (mut parts, mut from) = (Vec::new(), 0);
    for (at, _) in top_level(tokens).filter(|(_, token)| **token == PyToken::Sign(sign)) {
        parts.extend(tokens.get(from..at));
        from = at + 1;
    }
    parts.extend(tokens.get(from..));
    parts
}
