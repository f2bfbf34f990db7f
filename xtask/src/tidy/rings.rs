//! Rings of files: files of a crate that know each other, each by way of others. Few may.
//!
//! A file knows another if it names something of it, in a `use` or by a path. A name that a module
//! passes on (`pub use`) belongs to the file that declares it.

use super::read;
use crate::shell::root;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The most files of a ring.
const RING_MAX: usize = 4;
/// The crates' folders.
const CRATES: &[&str] =
    &["dsl", "engine", "grammar", "lab", "python", "render", "scenario", "setpiece", "xtask"];
/// Deepest chain of names that are passed on.
const PASSED_MAX: usize = 8;

type Module = Vec<String>;

/// The modules of a crate, and what they pass on.
#[derive(Default)]
struct Modules {
    code: BTreeMap<Module, String>,
    passed: BTreeMap<Module, BTreeMap<String, Module>>,
}

/// Reports each ring of too many files.
pub(super) fn check(breaches: &mut Vec<String>) -> Result<(), String> {
    for name in CRATES {
        let source = root().join(name).join("src");
        let mut modules = Modules::default();
        for file in super::rust_files(&source) {
            let path = file.strip_prefix(&source).unwrap_or(&file);
            modules.add(path, &read(&file)?);
        }
        for ring in modules.rings() {
            let files: Vec<String> = ring.iter().map(|module| module.join("/")).collect();
            breaches.push(format!(
                "{name}/src: {} files know each other: {}",
                ring.len(),
                files.join(", ")
            ));
        }
    }
    Ok(())
}

impl Modules {
    fn add(&mut self, path: &Path, text: &str) {
        let mut module: Module = path
            .with_extension("")
            .components()
            .map(|part| part.as_os_str().to_string_lossy().into_owned())
            .collect();
        if module.iter().any(|part| part == "tests" || part == "testing") {
            return;
        }
        if let [only] = module.as_slice()
            && (only == "lib" || only == "main")
        {
            module.clear();
        }
        let code = plain(text);
        let passed = uses(&code).into_iter().filter(|named| named.is_passed_on);
        let passed = passed.map(|named| (named.name, named.path)).collect();
        self.passed.insert(module.clone(), passed);
        self.code.insert(module, code);
    }

    /// The file that a path leads to, seen from a module; none outside of the crate.
    fn resolve(&self, from: &Module, path: &[String], depth: usize) -> Option<Module> {
        let (first, mut rest) = path.split_first()?;
        let mut at = match first.as_str() {
            "crate" => Module::new(),
            "self" => from.clone(),
            "super" => from.split_last()?.1.to_vec(),
            child => {
                let inner = [from.as_slice(), &[child.to_owned()]].concat();
                self.code.contains_key(&inner).then_some(inner)?
            }
        };
        while let Some((next, behind)) = rest.split_first() {
            if next == "super" {
                at.pop();
            } else {
                let inner = [at.as_slice(), std::slice::from_ref(next)].concat();
                if !self.code.contains_key(&inner) {
                    break;
                }
                at = inner;
            }
            rest = behind;
        }
        let passed = rest.first().and_then(|name| self.passed.get(&at)?.get(name));
        if let Some(passed) = passed.filter(|_| depth < PASSED_MAX) {
            let path = [passed.as_slice(), &rest[1..]].concat();
            if let Some(found) = self.resolve(&at, &path, depth + 1) {
                return Some(found);
            }
        }
        Some(at)
    }

    /// The files that each one knows.
    fn arrows(&self) -> BTreeMap<&Module, BTreeSet<Module>> {
        let known = |module: &Module, code: &str| {
            let used = uses(code).into_iter().filter(|named| !named.is_passed_on);
            let paths: Vec<Module> =
                used.map(|named| named.path).chain(paths(&without_uses(code))).collect();
            let found = paths.iter().filter_map(|path| self.resolve(module, path, 0));
            found.filter(|file| file != module && self.code.contains_key(file)).collect()
        };
        self.code.iter().map(|(module, code)| (module, known(module, code))).collect()
    }

    /// The rings of more files than a ring may have.
    fn rings(&self) -> Vec<BTreeSet<Module>> {
        let arrows = self.arrows();
        let reach = |from: &Module| {
            let mut seen = BTreeSet::new();
            let mut stack = vec![from];
            while let Some(next) = stack.pop() {
                for file in arrows.get(next).into_iter().flatten() {
                    if seen.insert(file.clone())
                        && let Some((known, _)) = arrows.get_key_value(file)
                    {
                        stack.push(known);
                    }
                }
            }
            seen
        };
        let reached: BTreeMap<&Module, BTreeSet<Module>> =
            self.code.keys().map(|module| (module, reach(module))).collect();
        let ring = |module: &Module| -> BTreeSet<Module> {
            let back =
                |other: &&Module| reached.get(*other).is_some_and(|all| all.contains(module));
            reached.get(module).into_iter().flatten().filter(back).cloned().collect()
        };
        let rings: BTreeSet<BTreeSet<Module>> = self.code.keys().map(ring).collect();
        rings.into_iter().filter(|ring| ring.len() > RING_MAX).collect()
    }
}

/// Code without comments, without the tests at its end, and without visibilities that name a path.
fn plain(text: &str) -> String {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().map(|line| line.split("//").next().unwrap_or_default());
    let mut code = lines.collect::<Vec<_>>().join("\n");
    while let Some(from) = code.find("pub(in ") {
        let Some(length) = code[from..].find(')') else { break };
        code.replace_range(from..=from + length, "pub(crate)");
    }
    code
}

/// A name that a `use` brings.
struct UsedName {
    path: Module,
    name: String,
    is_passed_on: bool,
}

/// Every name that a file's `use`s bring.
fn uses(code: &str) -> Vec<UsedName> {
    let mut found = Vec::new();
    for (is_passed_on, tree) in statements(code) {
        expand(&[], tree, &mut |path, name| {
            found.push(UsedName { path: path.to_vec(), name: name.to_owned(), is_passed_on });
        });
    }
    found
}

/// The trees of the `use`s, and whether each is passed on.
fn statements(code: &str) -> impl Iterator<Item = (bool, &str)> {
    let starts = code.match_indices("use ").filter(|(at, _)| {
        let line = code[..*at].rsplit('\n').next().unwrap_or_default().trim();
        line.is_empty() || (line.starts_with("pub") && !line.contains(['{', ';']))
    });
    starts.filter_map(|(at, _)| {
        let line = code[..at].rsplit('\n').next().unwrap_or_default();
        let tree = &code[at + "use ".len()..];
        Some((line.contains("pub"), &tree[..tree.find(';')?]))
    })
}

/// Calls `each` with the path and the name of every leaf of a tree.
fn expand(before: &[String], tree: &str, each: &mut dyn FnMut(&[String], &str)) {
    let tree = tree.trim();
    let parts = |text: &str| -> Module {
        let parts = text.split("::").map(str::trim).filter(|part| !part.is_empty());
        parts.map(str::to_owned).collect()
    };
    let Some(open) = tree.find('{') else {
        let (path, name) = tree.split_once(" as ").unwrap_or((tree, ""));
        let mut whole = [before, &parts(path)].concat();
        whole.retain(|part| part != "self" || before.is_empty());
        let last = whole.last().cloned().unwrap_or_default();
        each(&whole, if name.is_empty() { &last } else { name.trim() });
        return;
    };
    let head = [before, &parts(&tree[..open])].concat();
    let inner = tree[open + 1..].trim_end().strip_suffix('}').unwrap_or(&tree[open + 1..]);
    let (mut depth, mut from) = (0, 0);
    for (at, sign) in inner.char_indices().chain([(inner.len(), ',')]) {
        match sign {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let branch = inner[from..at].trim();
                if !branch.is_empty() {
                    expand(&head, branch, each);
                }
                from = at + 1;
            }
            _ => {}
        }
    }
}

/// Code without its `use`s.
fn without_uses(code: &str) -> String {
    statements(code).fold(code.to_owned(), |code, (_, tree)| code.replacen(tree, "", 1))
}

/// Every path in the code itself.
fn paths(code: &str) -> Vec<Module> {
    let within = |sign: char| sign.is_alphanumeric() || sign == '_' || sign == ':';
    let words = code.split(move |sign| !within(sign)).filter(|word| word.contains("::"));
    words
        .filter(|word| !word.starts_with(':'))
        .map(|word| word.split("::").map(str::to_owned).collect())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rings(files: &[(&str, &str)]) -> Vec<usize> {
        let mut modules = Modules::default();
        for (path, text) in files {
            modules.add(Path::new(path), text);
        }
        modules.rings().iter().map(BTreeSet::len).collect()
    }

    #[test]
    fn rings_are_found_through_uses_paths_and_names_that_are_passed_on() {
        let five = [
            ("lib.rs", "mod a;\nmod b;\nmod c;\nmod d;\nmod e;\npub use e::E;\n"),
            ("a.rs", "use crate::b::{B, inner::C as D};\n"),
            ("b.rs", "fn f() { super::c::g() }\n"),
            ("c.rs", "pub(crate) use crate::d::D;\nuse crate::d::D as _;\n"),
            ("d.rs", "use crate::E;\n"),
            ("e.rs", "use super::a;\n"),
        ];
        assert_eq!(rings(&five), [5]);
        let mut four = five;
        four[4].1 = "// use crate::E;\npub(in crate::e) struct D;\n#[cfg(test)]\nuse crate::E;\n";
        assert!(rings(&four).is_empty());
    }
}
