//! The built-in bot: it plays everyone whom no agent drives.
//!
//! Decides in this order: a set piece that is his, the ball in his hands or at his feet ([`on_ball`]), going for the
//! ball ([`press`]), marking ([`mark`]), support ([`support`]), else his place in the block ([`formation`]); keepers by
//! [`keeper`]. Decisions are staggered: the ball's neighbourhood every step, the rest every fourth.
//!
//! Figures of its files without a source are chosen: so that its matches come out as `docs/calibration.md` wants them.

pub mod formation;
pub mod keeper;
pub mod mark;
pub mod on_ball;
pub mod press;
pub mod support;
pub mod taker;

use crate::event::Events;
use crate::football::body::Intent;
use crate::football::{reach, touch};
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::pitch::HALF_LENGTH_M;
use setpiece_scenario::vocabulary::{Role, Team};
use setpiece_scenario::{Ai, Others};

/// The middle of their goal in the own frame, metres; of the own one, its negative.
const GOAL: Vec2 = Vec2::new(HALF_LENGTH_M as f32, 0.0);
/// How near a ball must come to one who is to hold his place, metres; chosen.
const HOLD_M: f32 = 6.0;
/// Steps between two decisions of a player far from the ball.
const STAGGER: u32 = 4;

/// What a team's bots know of the game in a step.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Whose.
    pub team: Team,
    /// +1 if the team attacks towards +x.
    pub side: f32,
    /// The ball, own frame, metres.
    pub ball: Vec2,
    /// Whoever has the ball or dribbles it.
    pub owner: Option<PlayerId>,
    /// 0 the others have it, 1 we have it, smoothed.
    pub bias: f32,
    /// The offside line for us, own frame x, metres.
    pub line_x: f32,
    /// The block.
    pub block: formation::Block,
}

impl View {
    /// What a team knows now.
    pub fn of(game: &Match, team: Team) -> View {
        let side = team.side() as f32;
        let owner = game.owner.or_else(|| touch::controller(game));
        let share = 0.5 + 0.5 * game.play.share * side;
        let bias = formation::bias(share, game.play.ball_mean.x * side);
        View {
            team,
            side,
            ball: game.ball.pos.truncate() * side,
            owner,
            bias,
            line_x: crate::football::offside::line(game, team),
            block: formation::block(game, team, bias),
        }
    }

    /// In how many seconds a team is at the ball.
    fn soonest(game: &Match, team: Team) -> f32 {
        game.play.chaser[team.index()].map_or(f32::MAX, |id| game.player(id).body.meet_s)
    }

    /// The opponent who has the ball, or will have it first.
    pub fn carrier(&self, game: &Match) -> Option<PlayerId> {
        self.owner.or_else(|| reach::first(game)).filter(|id| id.team() != self.team)
    }

    /// Whether the team has the ball or is about to.
    pub fn attacks(&self, game: &Match) -> bool {
        if let Some(owner) = self.owner {
            return owner.team() == self.team;
        }
        if let Some(pass) = game.play.pass {
            return pass.by.team() == self.team;
        }
        match game.possession {
            Some(team) => team == self.team,
            // Nobody has had it yet: whoever will be there first.
            None => View::soonest(game, self.team) <= View::soonest(game, self.team.other()),
        }
    }
}

/// Lets the bot decide for everyone whom no agent drives.
pub fn think(game: &mut Match, events: &mut Events) {
    if game.play.set_piece.is_some() {
        taker::think(game);
        return;
    }
    let views = [View::of(game, Team::Left), View::of(game, Team::Right)];
    for team in game.teams() {
        if game.step.is_multiple_of(STAGGER) {
            mark::assign(game, &views[team.index()]);
        }
    }
    for id in game.order() {
        let i = id.index();
        let driven = game.play.driven & (1 << i) != 0;
        if !game.players[i].active || driven {
            continue;
        }
        match ai_of(game, id) {
            Ai::Lazy => game.players[i].body.intent = Intent::Stand,
            Ai::Hold => hold(game, &views[id.team().index()], id),
            Ai::Bot | Ai::Behavior(_) => decide(game, events, &views[id.team().index()], id),
        }
    }
}

/// Who plays him now: his own `ai`, or what the scenario says of an agent's mates.
fn ai_of(game: &Match, id: PlayerId) -> Ai {
    let ai = game.player(id).ai;
    let mates_hold = game.play.others == Others::Hold && game.play.led[id.team().index()];
    if ai == Ai::Bot && mates_hold { Ai::Hold } else { ai }
}

/// Stands, but plays a ball that comes to him; with it in his hands he is a keeper like any other.
fn hold(game: &mut Match, view: &View, id: PlayerId) {
    if game.play.hands.is_some_and(|(keeper, _)| keeper == id) {
        on_ball::decide(game, view, id);
        return;
    }
    let near = game.player(id).pos.distance_squared(game.ball.pos.truncate()) < HOLD_M * HOLD_M;
    let his = game.play.chaser[id.team().index()] == Some(id) && near;
    let body = &mut game.players[id.index()].body;
    body.dribble = Vec2::ZERO;
    body.intent = if his { Intent::Ball(5.0) } else { Intent::Stand };
}

/// One player's decision.
fn decide(game: &mut Match, events: &mut Events, view: &View, id: PlayerId) {
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
    let [first, second] = pressers(game, view);
    if first == Some(id) || game.play.pass.is_some_and(|pass| pass.to == Some(id)) {
        press::first(game, events, view, id);
        return;
    }
    let due = (game.step + id.in_team() as u32).is_multiple_of(STAGGER);
    if second == Some(id) {
        if game.play.team_pressure[view.team.index()] {
            press::first(game, events, view, id);
        } else {
            press::second(game, events, view, id);
        }
        return;
    }
    let was_on_ball = matches!(game.player(id).body.intent, Intent::Ball(_));
    if !due && !was_on_ball {
        return;
    }
    game.players[id.index()].body.kick = None;
    if view.attacks(game) {
        support::place(game, view, id);
    } else {
        mark::place(game, view, id);
    }
}

/// The man who goes for the ball, and the one who covers him where the others attack: whoever is there first, but those
/// whom an agent plays are not relied on.
fn pressers(game: &Match, view: &View) -> [Option<PlayerId>; 2] {
    let [second, third] = game.play.behind[view.team.index()];
    let first = game.play.chaser[view.team.index()];
    if view.attacks(game) {
        return [first, None];
    }
    let mut queue = [first, second, third].into_iter().flatten().filter(|id| game.play.driven & (1 << id.0) == 0);
    let carrier = view.carrier(game).filter(|_| !game.play.team_pressure[view.team.index()]);
    let Some(carrier) = carrier else {
        return [queue.next(), queue.next()];
    };
    // Who has somebody else to mark stays with them. (GRF's.)
    let marks = |id: PlayerId| game.player(id).body.mind.mark;
    let own = game.team(view.team).map(|(id, _)| id).find(|&id| marks(id) == Some(carrier));
    let mut queue = own.into_iter().chain(queue.filter(move |&id| own != Some(id) && marks(id).is_none()));
    [queue.next(), queue.next()]
}

/// Whether the bot may pass and shoot for him: not for the mates of an agent who can be given to it.
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

/// Sends a player to a point of the own frame.
pub fn send(game: &mut Match, view: &View, id: PlayerId, to: Vec2, speed: f32) {
    let to = to.clamp(Vec2::new(-54.5, -35.5), Vec2::new(54.5, 35.5)) * view.side;
    let body = &mut game.players[id.index()].body;
    body.dribble = Vec2::ZERO;
    body.intent = Intent::Go(to, speed);
}
