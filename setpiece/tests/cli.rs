//! The real binary, end to end: its output, its exit codes, and that no input makes it panic.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn setpiece(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_setpiece")).args(args).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Runs and expects one clear error: the exit code, the words, and no panic.
fn fails(args: &[&str], code: i32, words: &[&str]) -> String {
    let output = setpiece(args);
    let stderr = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {stderr}");
    assert!(!stderr.contains("panicked"), "{args:?}: {stderr}");
    for word in words {
        assert!(stderr.contains(word), "{args:?}: no `{word}` in: {stderr}");
    }
    stderr
}

fn json(args: &[&str]) -> serde_json::Value {
    let output = setpiece(args);
    assert!(output.status.success(), "{args:?}: {}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

fn write(folder: &Path, name: &str, content: impl AsRef<[u8]>) -> String {
    let path: PathBuf = folder.join(name);
    std::fs::write(&path, content).unwrap();
    path.to_string_lossy().into_owned()
}

const CLOSE: &str = "scenario close extends academy {
    ball at (0.77, 0)
    team left { GK at (-1, 0) CB at (0.75, 0) }
    team right { CB at (-0.9, 0.3) }
}
";

#[test]
fn lists_every_scenario_with_its_sides() {
    let output = text(&setpiece(&["list"]).stdout);
    let (scenarios, suites) = output.split_once("\n\n").unwrap();
    assert_eq!(scenarios.lines().count(), 41, "{output}");
    let names = suites.lines().map(|line| line.split_whitespace().next().unwrap());
    assert_eq!(names.collect::<Vec<_>>(), ["academy", "academy_multi", "benchmarks"]);
    for line in [
        "academy_3_vs_1_with_keeper",
        "11_vs_11_stochastic",
        "5_vs_5",
        "1_vs_1_easy",
        "11_vs_11_kaggle",
    ] {
        assert!(output.contains(line), "{output}");
    }
    assert!(!output.contains("full_match"), "abstract scenarios can't be run: {output}");
    let row = output.lines().find(|line| line.starts_with("academy_3_vs_1")).unwrap();
    assert!(row.contains("4 v 2"), "{row}");
}

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
fn a_compiled_file_runs_like_its_source_and_keeps_its_parameters() {
    let folder = folder();
    let source = write(folder.path(), "close.pitch", CLOSE);
    let compiled = folder.path().join("close.pitchc").to_string_lossy().into_owned();
    assert!(setpiece(&["build", &source, "-o", &compiled]).status.success());
    let run = |path: &str| {
        json(&[
            "run",
            path,
            "--agent",
            "random",
            "--set",
            "difficulty=0.95",
            "--episodes",
            "6",
            "--seed",
            "2",
            "--reward",
            "scoring",
            "--reward",
            "checkpoints",
            "--format",
            "json",
        ])
    };
    assert_eq!(run(&source)["digest"], run(&compiled)["digest"]);
    assert_eq!(run(&source)["terms"], run(&compiled)["terms"]);
    assert!(run(&compiled)["terms"]["checkpoints/carried"].is_number());

    let whole = std::fs::read_to_string(&compiled).unwrap();
    let cut = write(folder.path(), "cut.pitchc", &whole[..whole.len() / 2]);
    fails(&["run", &cut], 1, &["SP0007", "is truncated"]);
    let written = format!("\"version\":{}", setpiece::scenario::FORMAT_VERSION);
    for version in ["1", "99"] {
        let other = whole.replacen(&written, &format!("\"version\":{version}"), 1);
        let other = write(folder.path(), "other.pitchc", other);
        fails(&["run", &other], 1, &["SP0007", &format!("version {version};")]);
    }
    let changed = write(folder.path(), "changed.pitchc", whole.replacen("close", "klose", 1));
    fails(&["run", &changed], 1, &["SP0007", "checksum"]);
}

#[test]
fn the_compact_form_is_the_same_scenario_and_its_problems_are_reported() {
    type Change<'a> = &'a dyn Fn(&mut Vec<u8>);
    let folder = folder();
    let source = write(folder.path(), "close.pitch", CLOSE);
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (text, compact) = (at("text.pitchc"), at("compact.pitchc"));
    assert!(setpiece(&["build", &source, "-o", &text]).status.success());
    assert!(setpiece(&["build", &source, "-o", &compact, "--format", "bin"]).status.success());
    let again = at("again.pitchc");
    assert!(setpiece(&["build", &compact, "-o", &again]).status.success());
    assert_eq!(
        std::fs::read(&text).unwrap(),
        std::fs::read(&again).unwrap(),
        "one form holds what the other does"
    );
    let whole = std::fs::read(&compact).unwrap();
    assert!(whole.len() < std::fs::read(&text).unwrap().len() * 3 / 4, "{} bytes", whole.len());
    let broken = |name: &str, change: Change<'_>| {
        let mut bytes = whole.clone();
        change(&mut bytes);
        std::fs::write(at(name), bytes).unwrap();
        at(name)
    };
    let cases: [(&str, Change<'_>, &str); 6] = [
        ("head", &|bytes| bytes.truncate(17), "truncated"),
        ("half", &|bytes| bytes.truncate(bytes.len() / 2), "truncated"),
        ("version", &|bytes| bytes[8] = 99, "version 99"),
        ("changed", &|bytes| *bytes.last_mut().unwrap() ^= 1, "checksum"),
        ("longer", &|bytes| bytes.push(0), "checksum"),
        ("other.pitchc", &|bytes| bytes[0] = b'x', "SP000"),
    ];
    for (name, change, report) in cases {
        fails(&["run", &broken(name, change)], 1, &[report]);
    }
}

#[test]
fn a_name_or_file_that_is_not_there_is_one_clear_error() {
    fails(&["run", "academy_3_vs_1"], 1, &["SP0005", "did you mean `academy_3_vs_1_with_keeper`?"]);
    fails(
        &["run", "academy_3_vs_1_with_keper"],
        1,
        &["SP0005", "did you mean `academy_3_vs_1_with_keeper`?"],
    );
    fails(&["run", "academy_3_vs1"], 1, &["SP0005", "did you mean `academy_3_vs_1_with_keeper`?"]);
    let stderr = fails(&["run", "academ"], 1, &["SP0005"]);
    assert!(!stderr.contains("`academy`"), "a base that nobody plays: {stderr}");
    fails(&["run", "nothing/of/the/kind.pitch"], 1, &["SP0001"]);
    let folder = folder();
    let close = write(folder.path(), "close.pitch", CLOSE);
    fails(&["run", &close.replace("close", "clse")], 1, &["SP0001", "did you mean `close.pitch`?"]);
    fails(&["run", &folder.path().to_string_lossy()], 1, &["SP0006", "is a directory"]);
    fails(&["check", &folder.path().to_string_lossy()], 1, &["SP0006"]);
    fails(&["build", &close, "-o", "/no/such/folder/x.pitchc"], 1, &["SP0001", "can't be written"]);
    fails(&["build", &close, "-o", &close], 1, &["SP0001", "can't be written"]);
    assert_eq!(std::fs::read_to_string(&close).unwrap(), CLOSE, "the source is still there");
}

#[test]
fn a_file_that_is_no_text_is_one_clear_error() {
    let folder = folder();
    let check = |name: &str, content: &[u8], words: &[&str]| {
        let path = write(folder.path(), name, content);
        fails(&["run", &path], 1, words);
        fails(&["check", &path], 1, words);
    };
    check("bytes.pitch", b"scenario x {\n  \xff\xfe\n}", &["SP0003", "line 2"]);
    check("empty.pitch", b"", &["SP0"]);
    check("large.pitch", &vec![b'/'; 10 << 20], &["SP0002", "larger than"]);
    check(
        "deep.pitch",
        format!("scenario x {{ let y = {}1{} }}", "(".repeat(10_000), ")".repeat(10_000))
            .as_bytes(),
        &["SP0102"],
    );
    check("braces.pitch", "{".repeat(10_000).as_bytes(), &["SP0102"]);
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
fn values_that_are_not_finite_are_reported() {
    let folder = folder();
    let source =
        CLOSE.replace("ball at", "reward x { state n = 0  give 1 / n as \"broken\" }\n    ball at");
    let path = write(folder.path(), "faulty.pitch", source);
    let output = text(&setpiece(&["run", &path, "--episodes", "2"]).stdout);
    assert!(output.contains("values in `x` were not finite"), "{output}");
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
fn an_imported_copy_of_a_reward_takes_the_librarys_place() {
    let folder = folder();
    let copy = include_str!("../../stdlib-scenarios/rewards.pitch")
        .replace("give +1 on goal", "give +3 on goal");
    write(folder.path(), "mine.pitch", copy);
    let path = write(folder.path(), "close.pitch", format!("import \"mine.pitch\"\n{CLOSE}"));
    let result =
        json(&["run", &path, "--agent", "run_and_shoot", "--episodes", "10", "--format", "json"]);
    assert_eq!(result["terms"]["scoring/goal"], 3.0 * result["success_rate"].as_f64().unwrap());
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
fn a_compiled_scenario_is_never_written_over_a_source() {
    let folder = folder();
    let path = write(folder.path(), "close.pitch", CLOSE);
    let other = write(folder.path(), "other.pitch", CLOSE);
    fails(&["build", &path, "-o", &path], 1, &["SP0001"]);
    fails(&["build", &path, "-o", &other], 1, &["ends in .pitchc"]);
    assert_eq!(std::fs::read_to_string(&other).unwrap(), CLOSE);
    fails(&["build", &path, "-o", &folder.path().to_string_lossy()], 1, &["it is a directory"]);
}

#[test]
fn checks_names_and_files_that_have_nothing_to_run() {
    let folder = folder();
    assert!(setpiece(&["check", "academy_corner"]).status.success());
    let parts = "/// Paid per goal.\nreward mine { give 1 as \"goal\" when goal by us }\nformation pair { GK at (-1, 0)  CB at (-0.5, 0) }\n";
    let path = write(folder.path(), "parts.pitch", parts);
    let output = setpiece(&["check", &path]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let wrong = write(
        folder.path(),
        "wrong.pitch",
        parts.replace("-0.5", "fot").replace("give 1", "give 1m"),
    );
    fails(&["check", &wrong], 1, &["`fot`", "SP0302", "wrong.pitch:2", "wrong.pitch:3"]);
    let nothing = write(folder.path(), "nothing.pitch", "// only a comment\n");
    fails(&["check", &nothing], 1, &["SP0214"]);
}

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
fn rewards_come_from_the_files() {
    let folder = folder();
    let run = |value: &str| {
        let path = write(
            folder.path(),
            "own.pitch",
            format!(
                "reward mine {{ give {value} on goal by us as \"goal\" }}\n{}",
                CLOSE.replace("ball at", "remove reward scoring\n    reward mine\n    ball at")
            ),
        );
        json(&[
            "run",
            &path,
            "--agent",
            "run_and_shoot",
            "--episodes",
            "10",
            "--seed",
            "1",
            "--format",
            "json",
        ])
    };
    let (one, five) = (run("1"), run("5"));
    assert!(one["terms"]["mine/goal"].as_f64().unwrap() > 0.5, "{one}");
    let ratio =
        five["terms"]["mine/goal"].as_f64().unwrap() / one["terms"]["mine/goal"].as_f64().unwrap();
    assert!((ratio - 5.0).abs() < 1e-9);
}

#[test]
fn a_reward_of_the_files_own_takes_the_place_of_the_librarys() {
    let folder = folder();
    let own = format!("reward scoring {{ give 5 on goal by us as \"goal\" }}\n{CLOSE}");
    let path = write(folder.path(), "own.pitch", own);
    let result = json(&[
        "run",
        &path,
        "--agent",
        "run_and_shoot",
        "--episodes",
        "5",
        "--seed",
        "1",
        "--format",
        "json",
    ]);
    assert_eq!(result["terms"]["scoring/goal"], 5.0, "{result}");
    assert!(result["terms"]["scoring/conceded"].is_null(), "{result}");
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
fn a_level_that_stands_for_a_scenario_is_recognised() {
    fails(
        &["run", "academy_corner{difficulty=0.8}#3"],
        1,
        &["SP0005", "`--level 'academy_corner{difficulty=0.8}#3'`"],
    );
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

#[test]
fn a_snapshot_is_taken_and_begun_from() {
    let folder = folder();
    let path = folder.path().join("early.pitchs").to_string_lossy().into_owned();
    let taken = setpiece(&["snapshot", "5_vs_5", "--step", "100", "--seed", "3", "-o", &path]);
    let said = text(&taken.stdout);
    assert!(
        taken.status.success() && said.contains("5_vs_5 at step 100") && said.contains("bytes"),
        "{said}"
    );
    let run = |threads| {
        json(&[
            "run",
            "5_vs_5",
            "-n",
            "4",
            "--from",
            &path,
            "--threads",
            threads,
            "--format",
            "json",
        ])
    };
    let (one, two, start) =
        (run("1"), run("2"), json(&["run", "5_vs_5", "-n", "4", "--format", "json"]));
    assert_eq!(one["digest"], two["digest"]);
    assert_ne!(one["digest"], start["digest"]);
    let broken = write(folder.path(), "broken.pitchs", &std::fs::read(&path).unwrap()[..200]);
    fails(&["run", "5_vs_5", "--from", &broken], 1, &["SP0013", "truncated"]);
    fails(&["run", "academy_corner", "--from", &path], 1, &["SP0013", "left players differ"]);
    fails(&["run", "5_vs_5", "--from", "nowhere.pitchs"], 1, &["SP0001", "nowhere.pitchs"]);
    fails(
        &["snapshot", "academy_empty_goal_close", "--step", "9999", "-o", &path],
        1,
        &["SP0012", "there is no step 9999"],
    );
    fails(
        &["snapshot", "5_vs_5", "-o", "over.pitch"],
        1,
        &["ends in .pitchc, a snapshot in .pitchs"],
    );
}

#[test]
fn a_bench_tells_its_figures_and_compares_them() {
    let folder = folder();
    let quick = ["academy_empty_goal_close", "--seconds", "0.05", "--matches", "4"];
    let output =
        setpiece(&[&["bench"][..], &quick, &["--threads", "1,2", "--format", "jsonl"]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let lines: Vec<serde_json::Value> =
        text(&output.stdout).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let threads: Vec<u64> = lines.iter().map(|line| line["threads"].as_u64().unwrap()).collect();
    assert_eq!(threads, [1, 2]);
    for line in &lines {
        assert!(line["steps_per_second"].as_f64().unwrap() > 0.0, "{line}");
    }
    assert!(lines[0]["resets_per_step"].as_f64().unwrap() > 0.0, "{}", lines[0]);
    let phases = lines[0]["microseconds"].as_object().unwrap();
    assert!(phases.len() == 9 && phases["movement"].as_f64().unwrap() > 0.0, "{phases:?}");
    let once = lines[0]["once_microseconds"].as_object().unwrap();
    assert!(once.len() == 7 && once.values().all(|took| took.as_f64().unwrap() > 0.0), "{once:?}");
    assert!(lines[1]["scaling"].as_f64().unwrap() > 0.0, "{}", lines[1]);
    let before = write(folder.path(), "before.jsonl", output.stdout.as_slice());
    let table =
        setpiece(&[&["bench"][..], &quick, &["--threads", "1", "--against", &before]].concat());
    let table = text(&table.stdout);
    assert!(table.contains("ratio") && table.contains("µs a step"), "{table}");
    let lines = setpiece(
        &[&["bench"][..], &quick, &["--threads", "1", "--format", "jsonl", "--against", &before]]
            .concat(),
    );
    let line: serde_json::Value = serde_json::from_str(&text(&lines.stdout)).unwrap();
    assert!(line["ratio"].as_f64().unwrap() > 0.0, "{line}");
    let other =
        ["bench", "academy_corner", "--seconds", "0.05", "--threads", "1", "--against", &before];
    let alone = setpiece(&other);
    assert!(
        text(&alone.stdout).contains("–") && text(&alone.stderr).contains("no row of"),
        "{alone:?}"
    );
    let wrong = write(folder.path(), "wrong.jsonl", "{}");
    fails(
        &["bench", "--against", &wrong],
        1,
        &["SP0001", "no table of `setpiece bench --format jsonl`"],
    );
    fails(&["bench", "nowhere"], 1, &["SP0005", "nowhere"]);
    fails(&["bench", "--seconds", "never"], 2, &["0.01 to 3600"]);
}

#[test]
fn imports_and_scripts_stay_below_the_root() {
    let outer = folder();
    let inner = outer.path().join("inner");
    std::fs::create_dir_all(inner.join("parts")).unwrap();
    let secret = write(outer.path(), "secret.pitch", "root:x:0:0:secret\n");
    write(&inner, "parts/shared.pitch", "import \"../also.pitch\"\nconst width = 0.1\n");
    write(&inner, "also.pitch", "const also = 0.2\n");
    let scenario = |head: &str, body: &str| {
        format!(
            "{head}\nscenario s extends academy {{ ball at (0, 0) team left {{ CM at (0.1, 0) }} {body} }}\n"
        )
    };
    let below = write(
        &inner,
        "below.pitch",
        scenario("import \"parts/shared.pitch\"", "require also > width"),
    );
    assert!(setpiece(&["check", &below]).status.success());
    let paths = ["../secret.pitch", "parts/../../secret.pitch", &secret, "/etc/passwd"];
    for path in paths {
        for text in [
            scenario(&format!("import \"{path}\""), ""),
            scenario("", &format!("reward script \"{path}\" as \"r\"")),
        ] {
            let root = write(&inner, "root.pitch", text);
            let said = fails(&["check", &root], 1, &[]) + text_of(&["check", &root]).as_str();
            assert!(said.contains("lies outside of the scenario's folder"), "{path}: {said}");
            assert!(!said.contains("root:x"), "{path}: {said}");
        }
    }
    // A file imported by another one is still relative to the root's folder.
    write(&inner, "parts/outward.pitch", "import \"../../secret.pitch\"\n");
    let root = write(&inner, "root.pitch", scenario("import \"parts/outward.pitch\"", ""));
    fails(&["check", &root], 1, &["lies outside of the scenario's folder"]);
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&secret, inner.join("link.pitch")).unwrap();
        let root = write(&inner, "root.pitch", scenario("import \"link.pitch\"", ""));
        fails(&["check", &root], 1, &["lies outside of the scenario's folder"]);
    }
    write(outer.path(), "fine.pitch", "const fine = 0.1\n");
    let root =
        write(&inner, "root.pitch", scenario("import \"../fine.pitch\"", "require fine < 1"));
    fails(&["run", &root], 1, &["`--allow-outside` isn't given"]);
    assert!(setpiece(&["check", "--allow-outside", &root]).status.success());
    assert!(setpiece(&["run", &root, "--allow-outside", "--episodes", "1"]).status.success());
}

fn text_of(args: &[&str]) -> String {
    text(&setpiece(args).stdout)
}

#[test]
fn what_an_author_writes_does_not_steer_the_terminal() {
    let folder = folder();
    let clear = "\u{1B}[2J\u{1B}]0;title\u{7}\u{9B}31m\u{202E}";
    let body = format!(
        "scenario s extends academy {{ ball at (0, 0) {clear} foo\n let a = \"{clear}\" + 1 }}\n"
    );
    let sources = [
        body,
        format!("import \"{clear}.pitch\"\n"),
        format!("scenario s {{ reward script \"{clear}\" }}"),
    ];
    for source in sources {
        let path = write(folder.path(), "steers.pitch", source);
        for colour in ["never", "always"] {
            let said = fails(&["--color", colour, "check", &path], 1, &[]);
            let controls = ["\u{1B}[2J", "\u{1B}]", "\u{7}", "\u{9B}", "\u{202E}"];
            assert!(controls.iter().all(|control| !said.contains(control)), "{said:?}");
            assert!(colour == "always" || !said.contains('\u{1B}'), "{said:?}");
        }
    }
    let said = fails(&["check", "no\u{1B}[31msuch.pitch"], 1, &["SP0001"]);
    assert!(!said.contains('\u{1B}'), "{said:?}");
}

#[test]
fn names_and_words_of_a_scenario_set_no_colours() {
    let folder = folder();
    let text = CLOSE.replace("ball at", "reward r\n    ball at");
    let text = format!(
        "/// A \u{1b}[7mtitle\u{1b}[0m\n{text}\nreward r {{ give 0.1 as \"\u{1b}[31mred\u{1b}]0;x\u{7}\" }}\n"
    );
    let file = write(folder.path(), "loud.pitch", text);
    let output = text_of(&["run", &file, "--color", "always", "--episodes", "2"]);
    assert!(output.contains("␛[31mred") && output.contains("A ␛[7mtitle"), "{output}");
    assert!(output.contains("\u{1b}[1mclose"), "the command's own styles are kept: {output}");
    assert!(
        !output.contains("\u{1b}[31mred")
            && !output.contains("\u{1b}[7m")
            && !output.contains('\u{7}'),
        "{output}"
    );
}
