//! Players in rows of four, as many as one instruction processes.

use setpiece_scenario::pitch::PLAYERS_MAX;

/// Numbers in a row.
pub(crate) const WIDTH: usize = 4;
/// Rows that hold all players.
pub(crate) const ROWS: usize = PLAYERS_MAX.div_ceil(WIDTH);

/// One number for each of four players.
pub(crate) type Lane = [f32; WIDTH];
