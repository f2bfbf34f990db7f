//! Arguments: too many, too few, twice, or not what a function takes.

use super::facts;
use crate::problem::said::say;
use crate::problem::{Code, Guess};
use crate::source::Span;

facts! {
    /// Facts about calls.
    pub(crate) Calls {
        /// A parameter without a default gets no value; `signature`: how the function is written.
        Missing { callee: String, parameter: String, form: Form } = Code::WrongArguments => {
            let said = say(format!("`{callee}` needs a value for `{parameter}`"), "");
            match form {
                Form::Builtin(signature) => said.help(format!("`{signature}`")),
                Form::Named => said.help(format!("write `{parameter}: …`")).suggesting(parameter),
                Form::Unknown => said,
            }
        },
        /// More arguments than parameters.
        TooMany {
            callee: String,
            names: Vec<String>,
            signature: Option<String>,
        } = Code::WrongArguments => {
            let takes = match names.len() {
                0 => "no value".to_owned(),
                1 => "one value".to_owned(),
                n => format!("{n} values"),
            };
            say(format!("`{callee}` takes {takes}"), "too many").help(match signature {
                Some(signature) => format!("`{signature}`"),
                None if names.is_empty() => "leave it out".to_owned(),
                None => format!("write `{callee}({})`", names.join(", ")),
            })
        },
        /// An argument for a parameter that the function doesn't have.
        NoParameter { callee: String, text: String, guess: Guess } = Code::WrongArguments =>
            say(format!("`{callee}` has no parameter `{text}`"), "not known").guess(guess, "it has"),
        /// A parameter gets two values.
        GivenTwice { parameter: String, first: Span } = Code::WrongArguments =>
            say(format!("`{parameter}` is given twice"), "given again here")
                .at(first, "first given here")
                .help("leave one of them out"),
        /// An argument without a name where names are needed.
        ByName { callee: String } = Code::WrongArguments =>
            say(format!("`{callee}` takes its arguments by name"), "which parameter is meant?")
                .help("write `name: value`"),
        /// `for` or `where` in the call of a function that goes through no players.
        ///
        /// - `least`: how the nearest of them is written, and in the place of what.
        NoPlayers { callee: String, least: Option<(Span, String)> } = Code::WrongArguments =>
            say(
                format!("`{callee}` goes through no players"),
                "`for` and `where` belong to `count`, `sum`, `min` and their like",
            )
            .help(match least {
                Some((_, least)) => format!("write `{least}`"),
                None => "count players first: `count(p in us where …)`".to_owned(),
            })
            .writing_if(least.as_ref().map(|(span, least)| (*span, least))),
        /// `choice(0.3: press)`.
        WeightFirst { value: String, weight: String } = Code::WrongArguments =>
            say("a weight stands behind its value", "the other way round")
                .help(format!("write `{value}: {weight}`")),
        /// `count` and its like without one set of players.
        OneSet { function: &'static str, signature: String } = Code::WrongArguments =>
            say(format!("`{function}` goes through one set of players"), "").help(format!("`{signature}`")),
        /// `count` and its like of something that is no set.
        WhichPlayers { function: &'static str, signature: String } = Code::WrongArguments =>
            say(format!("`{function}` doesn't say which players"), "").help(format!("`{signature}`")),
        /// `mean` and its like of a team without players, at the start.
        NobodyToCount { function: &'static str } = Code::Impossible =>
            say(format!("`{function}` goes through nobody"), "the team has no players"),
        /// `grid(…)` outside of a loop.
        GridAlone = Code::WrongType =>
            say("a grid is gone through by a loop", "no value")
                .help("write, for example, `mean(distance(p, ball) for p in grid(16, 12))`"),
        /// A grid in the start.
        GridAtStart = Code::WrongScope =>
            say("the start has no loops over points", "the match hasn't begun here")
                .help("compute it in a reward, a record or an ending"),
        /// A side of a grid that is no small number.
        GridSide { most: f64 } = Code::OutOfRange =>
            say(format!("a grid has 1 to {most} points, as many in every episode"), "")
                .help("write whole numbers, for example `grid(16, 12)`"),
        /// `min_gap` of fewer than two players.
        NoGap = Code::Impossible =>
            say("a gap needs two players", "there are fewer").help("leave the requirement out"),
        /// Loops inside loops.
        TooManyLoops { most: usize } = Code::Impossible =>
            say(format!("more than {most} loops stand inside each other"), "")
                .help("compute the inner one before, with a `let`"),
        /// Uses of definitions without an end in sight.
        TooLarge { name: String } = Code::Impossible =>
            say(format!("`{name}` makes the program too large"), "")
                .help("use it less often, or name its value with a `let`"),
        /// An expression deeper than is lowered.
        TooDeep = Code::TooDeep =>
            say("the expression is nested too deeply", "").help("name a part of it with `let`"),
        /// A function that the compiler doesn't know yet.
        NotYet {
            function: &'static str,
        } = Code::NotYet => say(format!("`{function}` is not supported yet"), ""),
        /// `min_by` and its like at the start.
        NotYetAtStart { function: &'static str } = Code::NotYet =>
            say(format!("`{function}` in the start is not supported yet"), "").help("name the player"),
        /// A polygon with too few or too many corners.
        Corners { most: usize, found: usize } = Code::WrongArguments =>
            say(format!("a polygon has 3 to {most} corners, found {found}"), "").help(CORNERS),
        /// A corner with a name.
        CornerWithName = Code::WrongArguments => say("a polygon's corners have no names", "").help(CORNERS),
        /// `by` of an event that nobody does.
        NobodyDoes { event: String } = Code::WrongArguments =>
            say(format!("nobody does `{event}`"), "`by` says nothing here").help(format!("write `{event}` alone")),
        /// `to` of an event that reaches nobody; `others`: the events that have one.
        ReachesNobody { event: String, others: Vec<&'static str> } = Code::WrongArguments =>
            say(format!("`{event}` reaches nobody"), "`to` says nothing here")
                .help(format!("leave it out; `to` belongs to `{}`", others.join("`, `"))),
        /// `event.by` or `event.to` of an event that has none.
        AlwaysNobody { event: String, is_receiver: bool } = Code::WrongArguments => {
            let message =
                if *is_receiver { format!("`{event}` reaches nobody") } else { format!("nobody does `{event}`") };
            say(message, "always nobody").help("leave it out")
        },
        /// A qualifier that an event never has.
        NeverQualified {
            event: String,
            qualifier: String,
            known: Vec<&'static str>,
        } = Code::UnknownEvent =>
            say(format!("`{event}` is never `{qualifier}`"), "").help(if known.is_empty() {
                format!("write `{event}` alone")
            } else {
                format!("it can be `{}`", known.join("`, `"))
            }),
    }
}

const CORNERS: &str = "write its corners in order: `polygon((0, 0), (0.5, 0), (0.5, 0.2))`";

/// How a missing argument is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Form {
    /// As a function of the language is: its signature.
    Builtin(String),
    /// With the parameter's name.
    Named,
    /// Not known.
    Unknown,
}
