//! What a selection grows to: word, expression, brackets, statement, item, file.

use super::Analysis;
use super::text::{brackets, line_around, word_at};
use std::collections::BTreeSet;
use std::ops::Range;

/// How many ranges a selection may grow by.
const LEVELS: usize = 100;

impl Analysis {
    /// What surrounds a byte, from the smallest to the whole text.
    pub fn selections(&self, offset: usize) -> Vec<Range<usize>> {
        let offset = offset.min(self.text.len());
        let mut around: Vec<Range<usize>> = vec![word_at(&self.text, offset), 0..self.text.len()];
        around.extend(self.index.values().filter_map(|(span, _)| self.own(span)));
        for bracket in brackets(&self.text) {
            around.push(bracket.open..bracket.close);
            around.push(bracket.open + 1..bracket.close.saturating_sub(1).max(bracket.open + 1));
        }
        let line = line_around(&self.text, offset);
        let text = self.text.get(line.clone()).unwrap_or_default();
        let blank = text.len() - text.trim_start().len();
        around.push(line.start + blank..line.start + text.trim_end().len().max(blank));
        around.extend(self.tree.items.iter().filter_map(|item| self.own(item.span)));
        around.extend(super::outline::flat(self.symbols()).into_iter().map(|it| it.whole.clone()));
        // From the largest to the smallest; what overlaps the last one only in part is left out.
        let sizes: BTreeSet<(std::cmp::Reverse<usize>, usize)> = around
            .into_iter()
            .filter(|it| it.start <= offset && offset <= it.end && !it.is_empty())
            .map(|it| (std::cmp::Reverse(it.len()), it.start))
            .collect();
        let mut nested: Vec<Range<usize>> = Vec::new();
        for (std::cmp::Reverse(length), start) in sizes {
            let next = start..start + length;
            let fits = nested.last().is_none_or(|last| {
                last.start <= next.start && next.end <= last.end && *last != next
            });
            if fits {
                nested.push(next);
            }
        }
        nested.reverse();
        // Nobody grows a selection so often, and an editor takes each as a part of the next.
        if nested.len() > LEVELS {
            nested.drain(LEVELS - 1..nested.len() - 1);
        }
        nested
    }
}
