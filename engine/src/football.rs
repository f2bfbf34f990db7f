//! The game: players, touches, kicks, the referee.

use crate::event::Events;
use crate::physics::Scratch;
use crate::start::Drawn;
use crate::state::Match;
use setpiece_scenario::vocabulary::Action;

/// The match that a drawn start begins with.
pub fn begin(drawn: &Drawn) -> Match {
    Match::blank(drawn)
}

/// Plays one step of 100 ms: `actions[i]` is slot i's, in the own frame of its team. Stops early when play stops
/// (`Match::dead`), so that goals and the ball out of play are judged where they happened.
pub fn play_step(game: &mut Match, actions: &[Action], events: &mut Events, scratch: &mut Scratch) {
    let _ = (actions, events, scratch);
    game.step += 1;
}

/// Applies the restart that a stop of play calls for: ball and players are placed, `dead` ends. Dead time costs no step.
pub fn restart(game: &mut Match, events: &mut Events) {
    let _ = events;
    game.dead = false;
}
