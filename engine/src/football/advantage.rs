//! Advantage: a foul that the referee lets run while the victim's team may gain more by playing on.
//!
//! He waits before he looks; whoever has lost the ball by then gets the free kick after all, also when the ball leaves
//! the pitch. A team that keeps it long enough, or scores, has had its advantage.

use crate::football::{report, whistle};
use crate::state::event::Events;
use crate::state::play::{Advantage, Restart};
use crate::state::{Match, PlayerId};
use setpiece_scenario::vocabulary::EventKind;

/// How long nothing is decided, ticks.
const WAIT_TICKS: u32 = 60;
/// After so many ticks there is no way back.
const OVER_TICKS: u32 = 300;

/// Lets play run after a foul.
pub fn wait(game: &mut Match, by: PlayerId, victim: PlayerId, restart: Restart) {
    // The first of two fouls is the one to come back to.
    game.play.advantage.get_or_insert(Advantage { by, victim, restart, tick: game.tick });
}

/// Looks at a foul that was let run, once a tick.
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

/// Gives the free kick after all, in place of what would stop play now; false where no foul was let run.
pub fn called_back(game: &mut Match, events: &mut Events) -> bool {
    let Some(Advantage { restart, .. }) = game.play.advantage.take() else { return false };
    game.play.pass = None;
    game.play.shot = None;
    whistle::stop(game, events, restart.mode, restart.team, restart.spot);
    true
}

/// The advantage has been had.
pub fn played(game: &mut Match, events: &mut Events) {
    if let Some(advantage) = game.play.advantage.take() {
        report::did(game, events, EventKind::Advantage, advantage.by, Some(advantage.victim));
    }
}
