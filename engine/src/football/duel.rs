//! Challenges for the ball: a leg goes out to where the ball will be.
//!
//! A lunge is decided some ticks before the foot meets the ball. It aims at the place where the
//! ball will be if nobody touches it. If somebody does, the foot arrives beside the ball.

use crate::football::{
    bounce, contact, dribble_motion, leg, noise, poke, possession, reach, report, slide, touch,
    trap,
};
use crate::state::event::Events;
use crate::state::player::{Aim, Lunge, Pose};
use crate::state::{Match, Player, PlayerId, Squad};
use setpiece_scenario::vocabulary::{EventKind, Role, Team};

/// A carrier's ball that they have again no sooner than this is stopped like one that nobody has,
/// seconds. (GRF's.)
const LOOSE_S: f32 = 0.4;
/// A slower ball isn't trapped, m/s. (GRF's.)
const TRAPPED_MPS: f32 = 2.0;
/// An unseen touch is judged `AHEAD_TICKS` ahead. If it moves the ball there by more than
/// `MISJUDGED_M`, the player doesn't reach for it. (GRF's.)
const AHEAD_TICKS: u32 = 100;
const MISJUDGED_M: f32 = 2.0;
/// Limits of the cosine that tells how far an opponent stands between a player and the ball: too
/// far to poke it, and to take it. (GRF's.)
const POKES: f32 = 0.6;
const TAKES: f32 = 0.5;
/// Slides of players without agents. (GRF's.)
///
/// - `SLIDE_TICKS`: how far ahead the ball is looked at.
/// - `SLIDE_M`, `SLIDE_HIGH_M`: how far from the tackler and how high the ball must be then.
/// - `LEFT_S`, `LATER`: the carrier needs at least this long to reach the ball, in seconds and as a
///   share of the tackler's time.
/// - `SLIDES_TO`: up to this cosine the carrier doesn't stand between the tackler and the ball.
const SLIDE_TICKS: u32 = 20;
const SLIDE_M: std::ops::Range<f32> = 0.7..1.6;
const SLIDE_HIGH_M: f32 = 0.4;
const LEFT_S: f32 = 0.26;
const LATER: f32 = 0.6;
const SLIDES_TO: f32 = -0.4;
/// Speed of a poked ball, besides half of what taking it would give, m/s. (GRF's.)
const POKED_MPS: f32 = 4.0;

/// Lets legs that have arrived meet the ball, and sends out those that can reach it. `legs`: the
/// players with a leg out when the tick began. `near`: the players that may send one.
pub fn contest(game: &mut Match, events: &mut Events, legs: Squad, near: Squad) {
    let now = game.tick as i32;
    for id in game.order_of(legs) {
        let Some(lunge) = game.player(id).body.lunge else { continue };
        if lunge.at == now {
            meet(game, events, id, lunge);
        }
        if lunge.until() <= now {
            game.players[id.index()].body.lunge = None;
        }
        if game.dead {
            return;
        }
    }
    bounce::off_bodies(game, events, near);
    let Some(rival) = game.on_ball() else { return };
    for id in game.order_of(near) {
        if id.team() != rival.team()
            && game.tick.is_multiple_of(every(game, id, rival))
            && may(game, id)
        {
            begin(game, events, id, rival);
        }
    }
}

/// Whether a player is free to reach for the ball.
fn may(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    player.is_up()
        && player.body.lunge.is_none()
        && !player.body.swings()
        && game.tick as i32 >= player.body.ready_at
        && touch::contests(game, id)
}

/// Ticks between two attempts of a player to reach for the ball.
///
/// It depends on who they are: sooner at the ball than its owner, first of their team, or anybody
/// else. (GRF's.)
fn every(game: &Match, id: PlayerId, rival: PlayerId) -> u32 {
    let first = game.play.chaser[id.team().index()] == Some(id);
    if !first {
        5
    } else if game.player(id).body.meet_s < game.player(rival).body.meet_s {
        2
    } else {
        4
    }
}

/// Begins a motion that meets a rival's ball, or a slide.
fn begin(game: &mut Match, events: &mut Events, id: PlayerId, rival: PlayerId) {
    let (player, other) = (*game.player(id), *game.player(rival));
    // A player who hasn't seen the last touch trusts the ball's earlier path, unless the touch
    // changed it much.
    if reach::expected(game, id, AHEAD_TICKS)
        .distance(game.play.forecast.at(game.tick + AHEAD_TICKS))
        > MISJUDGED_M
    {
        return;
    }
    let soon = |player: &Player| player.pos + player.vel * 0.1;
    let to_ball = game.play.forecast.at(game.tick + 10).truncate() - soon(&other);
    let hidden =
        (soon(&other) - soon(&player)).normalize_or_zero().dot(to_ball.normalize_or_zero());
    let first = game.play.chaser[id.team().index()] == Some(id);
    let ours = soonest_s(game, id.team()) < other.body.meet_s;
    let takes = if ours { dribble_motion::is_slow(game, id) } else { hidden <= TAKES };
    if first && takes && dribble_motion::takes(game, id) {
        return;
    }
    let rolls = game.ball.vel.truncate().length_squared() > TRAPPED_MPS * TRAPPED_MPS;
    let loose = other.body.meet_s > LOOSE_S && !possession::has_ball(game, rival) && hidden <= 0.0;
    if first
        && rolls
        && (ours || loose)
        && let Some(trap) = trap::find(game, id)
    {
        dribble_motion::start(game, id, trap, Aim::Carry);
        return;
    }
    if !ours
        && hidden <= POKES
        && let Some(poke) = poke::find(game, id)
    {
        dribble_motion::start(game, id, poke, Aim::Poke);
        return;
    }
    if hidden <= SLIDES_TO && comes_late(game, id, &player, &other) {
        slide::begin(game, events, id, None);
    }
}

/// How soon somebody of a team is at the ball, seconds.
fn soonest_s(game: &Match, team: Team) -> f32 {
    let first = game.play.chaser[team.index()];
    first.map_or(f32::MAX, |id| game.player(id).body.meet_s)
}

/// Whether the ball gets past a player before its carrier has it again. A team without agents
/// slides at such a ball. (GRF's.)
fn comes_late(game: &Match, id: PlayerId, player: &Player, carrier: &Player) -> bool {
    let ball = game.play.forecast.at(game.tick + SLIDE_TICKS);
    let gap = (player.pos + player.vel * (SLIDE_TICKS as f32 * 0.01)).distance(ball.truncate());
    let (own_s, other_s) = (player.body.meet_s, carrier.body.meet_s);
    SLIDE_M.contains(&gap)
        && other_s > LEFT_S
        && other_s + 0.2 < LATER * (own_s + 0.2)
        && ball.z < SLIDE_HIGH_M
        && player.role != Role::GK
        && !game.has_agents(id.team())
}

/// Lets a foot arrive where the ball was expected.
fn meet(game: &mut Match, events: &mut Events, id: PlayerId, lunge: Lunge) {
    let player = *game.player(id);
    let slides = lunge.aim == Aim::Slide && player.body.pose == Pose::Sliding;
    if game.dead || game.play.hands.is_some() || !(player.is_up() || slides) {
        return;
    }
    let Some(missed) = leg::missed_share(game, lunge.place) else { return };
    let before = game.ball.vel;
    let velocity = match lunge.aim {
        Aim::Carry => dribble_motion::touched(game, id, &lunge),
        Aim::Poke => {
            let away = (game.ball.pos.truncate() - player.pos).normalize_or_zero() * POKED_MPS;
            let carried = dribble_motion::touched(game, id, &lunge);
            carried * 0.5 + away.extend(0.5 + noise::roll(game))
        }
        Aim::Slide => slide::touched(&player, before),
    };
    let velocity = velocity.lerp(before, missed);
    let rival = game.on_ball().filter(|rival| rival.team() != id.team());
    if let Some(rival) = rival {
        report::did(game, events, EventKind::Tackle, id, Some(rival));
    }
    contact::push(game, events, id, velocity.truncate(), velocity.z);
    if lunge.aim != Aim::Carry {
        // No deliberate kick: the keeper may pick it up.
        game.play.kicked_by = None;
    }
}
