//! Which player an agent's slot controls.
//!
//! Fixed slots keep their player for ever. The others follow the ball: to the mate who will be there much sooner, to
//! whoever has it, to the receiver of a pass, to the taker of a set piece; never to the keeper if there is another.

use crate::football::touch;
use crate::state::{Match, PlayerId};
use setpiece_scenario::vocabulary::{Role, Team};

/// Whether some slot controls the player.
pub fn controlled(game: &Match, id: PlayerId) -> bool {
    game.agents.iter().any(|slot| slot.player == Some(id))
}

/// Whether a slot that may switch can be given the player.
fn free(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    player.active && player.controllable && !controlled(game, id)
}

/// Switches at the start of a step.
pub fn update(game: &mut Match) {
    fill(game);
    for team in [Team::Left, Team::Right] {
        if !game.agents.iter().any(|slot| slot.team == team && !slot.fixed) {
            continue;
        }
        if let Some(set_piece) = game.play.set_piece {
            if set_piece.team == team {
                hand_to(game, set_piece.taker);
            }
            continue;
        }
        let owner = game.owner.or_else(|| touch::controller(game)).filter(|id| id.team() == team);
        if let Some(owner) = owner {
            hand_to(game, owner);
            continue;
        }
        let Some(chaser) = game.play.chaser[team.index()] else { continue };
        let fastest = game
            .agents
            .iter()
            .filter(|slot| slot.team == team)
            .filter_map(|slot| slot.player)
            .fold(f32::MAX, |least, id| least.min(game.player(id).body.meet_s));
        let pass_to = game.play.pass.and_then(|pass| pass.to);
        let awaited = pass_to.is_some_and(|to| to.team() == team && controlled(game, to));
        if !awaited && 3.0 * game.player(chaser).body.meet_s < fastest {
            hand_to(game, chaser);
        }
    }
}

/// Gives a player to a slot of his team that may switch, if he may be controlled and isn't yet.
pub fn hand_to(game: &mut Match, id: PlayerId) {
    let team = id.team();
    let keeper = game.player(id).role == Role::GK;
    if keeper || !free(game, id) {
        return;
    }
    let keep = game.owner.or(game.last_touch);
    let turn = usize::from(game.play.next_slot[team.index()]);
    let count = game.agents.len();
    // In turn, but the slot that has the ball goes last.
    let mut pick: Option<usize> = None;
    for i in 0..count {
        let slot = (turn + i) % count;
        let agent = game.agents[slot];
        if agent.team != team || agent.fixed {
            continue;
        }
        let has_ball = agent.player.is_some() && agent.player == keep;
        if !has_ball {
            pick = Some(slot);
            break;
        }
        pick = pick.or(Some(slot));
    }
    if let Some(slot) = pick {
        if let Some(old) = game.agents[slot].player {
            game.players[old.index()].body.kick = None;
        }
        game.agents[slot].player = Some(id);
        game.players[id.index()].body.kick = None;
        game.play.next_slot[team.index()] = ((slot + 1) % count) as u8;
    }
}

/// Gives every slot without a player the free one nearest to the ball.
fn fill(game: &mut Match) {
    for slot in 0..game.agents.len() {
        let agent = game.agents[slot];
        if agent.fixed || agent.player.is_some_and(|id| game.player(id).active) {
            continue;
        }
        let ball = game.ball.pos.truncate();
        let mut best: Option<(f32, PlayerId)> = None;
        for (id, player) in game.team(agent.team) {
            let keeper = if player.role == Role::GK { 1.0e6 } else { 0.0 };
            let distance = player.pos.distance_squared(ball) + keeper;
            if free(game, id) && best.is_none_or(|(least, _)| distance < least) {
                best = Some((distance, id));
            }
        }
        game.agents[slot].player = best.map(|(_, id)| id);
    }
}

/// Gives the slots that may switch their players anew: at the start and at restarts.
pub fn reassign(game: &mut Match) {
    for slot in &mut game.agents {
        if !slot.fixed {
            slot.player = None;
        }
    }
    if let Some(set_piece) = game.play.set_piece {
        hand_to(game, set_piece.taker);
    }
    fill(game);
}
