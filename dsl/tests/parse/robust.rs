//! No text makes the parser panic, hang or lose its place.

use super::{EVERYTHING, read, reported};
use proptest::prelude::*;

fn check(text: &str) {
    let (file, problems) = read(text);
    for span in problems
        .iter()
        .flat_map(|problem| problem.words().labels)
        .map(|label| label.span)
        .chain(file.items.iter().map(|item| item.span))
    {
        assert!(
            text.get(span.start as usize..span.end as usize).is_some(),
            "{span:?} is no span of {text:?}"
        );
    }
}

#[test]
fn what_nests_without_brackets_is_bounded_too() {
    for n in [50, 200, 250, 300, 1000] {
        check(&format!("scenario s {{ let x = {} 1 }}", "if a then b else ".repeat(n)));
        check(&format!(
            "scenario s {{ let x = {} a {} }}",
            "if ".repeat(n),
            "then b else c ".repeat(n)
        ));
        check(&format!("scenario s {{ let x = {} a }}", "count of 1 + ".repeat(n)));
        check(&format!("reward r {{ {} {} }}", "when a { ".repeat(n), "} ".repeat(n)));
    }
}

#[test]
fn chains_of_any_length_end_in_a_problem() {
    for n in [1_000, 20_000] {
        for (link, tail) in [
            ("1+", "1"),
            ("1 and ", "1"),
            ("not ", "a"),
            ("- ", "a"),
            ("a.", "b"),
            ("if a then b else ", "c"),
            ("if ", "c"),
            ("count of ", "goal"),
            ("pass by ", "us"),
            ("a < ", "b"),
            ("a|", "b"),
            ("else if if a then b ", "c"),
        ] {
            let problems = reported(&format!("scenario s {{ let x = {}{tail} }}", link.repeat(n)));
            assert!(!problems.is_empty() && problems.len() < 5, "{link}: {problems:?}");
        }
    }
    assert!(
        !reported(&format!("reward r {{ when a {{ }} {} }}", "else when b { } ".repeat(20_000)))
            .is_empty()
    );
}

#[test]
fn odd_signs_are_parsed_however_many() {
    for text in [
        "\0",
        "{",
        "}",
        "(",
        ")",
        "\"",
        "/*",
        "\"\"\"",
        "'",
        "///",
        "😀",
        "scenario",
        "scenario s",
        "\u{FEFF}",
        "}{",
        "@@@",
        "a\n",
        "/* */ (}",
        "scenario s { let x = }\n",
        "/// (\n suite x { ",
    ] {
        for n in [1, 5_000] {
            check(&text.repeat(n));
            check(&format!("scenario s {{\n{}\n}}", text.repeat(n)));
        }
    }
}

#[test]
fn nothing_that_nests_is_tried_twice() {
    for (open, close) in [
        ("(1, ", ")"),
        ("f(a: (", "))"),
        ("if a then b else if (", ")"),
        ("if (", ") then a else if a then b else c"),
        ("f(x for p in (", "))"),
        ("f(p in (", ") where a)"),
        ("count of (", ")"),
        ("pass by (", ")"),
        ("own (", ")"),
    ] {
        let deep = 60 / open.matches('(').count();
        for inner in ["1", "1 1", ""] {
            check(&format!(
                "scenario s {{ let x = {}{inner}{} }}",
                open.repeat(deep),
                close.repeat(deep)
            ));
        }
    }
    check(&format!("scenario s {{ let x = {} }}", "if a then b else if ".repeat(60)));
    check(&format!("suite s {{\n /// {}\n}}", "(".repeat(60)));
    check(&format!("{} 1 {}", "scenaro s { ".repeat(60), "} ".repeat(60)));
}

fn tokens() -> Vec<&'static str> {
    let mut tokens = Vec::new();
    let mut rest = EVERYTHING;
    while let Some(first) = rest.chars().next() {
        let word = |char: char| char.is_alphanumeric() || char == '_';
        let blank = |char: char| char.is_whitespace();
        let end = if word(first) {
            rest.find(|char| !word(char))
        } else if blank(first) {
            rest.find(|char| !blank(char))
        } else {
            Some(first.len_utf8())
        };
        let (token, behind) = rest.split_at(end.unwrap_or(rest.len()));
        tokens.push(token);
        rest = behind;
    }
    tokens
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn any_text_is_parsed(text in "\\PC*") {
        check(&text);
    }

    #[test]
    fn any_text_of_the_languages_signs_is_parsed(text in "([a-c0-9 \n\r\t{}()\\[\\]\"/*.,:;=<>+é-]|scenario |team left |reward |give |when |CB at |let )*") {
        check(&text);
    }

    #[test]
    fn a_spoilt_sample_is_parsed(
        edits in prop::collection::vec((0usize..2000, 0usize..2000, 0u8..4), 1..6),
    ) {
        let mut tokens = tokens();
        for (at, other, what) in edits {
            let (at, other) = (at % tokens.len(), other % tokens.len());
            match what {
                0 => { tokens.remove(at); }
                1 => { let token = tokens[at]; tokens.insert(at, token); }
                2 => tokens.swap(at, other),
                _ => { let token = tokens[other]; tokens.insert(at, token); }
            }
        }
        check(&tokens.concat());
    }
}

#[test]
fn a_lost_bracket_or_quote_is_a_few_problems() {
    let mut wrong = Vec::new();
    let scripts = EVERYTHING.find("\"\"\"").unwrap_or(0)..EVERYTHING.rfind("\"\"\"").unwrap_or(0);
    for (at, sign) in EVERYTHING.char_indices().filter(|(_, sign)| "(){}[]\"".contains(*sign)) {
        let line = EVERYTHING[..at].rsplit('\n').next().unwrap_or_default();
        if line.contains("//") || line.contains("/*") || scripts.contains(&at) {
            continue;
        }
        let text = format!("{}{}", &EVERYTHING[..at], &EVERYTHING[at + 1..]);
        let problems = reported(&text);
        if !(1..=4).contains(&problems.len()) {
            let line = EVERYTHING[..at].matches('\n').count() + 1;
            wrong.push(format!("line {line}, `{sign}`: {problems:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
