//! What a query must capture in an example. A comment below a line names a capture that begins
//! there: at the sign `^`, or for `<-` where the comment begins. `tree-sitter query --test` accepts
//! any capture around that place, and so passes for the wrong one.

use crate::shell::read;
use std::collections::BTreeSet;
use std::path::Path;

/// A capture's name, and the line and column where it begins, from 0.
type CapturePlace = (String, usize, usize);

/// Compares an example's comments with what `tree-sitter query` printed about it.
pub(super) fn check(example: &Path, printed: &str) -> Result<(), String> {
    let text = read(example)?;
    let (expected, found) = (expected(&text), found(printed));
    if expected.is_empty() {
        return Err(format!("{}: expects no capture", example.display()));
    }
    let missing: Vec<String> = expected
        .difference(&found)
        .map(|(name, line, column)| format!("{}:{}: no capture @{name}", line + 1, column + 1))
        .collect();
    if !missing.is_empty() {
        return Err(format!("{}:\n  {}", example.display(), missing.join("\n  ")));
    }
    println!("grammar: {} has its {} captures", example.display(), expected.len());
    Ok(())
}

/// The captures that the comments of a text name.
fn expected(text: &str) -> BTreeSet<CapturePlace> {
    let mut places = BTreeSet::new();
    let mut last = 0;
    for (number, line) in text.lines().enumerate() {
        let begins = line.len() - line.trim_start().len();
        let Some(comment) = line.trim_start().strip_prefix("//") else {
            last = number;
            continue;
        };
        let (column, name) = match (comment.find('^'), comment.trim_start().strip_prefix("<-")) {
            (_, Some(name)) => (begins, name),
            (Some(sign), None) => (begins + 2 + sign, &comment[sign + 1..]),
            (None, None) => continue,
        };
        places.insert((name.trim().to_owned(), last, column));
    }
    places
}

/// The captures of an output: `    capture: 0 - NAME, start: (2, 4), end: …` or
/// `    capture: NAME, start: (2, 4), end: …`.
fn found(printed: &str) -> BTreeSet<CapturePlace> {
    let read = |line: &str| {
        let rest = line.trim_start().strip_prefix("capture: ")?;
        let (name, rest) = rest.split_once(", start: (")?;
        let name = name.rsplit_once(" - ").map_or(name, |(_, name)| name);
        let (line, rest) = rest.split_once(", ")?;
        let (column, _) = rest.split_once(')')?;
        Some((name.to_owned(), line.parse().ok()?, column.parse().ok()?))
    };
    printed.lines().filter_map(read).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_name_captures_at_a_sign_or_at_their_own_beginning() {
        let text = "a {\n// <- fold\n    b c\n    // <- x\n    //^ y.z\n    // a comment\n";
        let place = |name: &str, line, column| (name.to_owned(), line, column);
        let all = [place("fold", 0, 0), place("x", 2, 4), place("y.z", 2, 6)];
        assert_eq!(expected(text), BTreeSet::from(all));
    }

    #[test]
    fn both_notations_of_a_capture_are_read() {
        let printed = "x.pitch\n  pattern: 0\n    capture: fold, start: (0, 0), end: (2, 1)\n    \
            capture: 2 - y.z, start: (3, 12), end: (3, 13), text: `x`\n";
        let all = [("fold".to_owned(), 0, 0), ("y.z".to_owned(), 3, 12)];
        assert_eq!(found(printed), BTreeSet::from(all));
    }
}
