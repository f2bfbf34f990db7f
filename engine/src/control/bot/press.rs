//! Going for the ball, free or an opponent's.

use crate::control::bot::formation::mindset;
use crate::control::bot::{TeamView, dribbling, off_ball, on_ball};
use crate::football::pace::SPRINT_MPS;
use crate::state::player::Intent;
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{Role, Stat};

/// A carrier slower than this stands, m/s.
const STANDS_MPS: f32 = 1.0;
/// A player is behind the carrier if the cosine between the player's direction and the ball's, seen
/// from the carrier, is smaller than this.
const BEHIND: f32 = -0.2;
/// A carrier's position is predicted this far ahead, seconds; hunters meet them this far away,
/// metres. (GRF's.)
const AHEAD_S: f32 = 0.14;
const AHEAD_M: f32 = 0.1 * SPRINT_MPS;
/// A hunter waits if the carrier is straight ahead, within this slope, and at least this far away,
/// metres. (GRF's.)
const WAITS_M: f32 = 0.5;
const STRAIGHT: f32 = 0.8;
/// A ball is met if it comes this near, metres, within these ticks, to where the player is after
/// these seconds. The carrier must not stand between: the cosine must not be smaller than this.
/// Measured: defenders begin about that long before.
const MEETS_M: f32 = 1.0;
const MEETS_TICKS: u32 = 25;
const MEETS_AHEAD_S: f32 = 0.1;
const OPEN_TO: f32 = 0.6;
/// Within this distance a hunter goes for the ball itself, metres; chosen.
const CHALLENGE_M: f32 = 2.0;
/// How far to the side of a carrier a defender runs past them, and how far ahead of the carrier
/// they count as beside the ball, metres; chosen.
const SHOULDER_M: f32 = 0.85;
const BESIDE_M: f32 = 0.2;
/// The target lies this far past the carrier, metres, so that defenders don't slow down beside
/// them; chosen.
const PAST_M: f32 = 5.0;
/// A player must reach the ball within this share of the other's time. (GRF's.)
const SOONER: f32 = 0.85;
/// From which chance of the ball on whoever is first of their team goes on for it. (GRF's.)
const KEEPS_ON: f32 = 0.8;
/// Who reaches the ball this soon knows what they want with it, seconds. (GRF's.)
const SOON_S: f32 = 1.0;
/// How far from a carrier's middle a player goes round them, metres.
const ROUND_M: f32 = 0.9;

/// Whether and how a player goes for the ball.
pub enum Pursuit {
    /// Doesn't go for it.
    None,
    /// Fetches a ball that is the team's to have.
    Fetch,
    /// Hunts an opponent's ball.
    Hunt(PlayerId),
}

/// Decides whether a player goes for the ball. (GRF's.) If the ball is the team's to have, its
/// first player goes. For an opponent's ball it is the nearest two, if they are near enough and
/// mark nobody.
pub fn pursuit(game: &Match, view: &TeamView, id: PlayerId) -> Pursuit {
    if game.play.pass.is_some_and(|pass| pass.to == Some(id)) {
        return Pursuit::Fetch;
    }
    let first = game.play.chaser[view.team.index()];
    let held = game.play.hands.is_some();
    if held || view.action.is_none_or(|action| action.team() == view.team) {
        return if first == Some(id) && !held { Pursuit::Fetch } else { Pursuit::None };
    }
    let Some(rival) = view.rival(game) else { return Pursuit::None };
    if first == Some(id) && is_sooner(game, id, rival) {
        return Pursuit::Fetch;
    }
    if game.play.team_pressure[view.team.index()] {
        let [second, third] = game.play.behind[view.team.index()];
        let mut queue = [first, second, third].into_iter().flatten();
        if queue.find(|id| !game.is_driven(*id)) == Some(id) {
            return Pursuit::Hunt(rival);
        }
    }
    let (player, other) = (game.player(id), game.player(rival));
    let gap = (other.pos + other.vel * 0.12).distance(player.pos + player.vel * 0.04);
    let may = !view.best && player.body.mind.mark.is_none() && player.role != Role::GK;
    let near = |to: Vec2| view.board.nearest::<2>(view.team, to, None).contains(&id);
    if !may || gap >= hunt_m(game, player) {
        return Pursuit::None;
    }
    if first == Some(id) && chance(game, id, rival) > KEEPS_ON {
        return Pursuit::Fetch;
    }
    if near(other.pos + other.vel * 0.1) {
        return Pursuit::Hunt(rival);
    }
    Pursuit::None
}

/// Whether a player will be at the ball so much sooner than the opponent who has it that it is
/// theirs to have. (GRF's.)
pub(super) fn is_sooner(game: &Match, id: PlayerId, rival: PlayerId) -> bool {
    let time_s = |id: PlayerId| game.player(id).body.meet_s + 0.01;
    time_s(id) < SOONER * time_s(rival)
}

/// A player's chance of the ball against the opponent who has it: the other's time to it against
/// their own. (GRF's.)
fn chance(game: &Match, id: PlayerId, rival: PlayerId) -> f32 {
    let time_s = |id: PlayerId| game.player(id).body.meet_s + 0.2;
    time_s(rival) / time_s(id)
}

/// Goes for a ball that is the team's to have.
pub fn fetch(game: &mut Match, view: &TeamView, id: PlayerId) {
    let player = *game.player(id);
    let free = game.on_ball().is_none() && player.body.meet_s < SOON_S;
    let way = if free { Some(dribbling::way(game, view, id, 1.0)) } else { away(game, view, id) }
        .unwrap_or_else(|| (player.body.meet - player.pos).clamp_length_max(2.0));
    let body = &mut game.players[id.index()].body;
    body.intent = Intent::Ball(SPRINT_MPS);
    body.dribble = way;
    on_ball::before_touch(game, view, id);
}

/// Goes for an opponent's ball. A player straight in front of the opponent waits in their place
/// instead. (GRF's.)
pub fn hunt(game: &mut Match, view: &TeamView, id: PlayerId, rival: PlayerId) {
    let carrier = *game.player(rival);
    let own = game.player(id).pos * view.side;
    let place = carrier.pos * view.side;
    let between = place - own;
    let way = -game.goal() - place;
    // The point of the carrier's path that is equally near to both.
    let share = (0.5 * between.length_squared() / between.dot(-way).max(1e-3)).clamp(0.0, 1.0);
    let point =
        place + way * share + way.normalize_or_zero() * AHEAD_M + carrier.vel * view.side * AHEAD_S;
    let deep = (point.x - own.x).max(0.0) - WAITS_M;
    if (point.y - own.y).abs() <= deep * STRAIGHT && !game.play.team_pressure[view.team.index()] {
        off_ball::place(game, view, id);
        return;
    }
    let near = between.length() < CHALLENGE_M;
    let past = if near {
        alongside(view, game.goal(), own, &carrier).or_else(|| around(view, own, &carrier))
    } else {
        None
    };
    let body = &mut game.players[id.index()].body;
    body.dribble = Vec2::new(2.0 * view.side, 0.0);
    body.intent = match past {
        Some(point) => Intent::Go(point * view.side, SPRINT_MPS),
        None => Intent::Ball(SPRINT_MPS),
    };
}

/// Whether the ball of an opponent is about to come to a player.
pub fn is_met(game: &Match, view: &TeamView, id: PlayerId) -> bool {
    let Some(rival) = view.owner.filter(|owner| owner.team() != view.team) else { return false };
    let (player, carrier) = (game.player(id), game.player(rival));
    let ball = game.play.forecast.at(game.tick + MEETS_TICKS);
    let at = player.pos + player.vel * MEETS_AHEAD_S;
    let free = || {
        (carrier.pos - player.pos)
            .normalize_or_zero()
            .dot((ball.truncate() - carrier.pos).normalize_or_zero())
    };
    ball.z < 0.5
        && ball.truncate().distance_squared(at) < MEETS_M * MEETS_M
        && player.role != Role::GK
        && free() < OPEN_TO
}

/// Meets a ball that comes with an opponent.
pub fn meet(game: &mut Match, view: &TeamView, id: PlayerId) {
    let way = away(game, view, id).unwrap_or(Vec2::new(2.0 * view.side, 0.0));
    let body = &mut game.players[id.index()].body;
    body.kick = None;
    body.dribble = way;
    body.intent = Intent::Ball(SPRINT_MPS);
}

/// Where a player wants to run with an opponent's ball that they reach first. (GRF's.)
fn away(game: &Match, view: &TeamView, id: PlayerId) -> Option<Vec2> {
    let rival = view.rival(game).filter(|_| !view.best)?;
    let soon = game.player(id).body.meet_s < SOON_S && is_sooner(game, id, rival);
    soon.then(|| dribbling::way(game, view, id, 1.0))
}

/// From how far a player hunts a carrier, metres. (GRF's.)
fn hunt_m(game: &Match, player: &Player) -> f32 {
    let rested = 0.5 * (1.0 - player.fatigue) + 0.5 * (1.0 - (player.body.mean_mps / 8.0).min(1.0));
    // Players with a high work rate hunt from further away: chosen; the average is GRF's.
    let works = 0.7 + 0.4 * player.body.stats[Stat::Workrate.index()];
    (10.0 + 10.0 * (1.0 - mindset(game.player(player.body.mind.fills).role)))
        * rested
        * works
        * player.body.level
}

/// Where a defender runs who sees a running carrier's back, own frame: past the carrier's shoulder.
/// None if they are beside the carrier.
fn alongside(view: &TeamView, goal: Vec2, own: Vec2, carrier: &Player) -> Option<Vec2> {
    let place = carrier.pos * view.side;
    let way = (-goal - place).normalize_or(Vec2::NEG_X);
    let from = own - place;
    if from.dot(way) > BESIDE_M || stands(carrier) {
        return None;
    }
    let shoulder = if way.perp_dot(from) < 0.0 { -way.perp() } else { way.perp() };
    Some(place + shoulder * SHOULDER_M + way * PAST_M)
}

/// Whether a carrier stands still with the ball.
fn stands(carrier: &Player) -> bool {
    carrier.vel.length() < STANDS_MPS
}

/// Where a player runs if a standing carrier is between them and the ball, own frame: round the
/// carrier.
fn around(view: &TeamView, own: Vec2, carrier: &Player) -> Option<Vec2> {
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
