//! The rules of the project that a machine can check: which room may use which, where files and
//! clocks are read, lengths of files and lines, names of types,
//! words.

mod names;
mod rings;
mod rooms;
mod width;
mod words;

use crate::shell::root;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The sources of the workspace's crates.
const CRATES: &[&str] = &[
    "grammar/src",
    "scenario/src",
    "dsl/src",
    "engine/src",
    "render/src",
    "setpiece/src",
    "python/src",
    "xtask/src",
    "lab/src",
];

/// Longest source file in lines, without tests.
const LINES_MAX: usize = 600;

/// Each room, and everything that it may depend on.
const MAY_USE: &[(&str, &[&str])] = &[
    ("setpiece-grammar", &["pest", "pest_derive"]),
    ("setpiece-scenario", &["ciborium", "crc32fast", "libm", "schemars", "serde", "serde_json"]),
    (
        "setpiece-dsl",
        &[
            "setpiece-grammar",
            "setpiece-scenario",
            "miette",
            "pest",
            "strsim",
            "thiserror",
            "serde",
            "serde_json",
        ],
    ),
    (
        "setpiece-engine",
        &[
            "setpiece-scenario",
            "arrayvec",
            "glam",
            "libm",
            "log",
            "postcard",
            "rand_core",
            "rand_pcg",
            "rapier3d",
            "rayon",
            "rhai",
            "serde",
            "strsim",
            "thiserror",
            "wide",
        ],
    ),
    ("setpiece-render", &["glam", "serde", "thiserror"]),
    (
        "setpiece-python",
        &[
            "setpiece",
            "setpiece-engine",
            "setpiece-scenario",
            "log",
            "numpy",
            "pyo3",
            "serde_json",
            "rayon",
        ],
    ),
];

/// Words that a room's sources must not contain, and why.
const MUST_NOT_SAY: &[(&str, &[&str], &str)] = &[
    ("dsl/src", &["std::fs", "std::env", "std::net"], "sources come through a `SourceLoader`"),
    // Who builds words outside of the room of problems is stopped by the compiler: `say` is private
    // there.
    ("dsl/src/parse", PROSE, WHERE_WORDS_STAND),
    ("dsl/src/resolve", PROSE, WHERE_WORDS_STAND),
    ("dsl/src/lower", PROSE, WHERE_WORDS_STAND),
    ("dsl/src/compile", PROSE, WHERE_WORDS_STAND),
    (
        "dsl/src/problem/facts",
        &["message: String", "help: "],
        "a fact carries data; its words stand in its entry",
    ),
    (
        "engine/src",
        &["std::fs", "std::env", "std::net", "thread_local!", "HashMap", "HashSet"],
        "the engine is deterministic and reads nothing",
    ),
    ("engine/src", &["Instant::now", "SystemTime"], "the engine knows no clock"),
    (
        "render/src",
        &[
            "std::fs",
            "std::env",
            "std::net",
            "Instant::now",
            "SystemTime",
            "thread_local!",
            "HashMap",
            "HashSet",
        ],
        "a picture depends on its scene alone",
    ),
    ("scenario/src", &["std::fs", "std::env", "HashMap"], "the compiled scenario is plain data"),
    ("python/src", &["rapier3d", "rhai", "pest"], "the binding holds conversions only"),
];

/// What the words of a report often begin with.
const PROSE: &[&str] = &["did you mean", "\"write ", "\"leave ", "can't be ", "is given twice"];
/// Why no stage of the compiler says it.
const WHERE_WORDS_STAND: &str = "a stage reports a fact; its words stand in dsl/src/problem/facts/";

/// Where a word may stand all the same, and why.
const MAY_SAY: &[(&str, &str)] = &[
    // What the engine says of scripts.
    ("dsl/src/problem/facts/files.rs", "message: String"),
    ("dsl/src/problem/facts/files.rs", "help: "),
    // Rhai's machine, and what a call has left, shares and prints: every call begins with its own.
    ("engine/src/judge/script/call.rs", "thread_local!"),
    ("engine/src/judge/script/budget.rs", "thread_local!"),
    ("engine/src/judge/script/print.rs", "thread_local!"),
];

/// The rooms of the compiler (a file of `dsl/src` and its folder), from the ground up, and the
/// rooms that each may use. These must come earlier in the list.
const DSL_ARROWS: &[(&str, &[&str])] = &[
    ("source", &[]),
    ("habit", &[]),
    ("check", &[]),
    ("cast", &[]),
    ("outline", &[]),
    ("origins", &["source", "outline"]),
    ("ast", &["source"]),
    ("problem", &["source", "habit", "check"]),
    ("index", &["source"]),
    ("report", &["source", "problem"]),
    ("parse", &["source", "habit", "check", "ast", "problem"]),
    ("format", &["source", "problem", "parse"]),
    ("resolve", &["source", "index", "ast", "problem", "parse"]),
    (
        "lower",
        &[
            "source", "check", "cast", "outline", "origins", "index", "ast", "problem", "parse",
            "format", "resolve",
        ],
    ),
    (
        "compile",
        &[
            "source", "cast", "origins", "index", "ast", "problem", "parse", "check", "resolve",
            "lower",
        ],
    ),
];

/// Checks every rule and reports each breach.
pub(crate) fn tidy() -> Result<(), String> {
    let mut breaches = Vec::new();
    dependencies(&mut breaches)?;
    rooms::check(&root().join("engine/src"), &mut breaches)?;
    for (folder, words, why) in MUST_NOT_SAY {
        for file in rust_files(&root().join(folder)) {
            let text = read(&file)?;
            // Tests at the end of a file may use anything.
            let code = text.split("#[cfg(test)]").next().unwrap_or_default();
            let allowed = |word: &str| {
                MAY_SAY.iter().any(|(path, said)| *said == word && file.ends_with(path))
            };
            for word in words.iter().filter(|word| !allowed(word)) {
                if let Some(line) = code
                    .lines()
                    .position(|line| line.contains(word) && !line.trim_start().starts_with("//"))
                {
                    breaches.push(format!("{}:{}: `{word}`: {why}", file.display(), line + 1));
                }
            }
        }
    }
    for folder in CRATES {
        for file in rust_files(&root().join(folder)) {
            let text = read(&file)?;
            let lines = text.split("#[cfg(test)]").next().unwrap_or_default().lines().count();
            if lines > LINES_MAX {
                breaches
                    .push(format!("{}: {lines} lines; split it at {LINES_MAX}", file.display()));
            }
            if file.file_name().is_some_and(|name| name == "mod.rs") {
                breaches.push(format!("{}: write `foo.rs` beside `foo/`", file.display()));
            }
        }
    }
    dsl_arrows(&mut breaches)?;
    names::check(&mut breaches)?;
    rings::check(&mut breaches)?;
    crate::release::versions(&mut breaches);
    let tracked = tracked()?;
    words::check(&tracked, &mut breaches)?;
    for path in &tracked {
        match Path::new(path).extension().and_then(|ending| ending.to_str()) {
            Some("rs") => width::check(path, &mut breaches)?,
            Some("md") => width::check_prose(path, &mut breaches)?,
            _ => {}
        }
    }
    if breaches.is_empty() {
        println!("tidy: the house is in order");
        Ok(())
    } else {
        Err(format!("{} breaches\n  {}", breaches.len(), breaches.join("\n  ")))
    }
}

/// Checks the compiler's rooms against [`DSL_ARROWS`].
fn dsl_arrows(breaches: &mut Vec<String>) -> Result<(), String> {
    let folder = root().join("dsl/src");
    for (at, (room, may_use)) in DSL_ARROWS.iter().enumerate() {
        for used in *may_use {
            if !DSL_ARROWS.iter().take(at).any(|(below, _)| below == used) {
                breaches.push(format!(
                    "dsl: `{room}` may not be allowed `{used}`, which is not below it"
                ));
            }
        }
    }
    for file in rust_files(&folder) {
        let path = file.strip_prefix(&folder).map_err(|why| why.to_string())?.with_extension("");
        let rooms: Vec<_> = path.iter().filter_map(|part| part.to_str()).collect();
        // The crate's root names every room.
        let Some(&own) = rooms.first().filter(|room| **room != "lib") else { continue };
        let Some((_, may_use)) = DSL_ARROWS.iter().find(|(room, _)| *room == own) else {
            breaches.push(format!("{}: `{own}` is no room of DSL_ARROWS", file.display()));
            continue;
        };
        let text = read(&file)?;
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        // From a room's file up to the crate's root, in both notations.
        let to_root = ["crate::".to_owned(), "super::".repeat(rooms.len())];
        for (line, code) in
            code.lines().enumerate().filter(|(_, line)| !line.trim_start().starts_with("//"))
        {
            for used in to_root.iter().flat_map(|root| code.split(root.as_str()).skip(1)) {
                let used = used
                    .split(|c: char| !c.is_alphanumeric() && c != '_')
                    .next()
                    .unwrap_or_default();
                if used != own && used != "super" && !may_use.contains(&used) {
                    breaches.push(format!(
                        "{}:{}: `{own}` may not use `{used}`",
                        file.display(),
                        line + 1
                    ));
                }
            }
        }
    }
    Ok(())
}

fn dependencies(breaches: &mut Vec<String>) -> Result<(), String> {
    let output = Command::new("cargo")
        .args(["metadata", "--format-version", "1", "--no-deps"])
        .current_dir(root())
        .output()
        .map_err(|why| format!("cargo metadata can't be run: {why}"))?;
    let metadata: serde_json::Value =
        serde_json::from_slice(&output.stdout).map_err(|why| why.to_string())?;
    let list = |value: &serde_json::Value| value.as_array().cloned().unwrap_or_default();
    let mut seen = 0;
    for package in list(&metadata["packages"]) {
        let name = package["name"].as_str().unwrap_or_default();
        let Some((_, allowed)) = MAY_USE.iter().find(|(room, _)| *room == name) else { continue };
        seen += 1;
        for dependency in list(&package["dependencies"]) {
            let used = dependency["name"].as_str().unwrap_or_default();
            // `kind` is null for ordinary dependencies; tests may use more.
            if dependency["kind"].is_null() && !allowed.contains(&used) {
                breaches.push(format!("{name} may not use {used}"));
            }
        }
    }
    if seen == MAY_USE.len() {
        Ok(())
    } else {
        Err("cargo metadata does not show every room".to_owned())
    }
}

/// The paths of the tracked files that are there, from the project's root.
fn tracked() -> Result<Vec<String>, String> {
    let output = Command::new("git")
        .args(["ls-files", "-z"])
        .current_dir(root())
        .output()
        .map_err(|why| format!("git ls-files can't be run: {why}"))?;
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr);
        return Err(format!("git ls-files failed: {}", why.trim()));
    }
    let paths = String::from_utf8_lossy(&output.stdout);
    Ok(paths.split('\0').filter(|path| root().join(path).is_file()).map(str::to_owned).collect())
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(&folder).into_iter().flatten().flatten().map(|entry| entry.path())
        {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

fn read(file: &Path) -> Result<String, String> {
    fs::read_to_string(file).map_err(|why| format!("{}: {why}", file.display()))
}
