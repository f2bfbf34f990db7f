//! All numbers are finite, and players and ball are where they can be.

use super::must;
use crate::pitch::LabError;
use setpiece::engine::physics::lines::{out_x, out_y};
use setpiece::engine::state::{Match, PlayerId};
use setpiece::scenario::pitch::PLAYERS_MAX;
use setpiece::scenario::vocabulary::Role;

/// The fastest possible ball, m/s.
const BALL_MPS: f32 = 60.0;
/// The fastest possible player, m/s.
const PLAYER_MPS: f32 = 12.0;

/// Checks any single state.
pub(super) fn sound(game: &Match) -> Result<(), LabError> {
    ball(game)?;
    for i in (0..PLAYERS_MAX).filter(|&i| game.players[i].active) {
        must(game.squad.has(PlayerId(i as u8)), || format!("player {i} is nobody"))?;
        player(game, i)?;
    }
    for id in [game.owner, game.last_touch].into_iter().flatten() {
        must(game.squad.has(id), || format!("{id:?} is nobody"))?;
    }
    must(game.owner.is_none_or(|id| game.player(id).active), || {
        "a player who was sent off has the ball".to_owned()
    })?;
    if let Some((keeper, _)) = game.play.hands {
        let player = game.player(keeper);
        must(player.active && player.role == Role::GK, || {
            format!("{keeper:?} is no keeper and holds the ball")
        })?;
    }
    agents(game)
}

fn ball(game: &Match) -> Result<(), LabError> {
    let ball = game.ball;
    must(ball.pos.is_finite() && ball.vel.is_finite() && ball.spin.is_finite(), || {
        format!("the ball: {ball:?}")
    })?;
    must(ball.pos.z >= 0.1099, || format!("the ball is in the ground: {ball:?}"))?;
    must(ball.vel.length() < BALL_MPS, || format!("the ball is too fast: {ball:?}"))?;
    let pitch = &game.pitch;
    let inside = ball.pos.x.abs() <= out_x(pitch) && ball.pos.y.abs() <= out_y(pitch);
    must(inside || game.dead, || format!("the ball is out at {:?} and play goes on", ball.pos))
}

fn player(game: &Match, i: usize) -> Result<(), LabError> {
    let player = &game.players[i];
    let (x, y) = (game.rim() + 0.001).into();
    let finite = player.pos.is_finite() && player.vel.is_finite() && player.heading_rad.is_finite();
    must(finite, || format!("player {i}: {:?} {:?}", player.pos, player.vel))?;
    must(player.pos.x.abs() <= x && player.pos.y.abs() <= y, || {
        format!("player {i} is lost: {:?}", player.pos)
    })?;
    must(player.vel.length() < PLAYER_MPS, || format!("player {i} is too fast: {:?}", player.vel))?;
    must((0.0..=1.0).contains(&player.fatigue), || {
        format!("player {i} is tired by {}", player.fatigue)
    })?;
    let unit = (player.body.facing.length() - 1.0).abs() < 0.01;
    must(unit, || format!("player {i} faces nowhere: {:?}", player.body.facing))
}

/// Every agent has a player of its team, each a different one. It has none only if nobody is left.
fn agents(game: &Match) -> Result<(), LabError> {
    let mut taken = 0u32;
    for (slot, agent) in game.agents.iter().enumerate() {
        let Some(id) = agent.player else { continue };
        let player = game.player(id);
        must(id.team() == agent.team && player.controllable, || {
            format!("agent {slot} must not have {id:?}")
        })?;
        must(taken & (1 << id.0) == 0, || format!("two agents have {id:?}"))?;
        taken |= 1 << id.0;
    }
    Ok(())
}

/// Nobody appears, nobody changes teams, and agents stay the same.
pub(super) fn hold(before: &Match, judged: &Match) -> Result<(), LabError> {
    for i in 0..PLAYERS_MAX {
        let (was, is) = (&before.players[i], &judged.players[i]);
        must(was.active || !is.active, || format!("player {i} has appeared"))?;
    }
    must(before.squad == judged.squad, || "the squad has changed".to_owned())?;
    must(before.agents.len() == judged.agents.len(), || "an agent is lost".to_owned())?;
    for (slot, (was, is)) in before.agents.iter().zip(&judged.agents).enumerate() {
        let same =
            was.team == is.team && was.fixed == is.fixed && (!is.fixed || was.player == is.player);
        must(same, || format!("agent {slot} has become another: {was:?}, {is:?}"))?;
        let waits = judged.team(is.team).any(|(id, player)| {
            player.controllable && !judged.agents.iter().any(|agent| agent.player == Some(id))
        });
        let there = is.player.is_some_and(|id: PlayerId| judged.player(id).active);
        // An agent loses a player sent off in a step at the beginning of the next.
        let left =
            was.player.is_some_and(|id| before.player(id).active && !judged.player(id).active);
        must(there || is.fixed || !waits || left, || format!("agent {slot} has nobody: {is:?}"))?;
    }
    Ok(())
}
