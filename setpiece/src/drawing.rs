//! Draws in text where everybody stands.

use setpiece_engine::state::Match;
use setpiece_scenario::vocabulary::PitchMeasure;
use setpiece_scenario::{PitchSize, Team};

/// The meaning of a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paint {
    /// The left team.
    Left,
    /// The right team.
    Right,
    /// The ball.
    Ball,
    /// A success.
    Success,
    /// A failure.
    Failure,
    /// Anything else.
    Plain,
}

/// Columns and rows of the pitch inside its border.
const COLUMNS: usize = 65;
const ROWS: usize = 19;

/// Draws a match from above, without colours. Players of the left team are digits in source order,
/// those of the right team are letters, and the ball is `o`.
pub fn draw(game: &Match) -> String {
    drawn(game).into_iter().map(|(sign, _)| sign).collect()
}

/// The same sign by sign, each with what it stands for.
pub fn drawn(game: &Match) -> Vec<(char, Paint)> {
    let mut cells = [[(' ', Paint::Plain); COLUMNS]; ROWS];
    markings(&mut cells, &game.pitch);
    for team in Team::ALL {
        for (n, (_, player)) in game.team(*team).enumerate() {
            let (row, column) = cell(&game.pitch, player.pos.x, player.pos.y);
            cells[row][column] = match team {
                Team::Left => (char::from(b'0' + (n % 10) as u8), Paint::Left),
                Team::Right => (char::from(b'a' + n as u8), Paint::Right),
            };
        }
    }
    let (row, column) = cell(&game.pitch, game.ball.pos.x, game.ball.pos.y);
    cells[row][column] = ('o', Paint::Ball);
    let plain = |text: &str| text.chars().map(|sign| (sign, Paint::Plain)).collect::<Vec<_>>();
    let rim = "─".repeat(COLUMNS);
    let mut signs = plain(&format!("  ┌{rim}┐\n"));
    for (row, line) in cells.iter().enumerate() {
        // The goal mouths are open.
        let mouth = row == ROWS / 2;
        let (left, right) = if mouth { ("  ▐", "▌\n") } else { ("  │", "│\n") };
        signs.extend(plain(left));
        signs.extend(line);
        signs.extend(plain(right));
    }
    signs.extend(plain(&format!("  └{rim}┘")));
    signs
}

/// The half-way line, the boxes and the centre spot.
fn markings(cells: &mut [[(char, Paint); COLUMNS]; ROWS], pitch: &PitchSize) {
    for row in cells.iter_mut() {
        row[COLUMNS / 2] = ('┊', Paint::Plain);
    }
    cells[ROWS / 2][COLUMNS / 2] = ('·', Paint::Plain);
    let aside = pitch.measure(PitchMeasure::BoxHalfWidth) as f32;
    let edge = (pitch.measure(PitchMeasure::BoxDepth) - pitch.half_length()) as f32;
    let (top, depth) = cell(pitch, edge, -aside);
    let (bottom, _) = cell(pitch, 0.0, aside);
    for row in cells.iter_mut().take(bottom + 1).skip(top) {
        row[depth] = ('┊', Paint::Plain);
        row[COLUMNS - 1 - depth] = ('┊', Paint::Plain);
    }
}

/// The cell of a place in metres; anything outside the pitch is drawn at its edge.
fn cell(pitch: &PitchSize, x_m: f32, y_m: f32) -> (usize, usize) {
    let column = f32::midpoint(x_m / pitch.half_length() as f32, 1.0) * (COLUMNS - 1) as f32;
    let row = f32::midpoint(y_m / pitch.half_width() as f32, 1.0) * (ROWS - 1) as f32;
    (
        (row.round().max(0.0) as usize).min(ROWS - 1),
        (column.round().max(0.0) as usize).min(COLUMNS - 1),
    )
}
