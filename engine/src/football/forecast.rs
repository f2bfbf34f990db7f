//! When the ball's forecast is reckoned again.

use crate::physics::Forecast;
use crate::state::Match;

/// Reckons the forecast again where it no longer holds.
pub fn refresh(game: &mut Match) {
    if !game.play.forecast.holds(&game.ball, game.tick) {
        game.play.forecast = Forecast::of(&game.ball, game.tick);
    }
}

/// Reckons the forecast again after a touch.
pub fn renew(game: &mut Match) {
    game.play.forecast = Forecast::of(&game.ball, game.tick);
}
