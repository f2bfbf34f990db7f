//! Suites, checks and levels, by the real binary.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::level::Level;
use setpiece_scenario::Bindings;
use std::path::Path;
use std::process::Command;

const DRILL: &str = r#"
scenario drill extends academy {
    param gap = 2m in 1m..20m
    ball at (50m, 0m)
    team left { CF at (50m - gap, 0m) }
    end missed when elapsed > 10s
}
check "the empty goal is scored" {
    play drill with run_and_shoot for 20 episodes over params
    expect success_rate > 60%
}
check "nobody scores by standing" {
    play drill with idle for 10 episodes
    expect success_rate > 50%
}
suite near_and_far {
    each d in [1m, 15m] { drill(gap: d) for 10 episodes }
}
"#;

/// The exit code and both outputs of a command in a folder with the drill.
fn setpiece(folder: &Path, args: &[&str]) -> (Option<i32>, String, String) {
    std::fs::write(folder.join("drill.pitch"), DRILL).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_setpiece"))
        .args(args)
        .current_dir(folder)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn a_behaviour_of_the_file_plays_a_check() {
    let dir = tempfile::tempdir().unwrap();
    let text = r#"
        behavior finish { do run(0deg) for 0.5s  do shoot }
        scenario drill extends academy {
            ball at (45m, 0m)
            team left { CF at (43m, 0m) }
        }
        check "by a behaviour" { play drill with finish for 20 episodes  expect success_rate > 90% }
        check "by nobody" { play drill with hold for 20 episodes  expect success_rate < 1% }
    "#;
    std::fs::write(dir.path().join("by.pitch"), text).unwrap();
    let (code, out, err) = setpiece(dir.path(), &["test", "by.pitch"]);
    assert_eq!(code, Some(0), "{out}{err}");
    let (_, out, _) = setpiece(dir.path(), &["test", "by.pitch", "--format", "json"]);
    assert!(out.contains("\"finish\"") && out.contains("\"hold\""), "{out}");
}

#[test]
fn a_failed_check_leaves_its_worst_episode_and_the_command_that_shows_it() {
    let dir = tempfile::tempdir().unwrap();
    let (code, out, err) = setpiece(dir.path(), &["test"]);
    assert_eq!(code, Some(1), "{out}{err}");
    assert!(out.contains("2 checks, 1 failed"), "{out}");
    let files: Vec<_> = std::fs::read_dir(dir.path().join("failed-checks"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    let replay = files.iter().find(|name| name.ends_with(".pitchr")).unwrap();
    let shown = out.lines().find(|line| line.contains("see it: setpiece")).unwrap();
    assert!(shown.contains(replay.as_str()), "{shown}");
    let (code, _, err) = setpiece(dir.path(), &["replay", &format!("failed-checks/{replay}")]);
    assert_eq!(code, Some(0), "{err}");
}

#[test]
fn what_plays_an_abstract_scenario_is_an_error_beside_whatever_else_stands_there() {
    let dir = tempfile::tempdir().unwrap();
    let plans = [
        "check \"b\" { play academy for 3 episodes  expect success_rate > 1% }",
        "suite b { academy for 3 episodes }",
        "curriculum b { stage a = academy }",
    ];
    let good = "check \"a\" { play academy_corner for 3 episodes  expect success_rate >= 0% }";
    for text in plans.iter().flat_map(|plan| [(*plan).to_owned(), format!("{good}\n{plan}")]) {
        std::fs::write(dir.path().join("plans.pitch"), &text).unwrap();
        for command in ["check", "test"] {
            let (code, out, err) = setpiece(dir.path(), &[command, "plans.pitch"]);
            assert_eq!(code, Some(1), "{text}: {out}{err}");
            assert!(err.contains("`academy` is abstract") && err.contains("SP0214"), "{err}");
        }
    }
    let (code, _, err) = setpiece(dir.path(), &["run", "plans.pitch", "--scenario", "b"]);
    assert_eq!(code, Some(1));
    assert!(err.contains("`academy` is abstract") && !err.contains("did you mean"), "{err}");
}

#[test]
fn failed_checks_of_the_same_words_leave_replays_of_their_own() {
    let dir = tempfile::tempdir().unwrap();
    let check = |sign| {
        let seed = if sign == '!' { 1 } else { 2 };
        format!(
            "check \"x{sign}\" {{ play academy_corner with idle for 1 episodes seed {seed}  expect mean(length) < 1 step }}\n"
        )
    };
    for folder in ["d1", "d2"] {
        std::fs::create_dir_all(dir.path().join(folder)).unwrap();
        let file = dir.path().join(folder).join("a.pitch");
        std::fs::write(file, [check('!'), check('?')].concat()).unwrap();
    }
    let (code, out, err) = setpiece(dir.path(), &["test", "d1", "d2"]);
    assert_eq!(code, Some(1), "{out}{err}");
    let replays: Vec<_> = std::fs::read_dir(dir.path().join("failed-checks")).unwrap().collect();
    assert_eq!(replays.len(), 4, "{out}");
    for file in ["d1/a.pitch", "d2/a.pitch"] {
        let file = Path::new(file).display().to_string();
        assert_eq!(out.matches(&file).count(), 2, "{out}");
    }
}

#[test]
fn suites_are_not_watched() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("s.pitch"), "suite s { academy_corner for 1 episodes }")
        .unwrap();
    let named = ["run", "s.pitch", "--watch", "--scenario", "s"];
    for args in [&named[..], &named[..3], &["run", "academy", "--watch"]] {
        let (code, out, err) = setpiece(dir.path(), args);
        assert_eq!(code, Some(1), "{out}{err}");
        assert!(err.contains("`--watch` has no effect on a suite"), "{err}");
    }
}

#[test]
fn checks_are_the_same_with_any_number_of_threads() {
    let dir = tempfile::tempdir().unwrap();
    let args = |threads| ["test", "--format", "json", "--threads", threads];
    let without_time = |text: String| -> Vec<serde_json::Value> {
        let lines = text.lines().map(|line| serde_json::from_str(line).unwrap());
        let mut checks: Vec<serde_json::Value> = lines.collect();
        for check in &mut checks {
            check.as_object_mut().unwrap().remove("seconds");
        }
        checks
    };
    let [one, three] = ["1", "3"].map(|n| without_time(setpiece(dir.path(), &args(n)).1));
    assert_eq!(one.len(), 2);
    assert_eq!(one, three);
}

#[test]
fn a_filter_that_leaves_no_check_is_an_error() {
    let dir = tempfile::tempdir().unwrap();
    let (code, _, err) = setpiece(dir.path(), &["test", "--filter", "keeper"]);
    assert_eq!(code, Some(1));
    assert!(err.contains("SP0020") && err.contains("no check here has `keeper`"), "{err}");
    let (code, out, _) = setpiece(dir.path(), &["test", "--filter", "empty goal"]);
    assert_eq!(code, Some(0));
    assert!(out.contains("1 check, 0 failed"), "{out}");
}

#[test]
fn a_suite_is_a_table_with_a_row_for_each_entry() {
    let dir = tempfile::tempdir().unwrap();
    let (code, out, err) =
        setpiece(dir.path(), &["run", "academy", "--agent", "run_and_shoot", "--format", "csv"]);
    assert_eq!(code, Some(0), "{err}");
    assert_eq!(out.lines().count(), 12, "a heading and the Academy's 11:\n{out}");

    let suite = DRILL.find("suite").unwrap();
    let suite = DRILL[suite..].replace("drill(gap: d)", "academy_corner(difficulty: 0.5)");
    std::fs::write(dir.path().join("alone.pitch"), suite).unwrap();
    let args = ["run", "alone.pitch", "--beside", "random", "--format", "csv"];
    let (code, out, err) = setpiece(dir.path(), &args);
    assert_eq!(code, Some(0), "{err}");
    assert_eq!(out.lines().count(), 5, "{out}");
}

#[test]
fn a_suite_without_rewards_returns_zero_without_a_sign() {
    let dir = tempfile::tempdir().unwrap();
    let text = "scenario plain { ball at (0, 0) agents { left: 1 } end limit 2 steps\n\
        team left { GK at (-1, 0) CM at (-0.1, 0) } team right { GK at (1, 0) } }\n\
        suite all { plain for 2 episodes }\n";
    std::fs::write(dir.path().join("plain.pitch"), text).unwrap();
    let args = ["run", "plain.pitch", "--scenario", "all", "--format", "csv"];
    let (code, out, err) = setpiece(dir.path(), &args);
    assert_eq!(code, Some(0), "{err}");
    assert!(out.contains(",0,") && !out.contains("-0,"), "{out}");
}

#[test]
fn a_run_plays_what_is_named_and_says_what_else_stands_there() {
    let dir = tempfile::tempdir().unwrap();
    let text = "scenario drill extends academy_empty_goal_close {}\n\
        suite near { drill for 2 episodes }\nsuite far { academy_empty_goal for 2 episodes }\n\
        curriculum learn { stage one = drill until episodes > 9 }\n";
    std::fs::write(dir.path().join("all.pitch"), text).unwrap();
    let run = |more: &[&str]| {
        let args = [&["run", "all.pitch"], more].concat();
        setpiece(dir.path(), &args)
    };
    let (code, out, err) = run(&["--episodes", "2"]);
    assert_eq!(code, Some(0), "{err}");
    assert!(out.contains("2 episodes · agent bot"), "{out}");
    assert!(err.contains("the suites `near`, `far` too: `--scenario near` plays one"), "{err}");
    let (code, out, err) = run(&["--scenario", "far"]);
    assert_eq!(code, Some(0), "{err}");
    assert!(out.contains("academy_empty_goal") && !out.contains("near"), "{out}");
    let (code, _, err) = run(&["--scenario", "fr"]);
    assert_eq!(code, Some(1));
    assert!(err.contains("SP0214") && err.contains("`fr`"), "{err}");
    let (code, _, err) = run(&["--scenario", "learn"]);
    assert_eq!(code, Some(1));
    assert!(err.contains("SP0020") && err.contains("levels=\"learn\""), "{err}");
    let (code, _, err) = run(&["--agent", "random", "--agent", "bot"]);
    assert_eq!(code, Some(2));
    assert!(err.contains("--beside"), "{err}");
}

#[test]
fn a_file_of_suites_alone_needs_no_scenario() {
    let dir = tempfile::tempdir().unwrap();
    for (suite, problems) in [
        ("suite a { academy_corner for 5 episodes }", "no problems"),
        ("suite a { academy_cornr for 5 episodes }", "1 error and 0 warnings"),
    ] {
        std::fs::write(dir.path().join("alone.pitch"), suite).unwrap();
        let (_, out, err) = setpiece(dir.path(), &["check", "alone.pitch"]);
        assert!(out.contains(problems), "{out}{err}");
    }
    let (code, _, err) = setpiece(dir.path(), &["run", "alone.pitch"]);
    assert_eq!(code, Some(1));
    assert!(err.contains("SP0201") && !err.contains("SP0214"), "{err}");
    let (_, _, err) = setpiece(dir.path(), &["run", "academi"]);
    assert!(err.contains("did you mean `academy`?"), "{err}");
}

#[test]
fn the_librarys_checks_hold() {
    let checks = concat!(env!("CARGO_MANIFEST_DIR"), "/../stdlib-scenarios");
    let dir = tempfile::tempdir().unwrap();
    let (code, out, err) = setpiece(dir.path(), &["test", checks]);
    assert_eq!(code, Some(0), "{out}{err}");
    assert!(out.lines().count() > 8, "{out}");
}

#[test]
fn a_level_is_of_its_scenario() {
    let scenario = setpiece::compile_text(DRILL, "drill.pitch").unwrap().scenario;
    let level = Level::of(&scenario, &Bindings::defaults(&scenario.params), 7, 0);
    assert_eq!(level.to_string(), "drill#7");
    let changed = DRILL.replace("10s", "11s");
    let changed = setpiece::compile_text(&changed, "drill.pitch").unwrap().scenario;
    let error = level.bind(&changed).unwrap_err();
    assert_eq!(error.code().to_string(), "SP0019");
}

/// The digest of the one episode that a command plays.
fn episode(folder: &Path, args: &[&str]) -> String {
    let (code, out, err) = setpiece(folder, args);
    assert_eq!(code, Some(0), "{err}");
    let report: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(report["episodes"], 1, "{out}");
    report["digest"].as_str().unwrap().to_owned()
}

#[test]
fn the_level_of_a_failed_check_plays_its_worst_episode() {
    let dir = tempfile::tempdir().unwrap();
    let (_, out, _) = setpiece(dir.path(), &["test", "--filter", "standing"]);
    let level = out.lines().find_map(|line| line.trim().strip_prefix("worst: ")).unwrap();
    let replay = out.lines().find_map(|line| line.split_once("studio ")).unwrap().1;
    let shown = |what: &[&str], name: &str| {
        let args = [&["render", "-o", name, "--step", "90"], what].concat();
        let (code, _, err) = setpiece(dir.path(), &args);
        assert_eq!(code, Some(0), "{err}");
        std::fs::read(dir.path().join(name)).unwrap()
    };
    let played = shown(&["drill.pitch", "--agent", "idle", "--level", level], "played.svg");
    assert_eq!(played, shown(&[replay], "recorded.svg"));
}

#[test]
fn a_level_plays_exactly_its_episode() {
    let dir = tempfile::tempdir().unwrap();
    let run = |more: &[&str]| episode(dir.path(), &[&["run", "--format", "json"], more].concat());
    let text = run(&["drill.pitch", "--level", "drill{gap=5m}#12:3"]);
    let json = r#"{"scenario":"drill","params":{"gap":"5m"},"seed":12,"episode":3}"#;
    assert_eq!(run(&["drill.pitch", "--level", json]), text);
    assert_ne!(run(&["drill.pitch", "--level", "drill{gap=5m}#12:2"]), text);
    let alone = run(&["--level", "academy_corner#12"]);
    assert_eq!(run(&["academy_corner", "--seed", "12", "-n", "1"]), alone);

    let draw = |more: &[&str], name: &str| {
        let args = [&["render", "-o", name, "--step", "9"], more].concat();
        let (code, _, err) = setpiece(dir.path(), &args);
        assert_eq!(code, Some(0), "{err}");
        std::fs::read(dir.path().join(name)).unwrap()
    };
    let level = draw(&["drill.pitch", "--level", "drill{gap=5m}#12:3"], "a.svg");
    let same = ["drill.pitch", "--seed", "12", "--set", "gap=5m", "--episode", "3"];
    assert_eq!(draw(&same, "b.svg"), level);
}

#[test]
fn a_level_finds_its_scenario_among_those_of_a_file() {
    let dir = tempfile::tempdir().unwrap();
    let one =
        episode(dir.path(), &["run", "drill.pitch", "--level", "drill#3", "--format", "json"]);
    let two = format!("{DRILL}\nscenario last extends drill {{ ball at (0, 0) }}\n");
    std::fs::write(dir.path().join("two.pitch"), two).unwrap();
    let args = ["run", "two.pitch", "--level", "drill#3", "--format", "json"];
    assert_eq!(episode(dir.path(), &args), one);
    // The summary and its drawing show this episode.
    let (_, out, _) =
        setpiece(dir.path(), &["run", "drill.pitch", "--level", "drill{gap=5m}#12:3"]);
    assert!(out.contains("1 episode · agent bot · drill{gap=5m}#12:3"), "{out}");
}

#[test]
fn a_level_that_does_not_fit_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    for (args, code, words) in [
        (&["--level", "drill#3"][..], 1, "SP0019"),
        (&["--level", "drill#3"], 1, "FILE.pitch --level"),
        (&["drill.pitch", "--level", "dril#3"], 1, "did you mean `drill`?"),
        (&["drill.pitch", "--level", "drill{gab=5m}#3"], 1, "did you mean `gap`?"),
        (&["drill.pitch", "--level", "drill{gap=50m}#3"], 1, "gap"),
        (&["drill.pitch", "--level", "drill#-3"], 1, "the seed `-3`"),
        (&["drill.pitch", "--level", "{\"scenario\":\"drill\"}"], 1, "missing field `seed`"),
        (&["drill.pitch", "--level", "drill#1:18446744073709551615"], 1, "greatest index"),
        (&["drill.pitch", "--level", "drill#1", "--seed", "2"], 2, "cannot be used with"),
        (&["drill.pitch", "--level", "drill#1", "-n", "2"], 2, "cannot be used with"),
        (&["drill.pitch", "--level", "drill#1", "--format", "csv"], 1, "not a table"),
        (&["--level", "benchmarks#1"], 1, "isn't in the library"),
        (&[], 2, "SCENARIO"),
    ] {
        let (found, out, err) = setpiece(dir.path(), &[&["run"], args].concat());
        assert_eq!(found, Some(code), "{args:?}\n{out}{err}");
        assert!(err.contains(words), "{args:?}\n{err}");
    }
}
