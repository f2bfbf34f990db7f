//! The game: players, touches, kicks, the referee.
//!
//! Decides everything that happens on the pitch in a tick but two things: how a free ball flies and rebounds is
//! [`crate::physics`]'s, what players want to do is [`crate::control`]'s. What it all changes is [`crate::state`]. Inside:
//! [`movement`] (with `stride`), [`separation`] and [`mod@frame`] move bodies; [`reach`] says who is at the ball first;
//! [`touch`] (with `dribble` and `first_touch`), [`duel`], [`slide`], [`kick`] (with [`pass`] and [`shot`]) and [`keeper`]
//! play it, and it may [`bounce`] off a body; [`contact`] says what that means; [`referee`], [`offside`] and [`foul`] have
//! the [`whistle`] stop play, [`advantage`] lets it run, and [`mod@restart`] goes on; [`set_piece`] and [`lineup`] say who
//! stands where.

pub mod advantage;
pub mod begin;
pub mod block;
pub mod bounce;
pub mod clock;
pub mod contact;
mod dribble;
pub mod duel;
pub mod fatigue;
mod first_touch;
pub mod forecast;
pub mod foul;
pub mod frame;
pub mod keeper;
pub mod kick;
pub mod lineup;
pub mod movement;
pub mod noise;
pub mod offside;
pub mod pass;
pub mod pass_target;
pub mod possession;
pub mod reach;
pub mod recent;
pub mod referee;
pub mod report;
pub mod restart;
pub mod separation;
pub mod set_piece;
pub mod shot;
pub mod slide;
pub mod stats;
mod stride;
pub mod stumble;
pub mod tick;
pub mod touch;
pub mod whistle;

use crate::control;
use crate::laps::Phase;
use crate::physics::Scratch;
use crate::start::Drawn;
use crate::state::Match;
use crate::state::event::Events;
use setpiece_scenario::pitch::TICKS_PER_STEP;
use setpiece_scenario::vocabulary::Action;

/// The match that a drawn start begins with.
pub fn begin(drawn: &Drawn) -> Match {
    begin::begin(drawn)
}

/// Plays one step of 100 ms: `actions[i]` is slot i's, in the own frame of its team. Stops early when play stops
/// (`Match::dead`), so that goals and the ball out of play are judged where they happened.
pub fn play_step(game: &mut Match, actions: &[Action], events: &mut Events, scratch: &mut Scratch) {
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
        game.each(game.squad, |player| player.heading_rad = crate::math::heading(player.body.facing));
        recent::remember(game);
        fatigue::tire(game, game.tick - from);
        scratch.laps().end(Phase::Movement);
    }
    clock::end_step(game, events);
}

/// Goes on after a step that has been judged: play that was stopped is restarted (ball and players are placed; dead time
/// costs no step), and every agent gets its player of the step to come.
pub fn go_on(game: &mut Match) {
    if game.dead {
        restart::apply(game);
    }
    control::prepare(game);
}
