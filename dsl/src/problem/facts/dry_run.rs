//! What a dry run of a compiled scenario finds: the caller tries it, as the compiler doesn't play.

use super::facts;
use crate::problem::Code;
use crate::problem::said::{Said, say};
use crate::source::Span;

facts! {
    /// What a dry run found. `elsewhere`: the part at fault, where the problem's place is the
    /// scenario.
    pub DryRun {
        /// An ending holds at the start.
        EndsAtOnce {
            /// The scenario's name.
            scenario: String,
            /// The ending's label.
            ending: String,
            /// The ending's place, if it stands in another file.
            elsewhere: Option<Span>,
        } = Code::EndsAtOnce =>
            part(format!("`{scenario}` is over before its first step"), "holds at the start".to_owned(), elsewhere.as_ref())
                .help(format!(
                    "the ending `{ending}` holds at the start: place the players and the ball where it doesn't hold, \
                     or let it wait: `… and elapsed > 1s`"
                )),
        /// Few attempts at a start meet the requirements, or none.
        HardToDraw {
            /// The scenario's name.
            scenario: String,
            /// How many attempts met all requirements.
            met: u32,
            /// How many attempts were made.
            attempts: u32,
            /// The requirement that failed most often.
            hardest: String,
            /// What makes it hold.
            cure: Cure,
            /// Whether the requirement stands in a text.
            is_located: bool,
            /// The requirement's place, if it stands in another file.
            elsewhere: Option<Span>,
        } = if *met == 0 { Code::ImpossibleToDraw } else { Code::HardToDraw } => {
            let message = if *met == 0 { "can't be started" } else { "is seldom drawn" };
            let share = share(*met, *attempts);
            let label = if *is_located && *attempts > 1 { format!("fails most often; {share}") } else { share };
            part(format!("`{scenario}` {message}"), label, elsewhere.as_ref())
                .help(format!("`{hardest}` fails most often: {}", cure.words()))
        },
        /// A check is played with the policy of a scenario that has none.
        NoBaseline {
            /// The scenario's name.
            scenario: String,
            /// What differs from the library's scenario of that name, if that one has a policy.
            differs: Option<String>,
            /// The scenarios that have one.
            known: Vec<String>,
        } = Code::NoBaseline => match differs {
            Some(what) => say(
                format!("`{scenario}` has no baseline: it isn't the library's of this name"),
                format!("{what} differs"),
            )
            .help("name another agent: `with bot`; `setpiece test --agent FILE.onnx` plays any policy"),
            None => say(format!("`{scenario}` has no baseline"), "plays every slot")
                .help(format!("these have one: `{}`", known.join("`, `"))),
        },
    }
}

/// What makes a requirement hold.
#[derive(Clone, Debug, PartialEq)]
pub enum Cure {
    /// What the compiler knows of a requirement that it made itself.
    Known(String),
    /// The author wrote it.
    Loosen,
    /// Every number must be finite.
    Divisor,
    /// Players stand on the pitch, and apart.
    Spread,
}

impl Cure {
    fn words(&self) -> &str {
        match self {
            Cure::Known(help) => help,
            Cure::Loosen => "loosen it, or place the players so that it holds",
            Cure::Divisor => "look for a division by 0",
            Cure::Spread => "place them further from the lines and from each other",
        }
    }
}

/// Marks the part at fault, or the scenario where there is none.
fn part(said: String, label: String, elsewhere: Option<&Span>) -> Said {
    match elsewhere {
        Some(at) => say(said, "").at(at, label),
        None => say(said, label),
    }
}

fn share(met: u32, attempts: u32) -> String {
    match (met, attempts) {
        (0, 1) => "its start doesn't meet the requirements".to_owned(),
        (0, _) => format!("none of {attempts} starts meets the requirements"),
        _ => format!("{met} of {attempts} starts meet the requirements"),
    }
}
