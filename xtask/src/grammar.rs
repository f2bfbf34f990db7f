//! The grammar for editors by tree-sitter, held to the files of the repository.

mod captures;

use crate::shell::{self, copy_folder, root, run, write};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Folders whose `.pitch` files can all be read.
const SOUND: [&str; 5] = ["dsl", "editors", "examples", "grammar", "stdlib-scenarios"];
/// The specification: files of cases, some of which can't be read.
const SPECIFICATION: &str = "tests/spec";
/// Codes of reports on what can't be read: syntax, and words that are no role or event.
const UNREADABLE: [&str; 3] = [" SP01", " SP0203", " SP0207"];
/// The queries, which stand in `grammar/tree-sitter/queries`.
pub(crate) const QUERIES: [&str; 6] =
    ["highlights", "folds", "indents", "locals", "tags", "injections"];

/// Whether tree-sitter's command is there.
pub(crate) fn is_there() -> bool {
    ["tree-sitter", "node"].into_iter().all(|program| shell::is_there(&mut Command::new(program)))
}

/// Generates the parser, and has it and its queries read every sound file; reports those with an
/// error in their tree. Runs the tests of the queries.
pub(crate) fn grammar() -> Result<(), String> {
    let folder = generate()?;
    let files = sound_files()?;
    let all = [files.clone(), readable_cases()?].concat();
    let faulty = said_of(&folder, &["parse", "--quiet"], &all)?;
    if faulty.lines().any(|line| !line.trim().is_empty()) {
        return Err(format!("the grammar can't read:\n{faulty}"));
    }
    println!("grammar: {} texts read", all.len());
    run(&mut tree_sitter(&folder, &["test"]))?;
    for query in QUERIES {
        let path = format!("queries/{query}.scm");
        said_of(&folder, &["query", "--quiet", &path], &all)?;
        let example = folder.join(format!("test/query/{query}.pitch"));
        if example.exists() {
            let found = said_of(&folder, &["query", &path], std::slice::from_ref(&example))?;
            captures::check(&example, &found)?;
        }
    }
    let tags = said_of(&folder, &["tags"], &files)?;
    let tags = tags.lines().filter(|line| line.contains("\tdef (")).count();
    let colours = said_of(&folder, &["highlight", "--html"], &files)?;
    let colours = colours.matches("<span class=").count();
    println!("grammar: {tags} names, {colours} coloured words");
    if tags < files.len() || colours < 100 * files.len() {
        return Err("the queries find too few names or words".to_owned());
    }
    Ok(())
}

/// Generates the parser from the grammar in a folder of `target`; returns that folder.
pub(crate) fn generate() -> Result<PathBuf, String> {
    if !is_there() {
        let bring = "`cargo install tree-sitter-cli --no-default-features` brings it";
        return Err(format!("tree-sitter is not installed: {bring}"));
    }
    // The parser is generated beside its grammar, so both are copied. The folder's name is what
    // tree-sitter looks for.
    let folder = root().join("target/tree-sitter-setpiece");
    copy_folder(&root().join("grammar/tree-sitter"), &folder)?;
    let config = serde_json::json!({ "parser-directories": [root().join("target")] });
    let path = config_path();
    std::fs::write(&path, config.to_string())
        .map_err(|why| format!("{}: {why}", path.display()))?;
    run(Command::new("tree-sitter").arg("generate").current_dir(&folder))?;
    Ok(folder)
}

/// Builds the parser as a library that an editor loads.
pub(crate) fn build_parser(folder: &Path, library: &Path) -> Result<(), String> {
    // The linker wants its folder.
    write(library, "")?;
    run(Command::new("tree-sitter").args(["build", "--output"]).arg(library).current_dir(folder))
}

fn config_path() -> PathBuf {
    root().join("target/tree-sitter.json")
}

/// A call of tree-sitter's command; its own configuration lists our parser alone.
fn tree_sitter(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new("tree-sitter");
    command.args(args).arg("--config-path").arg(config_path()).current_dir(folder);
    command
}

/// What tree-sitter's command prints about some files.
fn said_of(folder: &Path, args: &[&str], files: &[PathBuf]) -> Result<String, String> {
    let name = args.join(" ");
    let mut command = tree_sitter(folder, args);
    // `query` takes its query first.
    let output = command
        .arg("--")
        .args(files)
        .output()
        .map_err(|why| format!("tree-sitter can't be run: {why}"))?;
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!("tree-sitter {name}:\n{printed}\n{errors}"));
    }
    Ok(printed)
}

fn sound_files() -> Result<Vec<PathBuf>, String> {
    let mut files = Vec::new();
    for sound in SOUND {
        pitch_files(&root().join(sound), &mut files)?;
    }
    files.sort();
    Ok(files)
}

/// The specification's cases that can be read, each as a file of `target`.
fn readable_cases() -> Result<Vec<PathBuf>, String> {
    let folder = root().join("target/tree-sitter-cases");
    let mut sources = Vec::new();
    pitch_files(&root().join(SPECIFICATION), &mut sources)?;
    let mut files = Vec::new();
    for source in sources {
        let text = std::fs::read_to_string(&source)
            .map_err(|why| format!("{}: {why}", source.display()))?;
        // Topics have files of the same names.
        let topic = source.strip_prefix(root()).unwrap_or(&source).with_extension("");
        for (number, text) in parts_of_cases(&text).into_iter().enumerate() {
            let path = folder.join(&topic).join(format!("{number}.pitch"));
            write(&path, &text)?;
            files.push(path);
        }
    }
    Ok(files)
}

/// The `.pitch` texts of a file of cases, without those of cases that can't be read.
fn parts_of_cases(text: &str) -> Vec<String> {
    let cases = format!("\n{text}");
    let mut parts = Vec::new();
    for case in cases.split("\n--- ").skip(1) {
        let (_, body) = case.split_once('\n').unwrap_or_default();
        let is_fault = |line: &str| {
            line.starts_with("//") && UNREADABLE.iter().any(|code| line.contains(code))
        };
        let is_readable = !body.lines().any(is_fault);
        if !is_readable {
            continue;
        }
        let body = format!("\n{body}");
        let mut files = body.split("\n+++ ");
        parts.extend(files.next().map(str::to_owned));
        let others = files.filter_map(|file| file.split_once('\n'));
        let others = others.filter(|(name, _)| name.trim().rsplit('.').next() == Some("pitch"));
        parts.extend(others.map(|(_, text)| text.to_owned()));
    }
    parts
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
            into.push(path);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::parts_of_cases;

    #[test]
    fn cases_with_a_fault_of_syntax_are_left_out() {
        let text = "// A topic.\n\n--- one check\na\n// ^ SP0201: b\n+++ b.pitch\nb\n+++ c.rhai\nc\n\
                    --- two check\nd\n// ^ SP0101: e\n--- three probe\nf\n";
        assert_eq!(parts_of_cases(text), ["\na\n// ^ SP0201: b", "b", "\nf\n"]);
    }
}
