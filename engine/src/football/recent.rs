//! The memory of the last seconds of play, and when it is updated.

use crate::state::Match;
use setpiece_scenario::vocabulary::Team;

/// Added to both teams' times to the ball before they are compared, seconds. (GRF's.)
const CALM_S: f32 = 1.5;
/// The weight of one step in a player's mean speed.
const TIRES: f32 = 0.02;

/// Resets the memory at a start and when play goes on after a stop. The team that has the ball, or
/// reaches it sooner, counts as having had it. (GRF's.)
pub fn begin(game: &mut Match) {
    let [left, right] = soonest(game);
    let sooner = if left < right { Team::Left } else { Team::Right };
    let team = holder(game).or(game.play.kick_off).unwrap_or(sooner);
    game.play.recent.begin(team);
}

/// The team that has the ball uncontested: in hands, or at a set piece.
fn holder(game: &Match) -> Option<Team> {
    match (game.play.hands, game.play.set_piece) {
        (Some((keeper, _)), _) => Some(keeper.team()),
        (_, Some(set_piece)) => Some(set_piece.team),
        _ => None,
    }
}

/// Seconds until each team reaches the ball, plus [`CALM_S`].
fn soonest(game: &Match) -> [f32; 2] {
    [Team::Left, Team::Right].map(|team| {
        game.team(team).fold(f32::MAX, |least, (_, player)| least.min(player.body.meet_s)).min(60.0)
            + CALM_S
    })
}

/// Adds a step to the memory.
pub fn remember(game: &mut Match) {
    let (soonest, holder, possession) = (soonest(game), holder(game), game.possession);
    let ball = game.ball.pos.truncate();
    game.each(game.squad, |player| {
        player.body.mean_mps += (player.vel.length() - player.body.mean_mps) * TIRES;
    });
    game.play.recent.remember(game.step, ball, soonest, holder, possession);
}
