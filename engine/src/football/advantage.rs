//! Advantage: after a foul the referee lets play run if the fouled team may gain more by it.
//!
//! The referee decides nothing at first. If the fouled team then loses the ball, or the ball leaves
//! the pitch, the free kick is given after all. A team that keeps the ball long enough, or scores,
//! has had its advantage.

use crate::football::{report, whistle};
use crate::state::event::Events;
use crate::state::play::{Advantage, Restart};
use crate::state::{Match, PlayerId};
use setpiece_scenario::vocabulary::EventKind;

/// Ticks before the first decision.
const WAIT_TICKS: u32 = 60;
/// After this many ticks the foul is no longer called back.
const OVER_TICKS: u32 = 300;

/// Lets play run after a foul.
pub fn wait(game: &mut Match, by: PlayerId, victim: PlayerId, restart: Restart) {
    // If a second foul follows, play is called back for the first one.
    game.play.advantage.get_or_insert(Advantage { by, victim, restart, tick: game.tick });
}

/// Checks, once per tick, whether a foul that was let run is called back or settled.
pub fn watch(game: &mut Match, events: &mut Events) {
    let Some(advantage) = game.play.advantage else { return };
    let since = game.tick.saturating_sub(advantage.tick);
    if since < WAIT_TICKS {
        return;
    }
    if game.possession != Some(advantage.restart.team) {
        called_back(game, events);
    } else if since >= OVER_TICKS {
        played(game, events);
    }
}

/// Gives the free kick after all, in place of what would stop play now. False if no foul was let
/// run.
pub fn called_back(game: &mut Match, events: &mut Events) -> bool {
    let Some(Advantage { restart, .. }) = game.play.advantage.take() else { return false };
    game.play.pass = None;
    game.play.shot = None;
    whistle::stop(game, events, restart.mode, restart.team, restart.spot);
    true
}

/// Ends the advantage: the team has had it.
pub fn played(game: &mut Match, events: &mut Events) {
    if let Some(advantage) = game.play.advantage.take() {
        report::did(game, events, EventKind::Advantage, advantage.by, Some(advantage.victim));
    }
}
