//! What can be folded: blocks, brackets, comments, imports.

use super::Analysis;
use super::text::{Bracket, brackets};
use std::ops::Range;

/// Some lines that can be folded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fold {
    /// The bytes, from the first line to the last.
    pub range: Range<usize>,
    /// What they are.
    pub kind: FoldKind,
}

/// What folded lines are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoldKind {
    /// What stands in brackets.
    Block,
    /// Lines of comments.
    Comment,
    /// Imports.
    Imports,
}

impl Analysis {
    /// What can be folded, from the top down; a broken text has what its brackets give.
    pub fn folds(&self) -> Vec<Fold> {
        let is_long = |range: &Range<usize>| {
            self.text.get(range.clone()).is_some_and(|text| text.contains('\n'))
        };
        let blocks = brackets(&self.text)
            .into_iter()
            .map(|Bracket { open, close }| Fold { range: open..close, kind: FoldKind::Block });
        let mut folds: Vec<Fold> = blocks.filter(|fold| is_long(&fold.range)).collect();
        folds.extend(self.runs("//", FoldKind::Comment));
        folds.extend(self.runs("import ", FoldKind::Imports));
        folds.sort_by_key(|fold| (fold.range.start, fold.range.end));
        folds
    }

    /// Two and more lines in a row that begin with a word.
    fn runs(&self, begin: &str, kind: FoldKind) -> Vec<Fold> {
        let (mut runs, mut run): (Vec<Fold>, Option<(Range<usize>, usize)>) = (Vec::new(), None);
        let mut at = 0;
        for line in self.text.split_inclusive('\n').chain(std::iter::once("")) {
            if line.trim_start().starts_with(begin) {
                let (range, lines) = run.unwrap_or((at..at, 0));
                run = Some((range.start..at + line.trim_end().len(), lines + 1));
            } else if let Some((range, lines)) = run.take()
                && lines > 1
            {
                runs.push(Fold { range, kind });
            }
            at += line.len();
        }
        runs
    }
}
