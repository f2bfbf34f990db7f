//! Players in rows of four, as many as one instruction works on.

use setpiece_scenario::pitch::PLAYERS_MAX;

/// Numbers of a row.
pub(crate) const WIDTH: usize = 4;
/// Rows that hold everybody.
pub(crate) const ROWS: usize = PLAYERS_MAX.div_ceil(WIDTH);

/// A number for each of four.
pub(crate) type Lane = [f32; WIDTH];
