//! Broken sources: whatever is cut out of a good one, the compiler answers with problems, never
//! with a panic.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece_dsl::problem::Severity;
use setpiece_dsl::source::{LoadError, Source, SourceLoader};
use setpiece_dsl::{CompileOptions, CompileOutcome, compile};

/// The standard library from the repository.
struct Std;

fn folder() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../stdlib-scenarios")
}

impl SourceLoader for Std {
    fn load(&self, path: &str, _from: &str) -> Result<Source, LoadError> {
        let full = folder().join(path.strip_prefix("std/").unwrap_or(path));
        let text = std::fs::read_to_string(full).map_err(|_| LoadError {
            message: format!("no file `{path}`"),
            similar: vec![],
            awaited: None,
        })?;
        Ok(Source { name: path.to_owned(), text: text.into() })
    }
}

fn outcome(text: &str) -> CompileOutcome {
    let root = Source { name: "case.pitch".to_owned(), text: text.into() };
    let outcome = compile(root, &Std, &CompileOptions::default());
    let failed = outcome.problems.iter().any(|problem| problem.severity() == Severity::Error);
    assert_eq!(
        outcome.scenario.is_none(),
        failed,
        "a scenario comes out exactly when nothing is wrong:\n{text}"
    );
    for problem in &outcome.problems {
        for label in &problem.words().labels {
            let source = outcome.sources.get(label.span.file).expect("a label in a file");
            let range = label.span.start as usize..label.span.end as usize;
            assert!(source.text.get(range).is_some(), "{problem:?} points outside its file");
        }
    }
    if let Some(scenario) = &outcome.scenario {
        setpiece_scenario::verify::verify(scenario).expect("a scenario that holds");
    }
    outcome
}

const GOOD: &str = r#"
reward pressing(reach: length = 2m in 0.5m..5m) extends scoring {
    state chain = 0
    let near = pressed(me, within: reach)
    give 0.5 once when ball in them.box as "entry"
    give closing(ball, them.goal) / 1m * (if near then 2 else 1) per second
    on pass completed by us from them.half when event.length > 5m { chain = chain + 1 give chain }
    when chain > 3 and held(us has ball, for: 2s) { give count(p in mates where p.x > ball.x) } else { chain = 0 }
}
formation pair { back: CB at (-0.5, 0) CM ahead of back by 10m }
scenario s extends academy {
    param far: length = 10m in 5m..15m
    let lane = choice(-0.2, 0.2)
    rules { offside: on, half_time: 100 steps }
    ball behind striker by 1m { velocity: (5m/s, 0m/s), owner: striker }
    team left { striker: CF at (0.5, lane) facing ball { stats: { speed: 0.9 } } GK at (-1, 0) }
    team right { formation: pair each outfield { ai: lazy } place back at (0.7, 0) }
    agents { left: [striker] }
    require distance(striker, ball) < far with 80% as "near"
    reward pressing(reach: 3m) * 0.5
    remove end possession
    end success close when within(shot by left, 3s) and ball.x > 0.9
    end limit 20s
}
"#;

#[test]
fn the_sound_source_compiles() {
    let found = outcome(GOOD);
    assert!(found.problems.is_empty(), "{:?}", found.problems);
}

#[test]
fn a_missing_word_is_no_panic() {
    let words: Vec<&str> = GOOD.split_inclusive(char::is_whitespace).collect();
    for cut in 0..words.len() {
        let text: String =
            words.iter().enumerate().filter(|(i, _)| *i != cut).map(|(_, word)| *word).collect();
        outcome(&text);
    }
}

#[test]
fn a_word_in_another_place_is_no_panic() {
    let words: Vec<&str> = GOOD.split_inclusive(char::is_whitespace).collect();
    for at in 0..words.len() {
        let mut moved = words.clone();
        moved.swap(at, (at * 7 + 3) % words.len());
        outcome(&moved.concat());
    }
}

#[test]
fn a_source_that_breaks_off_is_no_panic() {
    for (end, _) in GOOD.char_indices().step_by(7) {
        outcome(&GOOD[..end]);
    }
}

#[test]
fn a_long_sum_compiles_and_a_longer_one_is_refused() {
    let sum = |n: usize| {
        let terms = vec!["ball.x"; n].join(" + ");
        format!(
            "scenario s extends academy {{ ball at (0, 0) team left {{ CM at (0.1, 0) }} end far when {terms} > 3 }}"
        )
    };
    assert!(outcome(&sum(150)).scenario.is_some());
    assert!(outcome(&sum(2_000)).scenario.is_none());
}

#[test]
fn definitions_that_double_are_refused_in_time() {
    let mut text = String::from("fn f0(x: number) = x\n");
    for i in 1..40 {
        text.push_str(&format!("fn f{i}(x: number) = f{}(x) + f{}(x + 1)\n", i - 1, i - 1));
    }
    text.push_str(
        "scenario s extends academy { ball at (0, 0) team left { CM at (0.1, 0) } end far when f39(ball.x) > 3 }",
    );
    assert!(outcome(&text).scenario.is_none());
}

/// A good source without its brackets and quotes one by one: what follows from the lost one is not
/// reported.
#[test]
fn a_lost_bracket_or_quote_is_a_few_problems() {
    let mut wrong = Vec::new();
    for (at, sign) in GOOD.char_indices().filter(|(_, sign)| "(){}[]\"".contains(*sign)) {
        let text = format!("{}{}", &GOOD[..at], &GOOD[at + 1..]);
        let problems = outcome(&text).problems;
        if !(1..=4).contains(&problems.len()) {
            let line = GOOD[..at].matches('\n').count() + 1;
            let reported: Vec<String> =
                problems.iter().map(|p| format!("{} {}", p.code(), p.words().message)).collect();
            wrong.push(format!("line {line}, `{sign}`: {reported:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn three_mistakes_of_three_stages_are_three_problems() {
    let problems = outcome(
        "scenario mistakes extends academy {\n ball at (0.6, 0)\n team left { GK at (-1, 0) CBB at (0.5, 0) }\n \
         reward scorin\n end success soon when elapsed > 3m\n}\n",
    )
    .problems;
    let reported: Vec<_> =
        problems.iter().map(|problem| (problem.code().to_string(), problem.words().help)).collect();
    let wanted = [
        ("SP0203", Some("did you mean `CB`?")),
        ("SP0201", Some("did you mean `scoring`?")),
        ("SP0302", Some("compare it with a duration, for example `2s` or `20 steps`")),
    ];
    assert_eq!(reported, wanted.map(|(code, help)| (code.to_owned(), help.map(str::to_owned))));
}
