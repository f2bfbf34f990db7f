//! Helps of reports that apply themselves.
//!
//! A help says what to write. Everything that it may mean as an edit is tried on a copy of the
//! texts: what makes the report go away, and nothing else wrong, is offered.

use super::actions::{Action, ActionKind};
use super::closing::closings;
use super::edits::Edit;
use super::outline::{Symbol, SymbolKind, of_file};
use super::place::is_scenario;
use super::report::TextReport;
use super::text::{brackets, line_around};
use super::{Analysis, Workspace};
use crate::dsl::ast::{Item, ItemKind};
use crate::dsl::parse::parse;
use crate::dsl::problem::{Code, Severity};
use crate::dsl::source::{FileId, Source};
use crate::files::FileLoader;
use crate::grf::scripts;
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::Path;

/// How many edits are tried for a report.
const TRIES: usize = 12;
/// For how many reports of a selection edits are tried.
const REPORTS: usize = 6;
/// How often the fixes of a text are applied one after the other: each may uncover another report.
const ROUNDS: usize = 50;

impl Workspace {
    /// What mends the problems that touch some bytes of a text.
    pub(super) fn fixes(&mut self, path: &Path, within: &Range<usize>) -> Vec<Action> {
        let Some(analysis) = self.analysis(path) else { return Vec::new() };
        let reports = analysis.own_reports(path).filter(|it| it.touches(within)).take(REPORTS);
        let reports: Vec<TextReport> = reports.cloned().collect();
        reports.iter().flat_map(|report| self.fixes_of(path, &analysis, report)).collect()
    }

    /// What mends everything in a text whose report says how; none if nothing does.
    pub fn fix_all(&self, path: &Path) -> Option<Action> {
        let before = self.file_text(path)?;
        let mut after = self.clone();
        let mut from = 0;
        for _ in 0..ROUNDS {
            let Some(analysis) = after.analysis(path) else { break };
            // A script of another engine is translated as a whole or not at all.
            let scripts = scripts(&analysis.text);
            let is_in_script = |at: usize| scripts.iter().any(|script| script.contains(&at));
            let next = analysis
                .own_reports(path)
                .filter(|report| report.place.range.start >= from)
                .filter(|report| !is_in_script(report.place.range.start))
                .find_map(|report| {
                    let fixes = after.clone().fixes_of(path, &analysis, report);
                    // Which of several units or forms is meant only the author knows.
                    let has_forms = report.help.as_ref().is_some_and(|it| it.contains(", or "));
                    let is_open = has_forms || (names_unit(report) && fixes.len() > 1);
                    let fix = fixes.into_iter().next().filter(|_| !is_open);
                    Some((report.place.range.start, fix?))
                });
            let Some((at, fix)) = next else { break };
            from = at;
            after = after.after(&fix.edits);
        }
        let text = after.text(path).filter(|text| ***text != *before)?;
        Some(Action {
            title: "apply every help that says what to write".to_owned(),
            kind: ActionKind::FixAll,
            edits: vec![Edit::replace(path, 0..before.len(), &**text)],
            code: None,
        })
    }

    fn fixes_of(&mut self, path: &Path, analysis: &Analysis, report: &TextReport) -> Vec<Action> {
        let mut tries = meant(analysis, path, report);
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
            })
            .collect()
    }

    /// How many errors are left after some edits, if a report is gone and nothing else is wrong.
    fn mends(&mut self, path: &Path, report: &TextReport, edits: &[Edit]) -> Option<usize> {
        let mut after = self.after(edits);
        let (was, is) = (self.analysis(path)?, after.analysis(path)?);
        let alike = |analysis: &Analysis| {
            analysis.reports.iter().filter(|it| it.code == report.code).count()
        };
        let errors = |analysis: &Analysis| analysis.errors();
        if !is_unread(report) {
            // Of some things the compiler warns only in a text without errors.
            let less = if report.severity == Severity::Error {
                errors(&is) < errors(&was)
            } else {
                is.reports.len() < was.reports.len() && errors(&is) <= errors(&was)
            };
            return (less && alike(&is) < alike(&was)).then(|| errors(&is));
        }
        // What could not be read hides what is wrong behind it, but not in its own lines.
        let unread = |analysis: &Analysis| {
            let own = analysis.own_reports(path);
            own.filter(|it| is_unread(it)).count()
        };
        // What is tried is one edit.
        let line = edits.first().map(|edit| line_around(&is.text, edit.place.range.start));
        let is_new = |it: &TextReport| {
            !was.own_reports(path).any(|other| it.code == other.code && it.message == other.message)
        };
        // A file whose name can be read may not be there.
        let may_differ = report.code == Code::UnclosedString;
        let is_here = |it: &TextReport| line.as_ref().is_some_and(|line| it.touches(line));
        let spoils = is.own_reports(path).filter(|it| it.severity == Severity::Error).any(|it| {
            (is_unread(it) && (is_new(it) || is_here(it)))
                || (!may_differ && is_new(it) && is_here(it))
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

/// An edit that a help may mean.
struct Try {
    title: String,
    edits: Vec<Edit>,
}

/// The edits of one text that a report's help may mean, the likeliest first.
fn meant(analysis: &Analysis, path: &Path, report: &TextReport) -> Vec<Try> {
    let Some(help) = &report.help else { return Vec::new() };
    let range = report.place.range.clone();
    let marked = analysis.text.get(range.clone()).unwrap_or_default();
    let write = |range: Range<usize>, text: String| Try {
        title: format!("write `{text}`"),
        edits: vec![Edit::replace(path, range, text)],
    };
    let mut tries = Vec::new();
    let line = line_around(&analysis.text, range.start);
    let whole_line = analysis.text.get(line).unwrap_or_default().to_owned();
    // An example isn't what the author meant; of one with a unit, the unit is.
    let is_example = help.contains("for example") || names_unit(report);
    // What could be written is no answer to what should be.
    let lists = help.contains("use one of") || help.starts_with("it has");
    if lists {
        return Vec::new();
    }
    if matches!(report.code, Code::UnclosedBracket | Code::UnclosedString) {
        let places = closings(&analysis.text, range.start);
        let closed = places.into_iter().map(|(at, sign)| Try {
            title: format!("close it with `{}`", one_line(&sign)),
            edits: vec![Edit::replace(path, at..at, sign)],
        });
        tries.extend(closed);
        // One that closes another kind of bracket opens nothing: it is replaced.
        if !tries.is_empty() {
            return tries;
        }
    }
    let before = analysis.text.get(..range.start).unwrap_or_default();
    for text in quoted(help) {
        let Some(text) = behind(before, text) else { continue };
        let unit = text.trim_start_matches(|sign: char| sign.is_ascii_digit() || sign == '.');
        let has_unit =
            unit.len() < text.len() && unit.trim_start().starts_with(char::is_alphabetic);
        if text.starts_with("/ ") {
            tries.push(write(range.clone(), format!("{marked} {text}")));
        } else if has_unit && is_number(marked) {
            tries.push(write(range.clone(), format!("{marked}{unit}")));
        } else if !has_unit && !is_example && !invents(text, marked, &whole_line) {
            tries.push(write(range.clone(), text.to_owned()));
            // A line of another language is replaced as a whole.
            let line = line_around(&analysis.text, range.start);
            let written = analysis.text.get(line.clone()).unwrap_or_default();
            let begin = line.start + written.len() - written.trim_start().len();
            if begin == range.start {
                tries.push(write(begin..line.start + written.trim_end().len(), text.to_owned()));
            }
            // What is written in brackets may stand for the brackets around.
            let around = brackets(&analysis.text)
                .into_iter()
                .rev()
                .find(|pair| pair.open <= range.start && range.end <= pair.close);
            if let Some(pair) = around.filter(|_| text.starts_with(['(', '[', '{'])) {
                tries.push(write(pair.open..pair.close, text.to_owned()));
            }
            if let [sign] = text.as_bytes()
                && sign.is_ascii_punctuation()
            {
                tries.push(write(range.start..range.start, text.to_owned()));
                tries.push(write(range.end..range.end, text.to_owned()));
            }
        }
    }
    if help.contains("leave it out") || help.contains("leave one") {
        let line = line_around(&analysis.text, range.start);
        let leave = |range: Range<usize>, what: &str| Try {
            title: format!("leave out {what}"),
            edits: vec![Edit::replace(path, range, "")],
        };
        tries.push(leave(range.clone(), &format!("`{}`", one_line(marked))));
        tries.push(leave(line, "the line"));
    }
    if let [only] = tries.as_mut_slice()
        && !is_example
        && !help.starts_with("did you mean")
    {
        only.title.clone_from(help);
    }
    tries
}

/// Whether a report is about a text that can't be read.
fn is_unread(report: &TextReport) -> bool {
    report.code.to_string().starts_with("SP01")
}

/// Whether a report asks for the unit of a number.
fn names_unit(report: &TextReport) -> bool {
    report.help.as_ref().is_some_and(|help| help.contains("the unit"))
}

/// A text in a line of a title.
fn one_line(text: &str) -> String {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if words.chars().count() > 40 { words.chars().take(39).chain(['…']).collect() } else { words }
}

/// What stands between backticks and can be written as it is.
fn quoted(help: &str) -> impl Iterator<Item = &str> {
    let parts = help.split('`').skip(1).step_by(2);
    parts
        .map(|part| part.trim_end_matches(" …"))
        .filter(|part| !part.contains('…') && !part.is_empty())
}

/// What a help says to write behind what stands before the place already: of `give 1 when`, it is
/// `when` behind `give -1`. None if the author has written another beginning of it.
fn behind<'t>(before: &str, text: &'t str) -> Option<&'t str> {
    let line = before.rsplit('\n').next().unwrap_or_default();
    let written: Vec<&str> = line.split_whitespace().collect();
    let is_alike =
        |(one, other): (&&str, &str)| *one == other || (is_number(one) && is_number(other));
    let words = || text.split_whitespace();
    let starts = |count: usize| {
        written.len() >= count && written[written.len() - count..].iter().zip(words()).all(is_alike)
    };
    let count = words().count();
    let Some(known) = (1..count).rev().find(|count| starts(*count)) else {
        let first = words().next().unwrap_or_default();
        let is_word = first.len() > 1 && first.chars().all(char::is_alphabetic);
        let stands = count > 1 && is_word && statement_of(line).contains(&first);
        return (!stands).then_some(text);
    };
    let mut rest = text;
    for _ in 0..known {
        rest = rest.trim_start().split_once(char::is_whitespace)?.1;
    }
    Some(rest.trim_start())
}

/// The words of the statement under way at the end of a line.
fn statement_of(line: &str) -> Vec<&str> {
    line.rsplit(['{', '}']).next().unwrap_or_default().split_whitespace().collect()
}

/// Whether a help has numbers of its own where the author wrote others.
fn invents(text: &str, marked: &str, line: &str) -> bool {
    let numbers = |text: &str| -> Vec<String> {
        let parts = text.split(|sign: char| !(sign.is_alphanumeric() || matches!(sign, '.' | '_')));
        let begins = |part: &&str| part.starts_with(|sign: char| sign.is_ascii_digit());
        parts
            .filter(begins)
            .map(|part| part.trim_end_matches(char::is_alphabetic).to_owned())
            .collect()
    };
    let written = numbers(line);
    let is_new = !is_number(marked) || text.contains(['(', '[', '{']);
    is_new && !written.is_empty() && numbers(text).iter().any(|number| !written.contains(number))
}

fn is_number(text: &str) -> bool {
    text.parse::<f64>().is_ok()
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
