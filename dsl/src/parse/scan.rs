//! The first look at a text: brackets, strings and comments.
//!
//! Everything behind this step may rely on balanced brackets, closed strings and a bounded depth.

mod chain;
mod mend;
mod unopened;

use super::{LEAST_EFFORT, MAX_BRACKETS, MAX_PROBLEMS, MAX_TOKENS, span};
use crate::problem::Problem;
use crate::problem::facts::{Brackets, Fact, Syntax};
use crate::source::FileId;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

use chain::Chain;

/// What the first look finds.
pub(super) struct Scan<'t> {
    /// The text with its brackets and strings mended. Offsets agree with the author's text as far
    /// as that goes.
    pub(super) text: Cow<'t, str>,
    /// Comments, in order.
    pub(super) comments: Vec<Range<usize>>,
    /// Where a problem has been reported already, so that what follows from it is not reported
    /// again.
    pub(super) reported: Vec<Range<usize>>,
    /// What is wrong.
    pub(super) problems: Vec<Problem>,
}

/// Looks at a text.
pub(super) fn scan(text: &str, file: FileId) -> Scan<'_> {
    // Indentation decides only where brackets don't agree without it.
    let plain = look(text, file, false);
    if let Some(at) = plain.too_much {
        return too_much(at, file);
    }
    let Scanner { mends, tail, mut scan, .. } =
        if plain.scan.problems.is_empty() { plain } else { look(text, file, true) };
    if !mends.is_empty() || !tail.is_empty() {
        let mended = mended(text, &mends, &tail);
        if look(&mended, file, false).scan.problems.is_empty() {
            scan.text = Cow::Owned(mended);
        } else {
            // Mending went astray: what the brackets hold can't be known.
            scan.text = Cow::Borrowed("");
            scan.reported.push(0..usize::MAX);
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
        braces: None,
        skips: Vec::new(),
        chain: Chain::default(),
        chunk: 0,
        lost: Vec::new(),
        cut: false,
        tokens: 0,
        too_much: None,
        effort: LEAST_EFFORT + 2 * text.len(),
        scan: Scan {
            text: Cow::Borrowed(text),
            comments: Vec::new(),
            reported: Vec::new(),
            problems: Vec::new(),
        },
    };
    scanner.run(text);
    scanner
}

/// What is said of a text with too many words: it is not read.
fn too_much<'t>(at: usize, file: FileId) -> Scan<'t> {
    let problem = Problem::new(span(file, at, at + 1), Syntax::TooManyWords { most: MAX_TOKENS });
    Scan {
        text: Cow::Borrowed(""),
        comments: Vec::new(),
        reported: everything(),
        problems: vec![problem],
    }
}

/// The range of a text of which nothing more is reported.
fn everything() -> Vec<Range<usize>> {
    std::iter::once(0..usize::MAX).collect()
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

impl Open {
    /// The bracket that closes it.
    fn closer(&self) -> u8 {
        match self.byte {
            b'(' => b')',
            b'[' => b']',
            _ => b'}',
        }
    }
}

/// A part of the text that no bracket may be written into.
struct Skip {
    range: Range<usize>,
    /// Whether it goes on to the end of its line, which it needs.
    line: bool,
}

/// The `}` of a line.
struct LineBraces {
    /// From where on they are counted.
    from: usize,
    /// Where the line ends.
    end: usize,
    /// How many there are.
    left: usize,
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
    /// The `}` that are left on this line, if they have been counted.
    braces: Option<LineBraces>,
    /// Strings and comments, in order.
    skips: Vec<Skip>,
    chain: Chain,
    /// Where the item under way begins.
    chunk: usize,
    /// From where on nothing more is reported about the item under way, as its brackets are lost.
    lost: Vec<usize>,
    /// Whether a comment or script that is not closed swallows the rest.
    cut: bool,
    /// Words and signs so far.
    tokens: usize,
    /// The first word that is too many.
    too_much: Option<usize>,
    /// Bytes that may still be looked at again to say what is missing.
    effort: usize,
    scan: Scan<'t>,
}

impl Scanner<'_> {
    fn run(&mut self, text: &str) {
        let mut at = 0;
        while let Some(&byte) = self.bytes.get(at) {
            let rest = self.bytes.get(at..).unwrap_or_default();
            if !byte.is_ascii_whitespace() && !rest.starts_with(b"//") && !rest.starts_with(b"/*") {
                self.tokens += 1;
                if self.tokens > MAX_TOKENS {
                    self.too_much = Some(at);
                    return;
                }
            }
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
                    let word =
                        rest.split(|byte| !byte.is_ascii_alphanumeric() && *byte != b'_').next();
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

    /// Whether so many bytes may be looked at again; takes them from what is left.
    fn spend(&mut self, bytes: usize) -> bool {
        let left = self.effort.checked_sub(bytes + 64);
        self.effort = left.unwrap_or_default();
        left.is_some()
    }

    /// An item ends: nothing more is reported about it behind a lost bracket.
    fn end_chunk(&mut self, at: usize) {
        self.chunk = at;
        let lost = self.lost.drain(..).min();
        self.scan.reported.extend(lost.map(|from| from..at));
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
            self.problem(at, 2, Brackets::UnclosedComment);
            self.scan.reported.push(at..usize::MAX);
            self.tail.push_str("*/");
            self.lost.push(self.chunk);
            self.cut = true;
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
        self.cut = true;
        self.problem(at, 3, Brackets::UnclosedScript);
        self.scan.reported.push(at..usize::MAX);
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
        self.problem(at, 1, Brackets::UnclosedString);
        if let Some(closers) = self.closers_at_end(at..end) {
            // What closes the block on this line was not meant to be words.
            self.mends.insert(closers - 1, b'"');
            self.skips.push(Skip { range: at..closers, line: false });
            self.scan.reported.push(at..closers);
            return closers;
        }
        self.skips.push(Skip { range: at..end, line: true });
        self.scan.reported.push(self.line_from..end + 1);
        if self
            .bytes
            .get(at..end)
            .is_some_and(|text| text.iter().any(|byte| b"(){}[]".contains(byte)))
        {
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

    /// Where the closing brackets at the end of a string that is not closed begin, if they close
    /// what is open.
    fn closers_at_end(&self, string: Range<usize>) -> Option<usize> {
        let text = self.bytes.get(string.clone())?;
        let words = text.iter().rposition(|byte| !b")]} \t\r,;".contains(byte))? + 1;
        let mut open = self.open.iter().rev();
        let closers = text.get(words..)?.iter().filter(|byte| b")]}".contains(byte));
        let fit = closers.map(|closer| open.next().is_some_and(|open| open.closer() == *closer));
        let (count, fit) = fit.fold((0, true), |(count, all), fit| (count + 1, all && fit));
        let last_is_ascii = text.get(words - 1).is_some_and(u8::is_ascii);
        (words > 1 && count > 0 && fit && last_is_ascii).then_some(string.start + words)
    }

    fn opening(&mut self, at: usize, byte: u8) -> usize {
        if let Some((_, count)) = &mut self.deep {
            *count += 1;
            self.mends.insert(at, b' ');
        } else if self.open.len() >= MAX_BRACKETS {
            self.problem(at, 1, Syntax::NestedBrackets { most: MAX_BRACKETS });
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
                self.scan.reported.push(from..at + 1);
                self.deep = None;
            }
            return at + 1;
        }
        // A `}` that stands further left than the line of the `{` on top closes one further out.
        let dedented = self.by_indent && byte == b'}' && self.line_start;
        let fits = |open: &Open| open.closer() == byte && !(dedented && open.indent > self.indent);
        let matching = self
            .open
            .iter()
            .rposition(fits)
            .or_else(|| self.open.iter().rposition(|open| open.closer() == byte));
        // A round bracket does not close anything beyond a block.
        let block = self.open.iter().rposition(|open| open.byte == b'{');
        match matching {
            _ if self.is_wrong_closer(at, byte, matching) => self.wrong_closer(at, byte),
            Some(index) if byte == b'}' || block.is_none_or(|block| index > block) => {
                while self.open.len() > index + 1 {
                    self.unclosed(at, Some(at));
                }
                if let Some(open) = self.open.pop() {
                    self.unchain(at, if byte == b'}' { Chain::default() } else { open.chain });
                }
            }
            _ => self.unopened(at, byte),
        }
        at + 1
    }

    fn problem(&mut self, at: usize, len: usize, fact: impl Into<Fact>) {
        if self.scan.problems.len() < MAX_PROBLEMS {
            self.scan.problems.push(Problem::new(span(self.file, at, at + len), fact));
        }
    }
}

/// Whether a word that can only begin an item stands here.
fn begins_item(rest: &[u8]) -> bool {
    ["scenario ", "abstract scenario ", "formation ", "import ", "behavior "]
        .iter()
        .any(|word| rest.starts_with(word.as_bytes()))
}
