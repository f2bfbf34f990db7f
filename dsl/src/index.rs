//! What the compiler knows of places of the text: what names refer to, and the types of
//! expressions. Editors ask for it.

use crate::source::Span;
use std::collections::{BTreeMap, BTreeSet};

/// The facts of a compilation by place, from what could be read of a text.
///
/// Values are noted while the compiler compiles and names by `compile/uses`, on the same checked
/// tree, so an index never contradicts a report.
#[derive(Clone, Debug, Default)]
pub struct Index {
    uses: BTreeMap<Span, Span>,
    /// Names that declare something.
    declarations: BTreeSet<Span>,
    /// Declarations of one name that stand for each other.
    related: BTreeSet<(Span, Span)>,
    values: BTreeMap<Span, ValueFact>,
}

/// What is known of an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueFact {
    /// Its type with an article: `a length`.
    pub ty: String,
    /// Its numbers, if they are constants: metres, seconds, radians and their like; two of a point
    /// or vector, metres in the world's frame.
    pub constants: Vec<f64>,
    /// Whether it is a point of the pitch.
    pub is_point: bool,
}

impl Index {
    /// Notes that the name at `at` refers to a declaration, by the place of its name.
    pub(crate) fn refer(&mut self, at: Span, declaration: Span) {
        self.uses.insert(at, declaration);
    }

    /// Notes that a name declares something.
    pub(crate) fn declare(&mut self, at: Span) {
        self.declarations.insert(at);
    }

    /// Notes that one declaration stands for another of the same name: a child's for its parent's.
    pub(crate) fn relate(&mut self, one: Span, other: Span) {
        self.related.insert((one, other));
    }

    /// Notes what an expression is; what is known first stays, unless the new fact knows more.
    pub(crate) fn value(&mut self, at: Span, fact: ValueFact) {
        match self.values.entry(at) {
            std::collections::btree_map::Entry::Vacant(entry) => {
                entry.insert(fact);
            }
            std::collections::btree_map::Entry::Occupied(mut entry) => {
                if entry.get().constants.is_empty() {
                    entry.insert(fact);
                }
            }
        }
    }

    /// The same facts with the places of a file moved: of a text that was mended before it was
    /// compiled.
    #[must_use]
    pub fn moved(self, place: impl Fn(Span) -> Span) -> Index {
        Index {
            uses: self.uses.into_iter().map(|(at, it)| (place(at), place(it))).collect(),
            declarations: self.declarations.into_iter().map(&place).collect(),
            related: self.related.iter().map(|(one, it)| (place(*one), place(*it))).collect(),
            values: self.values.into_iter().map(|(at, fact)| (place(at), fact)).collect(),
        }
    }

    /// Where the name at a place is declared: the place of the declared name.
    pub fn declaration(&self, at: Span) -> Option<Span> {
        self.uses.get(&at).copied()
    }

    /// Every use of a name and where it is declared, by place.
    pub fn uses(&self) -> impl Iterator<Item = (Span, Span)> {
        self.uses.iter().map(|(at, declared)| (*at, *declared))
    }

    /// Every name of the text that declares something, by place.
    pub fn declarations(&self) -> impl Iterator<Item = Span> {
        self.declarations.iter().copied()
    }

    /// Pairs of declarations that have one name because one stands for the other: what a child
    /// declares for what it replaces, players of one name in two layouts.
    pub fn related(&self) -> impl Iterator<Item = (Span, Span)> {
        self.related.iter().copied()
    }

    /// What is known of the expression that stands exactly there.
    pub fn value_at(&self, at: Span) -> Option<&ValueFact> {
        self.values.get(&at)
    }

    /// Every expression whose type is known, by place.
    pub fn values(&self) -> impl Iterator<Item = (Span, &ValueFact)> {
        self.values.iter().map(|(at, fact)| (*at, fact))
    }
}
