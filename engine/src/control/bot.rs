//! The built-in bot: it plays everyone without an agent.
//!
//! It decides in this order: a set piece to take, the ball in hands or at feet ([`on_ball`]), going
//! for the ball ([`press`]), else [`off_ball`]: a place in the block ([`formation`]), shifted by
//! [`support`] and [`mark`]. Keepers are decided by [`keeper`]. Decisions are staggered: near the
//! action in every step, elsewhere in every second.
//!
//! The figures in these files are GRF's, measured, fitted or chosen, as each says.

mod board;
pub mod dribbling;
pub mod formation;
pub mod keeper;
pub mod mark;
mod matching;
pub mod odds;
pub mod off_ball;
pub mod on_ball;
pub mod press;
pub mod send;
pub mod support;
pub mod taker;
mod view;

pub use view::TeamView;

use crate::state::player::Intent;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::Role;
use setpiece_scenario::{Ai, Others};

/// A ball must come this near to a player who is to hold their place, metres; chosen.
const HOLD_M: f32 = 6.0;
/// Steps between two decisions of a player who isn't near the action, and of one who is far from
/// it.
const STAGGER: [u32; 2] = [2, 4];
/// Within this distance of the action everyone decides in every step, metres; chosen.
const NEAR_M: f32 = 15.0;
/// From this distance on a player is far from the action, metres; chosen.
const FAR_M: f32 = 30.0;
/// Steps between two assignments of slots and opponents. (GRF's.)
const ASSIGN_EVERY: u32 = 4;

/// Lets the bot decide for everyone without an agent.
pub fn think(game: &mut Match) {
    if game.play.set_piece.is_some() {
        taker::think(game);
        return;
    }
    let views = TeamView::of_both(game);
    for team in game.teams() {
        let view = &views[team.index()];
        let turn = (game.step + 2 * u32::from(team != game.play.early)) % ASSIGN_EVERY;
        if turn == 0 {
            formation::swap_slots(game, view);
        } else if turn == ASSIGN_EVERY - 1 {
            mark::assign(game, view);
        }
        support::assign(game, view);
    }
    for id in game.order() {
        let i = id.index();
        if !game.players[i].active || game.is_driven(id) {
            continue;
        }
        match ai_of(game, id) {
            Ai::Lazy => game.players[i].body.intent = Intent::Stand,
            Ai::Hold => hold(game, &views[id.team().index()], id),
            Ai::Bot | Ai::Behavior(_) => decide(game, &views[id.team().index()], id),
        }
    }
}

/// Who plays a player now: their own `ai`, or the scenario's choice for an agent's teammates.
fn ai_of(game: &Match, id: PlayerId) -> Ai {
    let ai = game.player(id).ai;
    let mates_hold = game.play.others == Others::Hold && game.play.led[id.team().index()];
    if ai == Ai::Bot && mates_hold { Ai::Hold } else { ai }
}

/// Stands, but plays a ball that comes. With the ball in hand, the player acts like any keeper.
fn hold(game: &mut Match, view: &TeamView, id: PlayerId) {
    if game.play.hands.is_some_and(|(keeper, _)| keeper == id) {
        on_ball::decide(game, view, id);
        return;
    }
    let near = game.player(id).pos.distance_squared(game.ball.pos.truncate()) < HOLD_M * HOLD_M;
    let theirs = game.play.chaser[id.team().index()] == Some(id) && near;
    let body = &mut game.players[id.index()].body;
    body.dribble = Vec2::ZERO;
    body.intent = if theirs { Intent::Ball(5.0) } else { Intent::Stand };
}

/// Decides for one player.
fn decide(game: &mut Match, view: &TeamView, id: PlayerId) {
    if game.player(id).body.swings() {
        return;
    }
    let has_ball = view.owner == Some(id);
    if game.player(id).role == Role::GK && !has_ball && keeper::stands(game, view, id) {
        return;
    }
    if has_ball {
        if may_decide(game, id) {
            on_ball::decide(game, view, id);
        } else {
            keep(game, id);
        }
        return;
    }
    match press::pursuit(game, view, id) {
        press::Pursuit::Fetch => return press::fetch(game, view, id),
        _ if press::is_met(game, view, id) => return press::meet(game, view, id),
        press::Pursuit::Hunt(rival) => return press::hunt(game, view, id, rival),
        press::Pursuit::None => {}
    }
    let player = game.player(id);
    let away = (player.pos * view.side).distance_squared(view.action_at(game));
    let near = away < NEAR_M * NEAR_M;
    let every = STAGGER[usize::from(away > FAR_M * FAR_M)];
    let due = (game.step + id.in_team() as u32).is_multiple_of(every);
    if !due && !near && matches!(player.body.intent, Intent::Go(..)) {
        return;
    }
    game.players[id.index()].body.kick = None;
    off_ball::place(game, view, id);
}

/// Whether the bot may pass and shoot for a player. It may not for teammates that the agent can
/// switch to.
fn may_decide(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    let team = id.team();
    let switches = game.agents.iter().any(|slot| slot.team == team && !slot.fixed);
    !game.play.led[team.index()] || player.role == Role::GK || !player.controllable || !switches
}

/// Keeps the ball where it is.
fn keep(game: &mut Match, id: PlayerId) {
    let body = &mut game.players[id.index()].body;
    body.dribble = Vec2::ZERO;
    body.intent = Intent::Ball(3.5);
}
