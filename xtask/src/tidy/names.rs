//! One name, one type: names of types that are defined more than once in the workspace.

use super::{CRATES, read, rust_files};
use crate::shell::root;
use std::collections::BTreeMap;

/// Names that several types may have, and why.
const MAY_BE_SHARED: &[(&str, &str)] = &[
    // What `clap` calls a program's subcommands; no program sees another's.
    ("Command", "the subcommands of a program"),
];

/// Words that a definition begins with, behind its visibility.
const KEYWORDS: &[&str] = &["struct ", "enum ", "trait ", "type ", "union "];

/// Names every type whose name another one has too.
pub(super) fn check(breaches: &mut Vec<String>) -> Result<(), String> {
    let mut found = BTreeMap::new();
    for folder in CRATES {
        for file in rust_files(&root().join(folder)) {
            let path =
                file.strip_prefix(root()).unwrap_or(&file).to_string_lossy().replace('\\', "/");
            if !path.ends_with("/tests.rs") && !path.contains("/tests/") {
                collect(&path, &read(&file)?, &mut found);
            }
        }
    }
    report(&found, breaches);
    Ok(())
}

/// Places of definitions by name: `dsl/src/ast.rs:33`.
type Definitions = BTreeMap<String, Vec<String>>;

/// Adds the types that a file defines; those within a function or a test are its own affair.
fn collect(path: &str, text: &str, found: &mut Definitions) {
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    // A class of Python's is called as the type that it hands over.
    let mut is_class = false;
    for (at, line) in code.lines().enumerate() {
        if line.starts_with("#[pyclass") {
            is_class = true;
        }
        let Some(name) = defined(line) else {
            // Attributes and documentation stand between.
            is_class &= line.starts_with(['#', '/']);
            continue;
        };
        if !std::mem::take(&mut is_class) {
            found.entry(name.to_owned()).or_default().push(format!("{path}:{}", at + 1));
        }
    }
}

/// The name of the type that a line at the outermost level begins to define.
fn defined(line: &str) -> Option<&str> {
    let visible = line.strip_prefix("pub").map(|rest| match rest.strip_prefix('(') {
        Some(scoped) => scoped.split_once(") ").map_or("", |(_, rest)| rest),
        None => rest.trim_start(),
    });
    let item = visible.unwrap_or(line);
    let rest = KEYWORDS.iter().find_map(|keyword| item.strip_prefix(keyword))?;
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
    Some(&rest[..end])
}

fn report(found: &Definitions, breaches: &mut Vec<String>) {
    for (name, places) in found.iter().filter(|(_, places)| places.len() > 1) {
        if !MAY_BE_SHARED.iter().any(|(allowed, _)| allowed == name) {
            breaches.push(format!("`{name}` names {} types: {}", places.len(), places.join(", ")));
        }
    }
    for (name, why) in MAY_BE_SHARED {
        if found.get(*name).is_none_or(|places| places.len() < 2) {
            breaches.push(format!("`{name}` ({why}) is not shared: remove it from MAY_BE_SHARED"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shared_name_is_reported_with_its_places() {
        let mut found = Definitions::new();
        for at in 0..MAY_BE_SHARED.len() * 2 {
            found.entry(MAY_BE_SHARED[at / 2].0.to_owned()).or_default().push(at.to_string());
        }
        collect(
            "a.rs",
            "//! A.\n\npub(crate) struct View<'a> {\n    of: &'a str,\n}\n",
            &mut found,
        );
        collect("b.rs", "enum View {\n    Whole,\n}\npub type Other = u8;\n", &mut found);
        collect(
            "c.rs",
            "fn f() {\n    struct View;\n}\n\n#[cfg(test)]\nmod tests {\n}\nstruct View;\n",
            &mut found,
        );
        let mut breaches = Vec::new();
        report(&found, &mut breaches);
        assert_eq!(breaches, ["`View` names 2 types: a.rs:3, b.rs:1"]);
    }

    #[test]
    fn classes_of_python_are_called_as_what_they_hand_over() {
        let mut found = Definitions::new();
        collect("a.rs", "pub struct Batch;\n", &mut found);
        collect(
            "p.rs",
            "#[pyclass(module = \"m\")]\n/// Matches.\npub(crate) struct Batch {\n}\nstruct Row;\n",
            &mut found,
        );
        assert_eq!(found["Batch"], ["a.rs:1"]);
        assert_eq!(found["Row"], ["p.rs:5"]);
    }
}
