//! A player who comes on for another one, in their place in the team.

use crate::football::stats;
use crate::state::{ComingOn, Match};
use setpiece_scenario::vocabulary::Stat;

/// Replaces a player where they stand: whoever has the ball keeps it. No-op for a player who is
/// not on the pitch.
pub fn come_on(game: &mut Match, coming: &ComingOn) {
    let player = &mut game.players[coming.player.index()];
    if !player.active {
        return;
    }
    player.fatigue = coming.fatigue;
    player.yellow_cards = 0;
    if let Some(difficulty) = coming.difficulty {
        player.difficulty = difficulty;
        player.body.level = stats::level_of(difficulty);
    }
    for &(stat, value) in &coming.stats {
        player.body.stats[stat.index()] = value.clamp(stats::LEAST, 1.0);
    }
    player.body.speed_top_mps = stats::speed_top(player.body.stats[Stat::Speed.index()]);
}
