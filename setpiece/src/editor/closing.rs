//! Where a bracket or a text in quotes that is left open may end.

use super::text::{code, line_around};
use std::ops::Range;

/// In how many lines behind an open bracket its end is looked for.
const LINES: usize = 400;

/// Where what is opened at a byte may be closed, the likeliest place first, and what is written
/// there: also the ends of other brackets of its line that are open there. The author's own lines
/// stay as they are.
pub(super) fn closings(text: &str, opened: usize) -> Vec<(usize, String)> {
    let rest = text.get(opened..).unwrap_or_default();
    let line = line_around(text, opened);
    match rest.as_bytes().first() {
        Some(b'"') if rest.starts_with("\"\"\"") => Vec::new(),
        Some(b'"') => quotes(text, opened, line.end),
        Some(b'(' | b'[') => brackets(text, opened, &line),
        Some(b'{') => blocks(text, opened, &line),
        _ => Vec::new(),
    }
}

/// Behind any word of its line, the last first.
fn quotes(text: &str, opened: usize, end: usize) -> Vec<(usize, String)> {
    let mut at = opened;
    let mut found = Vec::new();
    for word in text.get(opened..end).unwrap_or_default().split(' ') {
        let end = at + word.trim_end().len();
        if end > opened + 1 && !word.trim().is_empty() {
            found.push((end, "\"".to_owned()));
        }
        at += word.len() + 1;
    }
    found.reverse();
    found
}

/// At the end of its line or of the deeper lines behind it, or behind any word of its line.
fn brackets(text: &str, opened: usize, line: &Range<usize>) -> Vec<(usize, String)> {
    let ends = word_ends(text, opened + 1..line.end);
    let deeper = word_ends(text, line.end..block_end(text, line).0);
    let of_lines = deeper.iter().rev().filter(|end| {
        text.get(**end..).is_some_and(|behind| {
            let behind = behind.split('\n').next().unwrap_or_default();
            code(behind).all(|(_, sign)| sign.is_whitespace())
        })
    });
    let last = ends.last().into_iter();
    let places = last.chain(of_lines).chain(ends.iter().rev().skip(1));
    places.filter_map(|at| Some((*at, missing(text, line.start..*at, opened)?))).collect()
}

/// The ends of the round and square brackets that are open at the end of some bytes, above every
/// brace; none if the one of a byte isn't among them.
fn missing(text: &str, within: Range<usize>, opened: usize) -> Option<String> {
    let mut open: Vec<(usize, char)> = Vec::new();
    for (at, sign) in code(text.get(within.clone())?) {
        match sign {
            '(' => open.push((within.start + at, ')')),
            '[' => open.push((within.start + at, ']')),
            '{' => open.clear(),
            ')' | ']' if open.last().is_some_and(|(_, end)| *end == sign) => {
                open.pop();
            }
            '}' => return None,
            _ => {}
        }
    }
    let is_open = open.iter().any(|(at, _)| *at == opened);
    is_open.then(|| open.iter().rev().map(|(_, end)| *end).collect())
}

/// Behind the lines that stand deeper than its own; with all blocks that are open at the end of the
/// text; or behind any word of its line.
fn blocks(text: &str, opened: usize, line: &Range<usize>) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    if ends_its_line(text, line, opened) {
        let newline = if text.get(line.clone()).is_some_and(|it| it.ends_with("\r\n")) {
            "\r\n"
        } else {
            "\n"
        };
        let (at, indent) = block_end(text, line);
        let before = |at: usize| match text.get(..at) {
            Some(it) if it.ends_with('\n') => "",
            _ => newline,
        };
        found.push((at, format!("{}{indent}}}{newline}", before(at))));
        let end = text.trim_end().len();
        let behind =
            text.get(end..).and_then(|it| it.find('\n')).map_or(text.len(), |it| end + it + 1);
        let closed: String = open_blocks(text)
            .into_iter()
            .rev()
            .map(|open| format!("{}}}{newline}", indent_of(text, &line_around(text, open))))
            .collect();
        found.push((behind, format!("{}{closed}", before(behind))));
    }
    let ends = word_ends(text, opened + 1..line.end);
    found.extend(ends.into_iter().rev().map(|at| (at, " }".to_owned())));
    found
}

/// The braces that are open at the end of a text.
fn open_blocks(text: &str) -> Vec<usize> {
    let mut open = Vec::new();
    for (at, sign) in code(text) {
        match sign {
            '{' => open.push(at),
            '}' => {
                open.pop();
            }
            _ => {}
        }
    }
    open
}

/// Whether nothing but blanks and comments stands behind an opening brace in its line.
fn ends_its_line(text: &str, line: &Range<usize>, opened: usize) -> bool {
    let inside = text.get(line.clone()).unwrap_or_default();
    let behind = |at: usize| line.start + at > opened;
    !code(inside).any(|(at, sign)| behind(at) && !sign.is_whitespace())
}

/// The blanks before a line.
fn indent_of<'t>(text: &'t str, line: &Range<usize>) -> &'t str {
    let line = text.get(line.clone()).unwrap_or_default();
    line.get(..line.len() - line.trim_start().len()).unwrap_or_default()
}

/// Where the lines that stand deeper than this one end, and the blanks before it.
fn block_end<'t>(text: &'t str, line: &Range<usize>) -> (usize, &'t str) {
    let indent = indent_of(text, line);
    let (mut end, mut at) = (line.end, line.end);
    for inside in text.get(line.end..).unwrap_or_default().split_inclusive('\n').take(LINES) {
        let own = at..at + inside.len();
        at = own.end;
        if inside.trim().is_empty() {
            continue;
        }
        if indent_of(text, &own).len() <= indent.len() {
            break;
        }
        end = own.end;
    }
    (end, indent)
}

/// Where the words and signs of some bytes end that are no comment.
fn word_ends(text: &str, within: Range<usize>) -> Vec<usize> {
    let inside = text.get(within.clone()).unwrap_or_default();
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
            ("a [f(b", "a [f(b)]"),
            ("as \"b // c \nd", "as \"b // c\" \nd"),
            ("a {\n    b\n\n    c\n\nd {\n}", "a {\n    b\n\n    c\n}\n\nd {\n}"),
            ("a {\r\n    b\r\n", "a {\r\n    b\r\n}\r\n"),
            ("a {\n    b", "a {\n    b\n}\n"),
            ("  a {\n    b\n}", "  a {\n    b\n  }\n}"),
            ("a { b\nc", "a { b }\nc"),
        ] {
            let opened = text.find(['(', '[', '{', '"']).expect("an opening sign");
            let (at, sign) = closings(text, opened).into_iter().next().expect("a place");
            let mut closed = text.to_owned();
            closed.insert_str(at, &sign);
            assert_eq!(closed, first);
        }
        let all: Vec<usize> = closings("f(a.x, 2 < 3 {", 1).iter().map(|it| it.0).collect();
        assert_eq!(all, [12, 10, 8, 6, 5], "none behind the brace");
        let text = "a {\n    b {\n        c\n";
        let whole =
            closings(text, 2).into_iter().map(|(at, sign)| format!("{}{sign}", &text[..at]));
        assert!(whole.clone().any(|it| it == format!("{text}    }}\n}}\n")), "{whole:?}");
    }
}
