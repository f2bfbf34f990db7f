//! The language's specification: `tests/spec/<topic>/*.pitch`, annotated sources.
//!
//! A file holds cases. `--- NAME check` begins one, `--- NAME probe` one that is also tried in a
//! dry run; `+++ PATH` begins another file of it. Every problem must be annotated below its line,
//! and every annotation must match:
//!
//! ```text
//!     ball in right.bocks
//! //                ^^^^^ SP0204: `right` has no landmark or region `bocks`
//! //                help: did you mean `box`?
//! ```
//!
//! If the span begins in the first columns, `// @COLUMN+WIDTH SP0204: …` replaces the carets.
//! `SETPIECE_BLESS=1` rewrites the annotations to the compiler's reports.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::Loaded;
use setpiece::script_api::EngineScripts;
use setpiece_dsl::problem::Problem;
use setpiece_dsl::source::{LoadError, Source, SourceLoader};
use setpiece_dsl::{CompileOptions, CompileOutcome, compile};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Loads other files of the case, and the standard library under `std/`.
struct CaseLoader {
    files: Vec<(String, String)>,
}

impl SourceLoader for CaseLoader {
    fn load(&self, path: &str, _from: &str) -> Result<Source, LoadError> {
        if let Some(inner) = path.strip_prefix("std/") {
            let full = root().join("stdlib-scenarios").join(inner);
            if let Ok(text) = fs::read_to_string(full) {
                return Ok(Source { name: path.to_owned(), text: text.into() });
            }
        }
        if let Some((name, text)) = self.files.iter().find(|(name, _)| name == path) {
            return Ok(Source { name: name.clone(), text: text.as_str().into() });
        }
        let names: Vec<String> = self.files.iter().map(|(name, _)| name.clone()).collect();
        let near = setpiece_dsl::problem::nearest(path, names.iter().map(String::as_str))
            .map(str::to_owned);
        Err(LoadError {
            message: format!("no file `{path}`"),
            similar: near.into_iter().collect(),
            awaited: None,
        })
    }

    fn scenarios(&self) -> Vec<(String, String)> {
        let mut files = Vec::new();
        pitch_files(&root().join("stdlib-scenarios"), &mut files);
        let name = |file: &PathBuf| {
            let stem = file.file_stem()?.to_str()?.to_owned();
            let inner =
                file.strip_prefix(root().join("stdlib-scenarios")).ok()?.to_str()?.to_owned();
            inner.contains('/').then(|| (stem, format!("std/{inner}")))
        };
        files.iter().filter_map(name).collect()
    }
}

/// One case: its header line and its files, the root first.
struct Case {
    header: String,
    name: String,
    files: Vec<(String, String)>,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn pitch_files(folder: &Path, into: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let mut paths: Vec<PathBuf> =
        entries.filter_map(|entry| entry.ok().map(|entry| entry.path())).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            pitch_files(&path, into);
        } else if path.extension().is_some_and(|extension| extension == "pitch") {
            into.push(path);
        }
    }
}

/// Splits a file into cases; the lines before the first header are a preface.
fn split(text: &str) -> (String, Vec<Case>) {
    let (mut preface, mut cases) = (String::new(), Vec::<Case>::new());
    for line in text.lines() {
        if let Some(header) = line.strip_prefix("--- ") {
            let name = header.split_whitespace().next().unwrap_or_default().to_owned();
            cases.push(Case {
                header: header.to_owned(),
                name,
                files: vec![("case.pitch".to_owned(), String::new())],
            });
        } else if let (Some(path), Some(case)) = (line.strip_prefix("+++ "), cases.last_mut()) {
            case.files.push((path.trim().to_owned(), String::new()));
        } else {
            let text = match cases.last_mut().and_then(|case| case.files.last_mut()) {
                Some((_, text)) => text,
                None => &mut preface,
            };
            text.push_str(line);
            text.push('\n');
        }
    }
    (preface, cases)
}

fn is_annotation(line: &str) -> bool {
    let Some(rest) = line.trim_start().strip_prefix("//") else { return false };
    let rest = rest.trim_start();
    let code = |text: &str| text.trim_start_matches('^').trim_start().starts_with("SP0");
    (rest.starts_with('^') && code(rest))
        || (rest.starts_with('@') && rest.contains(" SP0"))
        || rest.starts_with("help: ")
}

/// The text of a file without its annotations.
fn bare(text: &str) -> String {
    text.lines()
        .filter(|line| !is_annotation(line))
        .fold(String::new(), |all, line| all + line + "\n")
}

/// The text of a file with the problems annotated below their lines.
fn annotated(text: &str, problems: &[(usize, usize, &Problem)]) -> String {
    let (mut out, mut offset) = (String::new(), 0);
    let mut lines: Vec<&str> = text.lines().collect();
    if lines.is_empty() {
        lines.push("");
    }
    let last = lines.len() - 1;
    for (number, line) in lines.iter().enumerate() {
        out.push_str(line);
        out.push('\n');
        let end = offset + line.len();
        for (start, stop, problem) in problems {
            let here = *start >= offset && (*start <= end || number == last);
            if !here {
                continue;
            }
            let column = line
                .get(..(*start - offset).min(line.len()))
                .map_or(0, |head| head.chars().count());
            let shown = line.get(
                (*start - offset).min(line.len())
                    ..(*stop).clamp(*start, end).saturating_sub(offset),
            );
            let width = shown.map_or(1, |text| text.chars().count()).max(1);
            let place = if column < 3 {
                format!("// @{column}+{width}")
            } else {
                format!("//{}{}", " ".repeat(column - 2), "^".repeat(width))
            };
            let words = problem.words();
            out.push_str(&format!("{place} {}: {}\n", problem.code(), words.message));
            if let Some(help) = words.help {
                out.push_str(&format!("//{}help: {help}\n", " ".repeat(column.max(3) - 2)));
            }
        }
        offset = end + 1;
    }
    out
}

/// Compiles a case, with the engine's check of its scripts; `probe` adds the dry run.
fn run(case: &Case, probe: bool) -> CompileOutcome {
    let bare: Vec<(String, String)> =
        case.files.iter().map(|(name, text)| (name.clone(), bare(text))).collect();
    let (name, text) = bare[0].clone();
    let options = CompileOptions { scripts: Some(&EngineScripts), ..CompileOptions::default() };
    let mut outcome =
        compile(Source { name, text: text.into() }, &CaseLoader { files: bare }, &options);
    if let (true, Some(scenario)) = (probe, &outcome.scenario) {
        let loaded = Loaded {
            scenario: Arc::new(scenario.clone()),
            warnings: outcome.problems.clone(),
            sources: outcome.sources.clone(),
            origin: outcome.origins.scenario,
            origins: outcome.origins.clone(),
            inputs: Vec::new(),
            behaviors: outcome.behaviors.clone(),
            unplayable: Vec::new(),
        };
        outcome.problems = setpiece::probe::probe(&loaded, None);
    }
    outcome
}

/// The case with the right annotations.
fn expected(case: &Case, outcome: &CompileOutcome) -> String {
    let mut out = format!("--- {}\n", case.header);
    for (index, (name, text)) in case.files.iter().enumerate() {
        if index > 0 {
            out.push_str(&format!("+++ {name}\n"));
        }
        let here: Vec<(usize, usize, &Problem)> = outcome
            .problems
            .iter()
            .filter_map(|problem| {
                let span = problem.place();
                let file = outcome.sources.get(span.file)?;
                if file.name == *name {
                    return Some((span.start as usize, span.end as usize, problem));
                }
                // Problems in a file of the library are annotated at the top.
                let foreign = case.files.iter().all(|(other, _)| file.name != *other);
                (index == 0 && foreign).then_some((0, 0, problem))
            })
            .collect();
        out.push_str(&annotated(&bare(text), &here));
    }
    out
}

#[test]
fn every_case_of_the_specification_holds() {
    let bless = std::env::var_os("SETPIECE_BLESS").is_some();
    let mut paths = Vec::new();
    pitch_files(&root().join("tests/spec"), &mut paths);
    assert!(!paths.is_empty(), "no specification found");
    let (mut faults, mut n) = (Vec::new(), 0);
    for path in paths {
        let text = fs::read_to_string(&path).expect("a readable file");
        let (preface, cases) = split(&text);
        let mut blessed = preface;
        for case in cases {
            n += 1;
            let kind = case.header.split_whitespace().nth(1).unwrap_or_default();
            assert!(
                matches!(kind, "check" | "probe"),
                "{}: `{}` is no kind of case",
                path.display(),
                case.header
            );
            let outcome = run(&case, kind == "probe");
            // The dry run may find an error in a scenario that compiles.
            let compiles = !outcome
                .problems
                .iter()
                .any(|p| p.severity() == setpiece_dsl::problem::Severity::Error);
            assert!(
                kind == "probe" || outcome.scenario.is_some() == compiles,
                "{}: {}",
                path.display(),
                case.name
            );
            let written: String = std::iter::once(format!("--- {}\n", case.header))
                .chain(case.files.iter().enumerate().map(|(index, (name, text))| {
                    if index == 0 { text.clone() } else { format!("+++ {name}\n{text}") }
                }))
                .collect();
            let wanted = expected(&case, &outcome);
            if written != wanted {
                faults.push(format!(
                    "{} {}\n{}",
                    path.display(),
                    case.name,
                    difference(&written, &wanted)
                ));
            }
            blessed.push_str(&wanted);
        }
        if bless {
            fs::write(&path, blessed).expect("a writable file");
        }
    }
    assert!(
        bless || faults.is_empty(),
        "{} of {n} cases differ:\n\n{}",
        faults.len(),
        faults.join("\n\n")
    );
}

/// Lines that only one of two texts has.
fn difference(written: &str, found: &str) -> String {
    let (written, found): (Vec<&str>, Vec<&str>) =
        (written.lines().collect(), found.lines().collect());
    let missing = written
        .iter()
        .filter(|line| !found.contains(line))
        .map(|line| format!("  annotated: {line}"));
    let surplus = found
        .iter()
        .filter(|line| !written.contains(line))
        .map(|line| format!("  found:     {line}"));
    missing.chain(surplus).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_standard_library_compiles_without_a_word() {
    let folder = root().join("stdlib-scenarios");
    let mut paths = Vec::new();
    pitch_files(&folder, &mut paths);
    let mut n = 0;
    for path in paths {
        let text = fs::read_to_string(&path).expect("a readable file");
        let inner = path.strip_prefix(&folder).expect("inside").to_string_lossy().into_owned();
        let outcome = compile(
            Source { name: format!("std/{inner}"), text: text.into() },
            &CaseLoader { files: vec![] },
            &CompileOptions::default(),
        );
        let words: Vec<String> = outcome
            .problems
            .iter()
            .filter(|problem| !problem.misses_scenario())
            .map(|problem| {
                let text = outcome.sources.text(problem.place());
                format!("{inner}: {} {} `{}`", problem.code(), problem.words().message, text)
            })
            .collect();
        assert!(words.is_empty(), "{}", words.join("\n"));
        if let Some(scenario) = &outcome.scenario {
            setpiece_scenario::verify::verify(scenario).expect("a scenario that holds");
            n += 1;
        }
    }
    assert_eq!(
        n, 41,
        "eleven Academy scenarios, six of them for all players, seven benchmarks and seventeen of \
         GRF's tests and examples"
    );
}
