//! Parsing: every construct, every trap, and the words of every report.

use setpiece_dsl::ast::{File, ItemKind};
use setpiece_dsl::parse::parse;
use setpiece_dsl::problem::Problem;
use setpiece_dsl::source::{FileId, Source};

const EVERYTHING: &str = include_str!("parse/everything.pitch");

fn read(text: &str) -> (File, Vec<Problem>) {
    let mut problems = Vec::new();
    let file = parse(&Source { name: "test.pitch".into(), text: text.into() }, FileId(0), &mut problems);
    (file, problems)
}

#[test]
fn everything_is_read() {
    let (file, problems) = read(EVERYTHING);
    assert_eq!(problems, []);
    assert_eq!(file.items.len(), 15);
    assert!(file.items.iter().all(|item| item.kind != ItemKind::Broken));
}
