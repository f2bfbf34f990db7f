//! The facts that stages find, by subject, each beside its words.
//!
//! A stage reports a fact with its data. Only this folder turns it into words, and only when a
//! report is rendered: to change a report, change the entry of its fact. An entry is
//!
//! ```text
//! /// When it is reported.
//! Name { data: Type, … } = its code =>
//!     say(message, what the marked text is).help(what to write instead),
//! ```
//!
//! The words read the data by reference.

mod behaviors;
mod bounds;
mod brackets;
mod calls;
mod chance;
mod dry_run;
mod files;
mod implied;
mod names;
mod plans;
mod players;
mod rewards;
mod scenario;
mod scope;
mod start;
mod syntax;
mod tables;
mod types;

pub(crate) use behaviors::Behaviors;
pub(crate) use bounds::Bounds;
pub(crate) use brackets::Brackets;
pub(crate) use calls::{Calls, Form};
pub(crate) use chance::Chance;
pub use dry_run::{Cure, DryRun};
pub(crate) use files::{Files, ImportLimit, ScriptLimit};
pub(crate) use implied::Implied;
pub(crate) use names::{Assigned, Kind, Like, Names, NotAFunction};
pub(crate) use plans::Plans;
pub(crate) use players::{AskedFor, Players};
pub(crate) use rewards::{Because, Never, Rewards};
pub(crate) use scenario::{Declared, Whole};
pub(crate) use scope::{BeforeOutside, Scopes, ViewOutside};
pub(crate) use start::Starts;
pub(crate) use syntax::{Hint, ROUND, Syntax, UnitGuess};
pub(crate) use tables::Tables;
pub(crate) use types::{Instead, Operand, Types, Undeclared, Use, Verb};

use super::Code;
use super::said::Said;

/// Declares the facts of a subject.
macro_rules! facts {
    ($(#[$about:meta])* $vis:vis $group:ident {
        $(
            $(#[$doc:meta])*
            $name:ident $({ $($(#[$of:meta])* $field:ident: $ty:ty),+ $(,)? })?
                = $code:expr => $words:expr,
        )+
    }) => {
        $(#[$about])*
        #[derive(Clone, Debug, PartialEq)]
        $vis enum $group {
            $($(#[$doc])* $name $({ $($(#[$of])* $field: $ty),+ })?,)+
        }

        impl $group {
            /// Its code.
            #[allow(unused_variables, reason = "most codes don't depend on the data")]
            pub(in crate::problem) fn code(&self) -> $crate::problem::Code {
                match self { $($group::$name $({ $($field),+ })? => $code,)+ }
            }

            /// Its words.
            #[allow(unused_variables, reason = "some data decides the code alone")]
            pub(in crate::problem) fn words(&self) -> super::Said {
                match self { $($group::$name $({ $($field),+ })? => $words,)+ }
            }
        }
    };
}
use facts;

/// Declares all facts from their subjects.
macro_rules! subjects {
    ($($(#[$about:meta])* $subject:ident,)+) => {
        /// What a stage found.
        #[derive(Clone, Debug, PartialEq)]
        pub(crate) enum Fact {
            $($(#[$about])* $subject($subject),)+
        }

        impl Fact {
            /// Its code.
            pub(super) fn code(&self) -> Code {
                match self { $(Fact::$subject(fact) => fact.code(),)+ }
            }

            /// Its words.
            pub(super) fn words(&self) -> Said {
                match self { $(Fact::$subject(fact) => fact.words(),)+ }
            }
        }

        $(impl From<$subject> for Fact {
            fn from(fact: $subject) -> Fact {
                Fact::$subject(fact)
            }
        })+
    };
}

subjects! {
    /// Draws and constants.
    Chance,
    /// Names.
    Names,
    /// Types and units.
    Types,
    /// Found by a dry run.
    DryRun,
    /// A scenario as a whole.
    Whole,
    /// Arguments and calls.
    Calls,
    /// What is not known where it is used.
    Scopes,
    /// Ranges.
    Bounds,
    /// Players and teams.
    Players,
    /// The start of an episode.
    Starts,
    /// Rewards, endings and observations.
    Rewards,
    /// Behaviors.
    Behaviors,
    /// Suites, checks and curricula.
    Plans,
    /// Imports and scripts.
    Files,
    /// Tables.
    Tables,
    /// Syntax.
    Syntax,
    /// Brackets, strings and comments.
    Brackets,
}

impl Fact {
    /// Whether the file has no scenario that can be run, or not the one that was asked for.
    pub(crate) fn misses_scenario(&self) -> bool {
        matches!(self, Fact::Whole(whole) if whole.code() == Code::NoScenario)
    }

    /// Whether a child of the scenario may bring what is missing.
    pub(crate) fn child_may_bring(&self) -> bool {
        matches!(self, Fact::Names(names) if names.child_may_bring())
    }
}
