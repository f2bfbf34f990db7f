//! Files that are safe to load: anything that would take all memory, or minutes per step, is
//! rejected before anything is built from it.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, EnvironmentOptions};
use setpiece::replay::{Recorder, Replay};
use setpiece::scenario::bounds::{
    CELLS_MAX, CODE_MAX, PARTS_MAX, SCRIPT_MAX_BYTES, SCRIPTS_MAX_BYTES, TERMS_MAX,
};
use setpiece::scenario::file::{binary, from_json, to_json};
use setpiece::scenario::{
    Action, Dimension, Each, Fold, FoldKind, Instr, Over, Program, Record, Reg, Reward, RewardBody,
    Scenario, Script,
};

fn corner() -> Scenario {
    setpiece::load("academy_corner").unwrap().scenario.as_ref().clone()
}

/// The error that both forms of a file give for a scenario.
fn refused(change: impl Fn(&mut Scenario)) -> String {
    let mut scenario = corner();
    change(&mut scenario);
    let report = from_json(&to_json(&scenario).unwrap()).unwrap_err().to_string();
    assert_eq!(
        binary::from_bytes(&binary::to_bytes(&scenario).unwrap()).unwrap_err().to_string(),
        report
    );
    report
}

fn record(program: Program) -> Record {
    let unit = Dimension::NONE;
    Record { name: "r".to_owned(), program, values: vec![Reg(0)], series: false, unit }
}

/// Four nested loops over all players around this many instructions.
fn nested(instructions: usize) -> Program {
    let mut code = vec![Instr::Const(-1.0)];
    for depth in (0..4).rev() {
        let fold = Fold { kind: FoldKind::Count, value: None, guard: None };
        let over = Over::Players { team: Reg(0), except: None };
        code.push(Instr::Each(Box::new(Each { over, body: (instructions + depth) as u32, fold })));
    }
    code.extend(std::iter::repeat_n(Instr::Us, instructions));
    Program { code, cells: 0, ..Program::default() }
}

#[test]
fn memory_is_bounded_over_all_parts() {
    let cells = |n: u32| Program { code: vec![Instr::Us], cells: n, ..Program::default() };
    let report = refused(|scenario| scenario.records = vec![record(cells(100_000)); 500]);
    assert!(report.contains(" memory cells, where a scenario may have 100,000"), "{report}");
    let report = refused(|scenario| {
        let body = RewardBody { init: cells(60_000), step: cells(60_000), ..RewardBody::default() };
        scenario.rewards = vec![Reward { name: "r".to_owned(), doc: String::new(), body }];
    });
    assert!(report.contains("memory cells"), "{report}");
    let long = Program { code: vec![Instr::Us; 90_000], cells: 0, ..Program::default() };
    let report = refused(|scenario| scenario.records = vec![record(long.clone()); 3]);
    assert!(
        report.contains(&format!("instructions, where a scenario may have {}", "200,000")),
        "{report}"
    );
    let report =
        refused(|scenario| scenario.records = vec![record(cells(0)); PARTS_MAX as usize + 1]);
    assert!(report.contains("2,001 records"), "{report}");
    let report = refused(|scenario| {
        scenario.rewards[0].body.terms = vec!["t".to_owned(); TERMS_MAX as usize + 1];
    });
    assert!(report.contains("terms of rewards"), "{report}");
    let report = refused(|scenario| {
        let source = " ".repeat(SCRIPT_MAX_BYTES);
        let script = Script {
            name: "s".to_owned(),
            at: (1, 1),
            source,
            named: Vec::new(),
            modules: Vec::new(),
        };
        scenario.scripts = vec![script; SCRIPTS_MAX_BYTES as usize / SCRIPT_MAX_BYTES + 1];
    });
    assert!(report.contains("bytes of scripts"), "{report}");
    let report = refused(|scenario| {
        let source = " ".repeat(SCRIPT_MAX_BYTES + 1);
        scenario.scripts = vec![Script {
            name: "s".to_owned(),
            at: (1, 1),
            source,
            named: Vec::new(),
            modules: Vec::new(),
        }];
    });
    assert!(report.contains("bytes in one script"), "{report}");
    let report = refused(|scenario| {
        scenario.records = vec![Record { series: true, ..record(cells(0)) }; 1_001];
    });
    assert!(report.contains("numbers of series"), "{report}");
    const { assert!(CODE_MAX >= 100_000 && CELLS_MAX >= 10_000) };
}

#[test]
fn the_work_of_a_step_is_bounded() {
    let report = refused(|scenario| scenario.records = vec![record(nested(90_000))]);
    assert!(
        report.contains("instructions in a step, where a scenario may have 33,554,432"),
        "{report}"
    );
    let report = refused(|scenario| scenario.records = vec![record(nested(5)); 1_000]);
    assert!(report.contains("instructions in a step"), "{report}");
    let mut scenario = corner();
    scenario.records = vec![record(nested(5))];
    from_json(&to_json(&scenario).unwrap()).expect("one is no more than a step may cost");
}

#[test]
fn long_scripts_are_refused_where_they_stand() {
    let script = |statements: usize| {
        let body: String = (0..statements).map(|n| format!("let a{n} = 1;\n")).collect();
        format!(
            "scenario s extends academy_corner {{ reward script rhai \"\"\"
fn reward(ctx, now, prev, events) {{\n{body}0.0 }}\n\"\"\" as \"r\" }}\n"
        )
    };
    let report = |text: String| match setpiece::compile_text(&text, "s.pitch") {
        Err(error) => error.to_string(),
        Ok(_) => String::new(),
    };
    let long = report(script(20_000));
    assert!(long.contains("larger than 32 KiB"), "{long}");
    let fits = setpiece::compile_text(&script(2_000), "s.pitch");
    assert!(fits.is_ok(), "{}", fits.unwrap_err());
}

#[test]
fn a_text_is_held_to_the_same_bounds_where_it_stands() {
    let records: String = (0..1_000)
        .map(|n| {
            let outer = ["r", "q", "p"].map(|name| format!(" for {name} in players)")).concat();
            format!(
                "    record r{n} = sum(sum(sum(sum(p.x * q.y + r.x * s.y for s in players){outer}\n"
            )
        })
        .collect();
    let text = format!("scenario s extends 11_vs_11_stochastic {{\n{records}}}\n");
    let Err(setpiece::Error::Compile(failure)) = setpiece::compile_text(&text, "s.pitch") else {
        panic!("it compiles")
    };
    let [problem] = failure.problems.as_slice() else { panic!("{:?}", failure.problems) };
    assert_eq!(problem.code().to_string(), "SP0418");
    let (line, _) = failure.sources.iter().next().unwrap().1.line_column(problem.place().start);
    assert_eq!(line, 2, "at one of the records");
}

#[test]
fn names_that_files_are_called_by_are_words() {
    for name in ["../../x/evil", "", "a b", "a\u{1b}[31m", "a/b", &"a".repeat(129)] {
        let report = refused(|scenario| name.clone_into(&mut scenario.name));
        assert!(report.contains("name"), "{report}");
    }
    let report = refused(|scenario| scenario.players[0].name = Some("x\ny".to_owned()));
    assert!(report.contains("is not a name"), "{report}");
}

/// A replay with this many idle steps.
fn replay_of(steps: u32) -> Vec<u8> {
    let mut environment = Environment::new(corner().into(), EnvironmentOptions::default()).unwrap();
    environment.reset(Some(1), Some(0)).unwrap();
    let mut recorder = Recorder::default();
    recorder.begin(None);
    let mut replay = Replay::of(&environment, &recorder).unwrap();
    replay.length = steps;
    replay.to_bytes().unwrap()
}

#[test]
fn a_replay_has_no_more_steps_than_can_be_played() {
    let report = Replay::from_bytes(&replay_of(4_000_000_000)).unwrap_err().to_string();
    assert!(report.contains("too long"), "{report}");
    Replay::from_bytes(&replay_of(864_000)).unwrap();
}

#[test]
fn an_episode_longer_than_a_replay_is_not_kept() {
    let mut environment = Environment::new(corner().into(), EnvironmentOptions::default()).unwrap();
    environment.reset(Some(1), Some(0)).unwrap();
    let mut recorder = Recorder::default();
    recorder.begin(None);
    for _ in 0..4_000_002 {
        recorder.note(Action::Idle, None);
    }
    let report = Replay::of(&environment, &recorder).unwrap_err().to_string();
    assert!(report.contains("too long"), "{report}");
    recorder.begin(None);
    Replay::of(&environment, &recorder).unwrap();
}
