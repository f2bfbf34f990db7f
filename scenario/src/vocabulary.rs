//! Every list of words that is needed in more than one place, once.
//!
//! The compiler checks against these tables, the engine matches their enums exhaustively, and Rhai,
//! the docs and Python read them. A row has a name in the language and one line of documentation.

mod action;
mod agent;
mod event;
mod function;
mod measure;
mod option;
mod pitch;
mod places;
mod primitive;
mod property;
mod role;
mod rule;
mod types;
mod value;
mod world;

pub use action::{Action, StickyAction};
pub use agent::AGENTS;
pub use event::{EventField, EventKind, Qualifier};
pub use function::Function;
pub use measure::{MeasureWord, QuantityWord};
pub use option::{
    AgentsOption, BallOption, PlayerOption, StartOption, SubstituteOption, TeamOption,
};
pub use pitch::{PitchFigure, PitchMeasure};
pub use places::{Along, Landmark, PitchRect, PitchRegion, RegionName, RegionShape};
pub use primitive::Primitive;
pub use property::{Field, Owner, PROPERTIES, Property};
pub use role::{Role, Stat, Team};
pub use rule::{GameMode, Rule, StartKind, Verdict};
pub use types::{Type, Unit};
pub use value::ValueWord;
pub use world::{WIND_MAX_MPS, WorldFigure};

/// Declares an enum whose variants have a name in the language and a line of documentation.
macro_rules! words {
    ($(#[$meta:meta])* $name:ident { $($variant:ident = $word:literal, $doc:literal;)+ }) => {
        $(#[$meta])*
        #[allow(clippy::doc_markdown, reason = "the rows' text is for people, not for rustdoc")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[derive(serde::Serialize, serde::Deserialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        pub enum $name {
            $(#[doc = $doc] #[serde(rename = $word)] $variant,)+
        }

        impl $name {
            /// Every variant, in the table's order.
            pub const ALL: &'static [$name] = &[$($name::$variant,)+];

            /// The name of every variant, in the table's order.
            pub const NAMES: &'static [&'static str] = &[$($word,)+];

            /// The name in the language.
            pub const fn name(self) -> &'static str {
                match self { $($name::$variant => $word,)+ }
            }

            /// One line of documentation.
            pub const fn doc(self) -> &'static str {
                match self { $($name::$variant => $doc,)+ }
            }

            /// Finds a variant by its name in the language.
            pub fn from_name(name: &str) -> Option<$name> {
                Self::ALL.iter().copied().find(|word| word.name() == name)
            }

            /// The variant's index in [`Self::ALL`].
            #[inline]
            pub const fn index(self) -> usize {
                self as usize
            }

            /// The variant at an index in [`Self::ALL`].
            pub fn from_index(index: usize) -> Option<$name> {
                Self::ALL.get(index).copied()
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.name())
            }
        }
    };
}
pub(crate) use words;
