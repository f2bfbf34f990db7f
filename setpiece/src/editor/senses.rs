//! What a word means that stands in several rules of the grammar.

use super::words::{self, WordKind};
use crate::dsl::parse::rules_around;
use setpiece_grammar::Rule;

/// What a word means within a rule of the grammar.
#[derive(Clone, Copy, Debug)]
struct Sense {
    /// The rule.
    rule: Rule,
    /// The word.
    word: &'static str,
    /// What it means, in a line.
    doc: &'static str,
    /// The page of the reference, under `docs/language/`.
    page: &'static str,
}

macro_rules! senses {
    ($($page:literal { $($rule:ident $word:literal $doc:literal;)* })*) => {
        &[$($(Sense {
            rule: Rule::$rule,
            word: $word,
            doc: $doc,
            page: concat!($page, ".md"),
        }),*),*]
    };
}

const SENSES: &[Sense] = senses! {
    "place" {
        place_at "at" "at this point";
        place_in "in" "somewhere in this region, drawn at reset";
        relative "left" "to the left of somebody, as they face or attack";
        relative "right" "to the right of somebody, as they face or attack";
        relative "of" "from which player or point";
        relative "by" "how far";
        between "and" "the other point";
        between "at" "how far along: 0% at the first point, 100% at the second";
        beyond "by" "how far";
        beyond "from" "from where it is seen";
        offset "from" "the point that the offset is added to";
        offset "by" "how far";
        facing "from" "the point that they look away from";
    }
    "start" {
        start "for" "the team that takes it";
        start "at" "where it is taken";
        rounds "when" "the next round begins as soon as this holds";
        substitute "when" "the player is replaced as soon as this holds";
    }
    "param" {
        param "in" "the range of its values, or a list of them";
    }
    "draw" {
        require "with" "in which share of the starts it is required";
    }
    "team" {
        team "left" "the left team, which attacks to the right";
        team "right" "the right team, which attacks to the left";
        player_when "when" "the player is there in episodes whose start is like this";
    }
    "ending" {
        end "when" "the episode ends as soon as this holds";
    }
    "event" {
        event_by "by" "whose deed it is: a team, a player or a role";
        event_to "to" "who receives the ball";
        event_from "from" "where on the pitch it begins";
    }
    "reward" {
        give_to "to" "who receives it";
        give_on "on" "paid in steps with one of these events";
        give_when "when" "paid in steps in which this holds";
        on_block "on" "in steps with one of these events";
        block_when "when" "only if this holds too";
        when_block "when" "in steps in which this holds";
        else_when "when" "in steps in which this holds, and none of the conditions before";
        audience "for" "who receives the reward";
        label "as" "the name that it has in results";
        labels "as" "the names of its terms in results";
    }
    "behavior" {
        interrupt "when" "as soon as this holds, in the middle of an act";
        repeat "until" "the repetition ends once this holds";
        do_until "until" "the act ends as soon as this holds";
        do_for "for" "how long the act lasts";
    }
    "record" {
        over_time "of" "of what: an event, a value, or a condition in brackets";
    }
    "observe" {
        seen_when "when" "it is seen while this holds, and 0 otherwise";
    }
    "expression" {
        binder "for" "for each member of a set";
        binder "in" "the set whose members are taken one after the other";
        expr "in" "whether a place lies in a region, or a value in a list or set";
        expr "to" "the value that it changes to";
        condition "in" "whether a place lies in a region, or a value in a list or set";
        condition "to" "the value that it changes to";
        set "in" "whether a place lies in a region, or a value in a list or set";
        arg "to" "what it is measured to";
        arg "for" "for how long";
        arg "within" "how near, or at which angle";
        arg "at" "at which place";
        operand "at" "where the event was";
        operand "to" "who received the ball or was hurt";
        operand "by" "who did it";
    }
    "table" {
        table "over" "the part of the pitch that it covers";
        table_file "from" "the file that has its numbers";
    }
    "import" {
        import "as" "the name in front of what the file declares";
    }
    "level" {
        episodes "for" "how many episodes";
        episodes "episodes" "how many episodes are played";
        sweep "each" "one row for each of these values";
        sweep "in" "the values that are taken one after the other";
        play "with" "who plays";
        over_params "over" "with parameters drawn from their ranges";
        stage_until "until" "the stage ends when this is reached";
        adapt "from" "the value at the beginning";
        adapt "to" "the last value";
        adapt "in" "the range that the measure is kept in";
        measure_arg "last" "measured over this many of the last episodes";
    }
};

/// The rules of the grammar that join words to a statement, by the block that it stands in (empty:
/// any) and by its first word (empty: any).
const JOINING: &[(&str, &str, &[Rule])] = &[
    ("team", "", &[Rule::player_when, Rule::relative]),
    ("formation", "", &[Rule::player_when, Rule::relative]),
    ("scenario", "ball", &[Rule::relative]),
    ("reward", "give", &[Rule::give_to, Rule::give_on, Rule::give_when, Rule::label]),
    ("reward", "give", &[Rule::event_by, Rule::event_from]),
    ("reward", "on", &[Rule::block_when]),
    ("reward", "when", &[Rule::when_block]),
    ("scenario", "reward", &[Rule::audience, Rule::label]),
    ("scenario", "end", &[Rule::end, Rule::event_by, Rule::event_from]),
    ("scenario", "start", &[Rule::start]),
    ("scenario", "rounds", &[Rule::rounds]),
    ("scenario", "substitute", &[Rule::substitute]),
    ("scenario", "param", &[Rule::param]),
    ("scenario", "require", &[Rule::require]),
    ("scenario", "team", &[Rule::team]),
    ("scenario", "observe", &[Rule::seen_when]),
    ("behavior", "do", &[Rule::do_until, Rule::do_for]),
    ("behavior", "interrupt", &[Rule::interrupt]),
    ("behavior", "repeat", &[Rule::repeat]),
    ("check", "play", &[Rule::play, Rule::episodes]),
    ("", "import", &[Rule::import]),
];

/// What a word means that joins a statement, by the statement's block and its first word.
pub(super) fn joined(block: &str, head: &str, word: &str) -> Option<&'static str> {
    let is_meant = |of: &str, it: &str| of.is_empty() || of == it;
    let rules =
        JOINING.iter().filter(|(of, first, _)| is_meant(of, block) && is_meant(first, head));
    let mut rules = rules.flat_map(|(_, _, rules)| rules.iter());
    rules.find_map(|rule| {
        let known = SENSES.iter().find(|known| known.rule == *rule && known.word == word);
        known.map(|known| known.doc)
    })
}

/// Rules whose words are all of one kind.
const KINDS: [(Rule, WordKind); 2] =
    [(Rule::over_kind, WordKind::OverTime), (Rule::callee, WordKind::Function)];

/// What a word means at a byte of a text, and the page of the reference: as the innermost rule has
/// it that gives it a meaning.
pub(super) fn sense(text: &str, offset: usize, word: &str) -> Option<(&'static str, &'static str)> {
    let of_kind = |kind: WordKind| words::all().find(|it| it.name == word && it.kind == kind);
    let is_known = SENSES.iter().any(|it| it.word == word);
    if !is_known && !KINDS.iter().any(|(_, kind)| of_kind(*kind).is_some()) {
        return None;
    }
    let around = rules_around(text, offset);
    let kind = KINDS.iter().find(|(rule, _)| around.last() == Some(rule));
    if let Some(found) = kind.and_then(|(_, kind)| of_kind(*kind)) {
        return Some((found.doc, found.page));
    }
    let of_rule = |rule: &Rule| {
        let found = SENSES.iter().find(|it| it.rule == *rule && it.word == word)?;
        // Beside `on`, a condition is about the step of the event.
        if *rule == Rule::give_when && is_of_event(text, offset) {
            return Some((WHEN_OF_EVENT, found.page));
        }
        Some((found.doc, found.page))
    };
    around.iter().rev().find_map(of_rule)
}

/// What the `when` of `give … on … when …` means.
const WHEN_OF_EVENT: &str = "paid for these events in steps in which this holds, too";

/// Whether the `give` whose condition begins at a byte has events.
fn is_of_event(text: &str, offset: usize) -> bool {
    let before = text.get(..offset).unwrap_or_default();
    let statement = before.rfind("give").and_then(|at| before.get(at..)).unwrap_or_default();
    statement.split(|sign: char| !(sign.is_alphanumeric() || sign == '_')).any(|word| word == "on")
}
