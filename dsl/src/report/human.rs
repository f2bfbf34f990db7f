//! Problems as pictures of the source, drawn by miette.

use super::{MAX_SHOWN, count, is_control, printable};
use crate::problem::{Label, Problem, Severity};
use crate::source::{FileId, Sources};
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError,
    MietteSpanContents, SourceCode, SourceSpan, SpanContents, ThemeCharacters, ThemeStyles,
};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// Longest line that is shown whole, bytes; of a longer one what is near the mark.
const LINE_MAX: usize = 240;
/// What is shown of a long line on either side of the mark's beginning, bytes.
const AROUND: usize = 60;

/// Draws the first problems and counts all.
pub(super) fn render(
    problems: &[&Problem],
    sources: &Sources,
    color: bool,
    width: usize,
) -> String {
    let styles = if color { ThemeStyles::ansi() } else { ThemeStyles::none() };
    let theme = GraphicalTheme { characters: ThemeCharacters::unicode(), styles };
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(width.max(40))
        .with_context_lines(1)
        .with_links(false);
    let mut text = String::new();
    for problem in problems.iter().take(MAX_SHOWN) {
        let drawn = handler.render_report(&mut text, &Picture::of(problem, sources));
        if drawn.is_err() {
            text.push_str(&printable(&problem.words().message, false));
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
    source: Option<ShownSource>,
    labels: Vec<LabeledSpan>,
    notes: Vec<Picture>,
}

impl Picture {
    fn of(problem: &Problem, sources: &Sources) -> Picture {
        let (words, place) = (problem.words(), problem.place());
        let source = ShownSource::of(place.file, sources);
        // Only labels that fit into one drawing share it.
        let primary_is_long =
            source.as_ref().is_some_and(|source| source.is_long_at(place.start as usize));
        let mut here = Vec::new();
        let mut elsewhere = Vec::new();
        for (i, label) in words.labels.iter().enumerate() {
            let long =
                source.as_ref().is_some_and(|source| source.is_long_at(label.span.start as usize));
            let apart = i > 0 && (label.span.file != place.file || primary_is_long || long);
            if apart {
                elsewhere.push(Picture::note(label, sources));
            } else {
                here.push(span(label, source.as_ref(), i == 0));
            }
        }
        Picture {
            code: Some(problem.code().to_string()),
            severity: match problem.severity() {
                Severity::Error => miette::Severity::Error,
                Severity::Warning => miette::Severity::Warning,
            },
            message: printable(&words.message, false).into_owned(),
            help: words.help.as_deref().map(|help| printable(help, false).into_owned()),
            source,
            labels: here,
            notes: elsewhere,
        }
    }

    /// A label that has a drawing of its own.
    fn note(label: &Label, sources: &Sources) -> Picture {
        let (message, bare) = (
            printable(&label.text, false).into_owned(),
            Label { span: label.span, text: String::new() },
        );
        let source = ShownSource::of(label.span.file, sources);
        let labels = vec![span(&bare, source.as_ref(), true)];
        Picture {
            code: None,
            severity: miette::Severity::Advice,
            message,
            help: None,
            source,
            labels,
            notes: Vec::new(),
        }
    }
}

/// A source without characters that steer a terminal: each becomes one as long, so that every
/// offset holds.
fn steady(text: &Arc<str>) -> Arc<str> {
    let steers = |(at, char): (usize, char)| {
        let ends_line =
            char == '\r' && text.get(at + 1..).is_some_and(|rest| rest.starts_with('\n'));
        is_control(char) && !ends_line
    };
    if !text.char_indices().any(steers) {
        return Arc::clone(text);
    }
    let shown = text.char_indices().map(|(at, char)| match char.len_utf8() {
        _ if !steers((at, char)) => char,
        1 => '?',
        2 => '\u{B7}',
        _ => '\u{FFFD}',
    });
    shown.collect::<String>().into()
}

/// A file as reports show it: whole lines, but of a very long one only what is near the mark.
#[derive(Debug)]
struct ShownSource {
    name: String,
    text: Arc<str>,
}

impl ShownSource {
    fn of(file: FileId, sources: &Sources) -> Option<ShownSource> {
        sources.get(file).map(|source| ShownSource {
            name: printable(&source.name, false).into(),
            text: steady(&source.text),
        })
    }

    /// The line around an offset, without its end.
    fn line(&self, at: usize) -> Range<usize> {
        let at = self.boundary(at);
        let start = self.text.get(..at).and_then(|text| text.rfind('\n')).map_or(0, |at| at + 1);
        let end = self
            .text
            .get(at..)
            .and_then(|text| text.find('\n'))
            .map_or(self.text.len(), |length| at + length);
        start..end
    }

    fn is_long_at(&self, at: usize) -> bool {
        self.line(at).len() > LINE_MAX
    }

    /// The character boundary at or before an offset.
    fn boundary(&self, at: usize) -> usize {
        let mut at = at.min(self.text.len());
        while !self.text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }

    /// The part of a mark that is drawn.
    fn mark(&self, range: Range<usize>) -> Range<usize> {
        if !self.is_long_at(range.start) {
            return range;
        }
        let end = self.boundary(range.start + AROUND).min(self.line(range.start).end);
        range.start..range.end.min(end).max(range.start)
    }
}

impl SourceCode for ShownSource {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let whole = self.text.as_ref().read_span(span, before, after)?;
        let named = |data: &'a [u8], at: SourceSpan, line: usize, column: usize, lines: usize| {
            Ok(Box::new(MietteSpanContents::new_named(
                self.name.clone(),
                data,
                at,
                line,
                column,
                lines,
            )) as Box<_>)
        };
        let longest =
            whole.data().split(|byte| *byte == b'\n').map(<[u8]>::len).max().unwrap_or_default();
        if longest <= LINE_MAX {
            let (start, length) = (whole.span().offset(), whole.span().len());
            let data = self.text.as_bytes().get(start..start + length).unwrap_or_default();
            return named(data, *whole.span(), whole.line(), whole.column(), whole.line_count());
        }
        let line = self.line(span.offset());
        let start = self.boundary(span.offset().saturating_sub(AROUND).max(line.start));
        let end = self
            .boundary((span.offset() + 2 * AROUND).max(span.offset() + span.len()).min(line.end));
        let number = self.text.get(..line.start).map_or(0, |text| text.matches('\n').count());
        let column = self.text.get(line.start..start).map_or(0, |text| text.chars().count());
        let data = self.text.as_bytes().get(start..end).unwrap_or_default();
        named(data, SourceSpan::new(start.into(), end - start), number, column, 1)
    }
}

fn span(label: &Label, source: Option<&ShownSource>, primary: bool) -> LabeledSpan {
    let text = (!label.text.is_empty()).then(|| printable(&label.text, false).into_owned());
    let range = label.span.start as usize..label.span.end as usize;
    let range = source.map_or(range.clone(), |source| source.mark(range));
    if primary {
        LabeledSpan::new_primary_with_span(text, range)
    } else {
        LabeledSpan::new_with_span(text, range)
    }
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
        (!self.notes.is_empty())
            .then(|| Box::new(notes) as Box<dyn Iterator<Item = &'a dyn Diagnostic>>)
    }
}
