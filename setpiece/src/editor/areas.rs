//! What can be a region.

use super::completion::{Completion, word, words_of};
use super::outline::flat;
use super::words::WordKind;
use super::{Analysis, Symbol, SymbolKind};
use crate::scenario::vocabulary::{Function, PitchRegion};

/// Functions whose value may be a region.
const SHAPES: [Function; 6] = [
    Function::Circle,
    Function::Rect,
    Function::Sector,
    Function::Polygon,
    Function::Choice,
    Function::Alternate,
];

/// Words that a region begins with.
const SIDES: [(&str, &str); 3] = [
    ("left", "an area of the left team, such as `left.box`"),
    ("right", "an area of the right team, such as `right.box`"),
    ("own", "an area seen from the own goal, such as `own.half`"),
];

/// Whether a place in a region is written at the end of a statement: `CB in `, `ball in `.
///
/// - `block`: the word of the block that it stands in.
pub(super) fn is_place_in(block: &str, text: &str) -> bool {
    let mut words = text.split_whitespace();
    let is_of_place = matches!(block, "team" | "formation")
        || (block == "scenario" && words.next() == Some("ball"));
    let is_condition = text.split_whitespace().any(|word| word == "when");
    is_of_place && !is_condition && text.trim_end().ends_with(" in")
}

impl Analysis {
    /// What may be or begin a region.
    ///
    /// - `block`: the word of the block that it stands in.
    pub(super) fn areas(&self, block: &str) -> Vec<Completion> {
        let of_pitch = words_of(&[WordKind::Place]);
        let of_pitch = of_pitch.filter(|it| PitchRegion::from_name(&it.text).is_some());
        let is_shape = |it: &Completion| SHAPES.iter().any(|shape| shape.name() == it.text);
        let shapes = words_of(&[WordKind::Function]).filter(is_shape);
        // Only a team has a goal of its own.
        let sides = SIDES.iter().filter(|(name, _)| *name != "own" || block != "scenario");
        let sides = sides.map(|&(name, doc)| word(name, doc, "in the match"));
        let items = self.value_items().into_iter().filter(|it| it.detail == "a region");
        let own = self.own_names().into_iter().filter(|it| self.is_area(&it.text));
        own.chain(items).chain(sides).chain(of_pitch).chain(shapes).collect()
    }

    /// Whether a scenario of the text has a region of this name, or a value that is one.
    fn is_area(&self, name: &str) -> bool {
        let is_it = |symbol: &Symbol| {
            let whole = self.text.get(symbol.whole.clone()).unwrap_or_default();
            let is_region = |end: usize| {
                self.index.values().any(|(at, fact)| {
                    let own = self.own(at);
                    fact.ty == "a region" && own.is_some_and(|own| own.end == end)
                })
            };
            symbol.name == name
                && match symbol.kind {
                    SymbolKind::Function => whole.starts_with("region"),
                    SymbolKind::Value => is_region(symbol.whole.start + whole.trim_end().len()),
                    _ => false,
                }
        };
        flat(self.symbols()).into_iter().any(is_it)
    }
}
