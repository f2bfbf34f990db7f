//! Text that can't be read: what was expected, and words that are misspelt or misplaced.

use super::facts;
use crate::problem::said::{Said, say};
use crate::problem::{Code, Guess};
use crate::source::Span;

facts! {
    /// Facts about syntax.
    pub(crate) Syntax {
        /// Something else was expected. `wanted`: nouns, see [`listed`]; `found`: empty at the end
        /// of the file.
        Expected {
            wanted: Vec<&'static str>,
            found: String,
            begins: bool,
            hint: Hint,
        } = Code::Syntax => {
            let found = if found.is_empty() { "the end of the file".to_owned() } else { format!("`{found}`") };
            let label = if *begins { "no statement begins like this" } else { "this can't stand here" };
            hint.add(say(format!("expected {}, found {found}", listed(wanted)), label))
        },
        /// The text ends, or its statement, where something was expected.
        Unfinished { wanted: Vec<&'static str>, last: String, hint: Hint } = Code::Syntax =>
            hint.add(say(format!("expected {} behind `{last}`", bare(&listed(wanted))), "something is missing")),
        /// A word that belongs to other statements; `habit`: how another language's word is
        /// written.
        Misplaced {
            word: String,
            place: &'static str,
            owner: &'static str,
            habit: Option<String>,
        } = Code::Syntax => {
            let said = say(format!("`{word}` can't stand in {place}"), "not here");
            match habit {
                Some(habit) => said.help(habit.as_str()),
                None => said.help(format!("it belongs in {owner}")),
            }
        },
        /// A word like one that may stand here.
        Misspelt { wanted: Vec<&'static str>, word: String, meant: &'static str } = Code::Syntax =>
            say(format!("expected {}, found `{word}`", listed(wanted)), "no such word here").help(did_you_mean(meant)),
        /// A word before `of` like one that looks at a whole episode.
        MisspeltOverTime { word: String, meant: &'static str } = Code::Syntax =>
            say(format!("expected `count`, `max` or the like, found `{word}`"), "no such word here")
                .help(did_you_mean(meant)),
        /// A role that there is not.
        UnknownRole { word: String, guess: Guess } = Code::UnknownRole => {
            let said = say(format!("unknown role `{word}`"), "no role has this name");
            if guess.known.is_empty() {
                said.guess(guess, "")
            } else {
                said.help(format!("the roles are {}", guess.known.join(", ")))
            }
        },
        /// A state of the match where an event is wanted; `when`: what stands for `on` and it.
        StateNoEvent { name: String, when: String } = Code::UnknownEvent =>
            say(format!("`{name}` is a state, no event"), "lasts").help(format!("write `{when}`")),
        /// A condition of what changes where an event is wanted; `when`: what stands for `on` and
        /// it.
        ChangeNoEvent { name: String, when: String } = Code::UnknownEvent => {
            let which = if name == ROUND { ": the first step of every round" } else { "" };
            say(format!("`{name} changes` is a condition, no event"), "a value")
                .help(format!("write `{when}`{which}"))
        },
        /// Behind `on`, a property of a player; `when`: what stands for both.
        PropertyNoEvent { name: String, when: String } = Code::UnknownEvent =>
            say(format!("`{name}` is a property of a player, no event"), "read at every step")
                .help(format!("write `{when}`")),
        /// Digits with `_` between them.
        DigitsAlone { number: String, rest: String } = Code::Syntax =>
            say(format!("`{number}{rest}` is no number"), "digits alone")
                .write(format!("{number}{}", rest.replace('_', ""))),
        /// A unit that there is not; `meant`: with a blank before it where one belongs.
        UnknownUnit { word: String, number: String, meant: UnitGuess } = Code::Syntax =>
            say(format!("unknown unit `{word}`"), "no unit has this name").help(match meant {
                UnitGuess::One(unit) => format!("did you mean `{number}{unit}`?"),
                UnitGuess::All(units) => format!("the units are `{}`", units.join("`, `")),
            }),
        /// A blank before a unit.
        UnitApart { number: String, unit: &'static str } = Code::Syntax =>
            say(format!("the unit `{unit}` must touch its number"), "a blank between them")
                .write(format!("{number}{unit}")),
        /// A second comparison behind the first one.
        ComparisonChain { first: Span } = Code::ComparisonChain =>
            say("comparisons don't chain", "a second comparison")
                .at(first, "the first one")
                .help("join two comparisons by `and`: `a < b and b < c`"),
        /// A block behind a `give`; `moved`: how the block begins, if it can stand on its own line.
        BlockAfterGive { give: Span, moved: Option<&'static str> } = Code::BlockAfterGive => {
            let said = say("a `give` has no block", "this opens a block").at(give, "so this is given whatever the block says");
            match moved {
                Some(head) => said.help(format!("put `{head} {{` on its own line, with the `give` inside it")),
                None => said.help("the `when` is read as the event's: end the `give` with a label, `as \"goal\"`"),
            }
        },
        /// A file with more words than are read.
        TooManyWords { most: usize } = Code::TooMuch =>
            say(format!("a file has more than {most} words and signs"), "one too many")
                .help("move parts of it into other files and import them, or compute them from parameters"),
        /// A list that is longer than is read; `what`: in the plural.
        TooLongList { what: String, most: usize } = Code::TooMuch =>
            say(format!("there are more than {most} {what} here"), "one too many")
                .help("what repeats can be computed, or named once and used again"),
        /// An expression with too many operators.
        TooManyOperators { most: u32 } = Code::TooDeep =>
            say(format!("an expression has more than {most} operators"), "too long").help(NAME_PARTS),
        /// Words that nest what follows them.
        NestedExpression { most: u32 } = Code::TooDeep =>
            say(format!("an expression is nested more than {most} deep"), "one too many").help(NAME_PARTS),
        /// Brackets in brackets.
        NestedBrackets { most: usize } = Code::TooDeep =>
            say(format!("brackets are nested more than {most} deep"), "one too many").help(NAME_PARTS),
        /// Blocks in blocks.
        NestedBlocks { most: u32 } = Code::TooDeep =>
            say(format!("blocks are nested more than {most} deep"), "one too many").help("split the reward in two"),
        /// A text that the grammar gives up on.
        TooDeep = Code::TooDeep => say("this is nested too deeply", "too deep from here").help(NAME_PARTS),
    }
}

/// What changes when a round begins, as authors write it.
pub(crate) const ROUND: &str = "round";

const NAME_PARTS: &str = "give parts of it names with `let` or `fn`";

/// What to write where something else was expected.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Hint {
    /// Nothing is known.
    None,
    /// How a habit of another language is written here.
    Habit(String),
    /// How the statement is written.
    Form(&'static str),
}

impl Hint {
    fn add(&self, said: Said) -> Said {
        match self {
            Hint::None => said,
            Hint::Habit(help) => said.help(help.as_str()),
            Hint::Form(form) => said.help(format!("write, for example, `{form}`")),
        }
    }
}

/// What an unknown unit may stand for.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum UnitGuess {
    /// This one, with a blank before it where one belongs.
    One(String),
    /// All that there are.
    All(Vec<&'static str>),
}

fn did_you_mean(meant: &str) -> String {
    format!("did you mean `{meant}`?")
}

/// At most four of what was expected: "a point, `,` or `)`".
fn listed(nouns: &[&str]) -> String {
    if let [only] = nouns {
        return (*only).to_owned();
    }
    // Things before words before brackets; examples only when there is room.
    let mut nouns = nouns.to_vec();
    nouns.sort_by_key(|noun| (noun.starts_with('`'), !noun.contains("`, `")));
    nouns.truncate(4);
    let plain: Vec<&str> = nouns.iter().map(|noun| bare(noun)).collect();
    match plain.split_last() {
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
        None => String::new(),
    }
}

/// A noun without its example.
fn bare(noun: &str) -> &str {
    noun.split(", for example").next().unwrap_or(noun)
}
