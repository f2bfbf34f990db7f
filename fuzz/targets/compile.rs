//! Any text through the compiler, its reports and the formatter.
#![no_main]

use libfuzzer_sys::fuzz_target;
use setpiece::Error;
use setpiece::dsl::problem::{Problem, Severity};
use setpiece::dsl::report::{Format, render};
use setpiece::dsl::source::{Source, Sources};
use setpiece::scenario::plan::{Plans, Played};
use setpiece::scenario::{Scenario, file, verify};
use setpiece_fuzz::levels;

const NAME: &str = "<fuzz>";

fuzz_target!(init: setpiece_fuzz::seed::write("compile"), |data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let scenario = match setpiece::compile_text(text, NAME) {
        Ok(loaded) => {
            assert!(loaded.warnings.iter().all(|problem| problem.severity() == Severity::Warning));
            report(&loaded.warnings, &loaded.sources);
            survives(&loaded.scenario);
            Some(loaded.scenario)
        }
        Err(Error::Compile(failure)) => {
            let is_error = |problem: &Problem| problem.severity() == Severity::Error;
            let failed = failure.problems.iter().any(is_error);
            assert!(failed, "no scenario, and no error says why");
            report(&failure.problems, &failure.sources);
            None
        }
        Err(error) => panic!("a text is refused otherwise than by its problems: {error}"),
    };
    let plans =
        levels::may_have_plans(text).then(|| levels::plans(text, NAME, report)).flatten();
    let source = Source { name: NAME.to_owned(), text: text.into() };
    let Ok(formatted) = setpiece::dsl::format::format(&source) else {
        assert!(scenario.is_none() && plans.is_none(), "what compiles can be formatted");
        return;
    };
    let again = Source { name: NAME.to_owned(), text: formatted.as_str().into() };
    let again = setpiece::dsl::format::format(&again).expect("what was formatted can be formatted");
    assert_eq!(formatted, again, "what was formatted is its own format");
    if let Some(scenario) = scenario {
        let other = setpiece::compile_text(&formatted, NAME).expect("what was formatted compiles as before");
        assert_eq!(said(&scenario), said(&other.scenario), "what was formatted says the same");
    }
    if let Some(plans) = plans {
        let other = levels::plans(&formatted, NAME, report).expect("formatted plans compile as before");
        assert_eq!(planned(&plans), planned(&other), "formatted plans say the same");
    }
});

/// What plans say, except quotations from their text.
fn planned(plans: &Plans) -> String {
    let played = |played: &Played| format!("{:?} {}", played.bindings, said(&played.scenario));
    let mut text = String::new();
    for suite in &plans.suites {
        text.push_str(&format!("suite {} {}\n", suite.name, suite.doc));
        for entry in &suite.entries {
            text.push_str(&format!("{} {} {}\n", entry.count, entry.seed, played(&entry.played)));
        }
    }
    for check in &plans.checks {
        let episodes = &check.episodes;
        let goals: Vec<_> = check.expectations.iter().map(|expected| &expected.goal).collect();
        text.push_str(&format!("check {} {} {}", check.name, check.agent, check.over_params));
        text.push_str(&format!(" {} {} {goals:?}", episodes.count, episodes.seed));
        text.push_str(&format!("{}\n", played(&episodes.played)));
    }
    for curriculum in &plans.curricula {
        let (name, doc, current) = (&curriculum.name, &curriculum.doc, curriculum.current);
        text.push_str(&format!("curriculum {name} {doc} {current}\n"));
        for stage in &curriculum.stages {
            text.push_str(&format!("{} {:?} {}\n", stage.name, stage.how, played(&stage.played)));
        }
    }
    text
}

/// A scenario's content, except quotations from its text and the places of scripts.
fn said(scenario: &Scenario) -> String {
    let mut scenario = scenario.clone();
    scenario.start.requires.iter_mut().for_each(|require| require.label.clear());
    scenario.scripts.iter_mut().for_each(|script| script.at = (1, 1));
    file::to_json(&scenario).expect("a compiled scenario can be written")
}

/// Problems point into their files, and can be rendered in both forms.
fn report(problems: &[Problem], sources: &Sources) {
    for label in problems.iter().flat_map(|problem| problem.words().labels) {
        let source = sources.get(label.span.file).expect("a label in a file");
        let range = label.span.start as usize..label.span.end as usize;
        assert!(source.text.get(range).is_some(), "{label:?} points outside its file");
    }
    let human = render(problems, sources, Format::Human { color: false, width: 80 });
    assert_eq!(human.is_empty(), problems.is_empty(), "a report says something");
    let json = render(problems, sources, Format::Json);
    let list: Vec<serde_json::Value> = serde_json::from_str(&json).expect("a report in JSON");
    assert_eq!(list.len(), problems.len(), "a report in JSON holds every problem");
}

/// A compiled scenario is valid like a loaded one, and survives writing and reading.
fn survives(scenario: &Scenario) {
    verify::verify(scenario).expect("a compiled scenario holds");
    let text = file::to_json(scenario).expect("a compiled scenario can be written");
    let again = file::from_json(&text).expect("a written scenario can be read");
    assert_eq!(
        file::to_json(&again).as_ref(),
        Ok(&text),
        "a scenario that was read is what was written"
    );
}
