//! The super mini map: a small picture with four planes.

use super::frame::SideFrame;
use super::{ObserveError, check_size, slot};
use crate::state::Match;

/// Width of GRF's map.
pub const SMM_WIDTH: usize = 96;
/// Height of GRF's map.
pub const SMM_HEIGHT: usize = 72;
/// Own team, opponents, ball, controlled player.
const PLANES: usize = 4;
const SET: u8 = 255;
/// The map shows x within ± this.
const X_EDGE: f64 = 1.0;
/// The map shows y within ± this.
const Y_EDGE: f64 = 1.0 / 2.25;

/// Bytes of a map.
pub fn smm_size(width: usize, height: usize) -> usize {
    width * height * PLANES
}

/// Writes agent `agent`'s map: row by row from the top, the four planes of a pixel together, 0 or
/// 255.
///
/// Planes: own team, opponents, ball, the controlled player (empty without one). Anything outside
/// is drawn at the edge.
///
/// # Errors
/// [`ObserveError`] for unknown agents, or a buffer whose size isn't [`smm_size`]; nothing is
/// written then.
pub fn smm(
    game: &Match,
    agent: usize,
    width: usize,
    height: usize,
    out: &mut [u8],
) -> Result<(), ObserveError> {
    let slot = slot(game, agent)?;
    check_size(out.len(), smm_size(width, height))?;
    out.fill(0);
    let frame = SideFrame { game, us: slot.team };
    let mut mark = |[x, y]: [f64; 2], plane: usize| {
        let column = pixel((x + X_EDGE) / (2.0 * X_EDGE), width);
        let row = pixel((y + Y_EDGE) / (2.0 * Y_EDGE), height);
        if let Some(byte) = out.get_mut((row * width + column) * PLANES + plane) {
            *byte = SET;
        }
    };
    for (plane, team) in frame.teams().into_iter().enumerate() {
        for (_, player) in frame.roster(team).filter(|(_, player)| player.active) {
            mark(frame.place_of(player.pos), plane);
        }
    }
    let [x, y, _] = frame.ball();
    mark([x, y], 2);
    if let Some(player) =
        slot.player.map(|player| game.player(player)).filter(|player| player.active)
    {
        mark(frame.place_of(player.pos), 3);
    }
    Ok(())
}

/// The pixel of a share of the picture, clamped to it.
fn pixel(share: f64, n: usize) -> usize {
    // The cast truncates, and saturates at 0.
    ((share * n as f64) as usize).min(n.saturating_sub(1))
}
