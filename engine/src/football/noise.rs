//! Chance in play: whether something happens, how far a kick goes astray, what a bot chooses.
//!
//! Without the rule `stochastic` the streams ignore the seed, so chance is the same in every match.

use crate::random::{Purpose, Stream};
use crate::start::Drawn;
use crate::state::Match;
use setpiece_scenario::vocabulary::Rule;

/// The stream of a purpose for a match: the episode's own, or the one shared by all matches that
/// aren't `stochastic`.
pub fn stream(drawn: &Drawn, purpose: Purpose) -> Stream {
    let (seed, index) = if drawn.rules[Rule::Stochastic.index()] == 0.0 {
        (0, 0)
    } else {
        (drawn.seed, drawn.index)
    };
    Stream::new(seed, index, purpose)
}

/// Draws whether something with this probability happens: a tackle won, a ball held.
pub fn happens(game: &mut Match, likely: f32) -> bool {
    roll(game) < likely
}

/// Uniform in 0..1.
pub fn roll(game: &mut Match) -> f32 {
    game.play_random.unit()
}

/// Uniform in -1..1.
pub fn spread(game: &mut Match) -> f32 {
    2.0 * game.play_random.unit() - 1.0
}

/// About normal: mean 0, standard deviation 1, never beyond 3.
pub fn bell(game: &mut Match) -> f32 {
    let random = &mut game.play_random;
    2.0 * (random.unit() + random.unit() + random.unit() - 1.5)
}

/// Draws whether a bot does something that it does with this frequency.
pub fn chooses(game: &mut Match, often: f32) -> bool {
    bot_roll(game) < often
}

/// Uniform in 0..1: how far a bot misjudges, or which of several equal choices it takes.
pub fn bot_roll(game: &mut Match) -> f32 {
    game.bot_random.unit()
}
