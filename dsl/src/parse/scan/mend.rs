//! Brackets that are not closed, or closed by another's: reported, and mended in the copy that is
//! parsed.

use super::{Chain, LineBraces, Scanner, Skip};
use crate::parse::recover::Context;
use crate::parse::{MAX_PROBLEMS, span};
use crate::problem::Problem;
use crate::problem::facts::Brackets;
use setpiece_scenario::vocabulary::Role;

impl Scanner<'_> {
    /// Whether a closing bracket was written for the innermost open one, which it does not fit.
    pub(super) fn is_wrong_closer(&mut self, at: usize, byte: u8, matching: Option<usize>) -> bool {
        let Some(last) = self.open.last().filter(|open| open.closer() != byte) else {
            return false;
        };
        let (last_byte, last_at, last_indent) = (last.byte, last.at, last.indent);
        match (byte, last_byte) {
            // The braces that this line opened are all that it may close.
            (b'}', b'(' | b'[') => {
                let closed = self.braces_from(at);
                let here = |open: &&super::Open| open.byte == b'{' && open.at >= self.line_from;
                let opened = self.open.iter().filter(here).count();
                last_at >= self.line_from && closed > opened && !self.line_start
            }
            (b'}', _) => false,
            (_, b'{') => self.line_start && last_indent == self.indent,
            _ => {
                let block = self.open.iter().rposition(|open| open.byte == b'{');
                matching.is_none_or(|index| block.is_some_and(|block| index < block))
            }
        }
    }

    /// How many `}` stand on this line from here on. Each line is counted once.
    fn braces_from(&mut self, at: usize) -> usize {
        let braces = |bytes: &[u8]| bytes.split(|byte| *byte == b'}').count() - 1;
        let known = self.braces.take().filter(|known| known.from <= at && at < known.end);
        let (end, left) = if let Some(known) = known {
            let passed = self.bytes.get(known.from..at).map_or(0, braces);
            (known.end, known.left.saturating_sub(passed))
        } else {
            let rest = self.bytes.get(at..).unwrap_or_default();
            let line = rest.split(|byte| *byte == b'\n').next().unwrap_or_default();
            (at + line.len(), braces(line))
        };
        self.braces = Some(LineBraces { from: at, end, left });
        left
    }

    /// Reports and mends a bracket that closes another.
    pub(super) fn wrong_closer(&mut self, at: usize, byte: u8) {
        let Some(open) = self.open.pop() else { return };
        let (opener, wanted) = (open.byte as char, open.closer());
        self.mends.insert(at, wanted);
        self.unchain(at, if open.byte == b'{' { Chain::default() } else { open.chain });
        if self.scan.problems.len() < MAX_PROBLEMS {
            let (closer, wanted, opened) =
                (byte as char, wanted as char, span(self.file, open.at, open.at + 1));
            let fact = Brackets::WrongCloser { closer, opener, wanted, opened };
            self.scan.problems.push(Problem::new(span(self.file, at, at + 1), fact));
        }
    }

    /// A new item begins at the left edge: whatever is open was forgotten.
    pub(super) fn close_all(&mut self, at: usize) {
        while !self.open.is_empty() {
            self.unclosed(at, None);
        }
    }

    /// Reports and mends the innermost open bracket, which should have been closed before `at`.
    pub(super) fn unclosed(&mut self, at: usize, closer: Option<usize>) {
        let Some(open) = self.open.pop() else { return };
        let (opener, wanted) = (open.byte as char, open.closer());
        // To tell a statement from the rest of one takes many times as long as to see a byte.
        let look = open.byte != b'{' && self.spend(8 * (at - open.at));
        let line = if look { self.line_end(open.at, at) } else { None };
        let end = line.or_else(|| self.blank_before(at, open.at));
        // Behind the line that was mended everything is read as it stands.
        self.scan.reported.push(open.at..line.unwrap_or(at) + 1);
        if open.byte == b'{' {
            self.lost.push(open.at);
        }
        self.unchain(at, if open.byte == b'{' { Chain::default() } else { open.chain });
        match end {
            Some(end) => self.mends.insert(end, wanted),
            // No blank to write the bracket into: take the opening one away.
            None => self.mends.insert(open.at, b' '),
        };
        let closer = closer.map(|at| {
            let closer = self.bytes.get(at).map_or(' ', |byte| *byte as char);
            (closer, span(self.file, at, at + 1))
        });
        self.problem(open.at, 1, Brackets::Unclosed { opener, wanted: wanted as char, closer });
    }

    /// The last unused newline or blank before `at`.
    fn blank_before(&self, at: usize, after: usize) -> Option<usize> {
        let range = self.bytes.get(after..at)?;
        (0..range.len()).rev().take(4096).map(|i| after + i).find(|i| self.is_free(*i))
    }

    /// The end of the first line from `from` on behind which a statement begins; else of the line
    /// of `from`.
    fn line_end(&self, from: usize, before: usize) -> Option<usize> {
        let range = self.bytes.get(from..before)?;
        let mut ends =
            range.iter().enumerate().filter(|(_, byte)| **byte == b'\n').map(|(end, _)| from + end);
        let first = ends.clone().next()?;
        let end = ends
            .find(|end| self.bytes.get(end + 1..before).is_none_or(begins_statement))
            .unwrap_or(first);
        let end = match self.skip_at(end) {
            Some(skip) if skip.line && skip.range.start > from => {
                skip.range.start.saturating_sub(1)
            }
            _ => end,
        };
        self.is_free(end).then_some(end)
    }

    /// Whether a bracket may be written over this byte: an unused blank outside of strings and
    /// comments.
    fn is_free(&self, at: usize) -> bool {
        self.bytes.get(at).is_some_and(u8::is_ascii_whitespace)
            && !self.mends.contains_key(&at)
            && self.skip_at(at).is_none()
    }

    /// The string or comment that holds this byte or needs it as its end.
    fn skip_at(&self, at: usize) -> Option<&Skip> {
        let index = self.skips.partition_point(|skip| skip.range.end < at);
        let holds = |skip: &&Skip| skip.range.contains(&at) || (skip.line && skip.range.end == at);
        self.skips.get(index..)?.iter().take(2).find(holds)
    }

    pub(super) fn finish(&mut self) {
        if let Some((from, _)) = self.deep.take() {
            self.scan.reported.push(from..usize::MAX);
        } else if let Some(open) = self.open.last().filter(|_| !self.cut) {
            // Only the innermost is reported: closing it may close the others' gap too.
            let (at, opener, wanted) = (open.at, open.byte as char, open.closer() as char);
            self.problem(at, 1, Brackets::Unclosed { opener, wanted, closer: None });
            self.scan.reported.push(at..usize::MAX);
        }
        self.unchain(self.bytes.len(), Chain::default());
        self.end_chunk(usize::MAX);
        if !self.open.is_empty() {
            // A comment without a newline at the end would swallow the brackets.
            self.tail.push('\n');
        }
        while let Some(open) = self.open.pop() {
            self.tail.push(open.closer() as char);
        }
    }
}

/// Whether a line begins a statement, or ends its list.
fn begins_statement(line: &[u8]) -> bool {
    let line = line.trim_ascii_start();
    let word = line
        .split(|byte| !byte.is_ascii_alphanumeric() && *byte != b'_')
        .next()
        .unwrap_or_default();
    let Ok(word) = str::from_utf8(word) else { return false };
    let keyword = Context::ALL.iter().any(|context| context.keywords().contains(&word));
    let placed = line
        .get(word.len()..)
        .is_some_and(|rest| rest.starts_with(b" at ") || rest.starts_with(b" in "));
    line.is_empty()
        || line.starts_with(b"}")
        || keyword
        || placed
        || Role::from_name(word).is_some()
}
