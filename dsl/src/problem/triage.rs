//! Chooses which of the problems that were found are reported: one mistake, one report.
//!
//! Each step drops problems that may only be the echo of another one. No step changes a report.

use super::{Code, Problem, Stage, has_errors};
use crate::source::{FileId, Sources, Span};
use std::collections::{BTreeMap, BTreeSet};

/// The problems to report, by file, place and code.
///
/// - `lost`: names whose declarations could not be read.
pub(crate) fn triage(
    problems: Vec<Problem>,
    sources: &Sources,
    lost: &BTreeSet<&str>,
) -> Vec<Problem> {
    let mut problems = one_of_each(problems);
    drop_lost_names(&mut problems, sources, lost);
    if problems.iter().any(|problem| problem.code().leaves_gap()) {
        problems.retain(|problem| !problem.code().may_be_echo());
    }
    drop_library(&mut problems, sources);
    // What a file without a scenario says wrong is mended before a scenario is missed.
    if problems.iter().any(|problem| problem.is_error() && !problem.misses_scenario()) {
        problems.retain(|problem| !problem.misses_scenario());
    }
    if has_errors(&problems) {
        drop_likely_used(&mut problems, sources);
        // What never pays or ends may do so once the errors are mended.
        problems.retain(|problem| !matches!(problem.code(), Code::NeverPays | Code::NeverEnds));
    }
    drop_hidden(&mut problems);
    drop_uses_of_reserved(&mut problems, sources);
    drop_around_unread(&mut problems);
    problems
}

/// Problems in order, and one of those that a reader can't tell apart: they differ in help or
/// further labels alone.
fn one_of_each(problems: Vec<Problem>) -> Vec<Problem> {
    let headline = |problem: Problem| {
        let (said, span) = (problem.fact().words(), problem.place());
        ((span.file, span.start, span.end, problem.code(), said.message, said.label), problem)
    };
    let mut headed: Vec<_> = problems.into_iter().map(headline).collect();
    headed.sort_by(|(a, _), (b, _)| a.cmp(b));
    headed.dedup_by(|(a, _), (b, _)| a == b);
    headed.into_iter().map(|(_, problem)| problem).collect()
}

/// A name whose declaration can't be read is reported at the declaration.
fn drop_lost_names(problems: &mut Vec<Problem>, sources: &Sources, lost: &BTreeSet<&str>) {
    problems.retain(|problem| {
        !matches!(problem.code(), Code::UnknownName | Code::UnknownFunction | Code::UnknownParent)
            || !lost.contains(sources.text(problem.place()))
    });
}

/// A word of the language that was declared as a name is reported at the declaration, not where it
/// is used for what it can't be.
fn drop_uses_of_reserved(problems: &mut Vec<Problem>, sources: &Sources) {
    let is_reserved = |problem: &Problem| problem.code() == Code::ReservedName;
    let declared = problems.iter().filter(|problem| is_reserved(problem));
    let reserved: BTreeSet<String> =
        declared.map(|problem| sources.text(problem.place()).to_owned()).collect();
    problems.retain(|problem| {
        let words = problem.words();
        let uses = |name: &String| {
            let mut labels = words.labels.iter();
            labels.any(|label| sources.text(label.span) == name)
                || words.message.contains(&format!("`{name}`"))
        };
        is_reserved(problem) || !reserved.iter().any(uses)
    });
}

/// The library is sound: what breaks in it follows from what the author wrote.
fn drop_library(problems: &mut Vec<Problem>, sources: &Sources) {
    let is_library = |problem: &Problem| {
        sources.get(problem.place().file).is_some_and(|file| file.name.starts_with("std/"))
    };
    if problems.iter().any(|problem| problem.is_error() && !is_library(problem)) {
        problems.retain(|problem| !is_library(problem));
    }
}

/// Beside errors, what is named a second time is taken as used, as is what an error says was meant:
/// the part that uses it may be the one that is wrong.
fn drop_likely_used(problems: &mut Vec<Problem>, sources: &Sources) {
    let words = |text: &str| -> BTreeMap<String, u32> {
        let mut times = BTreeMap::new();
        for word in text.split(|c: char| !(c.is_alphanumeric() || c == '_')) {
            match times.get_mut(word) {
                Some(times) => *times += 1,
                None => drop(times.insert(word.to_owned(), 1)),
            }
        }
        times
    };
    let meant: BTreeSet<String> = problems.iter().flat_map(Problem::suggested).collect();
    let mut of_files: BTreeMap<FileId, BTreeMap<String, u32>> = BTreeMap::new();
    problems.retain(|problem| {
        if problem.code() != Code::UnusedName {
            return true;
        }
        let span = problem.place();
        let name = sources.text(span);
        let text = || sources.get(span.file).map_or("", |file| &*file.text);
        let of_file = of_files.entry(span.file).or_insert_with(|| words(text()));
        of_file.get(name).is_none_or(|times| *times < 2) && !meant.contains(name)
    });
}

/// What another name hides is not used for this reason.
fn drop_hidden(problems: &mut Vec<Problem>) {
    let hiding = problems.iter().filter(|problem| problem.code() == Code::HidingName);
    let hidden: BTreeSet<Span> = hiding
        .flat_map(|problem| problem.words().labels.into_iter().skip(1))
        .map(|label| label.span)
        .collect();
    problems
        .retain(|problem| problem.code() != Code::UnusedName || !hidden.contains(&problem.place()));
}

/// What holds a part that could not be read is not what the author wrote.
fn drop_around_unread(problems: &mut Vec<Problem>) {
    let is_syntax = |problem: &Problem| problem.code().stage() == Stage::Syntax;
    let unread: Vec<Span> =
        problems.iter().filter(|problem| is_syntax(problem)).map(Problem::place).collect();
    problems.retain(|problem| {
        let is_around = |span: Span| unread.iter().any(|part| span.holds(*part) && span != *part);
        is_syntax(problem) || !is_around(problem.place())
    });
}
