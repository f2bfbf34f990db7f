use super::*;
use crate::testing::{scenario, scoring};
use setpiece_scenario::vocabulary::{Role, Verdict};
use setpiece_scenario::{BinaryOp, Ending, Instr, Program, Reg, RewardBody, RewardHook, Script};

fn basic() -> Scenario {
    let mut scenario = scenario(&[
        (Team::Left, Role::CF, 0.5, 0.0),
        (Team::Left, Role::GK, -50.0, 0.0),
        (Team::Right, Role::GK, 50.0, 0.0),
    ]);
    scenario.rewards.push(scoring());
    scenario
}

fn environment(scenario: Scenario) -> Environment {
    setpiece_scenario::verify::verify(&scenario).unwrap();
    Environment::new(Arc::new(scenario), EnvironmentOptions::default()).unwrap()
}

/// Ends with this label when the given register's value is not 0.
fn ending(scenario: &mut Scenario, label: &str, verdict: Option<Verdict>, when: Instr) {
    scenario.endings.program.code.push(when);
    let when = Some(Reg(scenario.endings.program.code.len() as u32 - 1));
    scenario.endings.list.push(Ending { verdict, label: label.to_owned(), when, script: None });
}

fn script_reward(source: &str) -> Scenario {
    let mut scenario = basic();
    scenario.scripts.push(Script {
        name: "own.rhai".to_owned(),
        at: (1, 1),
        source: source.to_owned(),
        named: Vec::new(),
        modules: Vec::new(),
    });
    scenario.rewards = vec![Reward {
        name: "own".to_owned(),
        doc: String::new(),
        body: RewardBody {
            init: Program { code: Vec::new(), cells: 1, ..Program::default() },
            step: Program {
                code: vec![
                    Instr::Cell(0),
                    Instr::Const(2.0),
                    Instr::Binary(BinaryOp::Mul, Reg(0), Reg(1)),
                    Instr::Give { term: 0, value: Reg(2), guard: None },
                ],
                cells: 1,
                ..Program::default()
            },
            terms: vec!["script".to_owned()],
            hooks: vec![RewardHook { script: 0, cell: 0, terms: Vec::new(), args: Vec::new() }],
        },
    }];
    scenario
}

#[test]
fn an_episode_runs_exactly_to_its_limit() {
    let mut environment = environment(basic());
    let mut scratch = Scratch::default();
    environment.reset(Some(1), None).unwrap();
    for step in 1..=50 {
        let result = environment.step(&[Action::Idle], &mut scratch).unwrap();
        assert_eq!(result, StepResult { terminated: false, truncated: step == 50 });
        assert_eq!(environment.steps(), step);
    }
    let outcome = environment.outcome().unwrap();
    assert_eq!((&*outcome.label, outcome.verdict, outcome.truncated), ("limit", None, true));
    let error = environment.step(&[Action::Idle], &mut scratch).unwrap_err();
    assert_eq!(error.to_string(), "the episode has ended: reset the environment first");
}

#[test]
fn stepping_needs_an_episode_and_an_action_per_agent() {
    let mut environment = environment(basic());
    let mut scratch = Scratch::default();
    let unbegun = environment.step(&[Action::Idle], &mut scratch).unwrap_err();
    assert_eq!(unbegun, StepError::NotRunning { begun: false });
    environment.reset(Some(1), None).unwrap();
    let few = environment.step(&[], &mut scratch).unwrap_err();
    assert_eq!(few, StepError::Actions { found: 0, expected: 1 });
    assert_eq!(environment.steps(), 0);
}

#[test]
fn the_first_ending_wins_and_termination_beats_the_limit() {
    let mut scenario = basic();
    let step_limit = scenario.start.program.code.len() as u32;
    scenario.start.program.code.push(Instr::Const(0.1));
    scenario.start.limit = Some(Reg(step_limit));
    ending(&mut scenario, "never", None, Instr::Const(0.0));
    ending(&mut scenario, "won", Some(Verdict::Success), Instr::Const(1.0));
    ending(&mut scenario, "lost", Some(Verdict::Failure), Instr::Const(1.0));
    let mut environment = environment(scenario);
    environment.reset(Some(1), None).unwrap();
    let result = environment.step(&[Action::Idle], &mut Scratch::default()).unwrap();
    assert_eq!(result, StepResult { terminated: true, truncated: false });
    let outcome = environment.outcome().unwrap();
    assert_eq!((&*outcome.label, outcome.verdict), ("won", Some(Verdict::Success)));
    let end = environment.events().last().unwrap();
    assert_eq!(end.kind, setpiece_scenario::vocabulary::EventKind::End);
}

#[test]
fn resets_count_episodes() {
    let mut environment = environment(basic());
    environment.reset(None, None).unwrap();
    assert_eq!((environment.seed(), environment.index()), (0, 0));
    environment.reset(None, None).unwrap();
    assert_eq!(environment.index(), 1);
    environment.reset(Some(9), None).unwrap();
    assert_eq!((environment.seed(), environment.index()), (9, 0));
    environment.reset(None, Some(41)).unwrap();
    environment.reset(None, None).unwrap();
    assert_eq!((environment.seed(), environment.index()), (9, 42));
}

#[test]
fn rewards_are_chosen_by_name() {
    let mut scenario = basic();
    let mut other = scoring();
    other.name = "other".to_owned();
    scenario.library.push(other);
    let with = |names: &[&str]| {
        let rewards = Some(names.iter().map(ToString::to_string).collect());
        Environment::new(
            Arc::new(scenario.clone()),
            EnvironmentOptions { rewards, ..Default::default() },
        )
    };
    assert_eq!(with(&["other"]).unwrap().term_names(), ["other/1", "other/2"]);
    assert_eq!(
        with(&["othr"]).unwrap_err().to_string(),
        "no reward `othr`; there is `other`, `scoring`"
    );
}

#[test]
fn a_script_pays_and_remembers() {
    let source = "fn reward(ctx, now, prev, events) {
        this.n = (this.n ?? 0) + 1;
        if now.me == () { 0.0 } else { this.n + now.me.x * 0.0 }
    }";
    let mut environment = environment(script_reward(source));
    let mut scratch = Scratch::default();
    for _ in 0..2 {
        environment.reset(Some(1), None).unwrap();
        environment.game.agents[0].player = Some(PlayerId(0));
        for n in 1..=3u8 {
            environment.step(&[Action::Idle], &mut scratch).unwrap();
            assert_eq!(environment.rewards(), [2.0 * f32::from(n)]);
        }
        assert_eq!(environment.term_sums(0), [12.0]);
    }
    assert_eq!(environment.term_names(), ["own/script"]);
}

#[test]
fn a_failing_script_ends_its_episode_and_no_more() {
    let source = "fn reward(ctx, now, prev, events) {\n    if ctx.step == 2 {\n        loop { }\n    }\n    0\n}";
    let mut environment = environment(script_reward(source));
    let mut scratch = Scratch::default();
    for _ in 0..2 {
        environment.reset(Some(4), Some(7)).unwrap();
        environment.step(&[Action::Idle], &mut scratch).unwrap();
        let StepError::Script(error) = environment.step(&[Action::Idle], &mut scratch).unwrap_err()
        else {
            panic!("expected the script's error");
        };
        assert_eq!((error.script.as_str(), error.hook.as_str()), ("own.rhai", "reward"));
        assert_eq!((error.seed, error.index, error.step), (4, 7, 2));
        assert!(error.message.contains("a loop doesn't end"), "{error}");
        assert!(!environment.is_running());
    }
}

#[test]
fn scripts_draw_from_the_episodes_seed() {
    let source = "fn reward(ctx, now, prev, events) { ctx.random() }";
    let mut environment = environment(script_reward(source));
    let mut scratch = Scratch::default();
    let mut run = |seed| {
        environment.reset(Some(seed), None).unwrap();
        let mut paid = |()| {
            environment.step(&[Action::Idle], &mut scratch).unwrap();
            environment.rewards()[0]
        };
        [paid(()), paid(())]
    };
    let first = run(1);
    assert_ne!(first[0], first[1]);
    assert_eq!(first, run(1));
    assert_ne!(first, run(2));
}

#[test]
fn a_done_hook_ends_with_its_label() {
    let mut scenario = basic();
    let source =
        "fn done(ctx, now, prev, events) { if ctx.step == 3 { \"tired\" } else { false } }";
    scenario.scripts.push(Script {
        name: "own.rhai".to_owned(),
        at: (1, 1),
        source: source.to_owned(),
        named: Vec::new(),
        modules: Vec::new(),
    });
    let (verdict, label) = (Some(Verdict::Failure), "script".to_owned());
    scenario.endings.list.push(Ending { verdict, label, when: None, script: Some(0) });
    let mut environment = environment(scenario);
    let mut scratch = Scratch::default();
    environment.reset(Some(1), None).unwrap();
    while environment.is_running() {
        environment.step(&[Action::Idle], &mut scratch).unwrap();
    }
    assert_eq!(environment.steps(), 3);
    assert_eq!(&*environment.outcome().unwrap().label, "tired");
}

#[test]
fn a_clone_goes_its_own_way() {
    let source =
        "fn reward(ctx, now, prev, events) { this.n = (this.n ?? 0) + 1; this.n + ctx.random() }";
    let mut first = environment(script_reward(source));
    let mut scratch = Scratch::default();
    first.reset(Some(1), None).unwrap();
    first.step(&[Action::Idle], &mut scratch).unwrap();
    let mut second = first.clone();
    for environment in [&mut first, &mut second] {
        environment.step(&[Action::Right], &mut scratch).unwrap();
    }
    assert_eq!(first.rewards(), second.rewards());
    assert_eq!(first.digest(), second.digest());
}

#[test]
fn scripts_are_swapped_within_an_episode_and_nothing_else_is() {
    let counting = |add: &str| {
        script_reward(&format!(
            "fn reward(ctx, now, prev, events) {{ this.n = (this.n ?? 0) + 1; this.n + {add} }}"
        ))
    };
    let mut environment = environment(counting("0"));
    let mut scratch = Scratch::default();
    environment.reset(Some(1), None).unwrap();
    let mut paid = |environment: &mut Environment| {
        environment.step(&[Action::Idle], &mut scratch).unwrap();
        environment.rewards()[0]
    };
    assert_eq!([paid(&mut environment), paid(&mut environment)], [2.0, 4.0]);
    assert_eq!(environment.adopt_scripts(&Arc::new(counting("100"))), Ok(true));
    assert_eq!(paid(&mut environment), 206.0, "its memory goes on");
    let mut other = counting("0");
    other.name = "another".to_owned();
    assert_eq!(environment.adopt_scripts(&Arc::new(other)), Ok(false));
    assert_eq!(paid(&mut environment), 208.0);
    assert!(environment.adopt_scripts(&Arc::new(counting("(")),).is_err());
    assert_eq!(environment.adopt_scripts(&Arc::new(counting("now.me.speed"))), Ok(true));
    assert_eq!(paid(&mut environment), 2.0, "each agent has its own memory");
}
