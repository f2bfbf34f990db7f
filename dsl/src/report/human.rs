//! Problems as pictures of the source, drawn by miette.

use super::{MAX_SHOWN, count};
use crate::problem::{Label, Problem, Severity};
use crate::source::{FileId, Sources};
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode, ThemeCharacters,
    ThemeStyles,
};
use std::fmt;
use std::sync::Arc;

/// Draws the first problems and counts all.
pub(super) fn render(problems: &[&Problem], sources: &Sources, color: bool, width: usize) -> String {
    let styles = if color { ThemeStyles::ansi() } else { ThemeStyles::none() };
    let theme = GraphicalTheme { characters: ThemeCharacters::unicode(), styles };
    let handler =
        GraphicalReportHandler::new_themed(theme).with_width(width.max(40)).with_context_lines(1).with_links(false);
    let mut text = String::new();
    for problem in problems.iter().take(MAX_SHOWN) {
        let drawn = handler.render_report(&mut text, &Picture::of(problem, sources));
        if drawn.is_err() {
            text.push_str(&problem.message);
        }
        text.push('\n');
    }
    text.push_str(&count(problems));
    text
}

/// A problem as miette wants it: one file, the labels of others as notes.
#[derive(Debug)]
struct Picture {
    code: Option<String>,
    severity: miette::Severity,
    message: String,
    help: Option<String>,
    source: Option<NamedSource<Arc<str>>>,
    labels: Vec<LabeledSpan>,
    notes: Vec<Picture>,
}

impl Picture {
    fn of(problem: &Problem, sources: &Sources) -> Picture {
        let file = problem.labels.first().map(|label| label.span.file);
        let (here, elsewhere): (Vec<&Label>, Vec<&Label>) =
            problem.labels.iter().partition(|label| Some(label.span.file) == file);
        let mark = |(i, label): (usize, &Label)| span(label, i == 0);
        Picture {
            code: Some(problem.code.to_string()),
            severity: match problem.severity() {
                Severity::Error => miette::Severity::Error,
                Severity::Warning => miette::Severity::Warning,
            },
            message: problem.message.clone(),
            help: problem.help.clone(),
            source: file.and_then(|file| source(file, sources)),
            labels: here.into_iter().enumerate().map(mark).collect(),
            notes: elsewhere.into_iter().map(|label| Picture::note(label, sources)).collect(),
        }
    }

    /// A label of another file.
    fn note(label: &Label, sources: &Sources) -> Picture {
        let (message, bare) = (label.text.clone(), Label { span: label.span, text: String::new() });
        Picture {
            code: None,
            severity: miette::Severity::Advice,
            message,
            help: None,
            source: source(label.span.file, sources),
            labels: vec![span(&bare, true)],
            notes: Vec::new(),
        }
    }
}

fn source(file: FileId, sources: &Sources) -> Option<NamedSource<Arc<str>>> {
    sources.get(file).map(|source| NamedSource::new(&source.name, Arc::clone(&source.text)))
}

fn span(label: &Label, primary: bool) -> LabeledSpan {
    let text = (!label.text.is_empty()).then(|| label.text.clone());
    let range = label.span.start as usize..label.span.end as usize;
    if primary { LabeledSpan::new_primary_with_span(text, range) } else { LabeledSpan::new_with_span(text, range) }
}

impl fmt::Display for Picture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Picture {}

impl Diagnostic for Picture {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.code.as_ref().map(|code| Box::new(code) as Box<dyn fmt::Display>)
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(self.severity)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.labels.iter().cloned()))
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        let notes = self.notes.iter().map(|note| note as &dyn Diagnostic);
        (!self.notes.is_empty()).then(|| Box::new(notes) as Box<dyn Iterator<Item = &'a dyn Diagnostic>>)
    }
}
