//! Starts a new episode in an old state: the history is the snapshot's, the settings are the
//! scenario's.

use crate::football::{forecast, foul};
use crate::state::Match;
use crate::step;
use setpiece_scenario::vocabulary::{Rule, Team};

/// Builds the match of a new episode that begins in the state of `past`.
///
/// - From `past`: places, ball, everything under way (kicks, flights, a set piece), score, cards,
///   fatigue, the clock.
/// - From `fresh`, the start that the scenario draws: rules, the world, the pitch, limit,
///   difficulty, roles and statistics, who controls which player, the random streams. Nothing is
///   held.
///
/// Steps start at 0. Ticks continue, because everything under way is timed by them.
pub(super) fn begin_from(past: &Match, fresh: &Match) -> Match {
    let mut game = past.clone();
    game.elapsed_at_start = past.elapsed_at_start.saturating_add(past.step);
    game.step = 0;
    game.limit_steps = fresh.limit_steps;
    game.rules = fresh.rules;
    if game.conditions != fresh.conditions || game.pitch != fresh.pitch {
        game.conditions = fresh.conditions;
        game.pitch = fresh.pitch;
        forecast::renew(&mut game);
    }
    game.difficulty = fresh.difficulty;
    game.play_random = fresh.play_random.clone();
    game.bot_random = fresh.bot_random.clone();
    game.play.others = fresh.play.others;
    game.play.acting = fresh.play.acting;
    for slot in &mut game.agents {
        slot.sticky = 0;
        slot.steer = None;
    }
    let half_time = game.rules[Rule::HalfTime.index()];
    game.play.second_half = half_time > 0.0 && f64::from(game.elapsed_at_start) >= half_time;
    for (player, fresh) in game.players.iter_mut().zip(&fresh.players) {
        player.ai = fresh.ai;
        player.controllable = fresh.controllable;
        player.difficulty = fresh.difficulty;
        player.role = fresh.role;
        let (body, said) = (&mut player.body, &fresh.body);
        body.stats = said.stats;
        body.level = said.level;
        body.speed_top_mps = said.speed_top_mps;
        body.height_m = said.height_m;
        body.kickoff = said.kickoff;
        let mind = &mut body.mind;
        mind.slot = said.mind.slot;
        mind.run_until_step = mind.run_until_step.saturating_sub(past.step);
        mind.decide_at_step = mind.decide_at_step.saturating_sub(past.step);
    }
    for team in [Team::Left, Team::Right] {
        foul::replace_keeper(&mut game, team);
    }
    step::go_on(&mut game);
    game
}
