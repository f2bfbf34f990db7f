//! Which player an agent's slot controls.
//!
//! Fixed slots keep their player. Other slots follow the ball: to the teammate who reaches it much
//! sooner, to its owner, to the receiver of a pass, to the taker of a set piece. A match begins
//! with certain places of the team, keepers included, and its first step with the player at the
//! ball. A restart begins with the players nearest to the ball. During play no slot changes to a
//! keeper.

use crate::state::{AgentSlot, Match, PlayerId};
use arrayvec::ArrayVec;
use glam::Vec2;
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::vocabulary::{Role, Team};
use setpiece_scenario::{Ai, Others};

/// How long a requested run lasts, steps. (GRF's.)
const RUN_STEPS: u32 = 40;
/// The player nearest to the point this far ahead of the caller runs, metres. (GRF's.)
const AHEAD_M: f32 = 26.0;
/// A teammate takes over if three times their time to the ball is still less than the current
/// player's. (GRF's.)
const SOONER: f32 = 3.0;

/// The order in which a match's first slots get the places of a team. (GRF's.)
const FIRST_PLACES: [usize; TEAM_MAX] = [6, 5, 7, 8, 10, 0, 9, 2, 3, 1, 4];

/// Whether a slot controls the player.
pub fn controlled(game: &Match, id: PlayerId) -> bool {
    game.agents.iter().any(|slot| slot.player == Some(id))
}

/// Whether a switching slot can be given the player.
fn free(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    player.active && player.controllable && !controlled(game, id)
}

/// Switches players at the start of a step.
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
        let owner = game.on_ball().filter(|id| id.team() == team);
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
        if !awaited && SOONER * game.player(chaser).body.meet_s < fastest {
            hand_to(game, chaser);
        }
    }
}

/// Gives a player to a switching slot of their team, if they may be controlled and aren't yet.
pub fn hand_to(game: &mut Match, id: PlayerId) {
    let team = id.team();
    let takes = game.play.set_piece.is_some_and(|set_piece| set_piece.taker == id);
    let keeper = game.player(id).role == Role::GK && !takes;
    if keeper || !free(game, id) {
        return;
    }
    let keep = game.owner.or(game.last_touch);
    let turn = usize::from(game.play.next_slot[team.index()]);
    let count = game.agents.len();
    // Slots take turns, but the one that has the ball comes last.
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

/// Presses `switch` for a slot: in possession it sends a teammate on a run, otherwise the slot
/// takes the teammate who is sooner at the ball. No-op if there is none.
pub fn press(game: &mut Match, slot: usize) {
    if let Some(mate) = runner(game, slot) {
        game.players[mate.index()].body.mind.run_until_step = game.step + RUN_STEPS;
    } else if let Some(mate) = sooner(game, slot) {
        if let Some(old) = game.agents[slot].player {
            game.players[old.index()].body.kick = None;
        }
        game.agents[slot].player = Some(mate);
        game.players[mate.index()].body.kick = None;
    }
}

/// The player that `switch` would send on a run, if the slot's team has the ball: the bot-driven
/// player nearest to a point ahead of the slot's player.
pub fn runner(game: &Match, slot: usize) -> Option<PlayerId> {
    let agent = game.agents.get(slot)?;
    let id = agent.player.filter(|id| game.player(*id).active)?;
    if !has_ball(game, agent.team)
        || game.play.set_piece.is_some()
        || game.play.others == Others::Hold
    {
        return None;
    }
    let ahead = game.player(id).pos + Vec2::new(AHEAD_M * id.team().side() as f32, 0.0);
    let bots = game.team(agent.team).filter(|(mate, player)| {
        let runs = player.body.mind.run_until_step > game.step;
        player.role != Role::GK && player.ai == Ai::Bot && !runs && !controlled(game, *mate)
    });
    nearest(bots.map(|(mate, player)| (player.pos.distance_squared(ahead), mate)))
}

/// The player that `switch` would give to a slot, if the slot's team doesn't have the ball: the
/// free player who reaches it first, if sooner than the slot's player.
pub fn sooner(game: &Match, slot: usize) -> Option<PlayerId> {
    let agent = game.agents.get(slot)?;
    if agent.fixed || has_ball(game, agent.team) || game.play.set_piece.is_some() {
        return None;
    }
    let own = agent.player.map_or(f32::MAX, |id| game.player(id).body.meet_s);
    let mates =
        game.team(agent.team).filter(|(mate, player)| player.role != Role::GK && free(game, *mate));
    let soonest = nearest(mates.map(|(mate, player)| (player.body.meet_s, mate)))?;
    (game.player(soonest).body.meet_s < own).then_some(soonest)
}

/// Whether a team has the ball, or has passed it.
fn has_ball(game: &Match, team: Team) -> bool {
    let owner = game.on_ball().or_else(|| game.play.pass.map(|pass| pass.by));
    owner.is_some_and(|id| id.team() == team)
}

/// The first of those with the least value.
fn nearest(measured: impl Iterator<Item = (f32, PlayerId)>) -> Option<PlayerId> {
    measured.reduce(|best, next| if next.0 < best.0 { next } else { best }).map(|(_, id)| id)
}

/// Gives every empty slot the free player nearest to the ball.
fn fill(game: &mut Match) {
    for slot in 0..game.agents.len() {
        let agent = game.agents[slot];
        if agent.fixed || agent.player.is_some_and(|id| game.player(id).active) {
            continue;
        }
        let ball = game.ball.pos.truncate();
        let players = game.team(agent.team).filter(|(id, _)| free(game, *id));
        let distances = players.map(|(id, player)| (player.pos.distance_squared(ball), id));
        game.agents[slot].player = nearest(distances);
    }
}

/// Gives the switching slots their first players, wherever the ball is: each team's slots by place.
pub fn open(game: &mut Match) {
    release(game);
    for team in [Team::Left, Team::Right] {
        let open = |slot: &AgentSlot| slot.team == team && slot.player.is_none();
        let slots = game.agents.iter().filter(|slot| open(slot)).count();
        let ids = FIRST_PLACES.map(|place| PlayerId::new(team, place));
        let mut firsts: ArrayVec<_, TEAM_MAX> =
            ids.into_iter().filter(|id| free(game, *id)).take(slots).collect();
        firsts.sort_unstable_by_key(|id| id.0);
        for (slot, id) in game.agents.iter_mut().filter(|slot| open(slot)).zip(firsts) {
            slot.player = Some(id);
        }
    }
}

/// Gives the switching slots the players nearest to the ball, and the taker of a set piece.
pub fn reassign(game: &mut Match) {
    release(game);
    fill(game);
}

/// Frees the switching slots of their players; the taker of a set piece gets one.
fn release(game: &mut Match) {
    for slot in &mut game.agents {
        if !slot.fixed {
            slot.player = None;
        }
    }
    if let Some(set_piece) = game.play.set_piece {
        hand_to(game, set_piece.taker);
    }
}
