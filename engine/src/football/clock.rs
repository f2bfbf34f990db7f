//! The clock: half-time and full time.

use crate::football::{report, whistle};
use crate::state::Match;
use crate::state::event::Events;
use glam::Vec2;
use setpiece_scenario::vocabulary::{EventKind, GameMode, Rule};

/// Ends a step: counts it, and blows for half-time or full time.
pub fn end_step(game: &mut Match, events: &mut Events) {
    game.step += 1;
    if let Some(set_piece) = &mut game.play.set_piece {
        set_piece.waited_steps = set_piece.waited_steps.saturating_add(1);
    }
    let half_time = game.rules[Rule::HalfTime.index()];
    let on_clock = f64::from(game.step + game.elapsed_at_start);
    let due = half_time > 0.0 && on_clock >= half_time && !game.play.second_half;
    if due && !game.dead && game.play.set_piece.is_none() {
        game.play.second_half = true;
        events.push(report::event(game, EventKind::HalfTime));
        for player in &mut game.players {
            player.fatigue = 0.0;
        }
        whistle::stop(game, events, GameMode::KickOff, game.play.first_kickoff.other(), Vec2::ZERO);
    }
    if game.limit_steps.is_some_and(|limit| game.step >= limit) {
        events.push(report::event(game, EventKind::FullTime));
    }
}
