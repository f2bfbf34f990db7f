//! The first look at a text: brackets, strings and comments.
//!
//! Everything behind this step may rely on balanced brackets, closed strings and a bounded depth.

mod chain;

use super::{MAX_BRACKETS, MAX_PROBLEMS, span};
use crate::problem::{Code, Problem};
use crate::source::FileId;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

use chain::Chain;

/// What the first look finds.
pub(super) struct Scan<'t> {
    /// The text with its brackets and strings mended. Offsets agree with the author's text as far as that goes.
    pub(super) text: Cow<'t, str>,
    /// Comments, in order.
    pub(super) comments: Vec<Range<usize>>,
    /// Where a problem has been told already, so that what follows from it is not told again.
    pub(super) told: Vec<Range<usize>>,
    /// What is wrong.
    pub(super) problems: Vec<Problem>,
}

/// Looks at a text.
pub(super) fn scan(text: &str, file: FileId) -> Scan<'_> {
    // Indentation decides only where brackets don't agree without it.
    let plain = look(text, file, false);
    let Scanner { mends, tail, mut scan, .. } =
        if plain.scan.problems.is_empty() { plain } else { look(text, file, true) };
    if !mends.is_empty() || !tail.is_empty() {
        let mended = mended(text, &mends, &tail);
        if look(&mended, file, false).scan.problems.is_empty() {
            scan.text = Cow::Owned(mended);
        } else {
            // Mending went astray: what the brackets hold can't be known.
            scan.text = Cow::Borrowed("");
            scan.told.push(0..usize::MAX);
        }
    }
    scan
}

fn look(text: &str, file: FileId, by_indent: bool) -> Scanner<'_> {
    let mut scanner = Scanner {
        bytes: text.as_bytes(),
        file,
        by_indent,
        open: Vec::new(),
        deep: None,
        mends: BTreeMap::new(),
        tail: String::new(),
        line_start: true,
        line_from: 0,
        indent: 0,
        skips: Vec::new(),
        chain: Chain::default(),
        chunk: 0,
        lost: Vec::new(),
        scan: Scan { text: Cow::Borrowed(text), comments: Vec::new(), told: Vec::new(), problems: Vec::new() },
    };
    scanner.run(text);
    scanner
}

/// The text with bytes replaced (ASCII by ASCII) and the missing end added.
fn mended(text: &str, mends: &BTreeMap<usize, u8>, tail: &str) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for (at, byte) in mends {
        if let Some(slot) = bytes.get_mut(*at).filter(|slot| slot.is_ascii()) {
            *slot = *byte;
        }
    }
    let mut text = String::from_utf8(bytes).unwrap_or_else(|_| text.to_owned());
    text.push_str(tail);
    text
}

/// A bracket that is open.
struct Open {
    at: usize,
    byte: u8,
    /// The indentation of its line.
    indent: usize,
    /// What nests around it.
    chain: Chain,
}

/// A part of the text that no bracket may be written into.
struct Skip {
    range: Range<usize>,
    /// Whether it goes on to the end of its line, which it needs.
    line: bool,
}

struct Scanner<'t> {
    bytes: &'t [u8],
    file: FileId,
    /// Whether indentation tells which bracket is meant.
    by_indent: bool,
    open: Vec<Open>,
    /// Where a group that is too deep begins and how many brackets are open in it.
    deep: Option<(usize, usize)>,
    /// Bytes to be replaced.
    mends: BTreeMap<usize, u8>,
    tail: String,
    /// Only blanks stand before here on this line.
    line_start: bool,
    /// Where this line begins.
    line_from: usize,
    indent: usize,
    /// Strings and comments, in order.
    skips: Vec<Skip>,
    chain: Chain,
    /// Where the item under way begins.
    chunk: usize,
    /// From where on nothing more is told about the item under way, as its brackets are lost.
    lost: Vec<usize>,
    scan: Scan<'t>,
}

impl Scanner<'_> {
    fn run(&mut self, text: &str) {
        let mut at = 0;
        while let Some(&byte) = self.bytes.get(at) {
            let rest = self.bytes.get(at..).unwrap_or_default();
            let next = match byte {
                b'\n' => {
                    self.line_start = true;
                    self.indent = 0;
                    at += 1;
                    self.line_from = at;
                    continue;
                }
                b' ' | b'\t' if self.line_start => {
                    self.indent += 1;
                    at += 1;
                    continue;
                }
                b'/' if rest.starts_with(b"//") => self.line_comment(at),
                b'/' if rest.starts_with(b"/*") => self.block_comment(at, text),
                b'"' if rest.starts_with(b"\"\"\"") => self.raw_string(at, text),
                b'"' => self.string(at),
                b'(' | b'[' | b'{' => self.opening(at, byte),
                b')' | b']' | b'}' => self.closing(at, byte),
                b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'_' => {
                    if self.line_start && self.indent == 0 {
                        self.left_edge(at, rest);
                    }
                    let word = rest.split(|byte| !byte.is_ascii_alphanumeric() && *byte != b'_').next();
                    self.word(at, word.unwrap_or_default())
                }
                _ => self.sign(at, byte, rest),
            };
            self.line_start = false;
            at = next;
        }
        self.finish();
    }

    /// A word at the left edge may begin an item.
    fn left_edge(&mut self, at: usize, rest: &[u8]) {
        let only_item = begins_item(rest);
        if only_item {
            self.close_all(at);
        }
        if only_item || (self.open.is_empty() && rest.starts_with(b"reward ")) {
            self.end_chunk(at);
        }
    }

    /// An item ends: nothing more is told about it behind a lost bracket.
    fn end_chunk(&mut self, at: usize) {
        self.chunk = at;
        let lost = self.lost.drain(..).min();
        self.scan.told.extend(lost.map(|from| from..at));
    }

    fn find(&self, from: usize, what: &[u8]) -> Option<usize> {
        let rest = self.bytes.get(from..)?;
        rest.windows(what.len()).position(|window| window == what).map(|i| from + i)
    }

    fn line_comment(&mut self, at: usize) -> usize {
        let end = self.find(at, b"\n").unwrap_or(self.bytes.len());
        let rest = self.bytes.get(at..end).unwrap_or_default();
        if !rest.starts_with(b"///") || rest.starts_with(b"////") {
            self.scan.comments.push(at..end);
        }
        self.skips.push(Skip { range: at..end, line: true });
        end
    }

    fn block_comment(&mut self, at: usize, text: &str) -> usize {
        let end = if let Some(end) = self.find(at + 2, b"*/") {
            end + 2
        } else {
            self.problem(
                at,
                2,
                Code::UnclosedBracket,
                "this comment is not closed",
                "opened here",
                "close it with `*/`",
            );
            self.scan.told.push(at..usize::MAX);
            self.tail.push_str("*/");
            self.lost.push(self.chunk);
            text.len()
        };
        self.skips.push(Skip { range: at..end, line: false });
        self.scan.comments.push(at..end);
        end
    }

    fn raw_string(&mut self, at: usize, text: &str) -> usize {
        if let Some(end) = self.find(at + 3, b"\"\"\"") {
            self.skips.push(Skip { range: at..end + 3, line: false });
            return end + 3;
        }
        self.lost.push(self.chunk);
        self.problem(at, 3, Code::UnclosedString, "this script is not closed", "opened here", "close it with `\"\"\"`");
        self.scan.told.push(at..usize::MAX);
        self.tail.push_str("\"\"\"");
        text.len()
    }

    fn string(&mut self, at: usize) -> usize {
        let mut end = at + 1;
        loop {
            match self.bytes.get(end) {
                Some(b'"') => {
                    self.skips.push(Skip { range: at..end + 1, line: false });
                    return end + 1;
                }
                Some(b'\\') if matches!(self.bytes.get(end + 1), Some(b'"' | b'\\')) => end += 2,
                Some(b'\n') | None => break,
                Some(_) => end += 1,
            }
        }
        self.problem(
            at,
            1,
            Code::UnclosedString,
            "this string is not closed",
            "opened here",
            "close it with `\"` on its line",
        );
        self.skips.push(Skip { range: at..end, line: true });
        self.scan.told.push(self.line_from..end + 1);
        if self.bytes.get(at..end).is_some_and(|text| text.iter().any(|byte| b"(){}[]".contains(byte))) {
            // The quote that is missing stands further left: this swallows brackets.
            self.lost.push(self.chunk);
        }
        if end < self.bytes.len() {
            self.mends.insert(end, b'"');
            self.line_start = true;
            self.line_from = end + 1;
        } else {
            self.tail.push('"');
        }
        end + 1
    }

    fn opening(&mut self, at: usize, byte: u8) -> usize {
        if let Some((_, count)) = &mut self.deep {
            *count += 1;
            self.mends.insert(at, b' ');
        } else if self.open.len() >= MAX_BRACKETS {
            self.problem(
                at,
                1,
                Code::TooDeep,
                &format!("brackets are nested more than {MAX_BRACKETS} deep"),
                "one too many",
                "give parts of it names with `let` or `fn`",
            );
            self.deep = Some((self.open.first().map_or(at, |open| open.at), 1));
            self.mends.insert(at, b' ');
        } else {
            self.open.push(Open { at, byte, indent: self.indent, chain: self.chain });
            if byte == b'{' {
                self.unchain(at, Chain::default());
            }
        }
        at + 1
    }

    fn closing(&mut self, at: usize, byte: u8) -> usize {
        if let Some((from, count)) = &mut self.deep {
            *count -= 1;
            self.mends.insert(at, b' ');
            if *count == 0 {
                let from = *from;
                self.scan.told.push(from..at + 1);
                self.deep = None;
            }
            return at + 1;
        }
        let opening = match byte {
            b')' => b'(',
            b']' => b'[',
            _ => b'{',
        };
        // A `}` that stands further left than the line of the `{` on top closes one further out.
        let dedented = self.by_indent && byte == b'}' && self.line_start;
        let fits = |open: &Open| open.byte == opening && !(dedented && open.indent > self.indent);
        let matching =
            self.open.iter().rposition(fits).or_else(|| self.open.iter().rposition(|open| open.byte == opening));
        // A round bracket does not close anything beyond a block.
        let block = self.open.iter().rposition(|open| open.byte == b'{');
        match matching {
            Some(index) if byte == b'}' || block.is_none_or(|block| index > block) => {
                while self.open.len() > index + 1 {
                    self.unclosed(at, Some(at));
                }
                if let Some(open) = self.open.pop() {
                    self.unchain(at, if byte == b'}' { Chain::default() } else { open.chain });
                }
            }
            _ => {
                let closer = byte as char;
                let (message, label) = (format!("nothing is open that this `{closer}` closes"), "no opening bracket");
                self.problem(at, 1, Code::Syntax, &message, label, &format!("take the `{closer}` away"));
                self.mends.insert(at, b' ');
                if byte == b'}' {
                    self.lost.push(self.chunk);
                } else {
                    self.scan.told.push(self.line_from..at + 1);
                }
            }
        }
        at + 1
    }

    /// A new item begins at the left edge: whatever is open was forgotten.
    fn close_all(&mut self, at: usize) {
        while !self.open.is_empty() {
            self.unclosed(at, None);
        }
    }

    /// Reports and mends the innermost open bracket, which should have been closed before `at`.
    fn unclosed(&mut self, at: usize, closer: Option<usize>) {
        let Some(open) = self.open.pop() else { return };
        let (opener, wanted) = match open.byte {
            b'(' => ('(', b')'),
            b'[' => ('[', b']'),
            _ => ('{', b'}'),
        };
        let end = if open.byte == b'{' { self.blank_before(at, open.at) } else { self.line_end(open.at, at) };
        self.scan.told.push(open.at..at + 1);
        if open.byte == b'{' {
            self.lost.push(open.at);
        }
        self.unchain(at, if open.byte == b'{' { Chain::default() } else { open.chain });
        match end {
            Some(end) => self.mends.insert(end, wanted),
            // No blank to write the bracket into: take the opening one away.
            None => self.mends.insert(open.at, b' '),
        };
        if self.scan.problems.len() >= MAX_PROBLEMS {
            return;
        }
        let mut problem = Problem::new(
            Code::UnclosedBracket,
            span(self.file, open.at, open.at + 1),
            format!("this `{opener}` is not closed"),
            "opened here",
        )
        .help(format!("close it with `{}`", wanted as char));
        if let Some(closer) = closer {
            let text = self.bytes.get(closer).map_or(' ', |byte| *byte as char);
            problem =
                problem.label(span(self.file, closer, closer + 1), format!("this `{text}` belongs to another bracket"));
        }
        self.scan.problems.push(problem);
    }

    /// The last unused newline or blank before `at`.
    fn blank_before(&self, at: usize, after: usize) -> Option<usize> {
        let range = self.bytes.get(after..at)?;
        (0..range.len()).rev().take(4096).map(|i| after + i).find(|i| self.is_free(*i))
    }

    /// The end of the line of `from`.
    fn line_end(&self, from: usize, before: usize) -> Option<usize> {
        let end = from + self.bytes.get(from..before)?.iter().position(|byte| *byte == b'\n')?;
        let end = match self.skip_at(end) {
            Some(skip) if skip.line && skip.range.start > from => skip.range.start.saturating_sub(1),
            _ => end,
        };
        self.is_free(end).then_some(end)
    }

    /// Whether a bracket may be written over this byte: an unused blank outside of strings and comments.
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

    fn finish(&mut self) {
        if let Some((from, _)) = self.deep.take() {
            self.scan.told.push(from..usize::MAX);
        } else if let Some(open) = self.open.last() {
            // Only the innermost is told: closing it may close the others' gap too.
            let opener = open.byte as char;
            let wanted = match open.byte {
                b'(' => ')',
                b'[' => ']',
                _ => '}',
            };
            let (at, message) = (open.at, format!("this `{opener}` is not closed"));
            self.problem(at, 1, Code::UnclosedBracket, &message, "opened here", &format!("close it with `{wanted}`"));
            self.scan.told.push(at..usize::MAX);
        }
        self.unchain(self.bytes.len(), Chain::default());
        self.end_chunk(usize::MAX);
        if !self.open.is_empty() {
            // A comment without a newline at the end would swallow the brackets.
            self.tail.push('\n');
        }
        while let Some(open) = self.open.pop() {
            self.tail.push(match open.byte {
                b'(' => ')',
                b'[' => ']',
                _ => '}',
            });
        }
    }

    fn problem(&mut self, at: usize, len: usize, code: Code, message: &str, label: &str, help: &str) {
        if self.scan.problems.len() < MAX_PROBLEMS {
            self.scan.problems.push(Problem::new(code, span(self.file, at, at + len), message, label).help(help));
        }
    }
}

/// Whether a word that can only begin an item stands here.
fn begins_item(rest: &[u8]) -> bool {
    ["scenario ", "abstract scenario ", "formation ", "import ", "behavior "]
        .iter()
        .any(|word| rest.starts_with(word.as_bytes()))
}
