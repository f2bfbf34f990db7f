//! Going for the ball: the first man chases or presses, the second covers behind him.

use crate::control::bot::formation::mindset;
use crate::control::bot::{GOAL, View, on_ball, send};
use crate::event::Events;
use crate::football::body::{Intent, Pose};
use crate::football::movement::{RUN_MPS, SPRINT_MPS};
use crate::football::{noise, slide};
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::Ai;
use setpiece_scenario::vocabulary::{Role, Stat};

/// A carrier slower than this stands, m/s.
const STANDS_MPS: f32 = 1.0;
/// He is behind the carrier whose direction and the ball's, seen from there, have a smaller cosine.
const BEHIND: f32 = -0.2;
/// A mate this near to the carrier helps, metres; chosen.
const HELP_M: f32 = 18.0;
/// How far ahead a carrier is expected, seconds. (GRF's.)
const AHEAD_S: f32 = 0.5;
/// From how far a carrier could shoot: nearer to the goal a defender stands in their feet, metres. (GRF's.)
const SHOOT_M: f32 = 24.0;
/// How far before a carrier a lone defender goes back: a share of what the carrier has left, and its limits, metres.
/// Fitted to where the measured one stands and is met.
const CONTAIN_SHARE: f32 = 0.5;
const CONTAIN_M: f32 = 9.0;
const CLOSE_M: f32 = 0.4;
/// Who would be at the ball in less than this much of the carrier's time, of both and a fifth of a second, fights for it.
/// (GRF's.)
const FIGHTS: f32 = 0.8;
/// From how near a hunter goes for the ball, metres; chosen.
const CHALLENGE_M: f32 = 2.0;
/// How far beside a carrier a defender runs past them, and how far ahead of them they are beside the ball, metres; chosen.
const SHOULDER_M: f32 = 0.85;
const BESIDE_M: f32 = 0.2;
/// To how far past them they run, so that they don't slow down beside them, metres; chosen.
const PAST_M: f32 = 5.0;
/// How far ahead a slide is thought of, ticks; how far the ball must be from the tackler then, metres (GRF's); how far the
/// carrier must have pushed it, metres (what takes a sprinter as long as GRF asks for); and how far it must lie on the
/// tackler's side, a cosine. (GRF's.)
const SLIDE_AHEAD_TICKS: u32 = 20;
const SLIDE_M: std::ops::Range<f32> = 0.7..1.6;
const LONG_TOUCH_M: f32 = 0.62;
const OPEN: f32 = 0.4;
/// How often they slide then, in a step; fitted to the fouls on agents who sprint at a defender.
const SLIDES: f32 = 0.15;
/// How near, as a share of how far they hunt, the first of two goes out; chosen between how often bots and agents lose it.
const HUNTS_AT: f32 = 0.6;
/// How far he passes from the carrier's middle, metres.
const ROUND_M: f32 = 0.9;

/// The first man.
pub fn first(game: &mut Match, events: &mut Events, view: &View, id: PlayerId) {
    let rival = view.owner.filter(|owner| owner.team() != view.team);
    let held = game.play.hands.is_some_and(|(keeper, _)| keeper.team() != view.team);
    let player = *game.player(id);
    let own = player.pos * view.side;
    if held {
        send(game, view, id, Vec2::new(view.ball.x - 18.0, view.ball.y * 0.5), RUN_MPS);
        return;
    }
    let Some(rival) = rival else {
        let receives = game.play.pass.is_some_and(|pass| pass.by.team() == view.team);
        let beaten = game.play.chaser[view.team.other().index()].map_or(9.0, |other| game.player(other).body.meet_s)
            + 1.2
            < player.body.meet_s;
        if beaten && !receives && own.x > view.ball.x {
            cover(game, view, id);
            return;
        }
        let to_ball = player.body.meet - player.pos;
        let body = &mut game.players[id.index()].body;
        body.intent = Intent::Ball(SPRINT_MPS);
        body.dribble = to_ball.clamp_length_max(2.0);
        if player.body.meet_s < 0.7 {
            on_ball::before_touch(game, view, id);
        }
        return;
    };
    let carrier = *game.player(rival);
    let gap = player.pos.distance(carrier.pos);
    let told = game.play.team_pressure[view.team.index()];
    let goalside = own.x < view.ball.x + 0.5;
    // With mates about, whoever is about as soon at the ball as the carrier fights for it, and for one that lingers.
    // Else who stands in the way goes back with the carrier, and who is behind hunts where it is near enough.
    let alone = alone(game, id, carrier.pos);
    let fights = (carrier.body.meet_s + 0.2) / (player.body.meet_s + 0.2) > FIGHTS;
    let goes = told || !alone && (fights || lingers(game, rival));
    maybe_slide(game, events, view, id, rival);
    if game.player(id).body.pose == Pose::Sliding {
        return;
    }
    if !goes && !alone && gap < HUNTS_AT * hunt_m(game, &player) {
        hunt(game, view, id, rival);
        return;
    }
    if !goes && goalside {
        contain(game, view, id, &carrier);
        return;
    }
    if !goes && gap > hunt_m(game, &player) {
        cover(game, view, id);
        return;
    }
    let body = &mut game.players[id.index()].body;
    body.dribble = Vec2::new(2.0 * view.side, 0.0);
    body.intent = match past_him(view, own, &carrier).or_else(|| around_him(view, own, &carrier)) {
        Some(point) => Intent::Go(point * view.side, SPRINT_MPS),
        None => Intent::Ball(SPRINT_MPS),
    };
}

/// From how far a player hunts a carrier, metres. (GRF's.)
pub fn hunt_m(game: &Match, player: &Player) -> f32 {
    let rested = 0.5 * (1.0 - player.fatigue) + 0.5 * (1.0 - (player.body.mean_mps / 8.0).min(1.0));
    (10.0 + 10.0 * (1.0 - mindset(game.player(player.body.mind.fills).role))) * rested * player.body.level
}

/// Whether no mate in the field is near enough to the carrier to help.
fn alone(game: &Match, id: PlayerId, carrier: Vec2) -> bool {
    let helps = |mate: PlayerId, player: &Player| {
        mate != id
            && player.role != Role::GK
            && player.ai != Ai::Lazy
            && player.pos.distance_squared(carrier) < HELP_M * HELP_M
    };
    !game.team(id.team()).any(|(mate, player)| helps(mate, player))
}

/// Goes back before a carrier, on their way to the goal, the nearer the closer they come to where they could shoot from:
/// there the carrier runs into the defender. (GRF's.)
fn contain(game: &mut Match, view: &View, id: PlayerId, carrier: &Player) {
    let place = (carrier.pos + carrier.vel * AHEAD_S) * view.side;
    let way = -GOAL - place;
    let left_m = way.length() - SHOOT_M;
    let off_m = (left_m * CONTAIN_SHARE).clamp(CLOSE_M, CONTAIN_M);
    send(game, view, id, place + way.normalize_or_zero() * off_m, SPRINT_MPS);
}

/// Where he runs who has the carrier before him, in his own frame: past him, into his way to the goal; goal-side he
/// goes straight in.
fn past_him(view: &View, own: Vec2, carrier: &Player) -> Option<Vec2> {
    let gap = own.distance(carrier.pos * view.side);
    if own.x < view.ball.x + 0.5 {
        let runs = carrier.vel.length() > 4.0 && (1.2..2.2).contains(&gap);
        return runs.then(|| view.ball + carrier.vel * view.side * 0.25);
    }
    if gap < CHALLENGE_M {
        return alongside(view, own, carrier);
    }
    let way = (-GOAL - view.ball).normalize_or(Vec2::NEG_X);
    Some(view.ball + way * (gap * 0.6).clamp(1.5, 6.0) + carrier.vel * view.side * 0.3)
}

/// Where a defender runs who has a running carrier's back before them, in their own frame: past the carrier's shoulder;
/// none where they are beside the carrier.
fn alongside(view: &View, own: Vec2, carrier: &Player) -> Option<Vec2> {
    let place = carrier.pos * view.side;
    let way = (-GOAL - place).normalize_or(Vec2::NEG_X);
    let from = own - place;
    if from.dot(way) > BESIDE_M || stands(carrier) {
        return None;
    }
    let shoulder = if way.perp_dot(from) < 0.0 { -way.perp() } else { way.perp() };
    Some(place + shoulder * SHOULDER_M + way * PAST_M)
}

/// Whether a bot stands with the ball: it looks for a pass. An agent who stands is not attacked. (Measured.)
fn lingers(game: &Match, rival: PlayerId) -> bool {
    stands(game.player(rival)) && game.play.driven & (1 << rival.0) == 0
}

/// Whether he stands still with the ball.
fn stands(carrier: &Player) -> bool {
    carrier.vel.length() < STANDS_MPS
}

/// Where he runs who has a standing carrier between himself and the ball, in his own frame: round him.
fn around_him(view: &View, own: Vec2, carrier: &Player) -> Option<Vec2> {
    let middle = carrier.pos * view.side;
    let from = own - middle;
    let way = (view.ball - middle).try_normalize()?;
    let near = from.length() < 2.0;
    if !near || !stands(carrier) || from.normalize_or_zero().dot(way) > BEHIND {
        return None;
    }
    let side = if way.perp_dot(from) < 0.0 { -way.perp() } else { way.perp() };
    Some(middle + side * ROUND_M + way * 0.3)
}

/// Slides at a ball that the carrier has pushed far ahead, from where it can be reached; only players of a team without
/// agents do. (GRF's.)
fn maybe_slide(game: &mut Match, events: &mut Events, view: &View, id: PlayerId, rival: PlayerId) {
    let led = game.agents.iter().any(|slot| slot.team == view.team);
    if led || game.player(id).role == Role::GK || game.ball.pos.z > 0.4 {
        return;
    }
    let (player, carrier) = (game.player(id), game.player(rival));
    let ball = game.play.forecast.at(game.tick + SLIDE_AHEAD_TICKS).truncate();
    let ahead_s = SLIDE_AHEAD_TICKS as f32 * 0.01;
    let gap = (player.pos + player.vel * ahead_s).distance(ball);
    let lead = carrier.pos.distance(game.ball.pos.truncate());
    let between = (ball - carrier.pos).normalize_or_zero().dot((player.pos - carrier.pos).normalize_or_zero());
    if !SLIDE_M.contains(&gap) || lead < LONG_TOUCH_M || between < OPEN {
        return;
    }
    let tackler = player.skill(Stat::SlidingTackle);
    if noise::chooses(game, SLIDES * (0.4 + tackler)) {
        slide::begin(game, events, id, None);
    }
}

/// The second man.
pub fn second(game: &mut Match, events: &mut Events, view: &View, id: PlayerId) {
    if view.owner.is_none() && game.player(id).body.meet_s < 1.0 && game.play.pass.is_none() {
        let body = &mut game.players[id.index()].body;
        body.intent = Intent::Ball(SPRINT_MPS);
        body.dribble = Vec2::ZERO;
        return;
    }
    let carrier = view.owner.filter(|owner| owner.team() != view.team && game.play.hands.is_none());
    let player = game.player(id);
    match carrier.filter(|rival| player.pos.distance(game.player(*rival).pos) < hunt_m(game, player)) {
        Some(rival) => {
            hunt(game, view, id, rival);
            maybe_slide(game, events, view, id, rival);
        }
        None => cover(game, view, id),
    }
}

/// Runs to the point of a carrier's way to goal that is as near to the carrier as to the hunter; from near for the ball.
/// (GRF's.)
fn hunt(game: &mut Match, view: &View, id: PlayerId, rival: PlayerId) {
    let carrier = *game.player(rival);
    let (own, place) = (game.player(id).pos * view.side, carrier.pos * view.side);
    let between = place - own;
    if between.length() < CHALLENGE_M {
        let body = &mut game.players[id.index()].body;
        body.dribble = Vec2::new(2.0 * view.side, 0.0);
        body.intent = match alongside(view, own, &carrier) {
            Some(point) => Intent::Go(point * view.side, SPRINT_MPS),
            None => Intent::Ball(SPRINT_MPS),
        };
        return;
    }
    let way = -GOAL - place;
    // How much of the way it is: the middle between both, seen along it.
    let share = (0.5 * between.length_squared() / between.dot(-way).max(1e-3)).clamp(0.0, 1.0);
    let ahead = way.normalize_or_zero() * (0.1 * SPRINT_MPS) + carrier.vel * view.side * 0.14;
    send(game, view, id, place + way * share + ahead, SPRINT_MPS);
}

/// Stands between the ball and the own goal, some metres off.
pub fn cover(game: &mut Match, view: &View, id: PlayerId) {
    let goal = Vec2::new(-54.0, 0.0);
    let way = goal - view.ball;
    let length = way.length().max(1.0);
    let off = (length * 0.25).clamp(3.5, 8.0);
    let own = game.player(id).pos * view.side;
    let block = super::formation::place(game, view, id, id);
    let spot = view.ball + way * (off / length);
    let weight = if own.distance(view.ball) < 25.0 || view.ball.x < -15.0 { 0.75 } else { 0.4 };
    let to = block + (spot - block) * weight;
    let speed = if own.x > view.ball.x - 1.0 { SPRINT_MPS } else { 6.5 };
    send(game, view, id, to, speed);
}
