//! Chance in play: one stream, and none where the rule `stochastic` is off.

use crate::state::Match;
use setpiece_scenario::vocabulary::Rule;

/// Uniform in 0..1; one half where chance is off.
pub fn roll(game: &mut Match) -> f32 {
    if game.rule(Rule::Stochastic) { game.play_random.unit() } else { 0.5 }
}

/// About normal, mean 0, standard deviation 1, never beyond 3; 0 where chance is off.
pub fn bell(game: &mut Match) -> f32 {
    if !game.rule(Rule::Stochastic) {
        return 0.0;
    }
    let random = &mut game.play_random;
    2.0 * (random.unit() + random.unit() + random.unit() - 1.5)
}

/// Uniform in 0..1 for a bot's decision; one half where chance is off.
pub fn whim(game: &mut Match) -> f32 {
    if game.rule(Rule::Stochastic) { game.bot_random.unit() } else { 0.5 }
}
