//! Every operator has one meaning: constants folded by the compiler and parameters computed in a
//! match give the same.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use proptest::prelude::*;
use setpiece_dsl::source::{LoadError, Source, SourceLoader};
use setpiece_dsl::{CompileOptions, compile};
use setpiece_engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece_engine::judge::Recorded;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Every operator of two numbers `a` and `b` that a text can write, and those of one on `a`.
const FORMS: &[&str] = &[
    "a + b",
    "a - b",
    "a * b",
    "a / b",
    "-a",
    "mod(a, b)",
    "min(a, b)",
    "max(a, b)",
    "pow(abs(a), b / 100)",
    "abs(a)",
    "sqrt(abs(a))",
    "exp(a / 10)",
    "log(abs(a) + 1)",
    "floor(a)",
    "ceil(a)",
    "round(a)",
    "sin(a * 1rad)",
    "cos(a * 1rad)",
    "smoothstep(0, 3, a)",
    "clamp(a, -3, 3)",
    "distance((a * 1m, 0m), (0m, b * 1m)) / 1m",
    "angle((a * 1m, 0m), (0m, b * 1m)) / 1rad",
    "(a * 1rad + b * 1rad) / 1rad",
    "(a * 1rad - b * 1rad) / 1rad",
    "if a < b then 1 else 0",
    "if a <= b then 1 else 0",
    "if a > b then 1 else 0",
    "if a >= b then 1 else 0",
    "if a == b then 1 else 0",
    "if a != b then 1 else 0",
    "if a > 0 and b > 0 then 1 else 0",
    "if a > 0 or b > 0 then 1 else 0",
    "if not (a > b) then 1 else 0",
];

/// Loads nothing.
struct Alone;

impl SourceLoader for Alone {
    fn load(&self, path: &str, _from: &str) -> Result<Source, LoadError> {
        Err(LoadError { message: format!("no file `{path}`"), similar: Vec::new(), awaited: None })
    }
}

/// The records of an episode of one step.
fn records(body: &str) -> BTreeMap<String, Option<f64>> {
    let text = format!(
        "scenario s {{ ball at centre team left {{ CM at (-0.1, 0) }} agents {{ left: 0 }}\n    end limit 1 step {body} }}"
    );
    let root = Source { name: "test.pitch".to_owned(), text: text.into() };
    let outcome = compile(root, &Alone, &CompileOptions::default());
    let scenario = outcome.scenario.unwrap_or_else(|| panic!("{:#?}", outcome.problems));
    let mut environment =
        Environment::new(Arc::new(scenario), EnvironmentOptions::default()).unwrap();
    environment.reset(Some(1), None).unwrap();
    environment.step(&[], &mut Scratch::default()).unwrap();
    let number = |recorded: &Recorded| match recorded {
        Recorded::Number(number) => *number,
        other => panic!("{other:?}"),
    };
    environment.records().map(|(name, recorded)| (name.to_owned(), number(&recorded))).collect()
}

/// A form with its two operands; only whole words are replaced.
fn with(form: &str, a: &str, b: &str) -> String {
    let operand = |word: &str| match word {
        "a" => a.to_owned(),
        "b" => b.to_owned(),
        word => word.to_owned(),
    };
    let mut text = String::new();
    for piece in form.split_inclusive(|char: char| !char.is_alphanumeric()) {
        let word = piece.trim_end_matches(|char: char| !char.is_alphanumeric());
        text.push_str(&operand(word));
        text.push_str(&piece[word.len()..]);
    }
    text
}

/// Each form, folded from constants and run on parameters.
fn folded_and_run(a: f64, b: f64) -> Vec<(&'static str, Option<f64>, Option<f64>)> {
    let literal =
        |value: f64| if value < 0.0 { format!("(-{:?})", -value) } else { format!("{value:?}") };
    let mut body = format!("param p: number = {a:?}\nparam q: number = {b:?}\n");
    for (index, form) in FORMS.iter().enumerate() {
        body.push_str(&format!("record c{index} = {}\n", with(form, &literal(a), &literal(b))));
        body.push_str(&format!("record v{index} = {}\n", with(form, "p", "q")));
    }
    let found = records(&body);
    let pair = |index: usize| (found[&format!("c{index}")], found[&format!("v{index}")]);
    FORMS.iter().enumerate().map(|(index, form)| (*form, pair(index).0, pair(index).1)).collect()
}

fn agree(a: f64, b: f64) {
    for (form, folded, run) in folded_and_run(a, b) {
        assert_eq!(folded, run, "{form} of {a} and {b}");
    }
}

#[test]
fn the_remainder_of_constants_is_that_of_parameters() {
    let found = records(
        "param metre: length = 1m  param part: length = 0.1m
        record folded = mod(1m, 0.1m) / 1m  record run = mod(metre, part) / 1m",
    );
    assert_eq!(found["folded"], found["run"]);
    assert!(found["run"].unwrap() > 0.09, "{found:?}");
}

#[test]
fn half_a_turn_is_positive_however_it_is_computed() {
    let found = records(
        "param quarter: angle = 90deg
        record folded = (-90deg - 90deg) / 1rad  record run = (-quarter - quarter) / 1rad",
    );
    assert_eq!(found["folded"], Some(std::f64::consts::PI));
    assert_eq!(found["folded"], found["run"]);
}

#[test]
fn whole_numbers_agree() {
    for (a, b) in
        [(0.0, 1.0), (1.0, 1.0), (-1.0, 3.0), (7.0, -2.0), (6.0, 3.0), (1.0, 0.1), (2.5, -0.5)]
    {
        agree(a, b);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn folded_and_run_programs_agree(
        a in -50.0..50.0_f64,
        b in prop_oneof![-50.0..-0.01_f64, 0.01..50.0_f64],
    ) {
        agree(a, b);
    }
}
