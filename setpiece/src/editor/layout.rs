//! Formatting: of a text, of some lines, and while it is typed.

use super::edits::Edit;
use super::text::line_around;
use super::{Analysis, Workspace};
use crate::dsl::format::format;
use crate::dsl::source::Source;
use std::ops::Range;
use std::path::Path;

impl Workspace {
    /// The edits that format a text; none if it can't be read.
    pub fn format(&mut self, path: &Path) -> Vec<Edit> {
        let Some(analysis) = self.analysis(path) else { return Vec::new() };
        analysis.laid_out(path)
    }

    /// The edits of formatting in the lines of some bytes.
    pub fn format_range(&mut self, path: &Path, within: &Range<usize>) -> Vec<Edit> {
        let Some(text) = self.file_text(path) else { return Vec::new() };
        let lines = line_around(&text, within.start).start..line_around(&text, within.end).end;
        let mut edits = self.format(path);
        // What stands before a token belongs to the token's line.
        edits.retain(|edit| lines.contains(&edit.place.range.end));
        edits
    }

    /// The edits of formatting in the line of a byte: a bracket has been closed there.
    pub fn format_typed(&mut self, path: &Path, offset: usize) -> Vec<Edit> {
        self.format_range(path, &(offset..offset))
    }
}

impl Analysis {
    /// The edits that lead to the text in the one layout, each between two tokens: any of them
    /// alone leaves the tokens as they are.
    fn laid_out(&self, path: &Path) -> Vec<Edit> {
        let source = Source { name: String::new(), text: self.text.clone() };
        let Ok(formatted) = format(&source) else { return Vec::new() };
        between_tokens(&self.text, &formatted)
            .unwrap_or_else(|| vec![(0..self.text.len(), formatted.as_str())])
            .into_iter()
            .map(|(range, text)| Edit::replace(path, range, text))
            .collect()
    }
}

/// Where two texts differ in their blanks and the commas that mean nothing; `None` if they differ
/// in more.
fn between_tokens<'t>(old: &str, new: &'t str) -> Option<Vec<(Range<usize>, &'t str)>> {
    let is_blank =
        |sign: char| sign.is_whitespace() || matches!(sign, ',' | ';' | '\u{feff}' | '\u{a0}');
    let blanks = |text: &str| text.len() - text.trim_start_matches(is_blank).len();
    let (mut edits, mut at_old, mut at_new) = (Vec::new(), 0, 0);
    loop {
        let (rest_old, rest_new) = (old.get(at_old..)?, new.get(at_new..)?);
        let (gap_old, gap_new) = (blanks(rest_old), blanks(rest_new));
        if rest_old.get(..gap_old) != rest_new.get(..gap_new) {
            edits.push((at_old..at_old + gap_old, rest_new.get(..gap_new)?));
        }
        let (mut solid_old, mut solid_new) =
            (rest_old.get(gap_old..)?.chars(), rest_new.get(gap_new..)?.chars());
        match (solid_old.next(), solid_new.next()) {
            (None, None) => return Some(edits),
            (Some(one), Some(other)) if one == other => {
                at_old += gap_old + one.len_utf8();
                at_new += gap_new + one.len_utf8();
            }
            _ => return None,
        }
    }
}
