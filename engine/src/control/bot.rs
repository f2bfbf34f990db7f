//! The built-in bot: it plays everyone whom no agent drives.
//!
//! Decides in this order: a set piece that is his, the ball in his hands or at his feet ([`on_ball`]), going for the
//! ball ([`press`]), else [`off_ball`]: a place in the block ([`formation`]), drawn by [`support`] and [`mark`]; keepers by
//! [`keeper`]. Decisions are staggered: the ball's neighbourhood every step, the rest every fourth.
//!
//! Figures of its files without a source are chosen: so that its matches come out as `docs/calibration.md` wants them.

pub mod dribbling;
pub mod formation;
pub mod keeper;
pub mod mark;
pub mod odds;
pub mod off_ball;
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
const STAGGER: u32 = 2;
/// How near to what happens everyone decides in every step, metres; chosen.
const NEAR_M: f32 = 15.0;
/// Steps between two times that slots and opponents are given out. (GRF's.)
const ASSIGN_EVERY: u32 = 4;
/// How far ahead the offside line is reckoned, seconds. (GRF's.)
const LINE_AHEAD_S: f32 = 0.24;
/// Steps of a match of 90 minutes.
const WHOLE_MATCH_STEPS: f32 = 3000.0;

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
    /// Whoever has the ball, or will have it first.
    pub action: Option<PlayerId>,
    /// Whether the team is sooner at the ball than the other.
    pub best: bool,
    /// How near the team was to the ball lately, compared with the other: 0.5 far to 1.5 near.
    pub nearness: f32,
    /// How much the team dares, 0..1: more when behind, late, and with the ball.
    pub daring: f32,
    /// The line that the team does not fall back behind, own frame x, metres.
    pub trap_x: f32,
    /// The offside line for us a moment from now, own frame x, metres.
    pub line_x: f32,
}

impl View {
    /// What a team knows now.
    pub fn of(game: &Match, team: Team) -> View {
        let side = team.side() as f32;
        let owner = game.owner.or_else(|| touch::controller(game));
        let soonest = [team, team.other()].map(|team| View::soonest(game, team));
        let mut view = View {
            team,
            side,
            ball: game.ball.pos.truncate() * side,
            owner,
            action: owner.or_else(|| reach::first(game)).or(game.play.last_owner),
            best: match owner {
                Some(owner) => owner.team() == team,
                None => soonest[0] < soonest[1],
            },
            nearness: game.play.recent.nearness[team.index()],
            daring: daring(game, team),
            trap_x: 0.0,
            line_x: crate::football::offside::line_in(game, team, LINE_AHEAD_S),
        };
        view.trap_x = mark::trap_x(game, &view);
        view
    }

    /// In how many seconds a team is at the ball.
    fn soonest(game: &Match, team: Team) -> f32 {
        game.play.chaser[team.index()].map_or(f32::MAX, |id| game.player(id).body.meet_s)
    }

    /// Where it happens, own frame: the place of whoever has the ball or will have it.
    pub fn action_at(&self, game: &Match) -> Vec2 {
        self.action.map_or(self.ball, |id| game.player(id).pos * self.side)
    }

    /// The opponent who has the ball, or would have it first of theirs.
    pub fn rival(&self, game: &Match) -> Option<PlayerId> {
        self.owner.filter(|id| id.team() != self.team).or(game.play.chaser[self.team.other().index()])
    }

    /// How near the team was to the ball lately, for a player: to who goes for the ball, what is counts more the nearer
    /// the ball is. (GRF's.)
    pub fn nearness_of(&self, game: &Match, id: PlayerId) -> f32 {
        if game.play.chaser[self.team.index()] != Some(id) {
            return self.nearness;
        }
        let ball = game.play.forecast.at(game.tick + 30).truncate();
        let far = formation::share(ball.distance(game.player(id).pos), 2.0, 14.0);
        let calm = |team| View::soonest(game, team).min(60.0) + 1.5;
        let now = calm(self.team.other()) / calm(self.team);
        now + (self.nearness - now) * far * far
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

/// How much a team dares, 0..1. (GRF's; a match of 3000 steps is 90 minutes.)
fn daring(game: &Match, team: Team) -> f32 {
    let behind = game.score[team.other().index()] as f32 - game.score[team.index()] as f32;
    let behind = (0.5 + 0.25 * behind).clamp(0.0, 1.0);
    let played = ((game.elapsed_at_start + game.step) as f32 / WHOLE_MATCH_STEPS).min(1.0);
    let late = 0.5 + 0.5 * played;
    let had = game.play.recent.minute_s * team.side() as f32 / 60.0;
    0.5 * (0.5 + (behind - 0.5) * late) + 0.5 * (0.5 + 0.5 * had)
}

/// Lets the bot decide for everyone whom no agent drives.
pub fn think(game: &mut Match, events: &mut Events) {
    if game.play.set_piece.is_some() {
        taker::think(game);
        return;
    }
    let views = [View::of(game, Team::Left), View::of(game, Team::Right)];
    for team in game.teams() {
        let view = &views[team.index()];
        let turn = (game.step + 2 * u32::from(team == game.play.first_kickoff)) % ASSIGN_EVERY;
        if turn == 0 {
            formation::swap_slots(game, view);
        } else if turn == ASSIGN_EVERY - 1 {
            mark::assign(game, view);
        }
        support::assign(game, view);
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
    if press::stands_in(game, view, id) {
        return press::meet(game, events, view, id);
    }
    match pursuit(game, view, id) {
        Pursuit::Fetch => return press::fetch(game, view, id),
        Pursuit::Hunt(rival) => return press::hunt(game, events, view, id, rival),
        Pursuit::None => {}
    }
    let player = game.player(id);
    let due = (game.step + id.in_team() as u32).is_multiple_of(STAGGER);
    let near = (player.pos * view.side).distance_squared(view.action_at(game)) < NEAR_M * NEAR_M;
    if !due && !near && matches!(player.body.intent, Intent::Go(..)) {
        return;
    }
    game.players[id.index()].body.kick = None;
    off_ball::place(game, view, id);
}

/// Whether somebody goes for the ball.
enum Pursuit {
    /// Not they.
    None,
    /// For one that is the team's to have.
    Fetch,
    /// For one that an opponent has.
    Hunt(PlayerId),
}

/// Whether a player goes for the ball: the first of their team for one that is the team's to have; for an opponent's, the
/// two who are nearest, if they are near enough and mark nobody. (GRF's.)
fn pursuit(game: &Match, view: &View, id: PlayerId) -> Pursuit {
    if game.play.pass.is_some_and(|pass| pass.to == Some(id)) {
        return Pursuit::Fetch;
    }
    let first = game.play.chaser[view.team.index()];
    let held = game.play.hands.is_some();
    if held || view.action.is_none_or(|action| action.team() == view.team) {
        return if first == Some(id) && !held { Pursuit::Fetch } else { Pursuit::None };
    }
    let Some(rival) = view.rival(game) else { return Pursuit::None };
    if game.play.team_pressure[view.team.index()] {
        let [second, third] = game.play.behind[view.team.index()];
        let mut queue = [first, second, third].into_iter().flatten();
        if queue.find(|id| game.play.driven & (1 << id.0) == 0) == Some(id) {
            return Pursuit::Hunt(rival);
        }
    }
    let (player, other) = (game.player(id), game.player(rival));
    let gap = (other.pos + other.vel * 0.12).distance(player.pos + player.vel * 0.04);
    let may = !view.best && player.body.mind.mark.is_none() && player.role != Role::GK;
    let near = |to: Vec2| support::nearest::<2>(game, view.team, to, None).any(|near| near == id);
    if may && gap < press::hunt_m(game, player) && near(other.pos + other.vel * 0.1) {
        return Pursuit::Hunt(rival);
    }
    Pursuit::None
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
