//! Helps of reports that apply themselves.
//!
//! A help says what to write. Everything that it may be as an edit is tried on a copy of the texts:
//! what makes the report go away, and nothing else wrong, is offered.

use super::actions::{Action, ActionKind};
use super::edits::Edit;
use super::meant::{meant, one_line};
use super::outline::{Symbol, SymbolKind, of_file};
use super::place::is_scenario;
use super::report::{TextReport, TextRewrite};
use super::text::line_around;
use super::{Analysis, Workspace};
use crate::dsl::ast::{Item, ItemKind};
use crate::dsl::parse::parse;
use crate::dsl::problem::{Code, Severity};
use crate::dsl::source::{FileId, Source};
use crate::files::FileLoader;
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::Path;

/// How many edits are tried for a report.
const TRIES: usize = 12;
/// For how many reports of a selection edits are tried.
const REPORTS: usize = 6;

impl Workspace {
    /// What mends the problems that touch some bytes of a text.
    pub(super) fn fixes(&mut self, path: &Path, within: &Range<usize>) -> Vec<Action> {
        let Some(analysis) = self.analysis(path) else { return Vec::new() };
        let reports = analysis.own_reports(path).filter(|it| it.touches(within)).take(REPORTS);
        let reports: Vec<TextReport> = reports.cloned().collect();
        reports.iter().flat_map(|report| self.fixes_of(path, &analysis, report)).collect()
    }

    pub(super) fn fixes_of(
        &mut self,
        path: &Path,
        analysis: &Analysis,
        report: &TextReport,
    ) -> Vec<Action> {
        let mut tries = self.written(path, report);
        if tries.is_empty() {
            tries = meant(analysis, path, report);
        }
        if report.code == Code::UnknownName {
            tries.extend(self.imports(path, analysis, report));
        }
        tries.dedup_by(|one, other| one.edits == other.edits);
        let code = report.code;
        let mends: Vec<(Try, usize)> = tries
            .into_iter()
            .take(TRIES)
            .filter_map(|it| self.mends(path, report, &it.edits).map(|errors| (it, errors)))
            .collect();
        // Of several places for what is missing, one where the rest makes sense.
        let least = mends.iter().map(|(_, errors)| *errors).min().unwrap_or_default();
        let is_likely = |errors: usize| !is_unread(report) || errors == least;
        let mut titles = BTreeSet::new();
        mends
            .into_iter()
            .filter(|(it, errors)| is_likely(*errors) && titles.insert(it.title.clone()))
            .map(|(it, _)| Action {
                title: it.title,
                kind: ActionKind::Fix,
                edits: it.edits,
                code: Some(code),
                refused: None,
            })
            .collect()
    }

    /// The changes that a report brings: of the places of each the first that mends it.
    fn written(&mut self, path: &Path, report: &TextReport) -> Vec<Try> {
        let text = self.file_text(path).unwrap_or_default();
        let mut found: Vec<Try> = Vec::new();
        for TextRewrite { says, places } in &report.rewrites {
            let fitting = places.iter().take(TRIES).find(|edits| {
                let is_new = found.iter().all(|known| known.edits != **edits);
                is_new && self.mends(path, report, edits).is_some()
            });
            let Some(edits) = fitting else { continue };
            let gone = edits.first().and_then(|edit| text.get(edit.place.range.clone()));
            let title = if says.is_empty() {
                format!("leave out `{}`", one_line(gone.unwrap_or_default()))
            } else {
                format!("write `{}`", one_line(says))
            };
            found.push(Try { title, edits: edits.clone() });
        }
        found
    }

    /// How many errors are left after some edits, if a report is gone and nothing else is wrong.
    fn mends(&mut self, path: &Path, report: &TextReport, edits: &[Edit]) -> Option<usize> {
        let mut after = self.after(edits);
        let (was, is) = (self.analysis(path)?, after.analysis(path)?);
        let alike = |analysis: &Analysis| {
            analysis.reports.iter().filter(|it| it.code == report.code).count()
        };
        let errors = |analysis: &Analysis| analysis.errors();
        let unread = |analysis: &Analysis| {
            let own = analysis.own_reports(path);
            own.filter(|it| is_unread(it)).count()
        };
        if !is_unread(report) {
            // What can't be read hides what is wrong with it.
            let is_readable = unread(&is) <= unread(&was);
            // Of some things the compiler warns only in a text without errors.
            let less = if report.severity == Severity::Error {
                errors(&is) < errors(&was)
            } else {
                is.reports.len() < was.reports.len() && errors(&is) <= errors(&was)
            };
            return (less && is_readable && alike(&is) < alike(&was)).then(|| errors(&is));
        }
        // What could not be read hides what is wrong behind it, but not in its own lines.
        // What is tried is one edit. Where a bracket closes is seen by what makes sense in its
        // line; of anything else, what it brings has to make sense.
        let is_closing = matches!(report.code, Code::UnclosedBracket | Code::UnclosedString);
        let edit = edits.first();
        let line = edit.map(|edit| line_around(&is.text, edit.place.range.start));
        let brought = edit.map(|edit| {
            let from = edit.place.range.start;
            from..from + edit.text.len()
        });
        let is_new = |it: &TextReport| {
            !was.own_reports(path).any(|other| it.code == other.code && it.message == other.message)
        };
        // A file whose name can be read may not be there.
        let may_differ = report.code == Code::UnclosedString;
        let is_here = |it: &TextReport| line.as_ref().is_some_and(|line| it.touches(line));
        let is_brought = |it: &TextReport| {
            if is_closing {
                is_here(it)
            } else {
                brought.as_ref().is_some_and(|own| it.touches(own))
            }
        };
        let spoils = is.own_reports(path).filter(|it| it.severity == Severity::Error).any(|it| {
            (is_unread(it) && (is_new(it) || is_here(it)))
                || (!may_differ && is_new(it) && is_brought(it))
        });
        (unread(&is) < unread(&was) && !spoils).then(|| errors(&is))
    }

    /// Imports of the files that declare an unknown name.
    fn imports(&self, path: &Path, analysis: &Analysis, report: &TextReport) -> Vec<Try> {
        let name = analysis.text.get(report.place.range.clone()).unwrap_or_default();
        let folder = path.parent().and_then(|folder| std::fs::read_dir(folder).ok());
        let files = folder.into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
        let mut files: Vec<_> = files.filter(|it| is_scenario(it) && it != path).collect();
        files.extend(
            self.paths()
                .filter(|it| it.parent() == path.parent() && *it != path)
                .map(Path::to_owned),
        );
        files.sort();
        files.dedup();
        let beside = files.iter().filter_map(|file| {
            Some((file.file_name()?.to_str()?.to_owned(), self.file_text(file)?))
        });
        let of_library = FileLoader::library_texts();
        let at = analysis.import_at();
        beside
            .chain(of_library)
            .filter(|(_, text)| declares(text, name))
            .map(|(file, _)| Try {
                title: format!("import `{file}`, which declares `{name}`"),
                edits: vec![Edit::replace(path, at..at, format!("import \"{file}\"\n"))],
            })
            .collect()
    }
}

/// Changes that a help may mean.
pub(super) struct Try {
    pub(super) title: String,
    pub(super) edits: Vec<Edit>,
}

/// Whether a report is about a text that can't be read.
pub(super) fn is_unread(report: &TextReport) -> bool {
    report.code.to_string().starts_with("SP01")
}

/// Whether a report asks for the unit of a number.
pub(super) fn names_unit(report: &TextReport) -> bool {
    report.help.as_ref().is_some_and(|help| help.contains("the unit"))
}

/// Whether a text declares an item of this name.
fn declares(text: &str, name: &str) -> bool {
    let source = Source { name: String::new(), text: text.into() };
    let tree = parse(&source, FileId(0), &mut Vec::new());
    let is_plan = |symbol: &Symbol| symbol.kind == SymbolKind::Plan;
    of_file(&tree).iter().any(|symbol| symbol.name == name && !is_plan(symbol))
}

impl Analysis {
    /// Where another import stands: behind the last one, or above the first item and its comment.
    fn import_at(&self) -> usize {
        let is_import = |item: &&Item| matches!(item.kind, ItemKind::Import { .. });
        if let Some(last) = self.tree.items.iter().rfind(is_import) {
            return line_around(&self.text, last.span.end as usize).end;
        }
        let Some(first) = self.tree.items.first() else { return 0 };
        let mut at = line_around(&self.text, first.span.start as usize).start;
        while at > 0 {
            let above = line_around(&self.text, at - 1);
            if !self.text.get(above.clone()).is_some_and(|line| line.starts_with("///")) {
                break;
            }
            at = above.start;
        }
        at
    }
}
