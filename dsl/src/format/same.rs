//! Whether two texts say the same: their trees but for commas that mean nothing, and their
//! comments.

use super::pieces::{SourcePiece, pieces};
use pest::Parser;
use pest::iterators::Pair;
use setpiece_grammar::{PitchParser, Rule};

/// Whether two texts differ in their layout alone.
pub(super) fn same(before: &str, after: &str) -> bool {
    match (tree(before), tree(after), pieces(before), pieces(after)) {
        (Some(a), Some(b), Some(c), Some(d)) => a == b && words(&c).eq(words(&d)),
        _ => false,
    }
}

/// Tokens and comments in order, without the commas.
fn words<'p>(pieces: &'p [SourcePiece<'_>]) -> impl Iterator<Item = &'p str> {
    pieces.iter().filter(|piece| !piece.is(Rule::comma)).map(|piece| piece.text.as_ref())
}

/// The rules of a tree with their depths.
fn tree(text: &str) -> Option<Vec<(usize, Rule)>> {
    let mut nodes = Vec::new();
    flatten(PitchParser::parse(Rule::file, text).ok()?.next()?, 0, &mut nodes);
    Some(nodes)
}

fn flatten(pair: Pair<'_, Rule>, depth: usize, nodes: &mut Vec<(usize, Rule)>) {
    let rule = pair.as_rule();
    if matches!(rule, Rule::comma) {
        return;
    }
    nodes.push((depth, rule));
    for child in pair.into_inner() {
        flatten(child, depth + 1, nodes);
    }
}
