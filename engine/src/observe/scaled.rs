//! `scale`: observations in units in which most numbers lie within ± 1.

use super::layout::{self, SIMPLE115, SIMPLE115_STICKY};
use super::simple115::write_v2;
use super::{ObserveError, Scaled, egocentric};
use crate::state::Match;
use setpiece_scenario::pitch::TEAM_MAX;
use std::sync::LazyLock;

/// The factors of `simple115v2+sticky`; those of `simple115v2` are their beginning.
static SIMPLE: LazyLock<Vec<f32>> = LazyLock::new(|| layout::simple115v2_sticky().factors());

/// The factors of `egocentric` for the largest teams. Those of smaller teams are their beginning,
/// because every other player has the same factors.
static EGOCENTRIC: LazyLock<Vec<f32>> = LazyLock::new(|| layout::egocentric(TEAM_MAX).factors());

/// The value of a missing player. GRF's -1 would become constants down to -83.6.
const MISSING: f32 = 0.0;

/// Writes agent `agent`'s observation in the units of [`layout::Layout::scaled`]. `team` is the
/// larger team's size.
///
/// # Errors
/// [`ObserveError`] for unknown agents, or a buffer of another size; nothing is written then.
pub fn scaled(
    game: &Match,
    agent: usize,
    of: Scaled,
    team: usize,
    out: &mut [f32],
) -> Result<(), ObserveError> {
    let factors = match of {
        Scaled::Simple115v2 => {
            write_v2(game, agent, SIMPLE115, MISSING, out)?;
            &SIMPLE
        }
        Scaled::Simple115v2Sticky => {
            write_v2(game, agent, SIMPLE115_STICKY, MISSING, out)?;
            &SIMPLE
        }
        Scaled::Egocentric => {
            egocentric(game, agent, team, out)?;
            &EGOCENTRIC
        }
    };
    for (value, factor) in out.iter_mut().zip(factors.iter()) {
        *value *= factor;
    }
    Ok(())
}
