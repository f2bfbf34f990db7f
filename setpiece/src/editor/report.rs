//! What is wrong: the compiler's reports by file.

use super::Edit;
use super::place::FilePlace;
use crate::dsl::ast::Span;
use crate::dsl::problem::{Code, Elsewhere, Problem, Rewrite, Severity};
use crate::dsl::source::Sources;
use std::ops::Range;

/// A problem as an editor shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextReport {
    /// Where it is.
    pub place: FilePlace,
    /// Its stable code.
    pub code: Code,
    /// How bad it is.
    pub severity: Severity,
    /// One clause.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
    /// Further places, and what is to be said about them.
    pub related: Vec<(FilePlace, String)>,
    /// How the help is followed, as far as the compiler knows it.
    pub rewrites: Vec<TextRewrite>,
    /// A statement that the help asks for elsewhere.
    pub elsewhere: Option<Elsewhere>,
}

/// A way to follow a help.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextRewrite {
    /// What is written; empty if something is left out.
    pub says: String,
    /// The changes that it may be, the likeliest first.
    pub places: Vec<Vec<Edit>>,
}

impl TextRewrite {
    fn of(rewrite: Rewrite, sources: &Sources) -> TextRewrite {
        let edit = |(span, text): (Span, String)| {
            Some(Edit { place: FilePlace::of(span, sources)?, text })
        };
        let edits = |place: Vec<(Span, String)>| place.into_iter().map(edit).collect();
        TextRewrite {
            says: rewrite.says,
            places: rewrite.places.into_iter().filter_map(edits).collect(),
        }
    }
}

impl TextReport {
    /// Whether its place and some bytes meet.
    pub(super) fn touches(&self, within: &Range<usize>) -> bool {
        let own = &self.place.range;
        own.start <= within.end && within.start <= own.end
    }

    /// Problems in words, by file and place. One without a place in a file is left out.
    pub(super) fn all(problems: &[Problem], sources: &Sources) -> Vec<TextReport> {
        let mut reports: Vec<TextReport> =
            problems.iter().filter_map(|problem| TextReport::of(problem, sources)).collect();
        reports.sort_by(|one, other| {
            let key = |it: &TextReport| (it.place.range.start, it.code);
            one.place.path.cmp(&other.place.path).then(key(one).cmp(&key(other)))
        });
        reports
    }

    fn of(problem: &Problem, sources: &Sources) -> Option<TextReport> {
        let words = problem.words();
        let rewrites = words.rewrites.into_iter().map(|it| TextRewrite::of(it, sources)).collect();
        let related = words.labels.iter().skip(1);
        Some(TextReport {
            place: FilePlace::of(problem.place(), sources)?,
            code: problem.code(),
            severity: problem.severity(),
            message: words.message,
            help: words.help,
            related: related
                .filter_map(|label| Some((FilePlace::of(label.span, sources)?, label.text.clone())))
                .collect(),
            rewrites,
            elsewhere: words.elsewhere,
        })
    }
}
