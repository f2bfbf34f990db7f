//! Every help of the language's specification that says what to write, and whether it applies
//! itself.

use setpiece::dsl::problem::Severity;
use setpiece::editor::{Action, ActionKind, TextReport, Workspace};
use std::fs;
use std::path::{Path, PathBuf};

/// The files of the cases under `tests/spec`, without their annotations, the root first.
fn cases() -> Vec<(String, Vec<(PathBuf, String)>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/spec");
    let mut cases: Vec<(String, Vec<(PathBuf, String)>)> = Vec::new();
    let mut folders: Vec<PathBuf> =
        fs::read_dir(root).unwrap().map(|it| it.unwrap().path()).collect();
    folders.sort();
    for folder in folders {
        let mut files: Vec<PathBuf> =
            fs::read_dir(folder).unwrap().map(|it| it.unwrap().path()).collect();
        files.sort();
        for file in files.iter().filter(|it| it.extension().is_some_and(|it| it == "pitch")) {
            let text = fs::read_to_string(file).unwrap();
            let mut is_marked = false;
            for line in text.lines() {
                if let Some(header) = line.strip_prefix("--- ") {
                    let name = header.split_whitespace().next().unwrap();
                    let path = Path::new("/nowhere").join(name).join("case.pitch");
                    cases.push((name.to_owned(), vec![(path, String::new())]));
                    continue;
                }
                let Some((name, case)) = cases.last_mut() else { continue };
                if let Some(path) = line.strip_prefix("+++ ") {
                    case.push((Path::new("/nowhere").join(name).join(path.trim()), String::new()));
                    continue;
                }
                let comment = line.strip_prefix("//").map(str::trim_start);
                let is_mark = comment.is_some_and(|it| it.starts_with(['^', '@']));
                let goes_on = |it: &str| it.starts_with("help: ") || it.starts_with("also ");
                if is_mark || (is_marked && comment.is_some_and(goes_on)) {
                    is_marked = true;
                    continue;
                }
                is_marked = false;
                let (_, text) = case.last_mut().unwrap();
                text.push_str(line);
                text.push('\n');
            }
        }
    }
    cases
}

fn workspace(files: &[(PathBuf, String)]) -> Workspace {
    let mut workspace = Workspace::default();
    for (path, text) in files {
        workspace.set(path, text);
    }
    workspace
}

/// The errors of some files: those that hide others, and all.
fn errors(files: &[(PathBuf, String)]) -> (usize, usize) {
    let reports = workspace(files).reports();
    let all = reports.values().flatten();
    let errors: Vec<&TextReport> = all.filter(|it| it.severity == Severity::Error).collect();
    let unread = errors.iter().filter(|it| it.code.to_string().starts_with("SP01")).count();
    (unread, errors.len())
}

fn after(files: &[(PathBuf, String)], fix: &Action) -> Vec<(PathBuf, String)> {
    let mut files = files.to_vec();
    let mut edits = fix.edits.clone();
    edits.sort_by_key(|edit| std::cmp::Reverse(edit.place.range.start));
    for edit in edits {
        let file = files.iter_mut().find(|(path, _)| *path == edit.place.path).unwrap();
        file.1.replace_range(edit.place.range.clone(), &edit.text);
    }
    files
}

#[test]
fn helps_of_the_specification_apply_themselves() {
    let (mut helps, mut mended) = (0, 0);
    for (name, files) in cases() {
        let mut workspace = workspace(&files);
        let before = errors(&files);
        for (path, _) in &files {
            let reports = workspace.reports().get(path).cloned().unwrap_or_default();
            for report in reports {
                let Some(help) = report.help.as_ref().filter(|help| help.contains('`')) else {
                    continue;
                };
                helps += 1;
                let mut fixes = workspace.actions(path, report.place.range.clone());
                fixes.retain(|it| it.kind == ActionKind::Fix && it.code == Some(report.code));
                mended += usize::from(!fixes.is_empty());
                let text = &files.iter().find(|(other, _)| other == path).unwrap().1;
                let marked = &text[report.place.range.clone()];
                let line = text[..report.place.range.start].rsplit('\n').next().unwrap();
                let rest = text[report.place.range.start..].split('\n').next().unwrap();
                let shown = fixes.first().map_or_else(String::new, |fix| {
                    let (_, mended) =
                        after(&files, fix).into_iter().find(|(other, _)| other == path).unwrap();
                    let known: Vec<&str> = text.lines().collect();
                    let new = mended.lines().filter(|line| !known.contains(line));
                    format!("{}: {:?}", fix.title, new.collect::<Vec<_>>())
                });
                println!("{}\t{name}\t{help}\t⟨{marked}⟩\t{line}‸{rest}\t{shown:?}", report.code);
                for fix in &fixes {
                    let (unread, all) = errors(&after(&files, fix));
                    let is_less = if report.code.to_string().starts_with("SP01") {
                        unread < before.0
                    } else {
                        all < before.1 || report.severity == Severity::Warning
                    };
                    assert!(is_less, "{name}: {help}: {fix:?}");
                }
            }
        }
    }
    println!("{mended} of {helps} helps apply themselves");
    assert!(mended >= 805, "{mended} of {helps} helps apply themselves");
}
