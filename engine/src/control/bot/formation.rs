//! The team's block: where everyone's place is, given the ball and who has it.
//!
//! Slots come from roles, spread among players of one role; the block's formulas are GRF's, simplified.

use crate::control::bot::View;
use crate::football::lineup;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{Role, Team};

/// Half the pitch, metres.
const HALF: Vec2 = Vec2::new(55.0, 36.0);

/// Teams of fewer players keep the slots of their roles after a set piece; chosen, so that a team of eleven stays one after
/// red cards.
const WHOLE: usize = 8;

/// The block of a team in its own frame.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// Its middle, metres.
    pub centre: Vec2,
    /// Half its depth and width, metres.
    pub half: Vec2,
}

/// The place of a role in the block and its mindset: x -1 back to 1 front, y + down the picture.
fn slot_of(role: Role) -> (Vec2, f32) {
    match role {
        Role::GK | Role::CB => (Vec2::new(-1.0, 0.0), 0.0),
        Role::LB => (Vec2::new(-0.74, -0.77), 0.25),
        Role::RB => (Vec2::new(-0.74, 0.77), 0.25),
        Role::DM => (Vec2::new(-0.4, 0.0), 0.25),
        Role::CM => (Vec2::new(0.0, 0.0), 0.5),
        Role::LM => (Vec2::new(0.36, -0.85), 0.5),
        Role::RM => (Vec2::new(0.36, 0.85), 0.5),
        Role::AM => (Vec2::new(0.55, 0.0), 0.75),
        Role::CF => (Vec2::new(1.0, 0.0), 1.0),
    }
}

/// How far apart the players of one role stand.
fn spread_of(role: Role) -> f32 {
    match role {
        Role::CB => 0.27,
        Role::CM => 0.42,
        Role::LB | Role::RB | Role::LM | Role::RM => 0.12,
        _ => 0.3,
    }
}

/// Gives every player his slot, by role, those of one role from top to bottom as they stand at a kick-off.
pub fn assign_slots(game: &mut Match) {
    for i in 0..game.players.len() {
        let id = PlayerId(i as u8);
        let (role, side) = (game.players[i].role, id.team().side() as f32);
        let y_of = |player: &crate::state::Player| player.body.kickoff[1].y * side;
        let own_y = y_of(&game.players[i]);
        let (mut rank, mut count) = (0usize, 0usize);
        for (other, player) in game.team(id.team()) {
            if player.role == role {
                count += 1;
                let before = y_of(player) < own_y || (y_of(player) == own_y && other.0 < id.0);
                rank += usize::from(other != id && before);
            }
        }
        let (mut slot, mindset) = slot_of(role);
        if count > 1 {
            let place = rank as f32 - (count as f32 - 1.0) * 0.5;
            let spread = spread_of(role) * if count == 2 { 2.0 } else { 1.0 };
            slot.y += place * spread;
            // The middle one of three midfielders holds.
            if role == Role::CM && count >= 3 {
                slot.x += if place.abs() < 0.6 { -0.28 } else { 0.05 };
            }
        }
        game.players[i].body.mind.slot = slot.clamp(Vec2::splat(-1.0), Vec2::splat(1.0));
        game.players[i].body.mind.mindset = mindset;
    }
}

/// Gives every player of a whole team the slot of their number: a set piece has put them there, and they stay. (GRF gives
/// every slot to whoever is near it.)
pub fn assign_numbers(game: &mut Match, team: Team) {
    if game.team(team).count() < WHOLE {
        return;
    }
    for id in game.squad.of(team).ids() {
        let player = &mut game.players[id.index()];
        if player.role != Role::GK {
            let slot = lineup::SLOTS[id.in_team()];
            player.body.mind.slot = slot;
            player.body.mind.mindset = match slot.x {
                ..-0.8 => 0.0,
                ..-0.5 => 0.25,
                ..0.8 => 0.5,
                _ => 1.0,
            };
        }
    }
}

/// How much a team is in possession, 0..1: lately, and by the ball's place where that is unclear.
pub fn bias(share: f32, ball_x: f32) -> f32 {
    let side = (ball_x / HALF.x).clamp(-0.7, 0.7) / 1.4 + 0.5;
    let weight = 0.6 * (1.0 - (2.0 * share - 1.0).abs());
    (share * (1.0 - weight) + side * weight).clamp(0.0, 1.0)
}

/// The block of a team.
pub fn block(game: &Match, team: Team, bias: f32) -> Block {
    let side = team.side() as f32;
    let mean = game.play.ball_mean * side;
    let now = game.ball.pos.truncate() * side;
    let ball = mean * 0.6 + now * 0.4;
    let depth = 0.45 * (0.72 + 0.16 * bias);
    let width = 0.95 * (0.78 + 0.17 * bias);
    let sideways = 0.33 - 0.15 * bias;
    let x = ball.x * (1.0 - sideways) + 0.2 * HALF.x * (2.0 * bias - 1.0) * sideways + 7.0;
    let x = x * (0.95 * (1.0 - depth) + 0.05);
    let y = ball.y * (0.9 * (1.0 - width) + 0.12);
    Block { centre: Vec2::new(x + 3.0 * (bias - 0.5), y), half: Vec2::new(depth * HALF.x, width * HALF.y) }
}

/// A player's place in the block, own frame, metres: his slot, drawn a little towards the ball.
pub fn place(game: &Match, view: &View, id: PlayerId) -> Vec2 {
    let slot = game.player(id).body.mind.slot;
    let spot = view.block.centre + slot * view.block.half;
    let to_ball = view.ball - spot;
    let far = (to_ball.x * to_ball.x + 0.64 * to_ball.y * to_ball.y) / (50.0 * 50.0);
    let pull = (1.0 - far).max(0.0) * 0.22;
    let mut place = spot + Vec2::new(to_ball.x * pull, to_ball.y * pull * 0.7);
    place.x = place.x.clamp(-48.0, 50.0);
    place.y = place.y.clamp(-34.0, 34.0);
    place
}
