//! The width of lines: 100 columns for code, comments and prose. A line with a part of a string may
//! be longer, and so may tables, code and long links in prose.

use super::read;
use crate::shell::root;

/// The most columns of a line.
const COLUMNS_MAX: usize = 100;

/// Reports each line of a Rust file that is too long.
pub(super) fn check(path: &str, breaches: &mut Vec<String>) -> Result<(), String> {
    for line in too_long(&read(&root().join(path))?) {
        breaches.push(format!("{path}:{line}: longer than {COLUMNS_MAX} columns"));
    }
    Ok(())
}

/// Pages that programs write, with one line per thought.
const WRITTEN: &[&str] = &["docs/calibration.md", "docs/performance.md", "docs/transfer.md"];

/// Reports each line of a page's prose that is too long.
pub(super) fn check_prose(path: &str, breaches: &mut Vec<String>) -> Result<(), String> {
    if WRITTEN.contains(&path) {
        return Ok(());
    }
    for line in too_long_prose(&read(&root().join(path))?) {
        breaches.push(format!("{path}:{line}: longer than {COLUMNS_MAX} columns"));
    }
    Ok(())
}

/// The numbers of the lines of prose that are too long and could be divided.
fn too_long_prose(text: &str) -> Vec<usize> {
    let mut in_code = false;
    let mut long = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let begins = line.trim_start();
        in_code ^= begins.starts_with("```");
        let is_prose = !in_code && !begins.starts_with(['`', '|', '#', '!', '<']);
        let longest = line.split_whitespace().map(|word| word.chars().count()).max();
        let divides = longest.is_some_and(|longest| longest < COLUMNS_MAX - 10);
        if is_prose && divides && line.chars().count() > COLUMNS_MAX {
            long.push(number);
        }
    }
    long
}

/// The numbers of the lines that are too long and hold no part of a string.
fn too_long(text: &str) -> Vec<usize> {
    let mut inside = Inside::Code;
    let mut long = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let holds_string = inside.pass(line);
        if line.chars().count() > COLUMNS_MAX && !holds_string {
            long.push(number);
        }
    }
    long
}

/// What the end of a line stands in.
#[derive(Clone, Copy, PartialEq)]
enum Inside {
    Code,
    String,
    /// A raw string, with this many `#`.
    Raw(usize),
}

impl Inside {
    /// Goes through a line. Returns whether a part of a string stands in it.
    fn pass(&mut self, line: &str) -> bool {
        let mut holds = *self != Inside::Code;
        let mut rest = line;
        while let Some(first) = rest.chars().next() {
            match *self {
                Inside::Code if rest.starts_with("//") => return holds,
                Inside::Code => match opening(rest) {
                    Some((inside, length)) => {
                        (*self, holds) = (inside, true);
                        rest = &rest[length..];
                    }
                    None => rest = &rest[character(rest).unwrap_or(first.len_utf8())..],
                },
                Inside::String if first == '\\' => {
                    let escaped = rest.chars().nth(1).map_or(0, char::len_utf8);
                    rest = &rest[1 + escaped..];
                }
                Inside::String => {
                    if first == '"' {
                        *self = Inside::Code;
                    }
                    rest = &rest[first.len_utf8()..];
                }
                Inside::Raw(marks) => {
                    let end = format!("\"{}", "#".repeat(marks));
                    let Some(at) = rest.find(&end) else { return holds };
                    *self = Inside::Code;
                    rest = &rest[at + end.len()..];
                }
            }
        }
        holds
    }
}

/// The string that begins here, and the length of its opening.
fn opening(rest: &str) -> Option<(Inside, usize)> {
    if rest.starts_with('"') {
        return Some((Inside::String, 1));
    }
    let marks = rest.strip_prefix('r')?;
    let count = marks.chars().take_while(|mark| *mark == '#').count();
    marks[count..].starts_with('"').then_some((Inside::Raw(count), count + 2))
}

/// The length of the quotation mark as a character, `'"'`, if it stands here.
fn character(rest: &str) -> Option<usize> {
    ["'\"'", "'\\\"'", "'\\''", "'\\\\'"]
        .into_iter()
        .find(|mark| rest.starts_with(mark))
        .map(str::len)
}

#[cfg(test)]
mod tests {
    use super::{too_long, too_long_prose};

    #[test]
    fn long_prose_is_found_and_tables_code_and_links_are_not() {
        let wide = "word ".repeat(21);
        assert_eq!(too_long_prose(&format!("{wide}\n- {wide}\n")), [1, 2]);
        let others = format!("| {wide} |\n```\n{wide}\n```\nsee {}\n", "x".repeat(120));
        assert!(too_long_prose(&others).is_empty());
    }

    #[test]
    fn long_code_and_comments_are_found_and_long_strings_are_not() {
        let wide = "x".repeat(101);
        assert_eq!(too_long(&format!("let a = 1;\n// {wide}\n{wide}\n")), [2, 3]);
        assert!(too_long(&format!("let a = \"{wide}\";\n")).is_empty());
        assert!(too_long(&format!("let a = r#\"\n{wide} \" {wide}\n\"#;\n")).is_empty());
        assert_eq!(too_long(&format!("let a = \"\\\"\\\nb\";\n{wide}\n")), [3]);
        assert_eq!(too_long(&format!("let a = '\"';\n{wide}\n")), [2]);
    }
}
