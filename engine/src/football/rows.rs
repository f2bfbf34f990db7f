//! Players in rows of four, as many as one instruction works on.

use setpiece_scenario::pitch::PLAYERS_MAX;

/// Numbers of a row.
pub(super) const WIDTH: usize = 4;
/// Rows that hold everybody.
pub(super) const ROWS: usize = PLAYERS_MAX.div_ceil(WIDTH);

/// A number for each of four.
pub(super) type Lane = [f32; WIDTH];
