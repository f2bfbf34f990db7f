//! Tiredness: running uses up freshness.

use crate::football::pace::DT;
use crate::state::Match;
use setpiece_scenario::vocabulary::{Rule, Stat};

/// Freshness lost per metre at stamina 1 (0.00003 · 18.05 of GRF).
const PER_METRE: f32 = 0.000_03 * 18.05;

/// Adds the tiredness of a step of this many ticks.
pub fn tire(game: &mut Match, ticks: u32) {
    if !game.rule(Rule::Fatigue) {
        return;
    }
    let seconds = ticks as f32 * DT;
    game.each(game.squad, |player| {
        let metres = player.vel.length() * seconds;
        let stamina = player.body.stats[Stat::Stamina.index()];
        // Running never exhausts a player completely; a player who starts exhausted stays so.
        let most = player.fatigue.max(0.99);
        player.fatigue = (player.fatigue + metres * PER_METRE * (2.0 - stamina)).min(most);
    });
}
