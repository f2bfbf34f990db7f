//! Where a bracket or a text in quotes that is left open may end.

use super::text::{code, line_around};
use std::ops::Range;

/// In how many lines behind an open brace its end is looked for.
const LINES: usize = 400;

/// Where what is opened at a byte may be closed, the likeliest place first, and what is written
/// there. The author's own lines stay as they are.
pub(super) fn closings(text: &str, opened: usize) -> Vec<(usize, String)> {
    let rest = text.get(opened..).unwrap_or_default();
    let line = line_around(text, opened);
    let (sign, is_block) = match rest.as_bytes().first() {
        Some(b'(') => (")", false),
        Some(b'[') => ("]", false),
        Some(b'{') => ("}", true),
        Some(b'"') if rest.starts_with("\"\"\"") => return Vec::new(),
        Some(b'"') => ("\"", false),
        _ => return Vec::new(),
    };
    if sign == "\"" {
        let words = text.get(opened..line.end).unwrap_or_default().split(' ');
        let ends = words.scan(opened, |at, word| {
            let end = *at + word.trim_end().len();
            *at += word.len() + 1;
            (end > opened + 1 && !word.trim().is_empty()).then_some(end).map(Some).or(Some(None))
        });
        let mut found: Vec<_> = ends.flatten().map(|at| (at, sign.to_owned())).collect();
        found.reverse();
        return found;
    }
    let mut found: Vec<(usize, String)> = Vec::new();
    if is_block && ends_its_line(text, &line, opened) {
        let (at, indent) = block_end(text, &line);
        let is_first = text.get(..at).is_none_or(|it| it.ends_with('\n'));
        found.push((at, format!("{}{indent}}}\n", if is_first { "" } else { "\n" })));
    }
    // Behind any word of the line, the last first.
    let ends = word_ends(text, opened + 1..line.end);
    found.extend(ends.into_iter().rev().map(|at| (at, sign.to_owned())));
    found
}

/// Whether nothing but blanks and comments stands behind an opening brace in its line.
fn ends_its_line(text: &str, line: &Range<usize>, opened: usize) -> bool {
    let inside = text.get(line.clone()).unwrap_or_default();
    let behind = |at: usize| line.start + at > opened;
    !code(inside).any(|(at, sign)| behind(at) && !sign.is_whitespace())
}

/// Where the lines that stand deeper than this one end, and the blanks before it.
fn block_end<'t>(text: &'t str, line: &Range<usize>) -> (usize, &'t str) {
    let blanks = |line: &str| line.len() - line.trim_start().len();
    let head = text.get(line.clone()).unwrap_or_default();
    let indent = head.get(..blanks(head)).unwrap_or_default();
    let mut end = line.end;
    let mut at = line.end;
    for inside in text.get(line.end..).unwrap_or_default().split_inclusive('\n').take(LINES) {
        at += inside.len();
        if inside.trim().is_empty() {
            continue;
        }
        if blanks(inside) <= indent.len() {
            break;
        }
        end = at;
    }
    (end, indent)
}

/// Where the words and signs of some bytes end that are no comment.
fn word_ends(text: &str, within: Range<usize>) -> Vec<usize> {
    let inside = text.get(within.clone()).unwrap_or_default();
    // A comment begins behind the last sign that is code, or ends the text in quotes before it.
    let is_word = |sign: char| sign.is_alphanumeric() || matches!(sign, '_' | '.');
    let signs: Vec<(usize, char)> = code(inside).collect();
    let mut ends = Vec::new();
    for (nth, &(at, sign)) in signs.iter().enumerate() {
        let next = signs.get(nth + 1).map(|&(_, next)| next);
        let goes_on = is_word(sign) && next.is_some_and(is_word);
        if !sign.is_whitespace() && !goes_on {
            ends.push(within.start + at + sign.len_utf8());
        }
    }
    ends
}

#[cfg(test)]
mod tests {
    use super::closings;

    #[test]
    fn a_bracket_closes_in_its_line_and_a_brace_before_what_stands_beside_it() {
        for (text, first) in [
            ("a (b c // d\n e", "a (b c) // d\n e"),
            ("a [b", "a [b]"),
            ("as \"b // c \nd", "as \"b // c\" \nd"),
            ("a {\n    b\n\n    c\n\nd {\n}", "a {\n    b\n\n    c\n}\n\nd {\n}"),
            ("a {\n    b", "a {\n    b\n}\n"),
            ("  a {\n    b\n}", "  a {\n    b\n  }\n}"),
            ("a { b\nc", "a { b}\nc"),
        ] {
            let opened = text.find(['(', '[', '{', '"']).expect("an opening sign");
            let (at, sign) = closings(text, opened).into_iter().next().expect("a place");
            let mut closed = text.to_owned();
            closed.insert_str(at, &sign);
            assert_eq!(closed, first);
        }
        let all: Vec<usize> = closings("f(a.x, 2 < 3 {", 1).iter().map(|it| it.0).collect();
        assert_eq!(all, [14, 12, 10, 8, 6, 5]);
    }
}
