//! The team's block in open play: everyone's place, given the ball and which team is nearer to it.
//!
//! Every number has a slot in one formation ([`SLOTS`](crate::football::lineup::SLOTS)). Its role
//! decides how its place follows the ball. Players swap slots if that brings the team to its places
//! sooner. (All figures are GRF's.)

use crate::control::bot::TeamView;
use crate::control::bot::matching::matching;
use crate::football::block::TeamBlock;
use crate::math::{self, mix, share};
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::vocabulary::Role;

/// The whole block's depth and width, shares of the pitch.
const DEPTH: f32 = 0.45;
const WIDTH: f32 = 0.95;
/// Players' positions are predicted this far ahead when slots are assigned, seconds.
const SWAP_AHEAD_S: f32 = 0.5;

/// How a team wants its block, with and without the ball.
#[derive(Clone, Copy)]
struct BlockWish {
    /// Shares of the block's depth and width.
    depth: f32,
    width: f32,
    /// How far the block is pulled back, a share of the pitch; negative: pushed up.
    back: f32,
    /// Where midfielders stand between the rearmost (0) and the foremost (1).
    midfield: f32,
    /// How much the block follows who has had the ball recently, instead of the ball's place.
    by_side: f32,
    /// How strongly players are drawn to the action.
    drawn: f32,
}

const ATTACK: BlockWish = BlockWish {
    depth: 0.868,
    width: 0.948,
    back: 0.04,
    midfield: 0.828,
    by_side: 0.176,
    drawn: 0.826,
};
const DEFENCE: BlockWish = BlockWish {
    depth: 0.71,
    width: 0.84,
    back: 0.08,
    midfield: 0.776,
    by_side: 0.332,
    drawn: 0.938,
};
/// How strongly midfielders follow.
const MIDFIELD_KEEN: f32 = 0.35;

/// How much a role attacks, 0..1.
pub const fn mindset(role: Role) -> f32 {
    match role {
        Role::GK | Role::CB => 0.0,
        Role::LB | Role::RB | Role::DM => 0.25,
        Role::LM | Role::CM | Role::RM => 0.5,
        Role::AM => 0.75,
        Role::CF => 1.0,
    }
}

/// Everyone's wishes by [`Role::index`], with the ball and without.
static WISHES: [[BlockWish; 2]; Role::ALL.len()] = {
    let mut all = [[ATTACK, DEFENCE]; Role::ALL.len()];
    let mut index = 0;
    while index < all.len() {
        all[index] = wishes(Role::ALL[index]);
        index += 1;
    }
    all
};

/// A role's wishes, with the ball and without.
const fn wishes(role: Role) -> [BlockWish; 2] {
    let (mut attack, mut defence) = (ATTACK, DEFENCE);
    match role {
        Role::CB => attack.width = 1.0,
        Role::LB | Role::RB => {
            (attack.width, attack.back, defence.back) = (1.0, -0.16, -0.07);
        }
        Role::LM | Role::RM => (attack.back, defence.back) = (-0.16, -0.02),
        Role::AM | Role::CF => defence.depth = 0.835,
        _ => {}
    }
    let mind = mindset(role) - 0.5;
    attack.by_side += 0.2 * mind;
    defence.by_side -= 0.2 * mind;
    [attack, defence]
}

/// Assigns the slots again, so that everyone's way to theirs is short. (GRF's.)
pub fn swap_slots(game: &mut Match, view: &TeamView) {
    let mut field = [PlayerId(0); TEAM_MAX];
    let mut ways = [[0i32; TEAM_MAX]; TEAM_MAX];
    let mut count = 0;
    for (id, player) in game.team(view.team) {
        if player.role != Role::GK {
            field[count] = id;
            count += 1;
        }
    }
    let field = &field[..count];
    let soon =
        |id: PlayerId| (game.player(id).pos + game.player(id).vel * SWAP_AHEAD_S) * view.side;
    let mut places = [Vec2::ZERO; TEAM_MAX];
    for (place, &id) in places.iter_mut().zip(field) {
        *place = soon(id);
    }
    for (slot, &whose) in field.iter().enumerate() {
        let to = Outlook::of(game, view, whose).place(game, view, whose);
        for (place, ways) in places.iter().zip(&mut ways).take(count) {
            ways[slot] = (10.0 * place.distance(to)).round() as i32;
        }
    }
    let fills = matching(&ways, count);
    for (i, &id) in field.iter().enumerate() {
        game.players[id.index()].body.mind.fills = field[fills[i]];
    }
}

/// What a player's place in the block depends on, whatever slot they fill; own frame, metres.
pub struct Outlook {
    /// Where the ball was recently. For players nearer to the action, more recent places count.
    ball: Vec2,
    /// How much the team attacks, 0..1.
    attacks: f32,
    /// The x of the block, by who has had the ball recently.
    side_x: f32,
    /// Where the action is.
    focus: Vec2,
    /// How strongly the action draws players, 0..1.
    draws: f32,
}

impl Outlook {
    /// Computes how a player sees the game.
    pub fn of(game: &Match, view: &TeamView, id: PlayerId) -> Outlook {
        let (action, half) = (view.action_at(game), game.half());
        let urgent = 1.0 - share(action.distance(game.player(id).pos * view.side), 2.0, 30.0);
        let mean = |seconds: f32| view.means.over(seconds) * view.side;
        let ball_x = mean(3.5 * (1.0 - 0.7 * urgent)).x;
        let ball_y = mean(4.0 * (1.0 - 0.5 * urgent)).y;
        // How much the team attacks: by its nearness to the ball, and by the ball's place if that
        // is unclear.
        let near = share(view.nearness - 0.5, 0.3, 0.7);
        let unclear = 0.6 * (1.0 - (2.0 * near - 1.0).abs());
        let up = share(ball_x / half.x, -0.7, 0.7);
        let attacks = (mix(near, up, unclear) + 0.3 * (view.daring - 0.5)).clamp(0.0, 1.0);
        let side_x = half.x * (0.2 * (2.0 * attacks - 1.0) + 0.8 * view.lately);
        let focus = (mean(2.0) * 0.5 + action * 0.5).lerp(mean(3.0), attacks);
        let low = 0.3 + 0.7 * up;
        let draws = mix(math::eighths::<5>(1.0 - low), math::eighths::<6>(low), attacks);
        Outlook { ball: Vec2::new(ball_x, ball_y), attacks, side_x, focus, draws }
    }

    /// The player's place in the block if they fill the slot and role of `fills`.
    pub fn place(&self, game: &Match, view: &TeamView, fills: PlayerId) -> Vec2 {
        let Outlook { ball, attacks, side_x, focus, draws } = *self;
        let half = game.half();
        let filled = game.player(fills);
        let [attack, defence] = &WISHES[filled.role.index()];
        let both = |with: f32, without: f32| mix(without, with, attacks);
        let depth = DEPTH * both(attack.depth, defence.depth);
        let width = WIDTH * both(attack.width, defence.width);
        let dares = 0.3 * view.daring;
        let by_side = both(
            (attack.by_side - 0.3 + dares).clamp(0.0, 1.0),
            (defence.by_side - dares).clamp(0.0, 1.0),
        );
        let middle_x = (mix(ball.x, side_x, by_side) - half.x * both(attack.back, defence.back))
            .clamp(-half.x, half.x);
        let middle_x = middle_x * (0.95 * (1.0 - depth) + 0.05);
        let middle_y = ball.y.clamp(-half.y, half.y) * (0.9 * (1.0 - width) + 0.1);
        let (back, front) =
            ((middle_x - depth * half.x).max(view.trap_x), middle_x + depth * half.x);
        // The action, as attackers and as defenders see it.
        let ahead = Vec2::new((focus.x + 1.0).min(half.x), 0.9 * focus.y);
        let behind = Vec2::new((focus.x - 2.0).max(-half.x).min(-back), 0.9 * focus.y);
        let follows = share(ball.x / half.x, -0.8, 0.8);
        let midfield = 0.7 * both(attack.midfield, defence.midfield) + 0.3 * follows;
        let block = TeamBlock {
            depth: [back, front],
            half_width: width * half.y,
            middle_y,
            towards_x: (0.0, 0.0),
            towards_y: (ball.y, both(0.5, 0.2)),
            towards: (
                behind.lerp(ahead, attacks),
                both(attack.drawn, defence.drawn) * (0.2 + 0.8 * draws),
            ),
            midfield: (2.0 * midfield - 1.0, MIDFIELD_KEEN),
        };
        block.place(filled.body.mind.slot, half).clamp(-half, half)
    }
}
