//! What can be folded: blocks, brackets, comments, imports.

use super::Analysis;
use super::text::{Bracket, brackets};
use std::ops::Range;

/// Some lines that can be folded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FoldedLines {
    /// The bytes, from the first line to the last.
    pub range: Range<usize>,
    /// What they are.
    pub kind: FoldedKind,
}

/// What folded lines are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoldedKind {
    /// What stands in brackets.
    Block,
    /// Lines of comments.
    Comment,
    /// Imports.
    Imports,
}

impl Analysis {
    /// What can be folded, from the top down; a broken text has what its brackets give.
    pub fn folds(&self) -> Vec<FoldedLines> {
        let is_long = |range: &Range<usize>| {
            self.text.get(range.clone()).is_some_and(|text| text.contains('\n'))
        };
        let blocks = brackets(&self.text).into_iter().map(|Bracket { open, close }| FoldedLines {
            range: open..close,
            kind: FoldedKind::Block,
        });
        let mut folds: Vec<FoldedLines> = blocks.filter(|fold| is_long(&fold.range)).collect();
        folds.extend(self.runs("//", FoldedKind::Comment));
        folds.extend(self.runs("import ", FoldedKind::Imports));
        folds.sort_by_key(|fold| (fold.range.start, fold.range.end));
        folds
    }

    /// Two and more lines in a row that begin with a word.
    fn runs(&self, begin: &str, kind: FoldedKind) -> Vec<FoldedLines> {
        let (mut runs, mut run): (Vec<FoldedLines>, Option<(Range<usize>, usize)>) =
            (Vec::new(), None);
        let mut at = 0;
        for line in self.text.split_inclusive('\n').chain(std::iter::once("")) {
            if line.trim_start().starts_with(begin) {
                let (range, lines) = run.unwrap_or((at..at, 0));
                run = Some((range.start..at + line.trim_end().len(), lines + 1));
            } else if let Some((range, lines)) = run.take()
                && lines > 1
            {
                runs.push(FoldedLines { range, kind });
            }
            at += line.len();
        }
        runs
    }
}
