//! `simple115v2`, with or without the held keys, and its predecessor `simple115`.

use super::frame::SideFrame;
use super::layout::{SIMPLE115, SIMPLE115_STICKY};
use super::{ObserveError, check_size, slot};
use crate::state::{AgentSlot, Match};
use setpiece_scenario::pitch::TEAM_MAX;

/// The value of a missing player.
const MISSING: f32 = -1.0;

/// Writes agent `agent`'s `simple115v2` observation; the layout is [`super::layout::simple115v2`].
///
/// # Errors
/// [`ObserveError`] for unknown agents, or a buffer that doesn't have 115 numbers; nothing is
/// written then.
pub fn simple115v2(game: &Match, agent: usize, out: &mut [f32]) -> Result<(), ObserveError> {
    write_v2(game, agent, SIMPLE115, MISSING, out)
}

/// Writes agent `agent`'s `simple115v2+sticky` observation: `simple115v2` followed by the held
/// keys. The layout is [`super::layout::simple115v2_sticky`].
///
/// # Errors
/// [`ObserveError`] for unknown agents, or a buffer that doesn't have 125 numbers; nothing is
/// written then.
pub fn simple115v2_sticky(game: &Match, agent: usize, out: &mut [f32]) -> Result<(), ObserveError> {
    write_v2(game, agent, SIMPLE115_STICKY, MISSING, out)
}

/// Writes `simple115v2` and as many held keys as `expected` has room for. `missing` fills the
/// numbers of missing players.
pub(super) fn write_v2(
    game: &Match,
    agent: usize,
    expected: usize,
    missing: f32,
    out: &mut [f32],
) -> Result<(), ObserveError> {
    let slot = slot(game, agent)?;
    check_size(out.len(), expected)?;
    let frame = SideFrame { game, us: slot.team };
    let (out, held) = out.split_at_mut(SIMPLE115);
    out.fill(0.0);
    for (block, team) in frame.teams().into_iter().enumerate() {
        let base = block * 4 * TEAM_MAX;
        out[base..base + 4 * TEAM_MAX].fill(missing);
        for (place, (_, player)) in
            frame.roster(team).enumerate().filter(|(_, (_, player))| player.active)
        {
            let at = base + 2 * place;
            write(&mut out[at..at + 2], &frame.place_of(player.pos), &[2.0, 1.5]);
            let at = at + 2 * TEAM_MAX;
            write(&mut out[at..at + 2], &frame.stride_of(player.vel), &[1.0, 1.0]);
        }
    }
    write_ball_and_modes(game, frame, slot, out);
    for (bit, held) in held.iter_mut().enumerate() {
        *held = f32::from(slot.sticky >> bit & 1);
    }
    Ok(())
}

/// Writes agent `agent`'s `simple115` observation: the four blocks of players without gaps. The
/// layout is [`super::layout::simple115`].
///
/// # Errors
/// [`ObserveError`] for unknown agents, or a buffer that doesn't have 115 numbers; nothing is
/// written then.
pub fn simple115(game: &Match, agent: usize, out: &mut [f32]) -> Result<(), ObserveError> {
    let slot = slot(game, agent)?;
    check_size(out.len(), SIMPLE115)?;
    let frame = SideFrame { game, us: slot.team };
    out.fill(0.0);
    out[..8 * TEAM_MAX].fill(MISSING);
    let mut at = 0;
    for team in frame.teams() {
        for place in [true, false] {
            for (_, player) in frame.roster(team) {
                if player.active && place {
                    write(&mut out[at..at + 2], &frame.place_of(player.pos), &[2.0, 1.5]);
                } else if player.active {
                    write(&mut out[at..at + 2], &frame.stride_of(player.vel), &[1.0, 1.0]);
                }
                at += 2;
            }
        }
    }
    write_ball_and_modes(game, frame, slot, out);
    Ok(())
}

/// Writes what follows the players in both layouts.
fn write_ball_and_modes(game: &Match, frame: SideFrame<'_>, slot: AgentSlot, out: &mut [f32]) {
    write(&mut out[88..91], &frame.ball(), &[2.0, 1.5, 100.0]);
    out[90] = out[90].max(0.0);
    write(&mut out[91..94], &frame.ball_stride(), &[1.0, 1.0, 10.0]);
    out[94 + frame.owner().map_or(0, |(team, _)| 1 + team)] = 1.0;
    if let Some(place) = slot.player.and_then(|player| frame.place(player)) {
        out[97 + place] = 1.0;
    }
    out[108 + game.mode.index()] = 1.0;
}

/// Writes numbers, clamped to ± the bounds of their space.
fn write(out: &mut [f32], values: &[f64], bounds: &[f32]) {
    for ((out, value), bound) in out.iter_mut().zip(values).zip(bounds) {
        *out = (*value as f32).clamp(-bound, *bound);
    }
}
