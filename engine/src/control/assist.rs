//! GRF's magnet: a controlled player runs to a ball that is his, whatever direction is held. Whoever is scripted and no
//! agent's does what is written.

use crate::football::touch;
use crate::state::{Match, PlayerId};
use setpiece_scenario::vocabulary::Rule;

/// Whether the ball is the player's to get: he is his team's nearest, and no rival has it or is much sooner there.
pub fn ball_is_his(game: &Match, id: PlayerId) -> bool {
    let controlled = game.agents.iter().any(|slot| slot.player == Some(id));
    if !controlled || !game.rule(Rule::Assist) || game.play.set_piece.is_some() || game.play.hands.is_some() {
        return false;
    }
    let team = id.team();
    let receiver = game.play.pass.is_some_and(|pass| pass.to == Some(id));
    if game.play.chaser[team.index()] != Some(id) && !receiver {
        return false;
    }
    if touch::controller(game).is_some_and(|owner| owner != id) {
        return false;
    }
    let rival = game.play.chaser[team.other().index()].map_or(9.0, |rival| game.player(rival).body.meet_s);
    receiver || game.player(id).body.meet_s < rival + 0.2
}
