//! Formatting of a text and of some of its lines.

use super::{ATTACK, behind};
use setpiece::editor::{Edit, Workspace};
use std::path::Path;

/// A text after some edits of it.
fn edited(text: &str, edits: &[Edit]) -> String {
    let mut after = text.to_owned();
    let mut edits: Vec<_> = edits.iter().collect();
    edits.sort_by_key(|edit| edit.place.range.start);
    for pair in edits.windows(2) {
        assert!(pair[0].place.range.end <= pair[1].place.range.start, "they overlap: {pair:?}");
    }
    for edit in edits.iter().rev() {
        after.replace_range(edit.place.range.clone(), &edit.text);
    }
    after
}

#[test]
fn formatting_by_lines_is_formatting() {
    let path = Path::new("/nowhere/format.pitch");
    let text = ATTACK
        .replace("    ball at (0.5, 0)", "  ball   at (0.5,0)")
        .replace("        CM at", " CM at");
    let mut workspace = Workspace::default();
    workspace.set(path, &text);
    assert_eq!(edited(&text, &workspace.format(path)), ATTACK);
    let at = behind(&text, "  ball");
    let line = ATTACK.replace("        CM at", " CM at");
    assert_eq!(edited(&text, &workspace.format_range(path, &(at..at))), line);
    assert_eq!(edited(&text, &workspace.format_typed(path, at)), line);
}

/// Whatever lines are formatted, the text says the same, and formatting all of it leads where it
/// would have led.
#[test]
fn formatting_some_lines_changes_nothing_else() {
    let path = Path::new("/nowhere/format.pitch");
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let mut random: u64 = 7;
    let mut next = |below: usize| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (random >> 33) as usize % below
    };
    let mut tried = 0;
    for entry in std::fs::read_dir(file).expect("the examples").flatten() {
        if entry.path().extension().is_none_or(|ending| ending != "pitch") {
            continue;
        }
        let text = std::fs::read_to_string(entry.path()).expect("a text");
        // Lines lose their indentation, and some get empty lines around them.
        let lines = text.lines().map(|line| match next(4) {
            0 => format!("{line}\n"),
            1 => format!("\n{}\n", line.trim_start()),
            2 => format!("  {}\n", line.trim_start()),
            _ => format!("   {line}\n\n\n"),
        });
        let text: String = lines.collect();
        let mut workspace = Workspace::default();
        workspace.set(path, &text);
        let whole = edited(&text, &workspace.format(path));
        for _ in 0..4 {
            let from = next(text.len());
            let within = from..(from + next(400)).min(text.len());
            let is_char = |at: usize| text.is_char_boundary(at);
            if !is_char(within.start) || !is_char(within.end) {
                continue;
            }
            let part = edited(&text, &workspace.format_range(path, &within));
            let mut after = Workspace::default();
            after.set(path, &part);
            assert_eq!(edited(&part, &after.format(path)), whole, "{within:?} of {text}");
            tried += 1;
        }
    }
    assert!(tried > 60, "{tried}");
}
