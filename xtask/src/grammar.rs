//! The grammar for editors by tree-sitter, held to the files of the repository.

use crate::shell::{root, run};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Folders whose `.pitch` files are all sound.
const SOUND: [&str; 2] = ["examples", "stdlib-scenarios"];

/// Whether tree-sitter's command is there.
pub(crate) fn is_there() -> bool {
    let runs = |program: &str| {
        Command::new(program).arg("--version").output().is_ok_and(|out| out.status.success())
    };
    runs("tree-sitter") && runs("node")
}

/// Generates the parser and has it read every sound file; reports those with an error in their
/// tree.
pub(crate) fn grammar() -> Result<(), String> {
    if !is_there() {
        let bring = "`cargo install tree-sitter-cli --no-default-features` brings it";
        return Err(format!("tree-sitter is not installed: {bring}"));
    }
    // The parser is generated beside its grammar, so both are copied.
    let (source, folder) = (root().join("grammar/tree-sitter"), root().join("target/tree-sitter"));
    for file in ["grammar.js", "tree-sitter.json", "queries/highlights.scm"] {
        let copy = folder.join(file);
        let parent = copy.parent().unwrap_or(&folder);
        let made = std::fs::create_dir_all(parent);
        made.and_then(|()| std::fs::copy(source.join(file), &copy).map(drop))
            .map_err(|why| format!("{}: {why}", copy.display()))?;
    }
    run(Command::new("tree-sitter").arg("generate").current_dir(&folder))?;
    let mut files = Vec::new();
    for sound in SOUND {
        pitch_files(&root().join(sound), &mut files)?;
    }
    let parse = Command::new("tree-sitter")
        .args(["parse", "--quiet"])
        .args(&files)
        .current_dir(&folder)
        .output()
        .map_err(|why| format!("tree-sitter can't be run: {why}"))?;
    let printed = String::from_utf8_lossy(&parse.stdout);
    let faulty: Vec<&str> = printed.lines().filter(|line| !line.trim().is_empty()).collect();
    if !faulty.is_empty() || !parse.status.success() {
        let errors = String::from_utf8_lossy(&parse.stderr);
        return Err(format!("the grammar can't read:\n{}\n{errors}", faulty.join("\n")));
    }
    println!("grammar: {} files read", files.len());
    run(Command::new("tree-sitter")
        .args(["query", "--quiet", "queries/highlights.scm"])
        .args(files.first())
        .current_dir(&folder))
}

/// The `.pitch` files of a folder and those in it.
fn pitch_files(folder: &Path, into: &mut Vec<PathBuf>) -> Result<(), String> {
    let fault = |why| format!("{}: {why}", folder.display());
    let entries = std::fs::read_dir(folder).map_err(fault)?;
    for entry in entries {
        let path = entry.map_err(fault)?.path();
        if path.is_dir() {
            pitch_files(&path, into)?;
        } else if path.extension().is_some_and(|ending| ending == "pitch") {
            into.push(path.canonicalize().map_err(fault)?);
        }
    }
    Ok(())
}
