//! Parsing: text to a syntax tree. Never fails: what can't be read becomes `Broken` and a problem.
//!
//! 1. `scan` looks at brackets, strings and comments alone, reports the unclosed and mends them in
//!    a copy of the same length, so that every later offset holds for the author's text.
//! 2. One run of the grammar reads the whole file; lists of statements take junk where no statement
//!    can be read.
//! 3. The pairs become the tree (one file here per construct); `recover` re-reads junk to say what
//!    was expected.

mod around;
mod behavior;
mod event;
mod expr;
mod field;
mod item;
mod level;
mod next;
mod reader;
mod recover;
mod reward;
mod scan;
mod scenario;
mod team;

pub use around::rules_around;
pub use next::{NextPart, next_parts};
pub use recover::statement_words;

use crate::ast;
use crate::problem::Problem;
use crate::problem::facts::Syntax;
use crate::source::{FileId, Source, Span};
use pest::Parser;
use reader::Reader;
use setpiece_grammar::{PitchParser, Rule};

/// Brackets may be nested this deep.
pub const MAX_BRACKETS: usize = 64;

/// `if`s and phrases such as `by …` may be nested this deep without brackets.
pub const MAX_NESTED: u32 = 64;

/// An expression may have this many operators and calls on the way from its root to a leaf.
pub const MAX_OPERATORS: u32 = 256;

/// Blocks and `else when`s may be nested this deep.
pub const MAX_BLOCKS: u32 = 64;

/// A stage of compilation reports no more problems of one file.
pub const MAX_PROBLEMS: usize = 500;

/// A file may have this many words and signs, comments apart. Scenarios have some hundreds; a tree
/// of so many takes some hundred milliseconds and 100 MB, whatever the text is.
pub const MAX_TOKENS: usize = 100_000;

/// A list may be this long: statements of a block, items of a file, arguments, parameters, names,
/// values. Nobody writes so many, and looking one up in a list takes time.
pub const MAX_LIST: usize = 4_096;

/// Bytes of a file that may be looked at again to say what is wrong, beyond twice its length.
const LEAST_EFFORT: usize = 1 << 18;

/// Parses a file; says everything that could not be read in `problems`.
pub fn parse(source: &Source, id: FileId, problems: &mut Vec<Problem>) -> ast::File {
    let scan = scan::scan(&source.text, id);
    let mut reader = Reader::new(id, &source.text, &scan);
    let items = match PitchParser::parse(Rule::file, &scan.text) {
        Ok(pairs) => reader.file(pairs),
        Err(error) => {
            let at = reader.offset_of(&error.location);
            reader.push(Problem::new(reader.at(at), Syntax::TooDeep));
            Vec::new()
        }
    };
    let (mut found, lost) = reader.finish();
    found.extend(scan.problems);
    found.sort_by_key(|problem| (problem.place().start, problem.code()));
    problems.extend(found);
    ast::File { id, items, lost }
}

/// A span of a file from offsets.
fn span(file: FileId, start: usize, end: usize) -> Span {
    Span { file, start: start as u32, end: end.max(start) as u32 }
}
