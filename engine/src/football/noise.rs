//! Chance in play: what happens or not, and the noise of what happens.
//!
//! The rule `stochastic` switches the noise off, and makes what happens or not the same in every match: its streams are
//! then keyed by no seed.

use crate::random::{Purpose, Stream};
use crate::start::Drawn;
use crate::state::Match;
use setpiece_scenario::vocabulary::Rule;

/// The stream of a purpose for a match: the episode's own, or the one of all matches without noise.
pub fn stream(drawn: &Drawn, purpose: Purpose) -> Stream {
    let (seed, index) = if drawn.rules[Rule::Stochastic.index()] == 0.0 { (0, 0) } else { (drawn.seed, drawn.index) };
    Stream::new(seed, index, purpose)
}

/// Whether what is this likely happens: a tackle won, a ball held.
pub fn happens(game: &mut Match, likely: f32) -> bool {
    game.play_random.unit() < likely
}

/// Whether a bot does what it does this often.
pub fn chooses(game: &mut Match, often: f32) -> bool {
    choice(game) < often
}

/// Uniform in 0..1: what a bot has in mind where one thing is as good as another.
pub fn choice(game: &mut Match) -> f32 {
    game.bot_random.unit()
}

/// Uniform in 0..1; one half where noise is off.
pub fn roll(game: &mut Match) -> f32 {
    if game.rule(Rule::Stochastic) { game.play_random.unit() } else { 0.5 }
}

/// About normal, mean 0, standard deviation 1, never beyond 3; 0 where noise is off.
pub fn bell(game: &mut Match) -> f32 {
    if !game.rule(Rule::Stochastic) {
        return 0.0;
    }
    let random = &mut game.play_random;
    2.0 * (random.unit() + random.unit() + random.unit() - 1.5)
}

/// Uniform in 0..1, how far a bot misjudges; one half where noise is off.
pub fn whim(game: &mut Match) -> f32 {
    if game.rule(Rule::Stochastic) { game.bot_random.unit() } else { 0.5 }
}
