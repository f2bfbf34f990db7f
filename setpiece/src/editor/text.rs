//! Places in a text as editors count them: lines, and columns in UTF-16 units, both from 0.

use std::ops::Range;

/// A place between two characters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// The line, from 0.
    pub line: u32,
    /// The column in UTF-16 units, from 0.
    pub column: u32,
}

/// Where the lines of a text begin.
#[derive(Clone, Debug)]
pub struct Lines {
    starts: Vec<usize>,
}

impl Lines {
    /// Those of a text.
    pub fn of(text: &str) -> Lines {
        let ends = text.match_indices('\n').map(|(at, _)| at + 1);
        Lines { starts: std::iter::once(0).chain(ends).collect() }
    }

    /// The place of a byte of the text; of the text's end if it lies beyond.
    pub fn position(&self, text: &str, offset: usize) -> Position {
        let mut offset = offset.min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        let line = self.starts.partition_point(|start| *start <= offset).saturating_sub(1);
        let start = self.starts.get(line).copied().unwrap_or_default();
        let before = text.get(start..offset).unwrap_or_default();
        Position { line: line as u32, column: before.encode_utf16().count() as u32 }
    }

    /// The byte of a place. Beyond the end of a line it is the line's end, beyond the last line the
    /// text's.
    pub fn offset(&self, text: &str, Position { line, column }: Position) -> usize {
        let Some(&start) = self.starts.get(line as usize) else { return text.len() };
        let rest = text.get(start..).unwrap_or_default();
        let mut units = 0;
        for (at, char) in rest.char_indices() {
            if char == '\n' || (char == '\r' && rest[at..].starts_with("\r\n")) || units >= column {
                return start + at;
            }
            units += char.len_utf16() as u32;
        }
        text.len()
    }
}

/// The word around a byte of a text: letters, digits and underscores.
pub fn word_at(text: &str, offset: usize) -> Range<usize> {
    let is_word = |char: char| char.is_alphanumeric() || char == '_';
    let (before, after) = text.split_at_checked(offset).unwrap_or((text, ""));
    let start = before.trim_end_matches(is_word).len();
    let end = before.len() + after.len() - after.trim_start_matches(is_word).len();
    start..end
}

/// The line around a byte of a text, with its end.
pub fn line_around(text: &str, offset: usize) -> Range<usize> {
    let (before, after) = text.split_at_checked(offset).unwrap_or((text, ""));
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let end = after.find('\n').map_or(text.len(), |at| before.len() + at + 1);
    start..end
}

/// A pair of brackets: `(`, `[` or `{` and its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bracket {
    /// The byte of the opening one.
    pub open: usize,
    /// The byte behind the closing one; the text's end if there is none.
    pub close: usize,
}

/// The brackets of a text, by where they open. Those in comments and quotes are none. A closing one
/// also closes what was left open inside.
pub fn brackets(text: &str) -> Vec<Bracket> {
    let (mut found, mut open): (Vec<Bracket>, Vec<(char, usize)>) = (Vec::new(), Vec::new());
    for (at, sign) in code(text) {
        match sign {
            '(' | '[' | '{' => open.push((sign, at)),
            ')' | ']' | '}' => {
                let meant = match sign {
                    ')' => '(',
                    ']' => '[',
                    _ => '{',
                };
                if let Some(which) = open.iter().rposition(|(opened, _)| *opened == meant) {
                    for (_, begin) in open.drain(which..) {
                        found.push(Bracket { open: begin, close: at + 1 });
                    }
                }
            }
            _ => {}
        }
    }
    found.extend(open.iter().map(|(_, at)| Bracket { open: *at, close: text.len() }));
    found.sort_by_key(|bracket| bracket.open);
    found
}

/// A text whose brackets are closed, and how its bytes came from the first text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Closed {
    /// The text.
    pub text: String,
    /// The bytes of the first text before which a bracket was written.
    added: Vec<usize>,
}

impl Closed {
    /// A byte of the closed text in the first one.
    pub fn before(&self, at: usize) -> usize {
        // The n-th bracket stands at its byte and n others.
        let earlier = self.added.iter().enumerate().filter(|(nth, byte)| **byte + nth < at).count();
        at - earlier
    }
}

/// A text with the brackets closed that it leaves open, as late as can be, and without those that
/// close nothing. None if nothing is to be done.
pub fn closed(text: &str) -> Option<Closed> {
    let (mut open, mut blank): (Vec<char>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut added: Vec<(usize, char)> = Vec::new();
    for (at, sign) in code(text) {
        match sign {
            '(' => open.push(')'),
            '[' => open.push(']'),
            '{' => open.push('}'),
            ')' | ']' | '}' => match open.iter().rposition(|end| *end == sign) {
                Some(which) => {
                    added.extend(open.drain(which..).skip(1).rev().map(|end| (at, end)));
                }
                None => blank.push(at),
            },
            _ => {}
        }
    }
    added.extend(open.iter().rev().map(|end| (text.len(), *end)));
    if added.is_empty() && blank.is_empty() {
        return None;
    }
    let mut whole = text.to_owned();
    for at in blank {
        whole.replace_range(at..=at, " ");
    }
    for (at, end) in added.iter().rev() {
        whole.insert(*at, *end);
    }
    Some(Closed { text: whole, added: added.into_iter().map(|(at, _)| at).collect() })
}

/// The characters of a text that are neither in a comment nor in quotes, with their bytes.
pub fn code(text: &str) -> impl Iterator<Item = (usize, char)> {
    #[derive(Clone, Copy, PartialEq)]
    enum Within {
        Code,
        Line,
        Block,
        Quotes,
        Script,
    }
    let (mut within, mut skip) = (Within::Code, 0_usize);
    text.char_indices().filter(move |&(at, sign)| {
        if at < skip {
            return false;
        }
        let rest = text.get(at..).unwrap_or_default();
        if sign == '\n' && matches!(within, Within::Line | Within::Quotes) {
            within = Within::Code;
        }
        let (next, length) = match within {
            Within::Code if rest.starts_with("//") => (Within::Line, 2),
            Within::Code if rest.starts_with("/*") => (Within::Block, 2),
            Within::Code if rest.starts_with("\"\"\"") => (Within::Script, 3),
            Within::Code if sign == '"' => (Within::Quotes, 1),
            Within::Code => return true,
            Within::Block if rest.starts_with("*/") => (Within::Code, 2),
            Within::Script if rest.starts_with("\"\"\"") => (Within::Code, 3),
            Within::Quotes if sign == '\\' => {
                (within, 1 + rest.chars().nth(1).map_or(0, char::len_utf8))
            }
            Within::Quotes if sign == '"' => (Within::Code, 1),
            _ => (within, sign.len_utf8()),
        };
        within = next;
        skip = at + length;
        false
    })
}

/// Whether what is written behind a text is code: not in a comment, nor in quotes.
pub fn ends_in_code(text: &str) -> bool {
    // A blank ends nothing and begins nothing.
    let longer = format!("{text} ");
    code(&longer).last().is_some_and(|(at, _)| at == text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_utf16_units() {
        let text = "a\n😀é x\r\n\nlast";
        let lines = Lines::of(text);
        let at = |line, column| Position { line, column };
        for (offset, position) in [
            (0, at(0, 0)),
            (1, at(0, 1)),
            (2, at(1, 0)),
            (6, at(1, 2)),
            (8, at(1, 3)),
            (12, at(2, 0)),
            (17, at(3, 4)),
        ] {
            assert_eq!(lines.position(text, offset), position, "{offset}");
            assert_eq!(lines.offset(text, position), offset, "{position:?}");
        }
        assert_eq!(lines.offset(text, at(1, 99)), 10, "the end of the line");
        assert_eq!(lines.offset(text, at(99, 0)), text.len());
        assert_eq!(lines.position(text, 4), at(1, 0), "within a character");
    }

    #[test]
    fn a_word_is_found_from_either_end() {
        assert_eq!(word_at("ball at x_1", 8), 8..11);
        assert_eq!(word_at("ball at x_1", 11), 8..11);
        assert_eq!(word_at("ball at", 4), 0..4);
        assert_eq!(word_at("a + b", 2), 2..2);
    }

    #[test]
    fn what_is_left_open_is_closed() {
        for (text, expected) in
            [("a { f(1, }", "a { f(1, )}"), ("a { b [", "a { b []}"), ("a ) {}", "a   {}")]
        {
            assert_eq!(closed(text).map(|it| it.text).as_deref(), Some(expected));
        }
        assert_eq!(closed("a { (b) }"), None);
        let it = closed("f( } x{ y").map(|it| (it.before(0), it.before(it.text.len())));
        assert_eq!(it, Some((0, 9)));
    }

    #[test]
    fn comments_and_quotes_are_no_code() {
        let signs: String = code("a // b\n\"c\" /* d */ e").map(|(_, sign)| sign).collect();
        assert_eq!(signs, "a \n  e");
        for (text, is_code) in [
            ("", true),
            ("a ", true),
            ("// b", false),
            ("// b\n", true),
            ("/* b\n", false),
            ("/* b */", true),
            ("as \"b", false),
            ("as \"b\"", true),
            ("script rhai \"\"\"fn", false),
        ] {
            assert_eq!(ends_in_code(text), is_code, "{text}");
        }
    }

    #[test]
    fn brackets_in_comments_and_quotes_are_none() {
        let text = "a { ( // }\n \"}\" \"\"\" ) \"\"\" ] } {";
        let found: Vec<(usize, usize)> =
            brackets(text).iter().map(|it| (it.open, it.close)).collect();
        let end = text.find("] }").map(|at| at + 3).unwrap_or_default();
        assert_eq!(found, [(2, end), (4, end), (text.len() - 1, text.len())]);
    }
}
