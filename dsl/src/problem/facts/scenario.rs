//! A file's scenarios as wholes: which one is compiled, and whether it is too large.

use super::facts;
use crate::problem::said::say;
use crate::problem::{Code, Guess};
use setpiece_scenario::bounds::Excess;

facts! {
    /// Facts about a whole scenario.
    pub(crate) Whole {
        /// The scenario that was asked for is not in the file.
        NoSuchScenario {
            file: String,
            wanted: String,
            guess: Guess,
            suites: Vec<String>,
        } = Code::NoScenario => {
            let listed = match &suites[..] {
                [] => "it has".to_owned(),
                [suite] => format!("it has the suite `{suite}` and"),
                suites => format!("it has the suites `{}` and", suites.join("`, `")),
            };
            say(format!("`{file}` has no scenario `{wanted}`"), "").guess(guess, &listed)
        },
        /// The file has suites alone, others than the one that was asked for.
        NoSuchSuite { file: String, wanted: String, guess: Guess } = Code::NoScenario =>
            say(format!("`{file}` has no suite `{wanted}`"), "").guess(guess, "it has"),
        /// Every scenario of the file is abstract.
        OnlyAbstract { file: String, first: String } = Code::NoScenario =>
            say(format!("`{file}` has only abstract scenarios"), "abstract")
                .help(format!("extend it: `scenario mine extends {first} {{ … }}`")),
        /// The file has no scenario.
        NoScenario { file: String } = Code::NoScenario =>
            say(format!("`{file}` has no scenario"), "").help("write `scenario NAME { … }`"),
        /// The scenarios up to this one are more than a compilation may lower.
        TooManyExpressions { scenario: String, most: usize } = Code::TooMuch =>
            say(format!("up to `{scenario}` more than {most} expressions are used"), "too much")
                .help("use fewer or smaller rewards and functions, or put scenarios into files of their own"),
        /// A total of the scenario is above its limit.
        TooCostly { scenario: String, excess: Excess, is_part: bool } = Code::TooCostly =>
            say(format!("`{scenario}` has {}", excess.message), if *is_part { "the most of it" } else { "" })
                .help(excess.help),
        /// A program is beyond what the engine runs.
        CantRun { scenario: String, fault: String } = Code::Impossible =>
            say(format!("`{scenario}` can't be run: {fault}"), "").help("make its rewards and endings smaller"),
        /// Nothing refers to a name.
        Unused { what: Declared, name: String } = Code::UnusedName =>
            say(format!("{} `{name}` is never used", what.noun()), "not read")
                .help(format!("{}, leave it out, or begin its name with `_`", what.cure(name)))
                .writing(None, format!("_{name}")),
        /// A cast names nobody who could play.
        NoSuchAi { text: String } = Code::WrongType =>
            say(format!("`{text}` is not who plays a player"), "")
                .help("it can be `bot`, `hold`, `lazy`, a `behavior` or `script \"f.rhai\"`"),
    }
}

/// What a name that nothing refers to was declared as.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Declared {
    /// `behavior`
    Behavior,
    /// `const`
    Const,
    /// `ending`
    Ending,
    /// `formation`
    Formation,
    /// `fn`
    Function,
    /// `let`
    Let,
    /// A parameter of anything.
    Parameter,
    /// `region`
    Region,
    /// `reward`
    Reward,
    /// `state`
    State,
    /// `table`
    Table,
}

impl Declared {
    fn noun(self) -> &'static str {
        match self {
            Declared::Behavior => "behavior",
            Declared::Const => "`const`",
            Declared::Ending => "ending",
            Declared::Formation => "formation",
            Declared::Function => "function",
            Declared::Let => "`let`",
            Declared::Parameter => "parameter",
            Declared::Region => "region",
            Declared::Reward => "reward",
            Declared::State => "state",
            Declared::Table => "table",
        }
    }

    /// How it is used.
    fn cure(self, name: &str) -> String {
        match self {
            Declared::Behavior => format!("give it to a player, `ai: {name}`"),
            Declared::Ending => format!("end by it, `end {name}`"),
            Declared::Formation => format!("give it to a team, `formation: {name}`"),
            Declared::Reward => format!("pay it in a scenario, `reward {name}`"),
            _ => "use it".to_owned(),
        }
    }
}
