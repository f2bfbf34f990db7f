//! Files to names: which items a file sees, and what a scenario, reward or formation inherits.
//!
//! Nothing here looks into expressions; a name in an expression is resolved when it is lowered,
//! against the [`Library`] of the file in which it stands.

mod flatten;
mod load;
mod parts;

pub(crate) use flatten::{
    Flat, FlatEnding, FlatParam, FlatTeam, Named, arg_name, ending_declaration, flatten, last_part,
    quoted, reward_declaration, reward_name,
};
pub use load::Prelude;
pub(crate) use load::{Library, MAX_FILES, MAX_IMPORTED_BYTES, NamedItem, load};
pub(crate) use parts::{formation_chain, reward_chain};
