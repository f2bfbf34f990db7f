//! When the forecast of the ball's path is computed again.

use crate::physics::Forecast;
use crate::state::Match;

/// Computes the forecast again if it no longer holds.
pub fn refresh(game: &mut Match) {
    if !game.play.forecast.holds(&game.ball, game.tick) {
        game.play.forecast = Forecast::of(&game.ball, &game.pitch, &game.conditions, game.tick);
    }
}

/// Computes the forecast again after a touch.
pub fn renew(game: &mut Match) {
    game.play.forecast = Forecast::of(&game.ball, &game.pitch, &game.conditions, game.tick);
}
