//! What a checked scenario must meet: types and units, the tables of options, and football's own rules.

pub(crate) mod football;
pub(crate) mod names;
pub(crate) mod options;
pub(crate) mod types;
