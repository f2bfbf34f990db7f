//! How much a call of a script may use, and what it may not name.

/// How deep calls nest.
pub(super) const CALL_LEVELS_MAX: usize = 24;
/// How deep expressions and values nest.
pub(super) const EXPRESSION_DEPTH_MAX: usize = 48;
/// Bytes of a string.
pub(super) const STRING_MAX: usize = 4_096;
/// Elements of a list.
pub(super) const ARRAY_MAX: usize = 4_096;
/// Entries of a map.
pub(super) const MAP_MAX: usize = 512;

/// The keyword that imports a module. Only authors' texts have it; what runs is one text.
pub(super) const IMPORT: &str = "import";
/// Keywords that would give access to the outside, or to more than the limits allow.
pub(super) const DISABLED: &[&str] = &["eval", IMPORT, "export", "**", "**="];

/// The most operations of one call of a hook: a few milliseconds.
pub(super) const OPERATIONS_MAX: u64 = 200_000;

/// Bytes that count as one operation. Copying them takes about as long as an operation. A call that
/// spends every operation on values creates 200,000 × 256 B = 49 MiB. That is less than the 64 MiB
/// that the documentation promises; the rest is for what is too small to count.
pub(super) const BYTES_PER_OPERATION: usize = 256;

/// The functions that `budget` inserts: one counts the size of a value, one counts operations.
pub(super) const COUNTED: &str = "setpiece_counted";
pub(super) const WORKED: &str = "setpiece_worked";
/// What the names of these functions and of modules' functions begin with. Scripts can't define
/// such names.
pub(super) const PREFIX: &str = "setpiece_";

/// Why a call ends, even if the script tries to catch the error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Why {
    /// Its operations were spent on the size of values, not on their number.
    Size,
    /// It uses a value that is being changed.
    Changing,
}

/// What ends a call, and where. (Rhai itself loses the place.)
#[derive(Clone, Copy, Debug)]
pub(super) struct Overspent {
    pub(super) why: Why,
    pub(super) place: Option<(usize, usize)>,
}
