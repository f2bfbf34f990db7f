//! The pages of the error codes: every code has one, and its examples are correct.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::Error;
use setpiece::dsl::problem::{Code, Severity};
use setpiece::dsl::report::{Format, render};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/errors")
}

/// A fenced block of a page.
struct Block {
    /// The text after the fence: `pitch error=SP0203`.
    info: String,
    text: String,
}

fn blocks(page: &str) -> Vec<Block> {
    let (mut blocks, mut open) = (Vec::new(), None::<Block>);
    for line in page.lines() {
        match (&mut open, line.strip_prefix("```")) {
            (None, Some(info)) => open = Some(Block { info: info.to_owned(), text: String::new() }),
            (Some(_), Some(_)) => blocks.extend(open.take()),
            (Some(block), None) => {
                block.text.push_str(line);
                block.text.push('\n');
            }
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a block is not closed:\n{page}");
    blocks
}

/// Every report of a text, as a terminal shows it.
fn report(text: &str) -> String {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("scenario.pitch");
    std::fs::write(&path, text).unwrap();
    let found = setpiece::check(path.to_str().unwrap()).unwrap();
    let shown = render(&found.problems, &found.sources, Format::Human { color: false, width: 100 });
    shown.replace(&format!("{}/", dir.path().display()), "")
}

fn texts(folder: &Path) -> String {
    let mut paths: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let text = |path: &PathBuf| {
        if path.is_dir() { texts(path) } else { std::fs::read_to_string(path).unwrap() }
    };
    paths.iter().map(text).collect()
}

/// Every report of the compiler and the dry run has a case of the specification. A report of only
/// the command has a console on its page or a test, one of only vectors in Python a test there.
#[test]
fn every_code_is_earned_somewhere() {
    let root = folder().join("../..");
    let (cases, commands) = (texts(&root.join("tests/spec")), texts(&root.join("setpiece/tests")));
    let vectors = std::fs::read_to_string(root.join("python/tests/test_levels.py")).unwrap();
    for code in Code::ALL {
        let name = code.to_string();
        let of_the_command = name.starts_with("SP00") || name.starts_with("SP07");
        let console = || setpiece::explain::page(*code).unwrap().contains("```console");
        // A test can't make a system refuse threads.
        let shown = *code == Code::NoThreads
            || commands.contains(&name)
            || (*code == Code::OtherSpaces && vectors.contains(&name))
            || console();
        assert!(cases.contains(&name) || (of_the_command && shown), "{code} is earned nowhere");
    }
}

/// The rendering of each code's report; the pages' consoles show those of only the command.
#[test]
fn every_report_looks_as_it_should() {
    for code in Code::ALL {
        for (index, block) in blocks(setpiece::explain::page(*code).unwrap()).iter().enumerate() {
            if block.info.contains("error=") {
                let name = if index == 0 { format!("{code}") } else { format!("{code}_{index}") };
                insta::assert_snapshot!(name, report(&block.text));
            }
        }
    }
}

/// The codes of a text when it is run or checked, and whether one of them is an error.
fn codes(text: &str) -> (BTreeSet<String>, bool) {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("scenario.pitch");
    std::fs::write(&path, text).unwrap();
    let mut problems = match setpiece::load_file(&path) {
        Ok(loaded) => loaded.warnings,
        Err(Error::Compile(failure)) => failure.problems,
        Err(other) => panic!("{other}\n{text}"),
    };
    problems.extend(setpiece::check(path.to_str().unwrap()).unwrap().problems);
    let failed = problems.iter().any(|problem| problem.severity() == Severity::Error);
    (problems.iter().map(|problem| problem.code().to_string()).collect(), failed)
}

#[test]
fn every_code_has_a_page_and_no_page_lacks_a_code() {
    let files = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let files: BTreeSet<String> = files.collect();
    let wanted: BTreeSet<String> = Code::ALL.iter().map(|code| format!("{code}.md")).collect();
    assert_eq!(files, wanted);
    for code in Code::ALL {
        let page = setpiece::explain::page(*code).unwrap();
        assert_eq!(page.lines().next().unwrap(), format!("# {code}: {}", code.title()));
        let prose = page.split("```").next().unwrap().lines().skip(1).collect::<String>();
        assert!((60..700).contains(&prose.len()), "{code}: {prose}");
        assert!(!blocks(page).is_empty(), "{code} shows nothing");
    }
}

#[test]
fn every_broken_text_earns_its_code_and_every_other_one_is_sound() {
    let mut earned = 0;
    for code in Code::ALL {
        for block in blocks(setpiece::explain::page(*code).unwrap()) {
            let Some(info) = block.info.strip_prefix("pitch") else { continue };
            let (found, failed) = codes(&block.text);
            match info.trim().split_once('=') {
                Some(("error", wanted)) => {
                    assert_eq!(wanted, code.to_string());
                    assert!(
                        found.contains(wanted),
                        "{code} shows what earns {found:?}:\n{}",
                        block.text
                    );
                    assert_eq!(failed, code.severity() == Severity::Error, "{code}: {found:?}");
                    earned += 1;
                }
                // A text that fails only when played.
                Some(("file", _)) => {
                    assert!(found.iter().all(|code| code.starts_with("SP06")), "{code}: {found:?}");
                }
                _ => assert!(found.is_empty(), "{code} mends into {found:?}:\n{}", block.text),
            }
        }
    }
    assert!(earned > 45, "{earned}");
}
