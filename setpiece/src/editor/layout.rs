//! Formatting: of a text, of some lines, and while it is typed.

use super::edits::Edit;
use super::text::line_around;
use super::{Analysis, Workspace};
use crate::dsl::format::format;
use crate::dsl::source::Source;
use similar::{Algorithm, DiffOp, capture_diff_slices};
use std::ops::Range;
use std::path::Path;

impl Workspace {
    /// The edits that format a text; none if it can't be read.
    pub fn format(&mut self, path: &Path) -> Vec<Edit> {
        let Some(analysis) = self.analysis(path) else { return Vec::new() };
        analysis.laid_out(path)
    }

    /// The edits of formatting that touch some bytes.
    pub fn format_range(&mut self, path: &Path, within: &Range<usize>) -> Vec<Edit> {
        let mut edits = self.format(path);
        edits.retain(|edit| {
            let own = &edit.place.range;
            own.start <= within.end && within.start <= own.end
        });
        edits
    }

    /// The edits of formatting in the line of a byte: a bracket has been closed there.
    pub fn format_typed(&mut self, path: &Path, offset: usize) -> Vec<Edit> {
        let Some(text) = self.file_text(path) else { return Vec::new() };
        let line = line_around(&text, offset);
        let mut edits = self.format(path);
        edits.retain(|edit| {
            let own = &edit.place.range;
            line.start <= own.start && own.end <= line.end
        });
        edits
    }
}

impl Analysis {
    /// The edits, by whole lines, that lead to the text in the one layout.
    fn laid_out(&self, path: &Path) -> Vec<Edit> {
        let source = Source { name: String::new(), text: self.text.clone() };
        let Ok(formatted) = format(&source) else { return Vec::new() };
        let old: Vec<&str> = self.text.split_inclusive('\n').collect();
        let new: Vec<&str> = formatted.split_inclusive('\n').collect();
        let starts: Vec<usize> = std::iter::once(0)
            .chain(old.iter().scan(0, |at, line| {
                *at += line.len();
                Some(*at)
            }))
            .collect();
        let at = |line: usize| starts.get(line).copied().unwrap_or(self.text.len());
        capture_diff_slices(Algorithm::Myers, &old, &new)
            .into_iter()
            .filter(|op| !matches!(op, DiffOp::Equal { .. }))
            .map(|op| {
                let (was, is) = (op.old_range(), op.new_range());
                let text = new.get(is).unwrap_or_default().concat();
                Edit::replace(path, at(was.start)..at(was.end), text)
            })
            .collect()
    }
}
