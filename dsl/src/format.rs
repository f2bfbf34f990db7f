//! Formatting: the same tokens and comments, laid out in one way.
//!
//! 1. `pieces` takes the author's text apart into tokens and comments, as the grammar sees them.
//! 2. `layout` decides where lines end: statements of an open block stand on lines of their own, an
//!    author's other line breaks stay where they read well, and what is too wide is opened or
//!    wrapped.
//! 3. `print` writes the lines, with columns where the author began them.
//!
//! The result is compared with the text it came from (`same`), so that formatting never changes
//! what a file says.

mod layout;
mod pieces;
mod print;
mod same;

use crate::problem::{Problem, has_errors};
use crate::source::{FileId, Source};

/// Columns of a line.
pub const WIDTH: usize = 120;

/// Blanks per block.
pub const INDENT: usize = 4;

/// An expression on one line of the one layout, without comments; `None` if it is none.
pub(crate) fn one_line(text: &str) -> Option<String> {
    Some(print::one_line(&pieces::of_expression(text)?))
}

/// The text in the one layout. Comments, line breaks that read well and single empty lines are
/// kept; four blanks indent a block. The result reads as the same syntax tree and is its own
/// format.
///
/// # Errors
/// The problems of a text that can't be read: it is left alone.
pub fn format(source: &Source) -> Result<String, Vec<Problem>> {
    let mut problems = Vec::new();
    crate::parse::parse(source, FileId(0), &mut problems);
    if has_errors(&problems) {
        return Err(problems);
    }
    let Some(pieces) = pieces::pieces(&source.text) else { return Ok(source.text.to_string()) };
    let formatted = print::print(&layout::lay_out(&pieces));
    // A text that would say something else is worse than one that is laid out badly.
    Ok(if same::same(&source.text, &formatted) { formatted } else { source.text.to_string() })
}
