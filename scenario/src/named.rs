//! What a script reads of its scenario and its file by name.

use crate::program::{Program, Reg};
use crate::vocabulary::Type;
use serde::{Deserialize, Serialize};

/// A name of the scenario or the file that a script may read, and the program that computes it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NamedValue {
    /// The name.
    pub name: String,
    /// What it is.
    pub kind: NamedKind,
    /// Computes it from the state that is read; the judged team is the reader's.
    pub program: Program,
    /// Its registers, as many as [`NamedKind::n_values`] says.
    pub values: Vec<Reg>,
}

/// What a script gets under a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum NamedKind {
    /// A value.
    Value(Type),
    /// A region: whether the point in the program's first two cells lies in it.
    Region,
    /// A table: its numbers at that point, of the cell and between the cells.
    Table,
}

impl NamedKind {
    /// The number of its registers.
    pub fn n_values(self) -> usize {
        match self {
            NamedKind::Value(Type::Point) | NamedKind::Table => 2,
            NamedKind::Value(_) | NamedKind::Region => 1,
        }
    }

    /// The number of its program's memory cells: the coordinates of a point, metres.
    pub fn n_cells(self) -> u32 {
        if matches!(self, NamedKind::Value(_)) { 0 } else { 2 }
    }
}
