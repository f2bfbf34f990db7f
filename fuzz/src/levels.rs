//! What a text says about many episodes, and the levels of its curricula.

use crate::choice::Choices;
use setpiece::dsl::problem::{Problem, Severity};
use setpiece::dsl::source::Sources;
use setpiece::engine::batch::EpisodeSummary;
use setpiece::engine::environment::{Environment, EnvironmentOptions};
use setpiece::levels::{CurriculumRun, LevelSource as _};
use setpiece::scenario::plan::{Curriculum, Plans, Played, StageHow};
use setpiece::scenario::{Verdict, verify};
use setpiece::{Error, plans};

/// Levels that a curriculum chooses.
const LEVELS: usize = 40;

/// Whether a text may have suites, checks or curricula.
pub fn may_have_plans(text: &str) -> bool {
    ["suite", "check", "curriculum"].iter().any(|word| text.contains(word))
}

/// The plans of a text; `report` takes its problems.
pub fn plans(text: &str, name: &str, report: impl Fn(&[Problem], &Sources)) -> Option<Plans> {
    match plans::plans_of_text(text, name) {
        Ok(loaded) => {
            report(&loaded.warnings, &loaded.sources);
            hold(&loaded.plans);
            Some(loaded.plans)
        }
        Err(Error::Compile(failure)) => {
            let is_error = |problem: &Problem| problem.severity() == Severity::Error;
            assert!(failure.problems.iter().any(is_error), "no plans, and no error says why");
            report(&failure.problems, &failure.sources);
            None
        }
        Err(error) => panic!("a text is refused otherwise than by its problems: {error}"),
    }
}

/// Whatever is planned can be played: valid scenarios, and parameters within their ranges.
fn hold(plans: &Plans) {
    for suite in &plans.suites {
        assert!(!suite.entries.is_empty(), "suite {} has an entry", suite.name);
        suite.entries.iter().for_each(|entry| playable(&entry.played));
    }
    for check in &plans.checks {
        assert!(!check.expectations.is_empty(), "check {} expects something", check.name);
        playable(&check.episodes.played);
    }
    for curriculum in &plans.curricula {
        curriculum.stages.iter().for_each(|stage| playable(&stage.played));
        assert!((0.0..=1.0).contains(&curriculum.current), "a share: {}", curriculum.current);
        run(curriculum);
    }
}

fn playable(played: &Played) {
    verify::verify(&played.scenario).expect("a planned scenario holds");
    assert!(played.label().starts_with(&played.scenario.name));
    let given = played.scenario.params.iter().zip(&played.bindings.0);
    for (param, &value) in given {
        assert_eq!(
            param.admit(value).ok(),
            Some(value),
            "{} = {value} is in its range",
            param.name
        );
    }
}

/// A curriculum's levels, as long as every episode ends as its measure wants it.
fn run(curriculum: &Curriculum) {
    let mut run =
        CurriculumRun::new(curriculum.clone(), Some(1)).expect("a curriculum has a stage");
    let Some(mut episode) = summary(&curriculum.stages[0].played) else { return };
    for n in 0..LEVELS {
        let level = run.next().expect("a curriculum never runs out of levels");
        let stage = &curriculum.stages[level.scenario];
        for (param, &value) in stage.played.scenario.params.iter().zip(&level.bindings.0) {
            assert_eq!(
                param.admit(value).ok(),
                Some(value),
                "{}: {} = {value}",
                stage.name,
                param.name
            );
        }
        if let (StageHow::Adapt(adapt), Some(value)) =
            (&curriculum.stages[run.stage()].how, run.value())
        {
            let (least, most) = (adapt.from.min(adapt.to), adapt.from.max(adapt.to));
            assert!((least..=most).contains(&value), "{value} is between {least} and {most}");
        }
        episode.verdict = (n % 8 > 0).then_some(Verdict::Success);
        run.report(&level, &episode, &[]);
    }
    let mut again = CurriculumRun::new(curriculum.clone(), None).expect("a stage");
    again.restore(&run.save()).expect("a saved state is taken back");
    assert_eq!(again.next(), run.next(), "what was restored goes on as before");
}

/// The result of an episode that nobody has played; none without a start.
fn summary(played: &Played) -> Option<EpisodeSummary> {
    let options = EnvironmentOptions {
        bindings: Some(played.bindings.clone()),
        ..EnvironmentOptions::default()
    };
    let mut environment = Environment::new(played.scenario.clone(), options).ok()?;
    environment.reset(Some(1), None).ok()?;
    Some(EpisodeSummary::of(&environment))
}

/// Plans of a scenario that has parameters of these names, in 0..1.
pub fn text(choices: &mut Choices<'_>, scenario: &str, params: &[&str]) -> String {
    let bound = |choices: &mut Choices<'_>, value: &str| match params {
        [] => scenario.to_owned(),
        params => format!("{scenario}({}: {value})", choices.one(params)),
    };
    let mut text = String::from("suite many {\n");
    for _ in 0..=choices.below(3) {
        let (value, n) = (choices.between(0.0, 1.0), 1 + choices.below(9));
        let entry = bound(choices, &format!("{value:.2}"));
        text.push_str(&match choices.below(3) {
            0 => format!("{entry} for {n} episodes\n"),
            1 => format!("{entry} for {n} seed {n}\n"),
            _ => format!("each d in [0, {value:.2}] {{ {} for {n} }}\n", bound(choices, "d")),
        });
    }
    let (agent, measure) =
        (choices.one(&["bot", "random", "idle", "press"]), self::measure(choices));
    let over = choices.one(&["", " over params"]);
    let played = bound(choices, "0.5");
    text.push_str(&format!(
        "}}\ncheck \"it holds\" {{\nplay {played} with {agent} for 2 episodes{over}\nexpect {measure}\n}}\n"
    ));
    text.push_str(&format!(
        "curriculum learn {{\nstage first = {} until {} or steps > {}\n",
        bound(choices, "0.1"),
        self::measure(choices),
        1 + choices.below(90)
    ));
    if !params.is_empty() && choices.rarely(2) {
        let (from, to) = (choices.between(0.0, 1.0), choices.between(1.0, 0.0));
        text.push_str(&format!(
            "stage then_on = {} adapt d from {from:.2} to {to:.2} keeping success_rate(last: 3) in 20%..70%\n",
            bound(choices, "d")
        ));
    } else {
        text.push_str(&format!("stage then_on = {scenario}\n"));
    }
    if choices.rarely(2) {
        let share = choices.below(101);
        text.push_str(&format!("mix current: {share}%, earlier: {}%\n", 100 - share));
    }
    text.push_str("}\n");
    text
}

/// A measure of an episode and its bound.
fn measure(choices: &mut Choices<'_>) -> String {
    let sign = choices.one(&[">", "<", ">=", "<=", "==", "!="]);
    match choices.below(6) {
        0 => format!("success_rate {sign} 50%"),
        1 => format!("mean(length) {sign} 3s"),
        2 => format!("quantile(return, 90%) {sign} 0"),
        3 => format!("max(score) {sign} 1"),
        4 => format!("min(return) {sign} -1"),
        _ => format!("rate(outcome time_limit) {sign} 10%"),
    }
}
