//! `docs/reference/` and `docs/errors.md` are what the tables of the language, the registry of
//! codes and the declarations of the command say. `SETPIECE_BLESS=1` writes them.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "reference/words.rs"]
mod words;

use setpiece::dsl::problem::{Code, Severity, Stage};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use words::{Group, PAGES};

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs")
}

/// Compares a page with what it should be, or writes it.
fn hold(page: &str, wanted: &str) {
    let path = docs().join(page);
    if std::env::var_os("SETPIECE_BLESS").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, wanted).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(found == wanted, "docs/{page} says something else: SETPIECE_BLESS=1 writes it");
}

/// Prose in lines of at most 100 columns.
fn wrapped(text: &str) -> String {
    let (mut lines, mut line) = (String::new(), String::new());
    for word in text.split_whitespace() {
        if line.chars().count() + word.chars().count() >= 100 {
            let _ = writeln!(lines, "{line}");
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    lines.push_str(&line);
    lines
}

/// A table of words, each with an anchor.
fn table(text: &mut String, group: &Group) {
    let _ = write!(text, "\n## {}\n\n", group.title);
    let see: Vec<String> =
        group.pages.iter().map(|(title, page)| format!("[{title}](../{page})")).collect();
    let about = format!("{} Explained in {}.", group.about, see.join(" and "));
    let _ = write!(text, "{}\n\n", wrapped(&about));
    let _ = writeln!(text, "| {} |\n|{}", group.head.join(" | "), "---|".repeat(group.head.len()));
    for (word, cells) in &group.rows {
        let anchor = group.anchor(word);
        let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
        let _ = writeln!(text, "| <a id=\"{anchor}\"></a>`{word}` | {} |", cells.join(" | "));
    }
}

#[test]
fn the_pages_of_words_list_every_word() {
    let mut index: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut anchors = BTreeSet::new();
    let mut list = String::new();
    for page in PAGES {
        let groups = (page.groups)();
        let mut text = format!("# {}\n\n{}\n", page.title, page.about);
        for group in &groups {
            table(&mut text, group);
            for (word, _) in &group.rows {
                let anchor = group.anchor(word);
                let link = format!("[{}]({}#{anchor})", group.kind, page.file);
                assert!(anchors.insert(anchor), "`{word}` stands twice in {}", group.title);
                index.entry((*word).to_owned()).or_default().push(link);
            }
        }
        hold(&format!("reference/{}", page.file), &text);
        let titles: Vec<&str> = groups.iter().map(|group| group.kind).collect();
        let kinds = titles.join(", ");
        let _ = writeln!(list, "| [{}]({}) | {kinds} |", page.title, page.file);
    }
    assert!(anchors.len() > 250, "{}", anchors.len());
    let mut text = format!(
        "# Every word\n\nThe words of the language, from the tables that the compiler checks against. \
         [The pages of\nthe language](../language/README.md) explain them; \
         [the command](command.md) and [the codes of\nreports](../errors.md) have pages of their \
         own.\n\n| page | words for |\n|---|---|\n{list}\n## From A to Z\n\n| word | is |\n|---|---|\n"
    );
    let mut words: Vec<(String, Vec<String>)> = index.into_iter().collect();
    words.sort_by_key(|(word, _)| word.to_lowercase());
    for (word, links) in words {
        let _ = writeln!(text, "| `{word}` | {} |", links.join(", "));
    }
    hold("reference/README.md", &text);
}

#[test]
fn the_page_of_the_command_is_its_help() {
    let text = format!(
        "# The command\n\nEvery command of `setpiece` with its options, as `setpiece COMMAND --help` \
         lists them. [Using the\ncommand](../language/command.md) says what the most frequent ones \
         are for.\n\n{}",
        setpiece::cli::reference()
    );
    hold("reference/command.md", &text);
}

#[test]
fn the_page_of_codes_lists_every_code() {
    let mut text = String::from(
        "# The codes of reports\n\nEvery report has a stable code, and every code has a page: what \
         it means, a text that causes it,\nand the corrected text. `setpiece explain SP0203` prints \
         the page.\n",
    );
    let mut stage = None;
    for code in Code::ALL {
        if stage != Some(code.stage()) {
            stage = Some(code.stage());
            let title = match code.stage() {
                Stage::Load => "SP00: files, and what a command or a call names",
                Stage::Syntax => "SP01: syntax",
                Stage::Names => "SP02: names",
                Stage::Types => "SP03: types and units",
                Stage::Football => "SP04: football",
                Stage::Scripts => "SP05: scripts",
                Stage::DryRun => "SP06: what sampled starts show",
                Stage::Episode => "SP07: while episodes run",
            };
            let _ = write!(text, "\n## {title}\n\n| code | | |\n|---|---|---|\n");
        }
        let severity = if code.severity() == Severity::Error { "error" } else { "warning" };
        let _ = writeln!(text, "| [{code}](errors/{code}.md) | {severity} | {} |", code.title());
    }
    hold("errors.md", &text);
}

/// The pages that words point to exist, and have the section.
#[test]
fn every_word_points_to_a_section_of_the_language() {
    for page in PAGES {
        for group in (page.groups)() {
            for (_, target) in group.pages {
                let (file, section) = target.split_once('#').unwrap_or((target, ""));
                let text = std::fs::read_to_string(docs().join(file)).unwrap();
                let has = |line: &str| {
                    let title = line.trim_start_matches('#');
                    line.starts_with('#') && words::slug(title) == section
                };
                assert!(section.is_empty() || text.lines().any(has), "{target}");
            }
        }
    }
}
