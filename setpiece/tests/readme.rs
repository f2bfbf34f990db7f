//! README shows the command's output. `SETPIECE_BLESS=1` updates its consoles.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::path::{Path, PathBuf};
use std::process::Command;

/// The file whose mistakes README shows.
const SLIPS: &str = "scenario corner_routine extends academy {
    ball at (0.6, 0)
    team left { GK at (-1, 0) CBB at (0.5, 0) }
    reward scorin
    end success soon when elapsed > 3m
}
";

fn readme() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md")
}

/// A command's output in a folder: its results and its reports.
fn printed(args: &[&str], folder: &Path) -> [String; 2] {
    let output = Command::new(env!("CARGO_BIN_EXE_setpiece"))
        .args(args)
        .current_dir(folder)
        .output()
        .unwrap();
    [output.stdout, output.stderr].map(|text| {
        String::from_utf8(text)
            .unwrap()
            .lines()
            .map(|line| format!("{}\n", line.trim_end()))
            .collect()
    })
}

/// The range of the first console after some words of README.
fn console(text: &str, words: &str) -> std::ops::Range<usize> {
    let behind =
        text.find(words).unwrap_or_else(|| panic!("README doesn't say `{words}`")) + words.len();
    let begin = behind + text[behind..].find("\n```\n").unwrap() + "\n```\n".len();
    begin..begin + text[begin..].find("```\n").unwrap()
}

/// The output without what differs between runs.
fn lasting(text: &str) -> String {
    let speed = |line: &&str| line.trim_start().starts_with("speed ");
    text.lines().filter(|line| !speed(line)).map(|line| format!("{line}\n")).collect()
}

/// Compares the console after some words with the output, or updates it.
fn hold(words: &str, printed: &str) {
    let text = std::fs::read_to_string(readme()).unwrap();
    let place = console(&text, words);
    let printed = printed.trim_matches('\n').to_owned() + "\n";
    if lasting(&text[place.clone()]) == lasting(&printed) {
        return;
    }
    if std::env::var_os("SETPIECE_BLESS").is_some() {
        std::fs::write(
            readme(),
            format!("{}{printed}{}", &text[..place.start], &text[place.end..]),
        )
        .unwrap();
    } else {
        panic!("README differs from the output (SETPIECE_BLESS=1 updates it):\n{printed}");
    }
}

/// One test, because both parts may write the file.
#[test]
fn its_consoles_are_what_is_printed() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(readme()).unwrap();
    let sample = "cargo run --release -- run ";
    let behind = text.find(sample).expect("README runs a scenario") + sample.len();
    let given = text[behind..].lines().next().unwrap();
    let line = format!("{sample}{given}\n```\n");
    let args: Vec<&str> = ["run"].into_iter().chain(given.split(' ')).collect();
    let [results, _] = printed(&args, folder.path());
    hold(&line, &results);

    std::fs::write(folder.path().join("corner_routine.pitch"), SLIPS).unwrap();
    let [_, reports] = printed(&["check", "corner_routine.pitch"], folder.path());
    hold("all of them at once:\n", &reports);
}
