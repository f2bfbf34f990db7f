//! Texts for readers: every `.pitch` example of README and the reference compiles without a
//! problem, and the examples can be played. `python/tests/test_docs_pages.py` tries other pages.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The ```` ```pitch ```` blocks of a page.
fn blocks(page: &str) -> Vec<String> {
    let mut blocks = Vec::new();
    let mut open: Option<String> = None;
    for line in page.lines() {
        match (&mut open, line.trim()) {
            (None, "```pitch") => open = Some(String::new()),
            (Some(_), "```") => blocks.extend(open.take()),
            (Some(block), _) => {
                block.push_str(line);
                block.push('\n');
            }
            _ => {}
        }
    }
    blocks
}

fn reports(error: &setpiece::Error) -> String {
    match error {
        setpiece::Error::Compile(failure) => setpiece::dsl::report::render(
            &failure.problems,
            &failure.sources,
            setpiece::dsl::report::Format::Human { color: false, width: 100 },
        ),
        other => other.to_string(),
    }
}

#[test]
fn every_example_of_the_readme_compiles() {
    let text = std::fs::read_to_string(root().join("README.md")).unwrap();
    let blocks = blocks(&text);
    assert!(!blocks.is_empty(), "README has no example");
    for block in blocks {
        let loaded = setpiece::compile_text(&block, "README.md")
            .unwrap_or_else(|error| panic!("{}", reports(&error)));
        assert!(loaded.warnings.is_empty(), "{:?}\n{block}", loaded.warnings);
    }
}

/// A block of the reference may be a file with only rewards or regions, as `check` accepts it.
#[test]
fn every_example_of_the_reference_is_sound() {
    let folder = root().join("docs/language");
    let dir = tempfile::tempdir().unwrap();
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let page = entry.unwrap().path();
        for block in blocks(&std::fs::read_to_string(&page).unwrap()) {
            let path = dir.path().join("page.pitch");
            std::fs::write(&path, &block).unwrap();
            let found = setpiece::check(path.to_str().unwrap())
                .unwrap_or_else(|error| panic!("{}", reports(&error)));
            assert!(found.problems.is_empty(), "{}: {:?}\n{block}", page.display(), found.problems);
            let source = setpiece::dsl::source::Source {
                name: "page.pitch".to_owned(),
                text: block.as_str().into(),
            };
            let laid_out = setpiece::dsl::format::format(&source).unwrap();
            assert_eq!(
                *laid_out,
                *block,
                "{} is not laid out as `setpiece fmt` does",
                page.display()
            );
            seen += 1;
        }
    }
    assert!(seen >= 20, "{seen}");
}

#[test]
fn every_example_file_compiles_without_a_warning() {
    let mut seen = 0;
    for entry in std::fs::read_dir(root().join("examples")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "pitch") {
            let loaded =
                setpiece::load_file(&path).unwrap_or_else(|error| panic!("{}", reports(&error)));
            assert!(loaded.warnings.is_empty(), "{}: {:?}", path.display(), loaded.warnings);
            seen += 1;
        }
    }
    assert!(seen >= 2);
}

#[test]
fn every_scenario_of_the_library_compiles_without_a_warning_and_has_both_difficulties() {
    let entries = setpiece::list();
    assert_eq!(entries.len(), 41);
    for entry in entries {
        let loaded = setpiece::load(&entry.name).unwrap();
        assert!(loaded.warnings.is_empty(), "{}: {:?}", entry.name, loaded.warnings);
        assert_eq!(loaded.scenario.name, entry.name);
        assert!(!entry.title.is_empty(), "{}", entry.name);
        for param in ["difficulty", "left_difficulty"] {
            assert!(
                loaded.scenario.params.iter().any(|p| p.name == param),
                "{} has no `{param}`",
                entry.name
            );
        }
        setpiece::scenario::verify::verify(&loaded.scenario).unwrap();
        let text = setpiece::scenario::file::to_json(&loaded.scenario).unwrap();
        assert_eq!(setpiece::scenario::file::from_json(&text).unwrap(), *loaded.scenario);
    }
}
