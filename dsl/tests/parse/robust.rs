//! No text makes the parser panic, hang or lose its place.

use super::{EVERYTHING, read};
use proptest::prelude::*;

fn check(text: &str) {
    let (file, problems) = read(text);
    for span in problems.iter().flat_map(|problem| &problem.labels).map(|label| label.span).chain(file.items.iter().map(|item| item.span)) {
        assert!(text.get(span.start as usize..span.end as usize).is_some(), "{span:?} is no span of {text:?}");
    }
}

#[test]
fn what_nests_without_brackets_is_bounded_too() {
    for n in [50, 200, 250, 300, 1000] {
        check(&format!("scenario s {{ let x = {} 1 }}", "if a then b else ".repeat(n)));
        check(&format!("scenario s {{ let x = {} a {} }}", "if ".repeat(n), "then b else c ".repeat(n)));
        check(&format!("scenario s {{ let x = {} a }}", "count of 1 + ".repeat(n)));
        check(&format!("reward r {{ {} {} }}", "when a { ".repeat(n), "} ".repeat(n)));
    }
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
    fn a_spoilt_sample_is_parsed(edits in prop::collection::vec((0usize..2000, 0usize..2000, 0u8..4), 1..6)) {
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
