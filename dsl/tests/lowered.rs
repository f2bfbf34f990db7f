//! The programs that the standard rewards and a scenario become.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece_dsl::source::{LoadError, Source, SourceLoader};
use setpiece_dsl::{CompileOptions, compile};
use setpiece_scenario::{RewardBody, Scenario};

/// The standard library from the repository.
struct Std;

impl SourceLoader for Std {
    fn load(&self, path: &str, _from: &str) -> Result<Source, LoadError> {
        let inner = path.strip_prefix("std/").unwrap_or(path);
        let full = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../stdlib-scenarios")
            .join(inner);
        let text = std::fs::read_to_string(full).map_err(|_| LoadError {
            message: format!("no file `{path}`"),
            similar: vec![],
            awaited: None,
        })?;
        Ok(Source { name: path.to_owned(), text: text.into() })
    }
}

fn compiled(text: &str) -> Scenario {
    let root = Source { name: "case.pitch".to_owned(), text: text.into() };
    let outcome = compile(root, &Std, &CompileOptions::default());
    assert!(outcome.problems.is_empty(), "{:#?}", outcome.problems);
    outcome.scenario.expect("a scenario")
}

const CLOSE: &str = "scenario s extends academy { ball at (0.6, 0) team left { CM at (0.5, 0) } ";

/// The step program of the first reward, one instruction a line.
fn step(text: &str) -> String {
    let scenario = compiled(text);
    let RewardBody { init, step, terms, .. } = &scenario.rewards.last().expect("a reward").body;
    let lines = |code: &[setpiece_scenario::Instr]| {
        code.iter().enumerate().map(|(i, instr)| format!("{i}: {instr:?}\n")).collect::<String>()
    };
    format!(
        "terms {terms:?}, {} cells\ninit\n{}step\n{}",
        step.cells,
        lines(&init.code),
        lines(&step.code)
    )
}

#[test]
fn scoring_is_two_loops_over_goals() {
    insta::assert_snapshot!(step(&format!("{CLOSE} }}")));
}

#[test]
fn checkpoints_remember_what_was_paid() {
    insta::assert_snapshot!(step(&format!("{CLOSE} reward checkpoints(regions: 5) * 2 }}")));
}

#[test]
fn what_does_not_depend_on_the_event_stands_before_the_loop() {
    let text = format!(
        "{CLOSE} reward r {{ on pass by us when held(us has ball, for: 1s) {{ give distance(me, ball) / 1m }} }} }}"
    );
    insta::assert_snapshot!(step(&text));
}

#[test]
fn a_let_sees_no_assignment_of_its_step() {
    let text = format!(
        "{CLOSE} reward r {{ state n = 0  n = n + 1  let before = n  give before  give n  give prev(n) }} }}"
    );
    insta::assert_snapshot!(step(&text));
}

#[test]
fn a_start_keeps_its_parameters() {
    let scenario = compiled(
        "scenario s extends academy { param far: length = 10m in 5m..15m
         let lane = uniform(-0.1, 0.1)
         ball at (0.6, lane) team left { CM behind ball by far } end wide when ball.y > lane }",
    );
    let names: Vec<&str> = scenario.params.iter().map(|param| param.name.as_str()).collect();
    assert_eq!(names.last(), Some(&"far"));
    assert_eq!(scenario.start.lets.len(), 1);
    insta::assert_json_snapshot!(scenario.start);
}
