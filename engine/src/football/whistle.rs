//! The whistle: stops and resumes play.
//!
//! The reasons are decided by `referee`, `offside`, `foul` and `advantage`. `restart` places the
//! ball and the players.

use crate::football::report;
use crate::state::Match;
use crate::state::event::Events;
use crate::state::play::Restart;
use glam::Vec2;
use setpiece_scenario::pitch::BALL_RADIUS_M;
use setpiece_scenario::vocabulary::{EventKind, GameMode, Team};

/// Stops play; a restart follows.
pub fn stop(game: &mut Match, events: &mut Events, mode: GameMode, team: Team, spot: Vec2) {
    if game.dead {
        return;
    }
    game.dead = true;
    game.owner = None;
    game.play.received = None;
    game.play.pending = Some(Restart { mode, team, spot });
    let spot = spot.extend(BALL_RADIUS_M as f32);
    events.push(report::event(game, event_of(mode)).team(team).at(spot));
}

/// The event that awards a set piece.
pub fn event_of(mode: GameMode) -> EventKind {
    match mode {
        GameMode::Normal | GameMode::KickOff => EventKind::Kickoff,
        GameMode::GoalKick => EventKind::GoalKick,
        GameMode::FreeKick => EventKind::FreeKick,
        GameMode::Corner => EventKind::Corner,
        GameMode::ThrowIn => EventKind::ThrowIn,
        GameMode::Penalty => EventKind::Penalty,
    }
}

/// Ends the kick-off: it has been taken, or given up.
pub fn end_kick_off(game: &mut Match) {
    if game.play.kick_off.take().is_some() {
        game.mode = GameMode::Normal;
    }
}
