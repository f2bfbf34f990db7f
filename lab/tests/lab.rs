//! A short test of the bench: it plays, measures and reports errors.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::process::Command;

/// What the bench prints, mistakes included, and whether it was content.
fn lab(args: &[&str]) -> (String, bool) {
    let output = Command::new(env!("CARGO_BIN_EXE_lab")).args(args).output().unwrap();
    (String::from_utf8([output.stdout, output.stderr].concat()).unwrap(), output.status.success())
}

#[test]
fn scenarios_made_up_at_random_hold() {
    let (output, held) = lab(&["soak", "--steps", "10000", "--seed", "1"]);
    assert!(held, "{output}");
    assert!(output.contains("goals: "), "{output}");
}

#[test]
fn every_section_measures_every_figure() {
    for (section, figures) in [("2", 50), ("3", 75), ("4", 50), ("5", 30), ("6", 1500), ("7", 6)] {
        let (output, _) = lab(&["calibrate", "--only", section, "--count", "2"]);
        let rows: Vec<&str> = output.lines().filter(|line| line.starts_with("| C-")).collect();
        assert!(rows.len() >= figures, "section {section} has {} figures", rows.len());
        let found = rows.iter().filter(|row| !row.contains("| none |")).count();
        assert!(
            found * 10 >= rows.len() * 8,
            "section {section} measures {found} of {}: {output}",
            rows.len()
        );
    }
}

#[test]
fn wrong_arguments_are_reported() {
    for (args, words) in [
        (vec![], "calibrate"),
        (vec!["soak", "--steps"], "a value is required for '--steps <N>'"),
        (vec!["soak", "--stop", "1"], "unexpected argument '--stop'"),
        (vec!["calibrate", "--only", "x"], "invalid value 'x' for '--only <SECTION>'"),
        (vec!["calibrate", "--only", "9"], "2..=7"),
        (vec!["calibrate", "--all"], "unexpected argument '--all'"),
        (vec!["recorded", "keys.json"], "<TRACES>"),
        (vec!["recorded", "keys.json", "traces", "--write", "--add"], "cannot be used with"),
    ] {
        let (output, succeeded) = lab(&args);
        assert!(!succeeded && output.contains(words), "{args:?}: {output}");
    }
}
