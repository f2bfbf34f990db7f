//! The real binary, end to end: its output, its exit codes, and that no input makes it panic.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod bench;
mod build;
mod check;
mod files;
mod leaderboard;
mod list;
mod lsp;
mod policy;
mod profile;
mod rewards;
mod run;
mod snapshot;
mod terminal;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn setpiece(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_setpiece")).args(args).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn text_of(args: &[&str]) -> String {
    text(&setpiece(args).stdout)
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
