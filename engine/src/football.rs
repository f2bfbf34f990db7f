//! The game: players, touches, kicks, the referee.
//!
//! Decides everything that happens on the pitch in a tick, with two exceptions. How a free ball
//! flies and rebounds is [`crate::physics`]'s; what players want to do is [`crate::control`]'s. The
//! state that it changes is in [`crate::state`]. Inside:
//!
//! - [`movement`] (with `stride` and [`pace`]), [`separation`] and [`mod@frame`] move bodies.
//! - [`reach`] computes who is at the ball first.
//! - [`touch`] (with `dribble`, `dribble_motion` and `first_touch`), [`past`], [`duel`], [`slide`],
//!   [`kick`] (with [`pass`] and [`shot`]) and [`keeper`] (with `save_motion`) play the ball, which
//!   may also [`bounce`] off a body. [`contact`] decides what that means.
//! - [`referee`], [`offside`] and [`foul`] let the [`whistle`] stop play, [`advantage`] lets it
//!   run, and [`mod@restart`] resumes it.
//! - [`set_piece`] and [`lineup`] decide who stands where, and [`switching`] which player each
//!   agent controls.

pub mod advantage;
mod awkward;
pub mod begin;
pub mod block;
pub mod bounce;
mod carry;
pub mod clock;
pub mod contact;
mod dribble;
pub mod dribble_motion;
pub mod duel;
pub mod fatigue;
mod first_touch;
mod foot;
pub mod forecast;
pub mod foul;
pub mod frame;
pub mod keeper;
pub mod kick;
mod leg;
pub mod lineup;
pub mod movement;
pub mod noise;
pub mod offside;
pub mod pace;
pub mod pass;
pub mod pass_target;
pub mod past;
mod poke;
pub mod possession;
pub mod reach;
pub mod recent;
pub mod referee;
pub mod report;
pub mod restart;
mod save_motion;
pub mod separation;
pub mod set_piece;
pub mod shot;
pub mod slide;
pub mod stats;
mod stride;
pub mod stumble;
pub mod substitution;
mod swing;
pub mod switching;
pub mod tick;
pub mod touch;
mod trap;
pub mod whistle;
