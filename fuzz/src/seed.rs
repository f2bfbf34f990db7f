//! Seeds: initial inputs, made from the contents of the repository.

use crate::choice::Choices;
use setpiece::scenario::{Scenario, file};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// The variable with the folder into which a target writes its seeds before it starts.
pub const FOLDER: &str = "SETPIECE_FUZZ_SEEDS";

/// The first byte of an input of `load`: the meaning of the others.
pub mod load {
    /// The whole file.
    pub const FILE: u8 = b'f';
    /// The scenario in it; the checksum is recomputed.
    pub const BODY: u8 = b'b';
    /// Edits of a compiled scenario.
    pub const EDITS: u8 = b'e';
}

/// Largest compiled scenario among the seeds, bytes.
const BODY_MAX: usize = 12_000;
/// How many inputs of random bytes are among the seeds of a target that makes choices.
const RANDOM: u64 = 48;

/// Writes a target's seeds into the folder of [`FOLDER`]; no-op without it.
pub fn write(target: &str) {
    let Some(folder) = std::env::var_os(FOLDER).map(PathBuf::from) else { return };
    std::fs::create_dir_all(&folder).expect("a folder for seeds");
    let seeds = match target {
        "compile" => texts().into_iter().map(String::into_bytes).collect(),
        "script" => scripts().into_iter().map(String::into_bytes).collect(),
        "load" => loads(),
        _ => (0..RANDOM).map(|n| random(n, 400)).collect(),
    };
    for (n, seed) in seeds.into_iter().enumerate() {
        std::fs::write(folder.join(format!("{n:04}")), seed).expect("a seed is written");
    }
}

/// Scenarios that compile, in the order of their sources.
pub fn scenarios() -> &'static [Arc<Scenario>] {
    static SCENARIOS: OnceLock<Vec<Arc<Scenario>>> = OnceLock::new();
    SCENARIOS.get_or_init(|| {
        let compile = |text: String| {
            setpiece::compile_text(&text, "<seed>").ok().map(|loaded| loaded.scenario)
        };
        texts().into_iter().filter_map(compile).collect()
    })
}

/// A compiled scenario as the inside of its file.
pub fn body(scenario: &Scenario) -> String {
    serde_json::to_string(scenario).expect("a scenario that can be written")
}

/// The scenario chosen by the bytes.
pub fn pick(choices: &mut Choices<'_>) -> &'static Scenario {
    let all = scenarios();
    &all[usize::from(choices.word()) % all.len()]
}

fn loads() -> Vec<Vec<u8>> {
    let mut seeds: Vec<Vec<u8>> =
        (0..RANDOM).map(|n| [&[load::EDITS], &*random(n, 40)].concat()).collect();
    for (n, scenario) in scenarios().iter().enumerate() {
        let body = body(scenario);
        if body.len() > BODY_MAX {
            continue;
        }
        if n % 16 == 0 {
            let text = file::to_json(scenario).expect("a scenario that can be written");
            seeds.push([&[load::FILE], text.as_bytes()].concat());
        }
        seeds.push([&[load::BODY], body.as_bytes()].concat());
    }
    seeds
}

/// Every text in the language: cases of the specification, the library, the examples, and pages.
fn texts() -> Vec<String> {
    let mut texts = Vec::new();
    for text in files("tests/spec", "pitch") {
        texts.extend(text.split("\n--- ").skip(1).filter_map(|case| {
            let (_, case) = case.split_once('\n')?;
            Some(case.split("\n+++ ").next().unwrap_or(case).to_owned())
        }));
    }
    texts.extend(files("stdlib-scenarios", "pitch"));
    texts.extend(files("examples", "pitch"));
    for page in files("docs/language", "md") {
        let blocks = page.split("```pitch\n").skip(1);
        texts.extend(blocks.filter_map(|block| Some(block.split_once("```")?.0.to_owned())));
    }
    texts
}

/// Every script: files, and those in texts.
fn scripts() -> Vec<String> {
    let mut scripts = files("examples", "rhai");
    for text in texts() {
        scripts.extend(text.split("\"\"\"").skip(1).step_by(2).map(str::to_owned));
    }
    scripts
}

/// The repository's files with an ending, in order of their paths.
fn files(folder: &str, ending: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let (mut folders, mut paths) = (vec![root.join(folder)], Vec::new());
    while let Some(folder) = folders.pop() {
        for path in
            std::fs::read_dir(&folder).into_iter().flatten().flatten().map(|entry| entry.path())
        {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|found| found == ending) {
                paths.push(path);
            }
        }
    }
    paths.sort();
    paths.iter().filter_map(|path| std::fs::read_to_string(path).ok()).collect()
}

/// Bytes without a meaning, the same for the same number.
fn random(n: u64, len: usize) -> Vec<u8> {
    let mut state = n;
    let mut byte = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 56) as u8
    };
    (0..len).map(|_| byte()).collect()
}
