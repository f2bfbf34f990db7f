//! Formatting: what it keeps, what it changes, and that it never changes what a file says.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use proptest::prelude::*;
use setpiece_dsl::format::{WIDTH, format};
use setpiece_dsl::parse::parse;
use setpiece_dsl::source::{FileId, Source};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

fn source(text: &str) -> Source {
    Source { name: "test.pitch".into(), text: text.into() }
}

fn formatted(text: &str) -> String {
    format(&source(text)).unwrap_or_else(|problems| panic!("{problems:?}\n{text}"))
}

/// The syntax tree without its spans.
fn tree(text: &str) -> Option<String> {
    let mut problems = Vec::new();
    let file = parse(&source(text), FileId(0), &mut problems);
    if !problems.is_empty() {
        return None;
    }
    let (mut bare, shown) = (String::new(), format!("{:?}", file.items));
    let mut rest = shown.as_str();
    while let Some(at) = rest.find("Span { ") {
        bare.push_str(&rest[..at]);
        rest = &rest[at + rest[at..].find('}').unwrap() + 1..];
    }
    Some(bare + rest)
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn collect(folder: &Path, texts: &mut Vec<(String, String)>) {
    let mut paths: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            collect(&path, texts);
        } else if path.extension().is_some_and(|ending| ending == "pitch") {
            texts.push((path.display().to_string(), std::fs::read_to_string(&path).unwrap()));
        }
    }
}

/// Every text of the language in the repository; the specification's files case by case.
fn texts() -> Vec<(String, String)> {
    let mut files = Vec::new();
    for folder in ["stdlib-scenarios", "examples", "dsl/tests", "tests/spec"] {
        collect(&root().join(folder), &mut files);
    }
    let mut texts = Vec::new();
    for (name, text) in files {
        let mut part = String::new();
        for line in text.lines() {
            if line.starts_with("--- ") || line.starts_with("+++ ") {
                texts.push((name.clone(), std::mem::take(&mut part)));
            } else {
                part.push_str(line);
                part.push('\n');
            }
        }
        texts.push((name, part));
    }
    assert!(texts.len() > 150, "{}", texts.len());
    texts
}

/// Those that can be read.
fn readable() -> &'static [(String, String)] {
    static TEXTS: LazyLock<Vec<(String, String)>> =
        LazyLock::new(|| texts().into_iter().filter(|(_, text)| tree(text).is_some()).collect());
    &TEXTS
}

/// Whether a text has a body that the grammar doesn't take apart, which stays as it is to the last
/// blank.
fn is_opaque(text: &str) -> bool {
    ["behavior ", "curriculum ", "suite ", "check "].iter().any(|word| text.contains(word))
}

/// What holds for the format of every text.
fn assert_well_formed(name: &str, text: &str, result: &str) {
    assert_eq!(formatted(result), result, "{name} is not its own format");
    assert_eq!(tree(text), tree(result), "{name} says something else:\n{result}");
    assert!(
        result.is_empty() || (result.ends_with('\n') && !result.ends_with("\n\n")),
        "{name}: {result:?}"
    );
    if is_opaque(result) {
        return;
    }
    assert!(!result.starts_with('\n') && !result.contains("\n\n\n"), "{name}: {result}");
    for line in result.lines().filter(|line| !line.contains("\"\"\"")) {
        assert_eq!(line, line.trim_end(), "{name}");
    }
}

#[test]
fn the_format_of_every_text_says_the_same_and_is_its_own() {
    for (name, text) in readable() {
        assert_well_formed(name, text, &formatted(text));
    }
}

#[test]
fn the_library_and_the_examples_stand_in_the_format() {
    let mut files = Vec::new();
    collect(&root().join("stdlib-scenarios"), &mut files);
    collect(&root().join("examples"), &mut files);
    for (name, text) in files {
        assert_eq!(formatted(&text), text, "{name}: run `setpiece fmt`");
    }
}

/// The text with other blanks between its tokens: more of them, tabs, line ends and semicolons
/// where they mean nothing.
fn mangled(text: &str, dice: &[u8]) -> String {
    let (mut out, mut dice) = (String::new(), dice.iter().copied().cycle());
    let mut rest = text;
    while let Some(sign) = rest.chars().next() {
        let verbatim = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |at| at + 2)
        } else if let Some(raw) = rest.strip_prefix("\"\"\"") {
            raw.find("\"\"\"").map_or(rest.len(), |at| at + 6)
        } else if let Some(string) = rest.strip_prefix('"') {
            string.find('"').map_or(rest.len(), |at| at + 2)
        } else {
            0
        };
        if verbatim > 0 {
            out.push_str(&rest[..verbatim]);
            rest = &rest[verbatim..];
            continue;
        }
        match (sign, dice.next().unwrap_or_default() % 8) {
            (' ', 0 | 1) => out.push_str("   "),
            (' ', 2) => out.push('\t'),
            (' ', 3) => out.push_str(" \n "),
            ('\n', 0) => out.push_str("\n\n\n"),
            ('\n', 1) => out.push_str("  \r\n"),
            ('\n', 2) => out.push_str(" ;\n\t"),
            ('(' | ',' | '[', 0) => {
                out.push(sign);
                out.push('\n');
            }
            _ => out.push(sign),
        }
        rest = &rest[sign.len_utf8()..];
    }
    out
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 400,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn blanks_of_an_author_change_neither_tree_nor_layout(
        pick in any::<prop::sample::Index>(),
        dice in prop::collection::vec(any::<u8>(), 1..200),
    ) {
        let (name, text) = pick.get(readable());
        let mangled = mangled(text, &dice);
        // Some blanks mean something: `400 steps` on one line, for instance.
        prop_assume!(tree(&mangled) == tree(text));
        let result = formatted(&mangled);
        assert_well_formed(name, &mangled, &result);
        // A script keeps its own signs.
        let opaque = is_opaque(&result) || result.contains("\"\"\"");
        let code = |line: &&str| !opaque && !line.contains("//") && !line.contains('"');
        for line in result.lines().filter(code) {
            prop_assert!(!line.contains(['\t', ';', '\r']), "{name}: {line:?} in\n{result}");
        }
    }
}

#[test]
fn what_cannot_be_read_is_left_alone_with_its_reports() {
    let problems = format(&source("scenario s { ball at (0.6, 0 }")).unwrap_err();
    assert_eq!(problems[0].code().to_string(), "SP0104");
}

/// Each with what becomes of it.
const LAYOUTS: &[(&str, &str)] = &[
    ("", ""),
    ("// nothing\n\n\n", "// nothing\n"),
    (
        "scenario   s{ball at( 0.6,0 )\nteam left{GK at(-1,0) CM   at(0.5,-0.1){fatigue:30% yellow_cards:1}}}",
        "scenario s {\n    ball at (0.6, 0)\n    team left { GK at (-1, 0) CM at (0.5, -0.1) { fatigue: 30%, yellow_cards: 1 } }\n}\n",
    ),
    // Lines of a block are statements; the comma between them goes.
    (
        "reward r\n{\n  give 1, give 2 // two\n\n\n  /// kept\n  give - 3 }",
        "reward r {\n    give 1\n    give 2 // two\n\n    /// kept\n    give -3\n}\n",
    ),
    // But not where what follows would go on with the statement.
    (
        "scenario s {\n observe vector { ball.x,\n   stack(ball.y), // two\n -me.x,\n (me),\n noise, us has ball, me.y }\n}",
        "scenario s {\n    observe vector {\n        ball.x,\n        stack(ball.y), // two\n        -me.x,\n        (me),\n        noise\n        us has ball\n        me.y\n    }\n}\n",
    ),
    // An author's line breaks stay before the words that join, and go elsewhere.
    (
        "scenario s {\n    end far when ball.x >\n 0.5\n        and ball.y\n < 0.1\n}",
        "scenario s {\n    end far when ball.x > 0.5\n        and ball.y < 0.1\n}\n",
    ),
    (
        "fn f(\n  /// How far.\n  x: number=1 in 0 .. 2,\n  y: number) = x*2+y",
        "fn f(\n    /// How far.\n    x: number = 1 in 0..2,\n    y: number) = x * 2 + y\n",
    ),
    // Columns that an author began are finished; those they did not begin are not.
    (
        "reward r {\n    give 1 as \"a\"\n    give 20 + 30   as \"b\"\n}",
        "reward r {\n    give 1         as \"a\"\n    give 20 + 30   as \"b\"\n}\n",
    ),
    (
        "reward r {\n    give 1 as \"a\"\n    give 20 as \"b\"\n}",
        "reward r {\n    give 1 as \"a\"\n    give 20 as \"b\"\n}\n",
    ),
    (
        "reward r {\n    when a { give 1 }\n    else when b { give 2 } else { give 3 }\n}",
        "reward r {\n    when a { give 1 } else when b { give 2 } else { give 3 }\n}\n",
    ),
    (
        "formation f { GK at (-1, 0) /* its own */ CB at (-0.5, 0) }\nreward r { give 400   steps / 1s }",
        "formation f { GK at (-1, 0) /* its own */ CB at (-0.5, 0) }\nreward r { give 400 steps / 1s }\n",
    ),
    (
        "scenario s {\n    let a = 1\n  // Where.\n,   ball at (a, 0)\n}",
        "scenario s {\n    let a = 1\n    // Where.\n    ball at (a, 0)\n}\n",
    ),
    (
        "scenario s {\n    reward script rhai \"\"\"\n  fn reward() {\n }\n\"\"\" as \"x\"*2\n}",
        "scenario s {\n    reward script rhai \"\"\"\n  fn reward() {\n }\n\"\"\" as \"x\" * 2\n}\n",
    ),
];

#[test]
fn each_layout_is_as_written() {
    for (text, wanted) in LAYOUTS {
        assert_eq!(formatted(text), *wanted);
        assert_eq!(formatted(wanted), *wanted);
    }
}

#[test]
fn what_is_too_wide_is_opened_and_wrapped() {
    let players = "CM at (0.5, 0.1) ".repeat(9);
    let result = formatted(&format!("scenario s {{ team left {{ {players}}} }}"));
    assert_eq!(result.lines().count(), 2 + 2 + 9, "{result}");
    let sum = (0..40).map(|i| format!("speed_{i}")).collect::<Vec<_>>().join(" + ");
    let long = format!(
        "fn f(a: number) = {sum}\nregion r = polygon({})\n",
        ["(0.5, 0.25)"; 30].join(", ")
    );
    let result = formatted(&long);
    assert!(result.lines().all(|line| line.chars().count() <= WIDTH), "{result}");
    assert!(
        result.lines().skip(1).all(|line| line.starts_with("    ") || line.starts_with("region")),
        "{result}"
    );
    assert_well_formed("the long lines", &long, &result);
}
