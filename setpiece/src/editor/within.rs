//! What may follow within a statement: what the grammar would read there, and what that can be.

use super::Analysis;
use super::areas::is_place_in;
use super::completion::{Completion, CompletionKind, joining, word, words_of};
use super::cursor::{UnfinishedStatement, unfinished};
use super::senses::joined;
use super::words::WordKind;
use crate::dsl::parse::{NextPart, next_parts};
use crate::scenario::vocabulary::{EventKind, Owner, PROPERTIES, StartKind, Type, Unit};
use std::collections::BTreeSet;

/// What a place begins with, what it means, and what follows it.
const PLACES: [(&str, &str, &str); 9] = [
    ("at", "at this point", "at ${1:(0.5, 0)}"),
    ("in", "somewhere in this region, drawn at reset", "in ${1:left.half}"),
    ("ahead of", "ahead of somebody, as they face or attack", "ahead of ${1:ball} by ${2:2m}"),
    ("behind", "behind somebody, as they face or attack", "behind ${1:ball} by ${2:2m}"),
    ("left of", "to the left of somebody, as they face or attack", "left of ${1:ball} by ${2:2m}"),
    (
        "right of",
        "to the right of somebody, as they face or attack",
        "right of ${1:ball} by ${2:2m}",
    ),
    ("between", "on the line between two points", "between ${1:ball} and ${2:right.goal}"),
    (
        "beyond",
        "behind somebody, seen from somewhere",
        "beyond ${1:ball} by ${2:2m} from ${3:right.goal}",
    ),
    ("offset", "from a point along an angle", "offset from ${1:ball} along ${2:90deg} by ${3:2m}"),
];

/// What the last event of a text may be.
fn qualifiers(text: &str) -> Vec<Completion> {
    let event = text.split_whitespace().rev().find_map(EventKind::from_name);
    let known = event.map_or(&[][..], EventKind::qualifiers);
    let is_known = |it: &Completion| known.iter().any(|known| known.name() == it.text);
    words_of(&[WordKind::Qualifier]).filter(is_known).collect()
}

impl Analysis {
    /// What may stand at the end of a text, within a statement.
    pub(super) fn inside(&self, before: &str) -> Vec<Completion> {
        for UnfinishedStatement { block, text } in unfinished(before) {
            let parts = next_parts(block, text);
            if !parts.is_empty() {
                if let Some(found) = self.defaults(text).or_else(|| self.settings(block, text)) {
                    return found;
                }
                if is_place_in(block, text) {
                    return self.areas(block);
                }
                return self.parts(&parts, block, text);
            }
        }
        self.values()
    }

    /// What may be read behind a text.
    fn parts(&self, parts: &[NextPart], block: &str, text: &str) -> Vec<Completion> {
        let head = text.split_whitespace().next().unwrap_or_default();
        let last = text.split_whitespace().next_back().unwrap_or_default();
        let is_option = |key: &str| words_of(&[WordKind::Option("team")]).any(|it| it.text == key);
        // `difficulty: ` in a team has a value, `striker: ` a role.
        let wants_role = block == "team"
            && parts.contains(&NextPart::Role)
            && !is_option(last.trim_end_matches(':'));
        let mut found: Vec<Completion> = parts
            .iter()
            .flat_map(|part| match part {
                NextPart::Keyword(name) => {
                    let meant = joined(block, head, name).map(str::to_owned);
                    let known = joining(name).into_iter();
                    known
                        .map(|it| Completion { doc: meant.clone().unwrap_or(it.doc), ..it })
                        .collect()
                }
                NextPart::Place => PLACES
                    .iter()
                    .map(|&(name, doc, snippet)| Completion {
                        snippet: snippet.to_owned(),
                        kind: CompletionKind::Keyword,
                        ..word(name, doc, "a place")
                    })
                    .collect(),
                NextPart::Event => words_of(&[WordKind::Event]).collect(),
                NextPart::Qualifier => qualifiers(text),
                NextPart::Role => words_of(&[WordKind::Role]).collect(),
                NextPart::Type => words_of(&[WordKind::Type]).collect(),
                NextPart::Act => words_of(&[WordKind::Act]).chain(self.after("behavior")).collect(),
                NextPart::Unit if text.contains("limit ") => units_of_time(),
                // Behind a blank only the units that are words are read.
                NextPart::Unit if text.ends_with(' ') => long_units(),
                NextPart::Unit => words_of(&[WordKind::Unit]).collect(),
                NextPart::Name => self.named_after(text),
                NextPart::Value if wants_role => Vec::new(),
                // In a behaviour `for` says how long.
                NextPart::Operand if last == "for" && block == "behavior" => self.values(),
                NextPart::Operand if matches!(last, "by" | "to" | "for") => self.actors(),
                NextPart::Operand => self.values(),
                NextPart::Value => self.conditions(),
            })
            .collect();
        // A formation is drawn by `let`, and is what `formation:` and a kick-off ask for.
        let may_be_formation = head == "let" || block == "kickoff" || text.contains("formation");
        let mut seen = BTreeSet::new();
        found.retain(|it| {
            (may_be_formation || it.detail != "a formation")
                && seen.insert((it.text.clone(), it.doc.clone()))
        });
        found
    }

    /// What may be or begin a value or a condition.
    fn conditions(&self) -> Vec<Completion> {
        let over = words_of(&[WordKind::OverTime])
            .map(|it| Completion { snippet: format!("{} of $0", it.text), ..it });
        let logic = ["if", "not"].into_iter().filter_map(joining);
        let events = words_of(&[WordKind::Event]);
        self.values().into_iter().chain(events).chain(logic).chain(over).collect()
    }

    /// What a name may be behind a keyword.
    fn named_after(&self, text: &str) -> Vec<Completion> {
        match text.split_whitespace().next_back().unwrap_or_default() {
            "start" => StartKind::ALL.iter().map(|it| word(it.name(), it.doc(), "mode")).collect(),
            "place" => self.actors(),
            _ => Vec::new(),
        }
    }

    /// Teams, players, and who else an event is by.
    fn actors(&self) -> Vec<Completion> {
        let players = self.players().into_iter();
        let is_actor = |name: &str| !matches!(name, "ball" | "centre" | "score" | "event");
        let known = words_of(&[WordKind::Value]).filter(|it| is_actor(&it.text));
        players.chain(known).collect()
    }

    /// What may be or begin a value.
    pub(super) fn values(&self) -> Vec<Completion> {
        let mut found = self.own_names();
        found.extend(self.value_items());
        let of_match = PROPERTIES.iter().filter(|property| property.owner == Owner::Match);
        found.extend(of_match.map(|it| word(it.name, it.doc, it.ty.name())));
        found.extend(words_of(&[
            WordKind::Value,
            WordKind::Function,
            WordKind::Place,
            WordKind::Role,
            WordKind::Mode,
        ]));
        found.extend(joining("own"));
        let mut seen = BTreeSet::new();
        found.retain(|it| seen.insert((it.text.clone(), it.doc.clone())));
        found
    }
}

/// The units that stand behind a blank.
fn long_units() -> Vec<Completion> {
    words_of(&[WordKind::Unit])
        .filter(|it| matches!(it.text.as_str(), "steps" | "episodes"))
        .collect()
}

/// The units of durations.
fn units_of_time() -> Vec<Completion> {
    let is_time = |name: &str| Unit::from_name(name).is_some_and(|it| it.ty() == Type::Duration);
    words_of(&[WordKind::Unit]).filter(|it| is_time(&it.text)).collect()
}

/// The words that go on with a statement on a new line.
pub(super) fn further(before: &str) -> Vec<Completion> {
    let begun = before.trim_end();
    let goes_on = unfinished(before)
        .into_iter()
        .filter(|it| !it.text.trim().is_empty() && it.text.trim_end().len() < it.text.len())
        .find(|it| begun.ends_with(it.text.trim_end()));
    let Some(UnfinishedStatement { block, text }) = goes_on else { return Vec::new() };
    next_parts(block, text)
        .into_iter()
        .filter_map(|part| match part {
            NextPart::Keyword(name) => joining(name),
            _ => None,
        })
        .collect()
}
