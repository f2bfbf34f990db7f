//! Closing brackets that nothing opens: the bracket that is missing, where it is known.

use super::Scanner;
use crate::parse::span;
use crate::problem::facts::Brackets;
use std::ops::Range;

impl Scanner<'_> {
    /// Reports and mends a closing bracket that nothing opens.
    pub(super) fn unopened(&mut self, at: usize, byte: u8) {
        if byte == b'}'
            && self.spend(at - self.chunk)
            && let Some((head, slot)) = self.head_without_brace(at)
        {
            self.mends.insert(slot, b'{');
            self.missing_brace(head, at);
            return;
        }
        let near = self.spend(at - self.line_from);
        let point = if near { self.point_without_bracket(at) } else { None };
        self.problem(at, 1, Brackets::Unopened { closer: byte as char, point });
        self.mends.insert(at, b' ');
        if byte == b'}' {
            self.lost.push(self.chunk);
        } else {
            self.scan.reported.push(self.line_from..at + 1);
        }
    }

    fn missing_brace(&mut self, head: Range<usize>, closer: usize) {
        let text = self
            .bytes
            .get(head.clone())
            .map(String::from_utf8_lossy)
            .unwrap_or_default()
            .into_owned();
        let closer = span(self.file, closer, closer + 1);
        self.problem(head.start, head.len(), Brackets::NoBrace { head: text, closer });
    }

    /// The last line before `at` that begins a body and does not open it, and the blank behind it.
    fn head_without_brace(&self, at: usize) -> Option<(Range<usize>, usize)> {
        let mut from = self.chunk;
        let mut found = None;
        for line in self.bytes.get(self.chunk..at)?.split_inclusive(|byte| *byte == b'\n') {
            let (start, end) = (from, from + line.len());
            from = end;
            let code = line.split(|byte| *byte == b'/').next().unwrap_or_default().trim_ascii_end();
            let words = code.trim_ascii_start();
            let head = start + code.len() - words.len()..start + code.len();
            let rest = self.bytes.get(end..at).unwrap_or_default().trim_ascii_start();
            if begins_body(words, rest) && !rest.starts_with(b"{") && !code.contains(&b'{') {
                let slot = head.end;
                let free = self.bytes.get(slot).is_some_and(u8::is_ascii_whitespace)
                    && !self.mends.contains_key(&slot);
                found = free.then_some((head, slot)).or(found);
            }
        }
        found
    }

    /// `at -0.1, 0)`: the bracket that is missing stands behind `at`.
    fn point_without_bracket(&self, at: usize) -> Option<(String, String)> {
        let line = str::from_utf8(self.bytes.get(self.line_from..at)?).ok()?;
        let (_, point) = line.rsplit_once(" at ")?;
        let (x, y) = point.split_once(',')?;
        let number = |text: &str| {
            let text = text.trim().trim_start_matches('-').trim_end_matches('m');
            !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.')
        };
        (number(x) && number(y)).then(|| (x.trim().to_owned(), y.trim().to_owned()))
    }
}

/// Whether a line begins what has a body between braces, and has nothing else; `rest` is what
/// follows it.
fn begins_body(line: &[u8], rest: &[u8]) -> bool {
    let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    let (first, second, third) = (words.next(), words.next(), words.next());
    match first {
        Some(b"scenario" | b"abstract") => second.is_some(),
        Some(b"team") => matches!(second, Some(b"left" | b"right")) && third.is_none(),
        Some(b"behavior" | b"formation") => second.is_some() && !line.contains(&b'='),
        // A scenario names its rewards like that; statements of a reward tell that a body was
        // meant.
        Some(b"reward") => {
            [&b"give "[..], b"on ", b"state "].iter().any(|word| rest.starts_with(word))
        }
        Some(b"rules" | b"world" | b"pitch" | b"agents") => second.is_none(),
        _ => false,
    }
}
