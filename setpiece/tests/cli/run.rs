//! `setpiece run`: what it shows, and options and scenarios that it refuses.

use super::{CLOSE, fails, folder, json, setpiece, text, write};

#[test]
fn runs_a_scenario_of_the_library() {
    let result = json(&[
        "run",
        "academy_empty_goal_close",
        "--agent",
        "run_and_shoot",
        "--episodes",
        "20",
        "--seed",
        "1",
        "--format",
        "json",
    ]);
    let keys = [
        "scenario",
        "episodes",
        "seed",
        "outcomes",
        "score",
        "mean_return",
        "mean_length",
        "success_rate",
        "terms",
        "steps_per_second",
        "digest",
    ];
    for key in keys {
        assert!(!result[key].is_null(), "no `{key}` in {result}");
    }
    assert_eq!(result["episodes"], 20);
    assert!(result["success_rate"].as_f64().unwrap() >= 0.9, "{result}");
    assert!(
        (result["mean_return"].as_f64().unwrap()
            - result["terms"]["scoring/goal"].as_f64().unwrap())
        .abs()
            < 1e-9
    );
}

#[test]
fn the_text_shows_the_start_and_the_outcomes() {
    let output = setpiece(&["run", "academy_3_vs_1_with_keeper", "--episodes", "5", "--seed", "3"]);
    assert!(output.status.success());
    let stdout = text(&output.stdout);
    for word in ["Three of ours", "┌", "steps per second", "mean length"] {
        assert!(stdout.contains(word), "no `{word}` in {stdout}");
    }
}

#[test]
fn threads_and_repetition_change_nothing() {
    let run = |threads: &str| {
        json(&[
            "run",
            "academy_3_vs_1_with_keeper",
            "--agent",
            "random",
            "--episodes",
            "12",
            "--seed",
            "5",
            "--threads",
            threads,
            "--format",
            "json",
        ])
    };
    let (one, again, two) = (run("1"), run("1"), run("2"));
    for key in ["digest", "outcomes", "terms", "mean_return", "mean_length"] {
        assert_eq!(one[key], again[key], "{key}");
        assert_eq!(one[key], two[key], "{key}");
    }
}

#[test]
fn wrong_options_are_one_clear_error() {
    fails(&["run", "academy_empty_goal", "--episodes", "0"], 2, &["--episodes"]);
    fails(&["run", "academy_empty_goal", "--threads", "0"], 2, &["--threads"]);
    fails(&["run", "academy_empty_goal", "--agent", "genius"], 2, &["--agent"]);
    fails(&["run", "academy_empty_goal", "--set", "difficulty"], 2, &["name=value"]);
    fails(
        &["run", "academy_empty_goal", "--set", "dificulty=0.9"],
        1,
        &["SP0008", "did you mean `difficulty`?"],
    );
    fails(&["run", "academy_empty_goal", "--set", "difficulty=2"], 1, &["SP0008", "0..1"]);
    fails(&["run", "academy_empty_goal", "--set", "difficulty=much"], 1, &["SP0008", "much"]);
    fails(
        &["run", "academy_empty_goal", "--reward", "scorin"],
        1,
        &["SP0009", "did you mean `scoring`?"],
    );
    fails(&["run", "academy_empty_goal", "--seed", "-1"], 2, &["--seed"]);
}

#[test]
fn a_parameter_that_makes_no_start_is_one_clear_error() {
    let folder = folder();
    let source = CLOSE.replace(
        "ball at (0.77, 0)",
        "param x = 0.77\n    param n = 5\n    ball at (x, 0)\n    end limit n * 1 step",
    );
    let path = write(folder.path(), "free.pitch", source);
    assert!(setpiece(&["run", &path, "--episodes", "1"]).status.success());
    let off = fails(
        &["run", &path, "--set", "x=3"],
        1,
        &["SP0701", "`the ball lies on the pitch` does not hold"],
    );
    assert!(!off.contains("attempts"), "nothing is drawn: {off}");
    fails(&["run", &path, "--set", "n=0"], 1, &["SP0701", "the limit is 1 step"]);
    fails(
        &["run", &path, "--set", "n=2.5"],
        1,
        &["SP0008", "expected a whole number, found `2.5`"],
    );
    fails(
        &["run", "academy_corner", "--set", "difficulty=2"],
        1,
        &["SP0008", "is 2, outside 0..1"],
    );
    fails(
        &["run", "academy_corner", "--reward", "scoring", "--reward", "scoring"],
        1,
        &["SP0009", "requested twice"],
    );
}

#[test]
fn a_name_that_the_file_lacks_is_answered_with_its_scenarios_and_suites() {
    let folder = folder();
    let suites = "suite short { close for 2 episodes }\nsuite thorough { close for 9 episodes }";
    let both = write(folder.path(), "both.pitch", format!("{CLOSE}\n{suites}"));
    let run = |path: &str, name: &str, help: &str| {
        fails(&["run", path, "--scenario", name], 1, &["SP0214", help]);
    };
    run(&both, "nope", "it has the suites `short`, `thorough` and `close`");
    run(&both, "thorogh", "did you mean `thorough`?");
    run(&both, "clos", "did you mean `close`?");
    let one = write(
        folder.path(),
        "one.pitch",
        format!("{CLOSE}\nsuite short {{ close for 2 episodes }}"),
    );
    run(&one, "nope", "it has the suite `short` and `close`");
    let library = "suite short { academy_corner for 2 episodes }";
    let alone = write(folder.path(), "alone.pitch", library);
    run(&alone, "nope", "it has `short`");
    run(&alone, "shrt", "did you mean `short`?");
}

#[test]
fn values_that_are_not_finite_are_reported() {
    let folder = folder();
    let parts = "reward x {
        state n = 0
        give 1 as \"sound\"
        give 1 / n when elapsed > 0.5s as \"broken\"
    }
    reward y { state n = 0  n = n / n  give n }
    reward z { give 1 }
    ball at";
    let path = write(folder.path(), "faulty.pitch", CLOSE.replace("ball at", parts));
    let output = text(&setpiece(&["run", &path, "--episodes", "2"]).stdout);
    for line in [
        "values were not finite and were not paid",
        "`broken` of the reward `x`: first in step 6 of episode 0",
        "a `state` of the reward `y`: first in step 1 of episode 0",
    ] {
        assert!(output.contains(line), "{line}: {output}");
    }
    let named = output.lines().filter(|line| line.contains("of the reward"));
    assert_eq!(named.count(), 2, "{output}");
    assert!(
        json(&["run", &path, "--episodes", "2", "--format", "json"])["faults"].as_u64().unwrap()
            > 0
    );
}

#[test]
fn a_value_that_grows_beyond_numbers_is_not_paid() {
    let folder = folder();
    let source = CLOSE.replace(
        "ball at",
        "reward x { state n = 1  n = n * 1e10  give n as \"grows\" }\n    ball at",
    );
    let path = write(folder.path(), "grows.pitch", source);
    let result = json(&["run", &path, "--episodes", "1", "--format", "json"]);
    assert!(result["faults"].as_u64().unwrap() > 0);
    assert!(result["mean_return"].as_f64().unwrap().abs() < 1e31);
}

#[test]
fn an_episode_without_an_end_is_refused_at_once() {
    let folder = folder();
    let path = write(
        folder.path(),
        "endless.pitch",
        "scenario s { ball at centre  team left { CM at (-0.1, 0) } }",
    );
    fails(&["run", &path], 1, &["SP0703", "has no end"]);
}

#[test]
fn agents_of_both_sides_have_a_mean_each() {
    let folder = folder();
    let both = CLOSE.replace("ball at", "agents { left: 1, right: 1 }\n    ball at");
    let path = write(folder.path(), "both.pitch", both);
    let output = text(&setpiece(&["run", &path, "--episodes", "3"]).stdout);
    let line = output.lines().find(|line| line.contains("mean return")).unwrap();
    assert!(line.contains(" : "), "{output}");
    let result = json(&["run", &path, "--episodes", "3", "--format", "json"]);
    let (left, right) = (&result["mean_returns"]["left"], &result["mean_returns"]["right"]);
    let mean = f64::midpoint(left.as_f64().unwrap(), right.as_f64().unwrap());
    assert!((result["mean_return"].as_f64().unwrap() - mean).abs() < 1e-9, "{result}");
    let one = write(folder.path(), "close.pitch", CLOSE);
    let result = json(&["run", &one, "--episodes", "1", "--format", "json"]);
    assert!(result["mean_returns"].is_null(), "{result}");
}

#[test]
fn a_scenario_of_a_file_is_chosen_by_its_name() {
    let folder = folder();
    let second = CLOSE.replacen("scenario close", "scenario second", 1);
    assert_ne!(second, CLOSE);
    let path = write(folder.path(), "both.pitch", format!("{CLOSE}\n{second}"));
    let played = |more: &[&str]| {
        let result = json(&[&["run", &path, "-n", "1", "--format", "json"], more].concat());
        result["scenario"].as_str().unwrap().to_owned()
    };
    assert_eq!(played(&[]), "second");
    assert_eq!(played(&["--scenario", "close"]), "close");
    fails(&["run", &path, "--scenario", "clos"], 1, &["`clos`", "`close`"]);
    fails(&["run", &path, "--scenario", "close", "--level", "close#1"], 2, &["--level"]);
}

#[test]
fn a_level_that_stands_for_a_scenario_is_recognised() {
    fails(
        &["run", "academy_corner{difficulty=0.8}#3"],
        1,
        &["SP0005", "`--level 'academy_corner{difficulty=0.8}#3'`"],
    );
}

#[test]
fn a_level_that_cant_be_read_has_a_code() {
    for level in ["", "x{", "academy_corner{difficulty=0.8", "{\"scenario\": 3}", "a#1:x"] {
        fails(&["run", "--level", level], 1, &["SP0022", "can't be read", "help: a level is"]);
    }
    fails(&["run", "--level", &format!("academy_corner#1:{}", u64::MAX)], 1, &["SP0022"]);
}

/// Five goals in five episodes aren't a goal in every episode.
#[test]
fn a_score_of_few_episodes_has_a_wide_interval() {
    let args = ["run", "academy_empty_goal_close", "-a", "baseline", "--beside", "idle", "-n", "5"];
    let table = json(&[&args[..], &["--format", "json"]].concat());
    let agents = &table["entries"][0]["agents"];
    let score = |agent: usize, end: &str| agents[agent]["score"][end].as_f64().unwrap();
    assert_eq!([score(0, "value"), score(0, "high")], [1.0, 1.0], "{table}");
    assert!((score(0, "low") - 0.5655).abs() < 1e-3, "{table}");
    assert!((score(1, "high") - 0.4345).abs() < 1e-3, "{table}");
}
