//! The order of a step, and of what comes before the first and after each.
//!
//! Stands above [`football`](crate::football) and [`control`], of which neither calls the other's turn. Whoever
//! judges a step does so between [`play`] and [`go_on`].

use crate::control;
use crate::football::{begin, clock, fatigue, forecast, reach, recent, restart, switching, tick};
use crate::laps::Phase;
use crate::math;
use crate::physics::Scratch;
use crate::start::Drawn;
use crate::state::Match;
use crate::state::event::Events;
use setpiece_scenario::pitch::TICKS_PER_STEP;
use setpiece_scenario::vocabulary::Action;

/// The match that a drawn start begins with, ready for its first step.
pub fn begin(drawn: &Drawn) -> Match {
    let mut game = begin::begin(drawn);
    // Each agent's first action is for the player that the start gives it, wherever the ball is. (GRF's.)
    look_ahead(&mut game);
    game
}

/// Before a step: who can be at the ball first, and which player each agent has in it.
pub fn prepare(game: &mut Match) {
    look_ahead(game);
    switching::update(game);
}

/// Finds out where the ball goes, and who can be at it first.
fn look_ahead(game: &mut Match) {
    forecast::refresh(game);
    reach::assess(game);
}

/// Plays one step of 100 ms: `actions[i]` is slot i's, in the own frame of its team. Stops early when play stops
/// (`Match::dead`), so that goals and the ball out of play are judged where they happened.
pub fn play(game: &mut Match, actions: &[Action], events: &mut Events, scratch: &mut Scratch) {
    let from = game.tick;
    if !game.dead {
        control::command(game, actions, events);
        scratch.laps().end(Phase::Bots);
        for _ in 0..TICKS_PER_STEP {
            tick::advance(game, events, scratch);
            if game.dead {
                break;
            }
        }
        game.each(game.squad, |player| player.heading_rad = math::heading(player.body.facing));
        recent::remember(game);
        fatigue::tire(game, game.tick - from);
        scratch.laps().end(Phase::Movement);
    }
    clock::end_step(game, events);
    if from == 0 && !game.dead {
        switching::update(game);
    }
}

/// Goes on after a step that has been judged: play that was stopped is restarted (ball and players are placed; dead
/// time costs no step), and every agent gets its player of the step to come.
pub fn go_on(game: &mut Match) {
    if game.dead {
        restart::apply(game);
    }
    prepare(game);
}
