//! The order of a step, and of what comes before the first step and after each.
//!
//! [`football`](crate::football) and [`control`] don't call each other; this module calls both. The
//! judge runs between [`play`] and [`go_on`].

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

/// Builds the match of a drawn start. [`hand_over`] comes before its first step.
pub fn begin(drawn: &Drawn) -> Match {
    let mut game = begin::begin(drawn);
    // An agent is first shown the player of a certain place, wherever the ball is. (GRF's.)
    look_ahead(&mut game);
    game
}

/// Prepares a step: who can reach the ball first, and which player each agent controls.
pub fn prepare(game: &mut Match) {
    look_ahead(game);
    switching::update(game);
}

/// Finds out where the ball goes, and who can be at it first.
fn look_ahead(game: &mut Match) {
    forecast::refresh(game);
    reach::assess(game);
}

/// What comes before anybody chooses what to do in a match's first step: a start gives the ball's
/// player to an agent that has already been shown another (GRF's). No-op in later steps.
pub fn hand_over(game: &mut Match) {
    if game.tick == 0 && !game.dead {
        switching::update(game);
        begin::stagger(game);
    }
}

/// Plays one step of 100 ms: `actions[i]` is slot i's, in the own frame of its team. Returns early
/// if play stops (`Match::dead`), so that goals and balls out of play are judged where they
/// happened.
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
}

/// Continues after a judged step. If play was stopped, it is restarted (ball and players are
/// placed; dead time costs no step). Every agent gets its player for the next step.
pub fn go_on(game: &mut Match) {
    if game.dead {
        restart::apply(game);
    }
    prepare(game);
}
