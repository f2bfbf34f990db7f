//! `setpiece check`: reports, scripts, and files that change.

use super::{CLOSE, fails, folder, setpiece, text, write};
use std::process::Command;

#[test]
fn reports_of_very_long_lines_are_short() {
    let folder = folder();
    let deep = format!("scenario s {{ ball at {}0{} }}", "(".repeat(10_000), ")".repeat(10_000));
    let path = write(folder.path(), "deep.pitch", deep);
    let reports = fails(&["check", &path], 1, &["SP0102"]);
    assert_eq!(reports.matches("SP0").count(), 1, "one report: {reports}");
    assert!(reports.len() < 2000, "{} bytes", reports.len());
}

#[test]
fn three_mistakes_get_three_located_reports() {
    let folder = folder();
    let path = write(
        folder.path(),
        "mistakes.pitch",
        "scenario mistakes extends academy {
    ball at (0.6, 0)
    team left { GK at (-1, 0) CBB at (0.5, 0) }
    reward scorin
    end success soon when elapsed > 3m
}
",
    );
    let stderr = fails(
        &["check", &path],
        1,
        &["unknown role `CBB`", "did you mean `CB`?", "did you mean `scoring`?"],
    );
    for place in [":3:", ":4:", ":5:"] {
        assert!(stderr.contains(place), "no report at line {place}: {stderr}");
    }
    let output = setpiece(&["check", &path, "--message-format", "json"]);
    assert_eq!(output.status.code(), Some(1));
    let reports: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(reports.as_array().unwrap().len(), 3, "{reports}");
    assert!(
        reports.as_array().unwrap().iter().all(|report| report["labels"][0]["line"].is_number())
    );
}

/// A check is reported where it names its agent, with a scenario in the file and without one.
#[test]
fn a_check_with_a_baseline_that_is_missing_is_located() {
    let folder = folder();
    let check = |scenario: &str| {
        format!(
            "check \"it works\" {{
    play {scenario} with baseline for 5 episodes
    expect success_rate > 1%
}}
"
        )
    };
    let place = |text: &str, words: &[&str]| {
        let path = write(folder.path(), "checks.pitch", text);
        let words = [&["SP0024", "checks.pitch:2:"][..], words].concat();
        fails(&["check", &path], 1, &words);
    };
    place(&check("academy_corner"), &["`academy_corner` has no baseline", "these have one"]);
    let mine = CLOSE.replace("scenario close", "scenario academy_empty_goal_close");
    let both = format!("{}{mine}", check("academy_empty_goal_close"));
    place(&both, &["isn't the library's of this name", "player 1 (the left GK) differs"]);
    let path = write(folder.path(), "fine.pitch", check("academy_empty_goal_close"));
    assert!(setpiece(&["check", &path]).status.success());
}

#[test]
fn short_reports_are_lines_that_begin_with_a_place() {
    let folder = folder();
    let path = write(
        folder.path(),
        "mistakes.pitch",
        "scenario mistakes extends academy {
    ball at (0.6, 0)
    team left { CM at (0.5, 0) }
    reward scorin
}
",
    );
    let output = setpiece(&["check", &path, "absent.pitch", "--message-format", "short"]);
    assert_eq!(output.status.code(), Some(1));
    let printed = text(&output.stdout);
    let lines: Vec<&str> = printed.lines().collect();
    assert_eq!(lines.len(), 2, "{printed}");
    assert!(lines[0].starts_with(&format!("{path}:4:12: error[SP0201]")), "{printed}");
    assert!(lines[1].starts_with("absent.pitch:1:1: error[SP00"), "{printed}");
}

#[test]
fn what_a_script_prints_is_shown_with_its_place() {
    let folder = folder();
    write(
        folder.path(),
        "loud.rhai",
        "import \"lib\" as lib;\nfn reward(ctx, now, prev, events) {\n    if ctx.step == 1 { print(`step ${ctx.step}`); }\n    lib::pay(ctx.step)\n}",
    );
    write(
        folder.path(),
        "lib.rhai",
        "fn pay(step) { if step == 2 { debug(\"two\"); }\n#{a: 1, b: -0.5} }",
    );
    let text =
        CLOSE.replace("ball at", "reward script \"loud.rhai\" as [\"a\", \"b\"]\n    ball at");
    let path = write(folder.path(), "loud.pitch", text);
    let output = setpiece(&["run", &path, "--episodes", "1"]);
    let (shown, printed) = (self::text(&output.stdout), self::text(&output.stderr));
    assert!(output.status.success(), "{printed}");
    for line in ["loud.rhai:3:24: step 1", "lib.rhai:1:31: \"two\""] {
        assert!(printed.lines().any(|found| found == line), "{printed}");
    }
    assert!(shown.contains("loud/a") && shown.contains("loud/b"), "{shown}");
}

#[test]
fn a_bad_script_is_an_error_and_never_a_hang() {
    let folder = folder();
    let scenario = |script: &str| {
        CLOSE.replace("ball at", &format!("reward script \"{script}\"\n    ball at"))
    };
    write(folder.path(), "loop.rhai", "fn reward(ctx, now, prev, events) { loop { } }");
    let path = write(folder.path(), "loop.pitch", scenario("loop.rhai"));
    fails(&["run", &path, "--episodes", "1"], 1, &["loop.rhai", "reward", "operations"]);

    let large = "fn reward(ctx, now, prev, events) {\n    let s = \"\"; s.pad(4000, \"a\");\n    loop { s.split(\"a\"); }\n}";
    write(folder.path(), "large.rhai", large);
    let path = write(folder.path(), "large.pitch", scenario("large.rhai"));
    fails(&["run", &path, "--episodes", "1"], 1, &["large.rhai:3:14", "reward", "by their size"]);

    write(
        folder.path(),
        "name.rhai",
        "fn reward(ctx, now, prev, events) {\n    now.ball.colour\n}",
    );
    let path = write(folder.path(), "name.pitch", scenario("name.rhai"));
    fails(&["check", &path], 1, &["SP0503", "colour", "name.rhai:2"]);

    write(folder.path(), "hook.rhai", "fn rewards(ctx, now, prev, events) { 0.0 }");
    let path = write(folder.path(), "hook.pitch", scenario("hook.rhai"));
    fails(&["check", &path], 1, &["SP0502", "reward"]);
    fails(
        &["check", &write(folder.path(), "gone.pitch", scenario("gone.rhai"))],
        1,
        &["gone.rhai"],
    );
}

#[test]
fn watching_takes_a_changed_file_and_survives_a_broken_one() {
    use std::io::{BufRead, BufReader};
    let folder = folder();
    let path = write(folder.path(), "close.pitch", CLOSE);
    let mut child = Command::new(env!("CARGO_BIN_EXE_setpiece"))
        .args(["run", &path, "--watch", "--episodes", "2", "--agent", "idle"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let (sender, lines) = std::sync::mpsc::channel();
    for reader in [
        Box::new(child.stdout.take().unwrap()) as Box<dyn std::io::Read + Send>,
        Box::new(child.stderr.take().unwrap()),
    ] {
        let sender = sender.clone();
        std::thread::spawn(move || {
            for line in BufReader::new(reader).lines().map_while(Result::ok) {
                let _ = sender.send(line);
            }
        });
    }
    let wait_for = |word: &str| {
        let end = std::time::Instant::now() + std::time::Duration::from_secs(30);
        while std::time::Instant::now() < end {
            if let Ok(line) = lines.recv_timeout(std::time::Duration::from_millis(200))
                && line.contains(word)
            {
                return;
            }
        }
        panic!("no line with `{word}` came");
    };
    wait_for("mean score");
    wait_for("scoring/goal");
    wait_for("waiting for a change");
    // Lines with a word before the first one with another.
    let lines_with = |word: &str, last: &str| {
        let patience = std::time::Duration::from_secs(30);
        let lines = std::iter::from_fn(|| lines.recv_timeout(patience).ok());
        lines.take_while(|line| !line.contains(last)).filter(|line| line.contains(word)).count()
    };
    // A save by renaming, as editors do.
    let rename = |content: &str| {
        let temporary = write(folder.path(), ".close.pitch.swp", content);
        std::fs::rename(temporary, &path).unwrap();
    };
    rename(&CLOSE.replace("CB at (0.75", "CBB at (0.75"));
    wait_for("unknown role `CBB`");
    rename(&CLOSE.replace("scenario close", "scenario closer"));
    wait_for("closer");
    wait_for("waiting for a change");
    rename(&CLOSE.replace("scenario close", "scenario closest"));
    wait_for("closest");
    wait_for("waiting for a change");
    // A script that fails in every episode is reported once.
    let script = "fn reward(ctx, now, prev, events) { let none = []; none[3] * 1.0 }";
    let failing = format!("reward script rhai \"\"\"{script}\"\"\"\n    ball at");
    rename(&CLOSE.replace("ball at", &failing));
    wait_for("SP0702");
    std::fs::remove_file(&path).unwrap();
    assert_eq!(lines_with("SP0702", "is gone"), 0);
    child.kill().unwrap();
    let _ = child.wait();
}

#[test]
fn a_script_finds_the_parameters_by_their_names() {
    let folder = folder();
    let scenario = |name: &str| {
        let script = format!("fn reward(ctx, now, prev, events) {{ ctx.params.{name} * 1.0 }}");
        let reward =
            format!("param pace = 3\n    reward script rhai \"\"\"{script}\"\"\"\n    ball at");
        CLOSE.replace("ball at", &reward)
    };
    let output = setpiece(&["check", &write(folder.path(), "right.pitch", scenario("pace"))]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(!text(&output.stderr).contains("SP0213"), "{}", text(&output.stderr));
    let wrong = write(folder.path(), "wrong.pitch", scenario("paze"));
    fails(
        &["check", &wrong],
        1,
        &["SP0503", "no parameter is called `paze`", "did you mean `pace`?"],
    );
    // A behaviour's parameters are available together with the scenario's.
    let script = "fn act(ctx, me, now) { if ctx.params.quick { \"sprint\" } else { \"idle\" } }";
    let behavior =
        format!("behavior runs(quick: bool = on) script rhai \"\"\"{script}\"\"\"\n{CLOSE}");
    let own = behavior.replace("CB at (-0.9, 0.3)", "CB at (-0.9, 0.3) { ai: runs }");
    let output = setpiece(&["check", &write(folder.path(), "own.pitch", own.as_str())]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let wrong = write(folder.path(), "own_wrong.pitch", own.replace("params.quick", "params.quik"));
    fails(
        &["check", &wrong],
        1,
        &["SP0503", "no parameter is called `quik`", "did you mean `quick`?"],
    );
}
