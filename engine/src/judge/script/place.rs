//! Places in a script's text: Rhai counts lines and characters, reports count bytes.

use super::scan::definitions;
use std::ops::Range;

/// The byte at a line and column, both from 1; the end of the text if there is none.
pub(super) fn offset(source: &str, line: usize, column: usize) -> usize {
    let mut start = 0;
    for _ in 1..line {
        match source.get(start..).and_then(|rest| rest.find('\n')) {
            Some(end) => start += end + 1,
            None => return source.len(),
        }
    }
    let rest = source.get(start..).unwrap_or_default();
    rest.char_indices().nth(column.saturating_sub(1)).map_or(source.len(), |(at, _)| start + at)
}

/// The word or string that begins at a byte, or the one character there.
pub(super) fn word_at(source: &str, start: usize) -> Range<usize> {
    let rest = source.get(start..).unwrap_or_default();
    if let Some(end) = rest.strip_prefix('"').and_then(|rest| rest.find(['"', '\n'])) {
        return start..start + end + 2;
    }
    let word = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
    let length = if word > 0 { word } else { rest.chars().next().map_or(0, char::len_utf8) };
    start..start + length
}

/// The place of a function's name, if the text defines it.
pub(super) fn definition(source: &str, name: &str) -> Option<Range<usize>> {
    definitions(source).into_iter().find(|word| source.get(word.clone()) == Some(name))
}

/// Line and column, from 1, of a hook's definition; the beginning if it has none.
pub(super) fn hook_position(source: &str, hook: &str) -> (usize, usize) {
    let start = definition(source, hook).map_or(0, |range| range.start);
    place_of(source, start)
}

/// Line and column, from 1, of a byte.
pub(super) fn place_of(source: &str, at: usize) -> (usize, usize) {
    let before = source.get(..at).unwrap_or_default();
    let line_start = before.rfind('\n').map_or(0, |end| end + 1);
    (
        before.matches('\n').count() + 1,
        before.get(line_start..).unwrap_or_default().chars().count() + 1,
    )
}
