//! `setpiece bench`.

use super::{fails, folder, setpiece, text, write};

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
