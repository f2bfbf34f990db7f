//! What a release needs: one version everywhere, its section of the changelog, its address.

use crate::shell::root;
use clap::Args;
use std::path::PathBuf;

/// The version of the workspace.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");
/// The address of the repository, of which packages and archives are made.
const REPOSITORY: &str = env!("CARGO_PKG_REPOSITORY");

/// Places that repeat the version: a file, and what stands before the version in it.
///
/// Cargo has it for the members of the workspace, and Python's package takes it from there.
const PLACES: &[(&str, &str)] = &[
    ("Cargo.toml", "\nversion = \""),
    ("Cargo.toml", "path = \"grammar\", version = \""),
    ("Cargo.toml", "path = \"scenario\", version = \""),
    ("Cargo.toml", "path = \"dsl\", version = \""),
    ("Cargo.toml", "path = \"engine\", version = \""),
    ("Cargo.toml", "path = \"render\", version = \""),
    ("Cargo.toml", "path = \"setpiece\", version = \""),
    ("fuzz/Cargo.toml", "\nversion = \""),
    ("grammar/tree-sitter/tree-sitter.json", "\"version\": \""),
    ("CITATION.cff", "\nversion: \""),
    ("editors/vscode/package.json", "\n  \"version\": \""),
    ("editors/zed/Cargo.toml", "\nversion = \""),
    ("editors/zed/extension.toml", "\nversion = \""),
];

/// What is checked or written for a release.
#[derive(Debug, Args)]
pub(crate) struct ReleaseArgs {
    /// The tag that is released: it names the version, and the changelog has the date
    #[arg(long)]
    tag: Option<String>,
    /// The address of the repository that releases; packages must name the same
    #[arg(long)]
    repository: Option<String>,
    /// Write the version's section of the changelog into a file
    #[arg(long, value_name = "FILE")]
    notes: Option<PathBuf>,
}

/// Checks that everything names the same version, and what the options ask for.
pub(crate) fn release(args: &ReleaseArgs) -> Result<(), String> {
    let mut breaches = Vec::new();
    versions(&mut breaches);
    let changelog = read("CHANGELOG.md")?;
    if let Some(tag) = &args.tag {
        check_tag(tag, &changelog, &mut breaches);
    }
    if let Some(address) = &args.repository
        && address != REPOSITORY
    {
        breaches.push(format!(
            "this is {address}, but Cargo.toml sends everyone who installs to {REPOSITORY}"
        ));
    }
    if !breaches.is_empty() {
        return Err(breaches.join("\n  "));
    }
    if let Some(path) = &args.notes {
        let (_, text) = section(&changelog, VERSION).ok_or("the changelog lacks the version")?;
        let path = root().join(path);
        let folder = path.parent().unwrap_or(&path);
        std::fs::create_dir_all(folder)
            .and_then(|()| std::fs::write(&path, text))
            .map_err(|why| format!("{}: {why}", path.display()))?;
    }
    println!("release: {VERSION} everywhere");
    Ok(())
}

/// Reports each place that names another version than the workspace.
pub(crate) fn versions(breaches: &mut Vec<String>) {
    for (file, before) in PLACES {
        match read(file) {
            Ok(text) => match value_after(&text, before) {
                Some(VERSION) => {}
                Some(other) => breaches.push(format!("{file}: version {other}, not {VERSION}")),
                None => breaches.push(format!("{file}: no version after `{}`", before.trim())),
            },
            Err(why) => breaches.push(why),
        }
    }
    match read("CHANGELOG.md") {
        Ok(text) if section(&text, VERSION).is_some() => {}
        Ok(_) => breaches.push(format!("CHANGELOG.md: no section `## {VERSION} - DATE`")),
        Err(why) => breaches.push(why),
    }
}

fn check_tag(tag: &str, changelog: &str, breaches: &mut Vec<String>) {
    if tag.strip_prefix('v') != Some(VERSION) {
        breaches.push(format!("the tag is {tag}, the version {VERSION}"));
    }
    let date = section(changelog, VERSION).map_or("", |(date, _)| date);
    if !is_date(date) {
        breaches.push(format!("CHANGELOG.md: `## {VERSION} - {date}` has no date"));
    }
}

/// What the heading of a version says beside it, and the text below the heading.
fn section<'a>(changelog: &'a str, version: &str) -> Option<(&'a str, &'a str)> {
    let heading = ["\n## ", version, " - "].concat();
    let (_, rest) = changelog.split_once(&heading)?;
    let (date, text) = rest.split_once('\n')?;
    Some((date.trim(), text.split("\n## ").next().unwrap_or_default().trim()))
}

fn value_after<'a>(text: &'a str, before: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(before)?;
    rest.split('"').next()
}

/// Whether a text is a day such as `2026-11-27`.
fn is_date(text: &str) -> bool {
    text.len() == 10
        && text.char_indices().all(|(at, letter)| match at {
            4 | 7 => letter == '-',
            _ => letter.is_ascii_digit(),
        })
}

fn read(file: &str) -> Result<String, String> {
    // A checkout on Windows may have its line ends.
    std::fs::read_to_string(root().join(file))
        .map(|text| text.replace("\r\n", "\n"))
        .map_err(|why| format!("{file}: {why}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHANGELOG: &str = "# Changelog

## 9.1.0 - 2026-01-02

### Added

- A.

## 9.0.0 - unreleased

- B.
";

    #[test]
    fn a_section_ends_at_the_next_version() {
        assert_eq!(section(CHANGELOG, "9.1.0"), Some(("2026-01-02", "### Added\n\n- A.")));
        assert_eq!(section(CHANGELOG, "9.0.0"), Some(("unreleased", "- B.")));
        assert_eq!(section(CHANGELOG, "9.0"), None);
    }

    #[test]
    fn a_tag_of_another_version_or_without_a_date_is_refused() {
        let dated = format!("\n## {VERSION} - 2026-11-27\n\n- A.\n");
        let open = format!("\n## {VERSION} - unreleased\n\n- A.\n");
        for (tag, changelog, problems) in [
            (format!("v{VERSION}"), &dated, 0),
            (VERSION.to_owned(), &dated, 1),
            ("v0.0.1".to_owned(), &dated, 1),
            (format!("v{VERSION}"), &open, 1),
        ] {
            let mut breaches = Vec::new();
            check_tag(&tag, changelog, &mut breaches);
            assert_eq!(breaches.len(), problems, "{tag}: {breaches:?}");
        }
    }

    #[test]
    fn another_repository_is_refused() {
        let args = |repository: &str| ReleaseArgs {
            tag: None,
            repository: Some(repository.to_owned()),
            notes: None,
        };
        assert!(release(&args("https://example.org/other")).is_err());
        release(&args(REPOSITORY)).unwrap();
    }
}
