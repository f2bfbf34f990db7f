//! What a checked scenario must meet: types and units, the language's own names, and the tables of
//! options.

pub(crate) mod names;
pub(crate) mod options;
pub(crate) mod types;
