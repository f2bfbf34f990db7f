//! Challenges for the ball: a leg goes out to where the ball will be.
//!
//! A lunge is decided some ticks before the foot meets the ball. It aims at the place where the
//! ball will be if nobody touches it. If somebody does, the foot arrives beside the ball.

use crate::football::carry::Carry;
use crate::football::pace::DRIBBLES_FROM_MPS;
use crate::football::reach_motion::{
    BACK_DEG, KEEPER_POKES, RUNNING_POKES, ReachMotion, STANDING_POKES, TAKES, TRAP, motions,
};
use crate::football::{
    bounce, contact, dribble_motion, first_touch, foot, leg, noise, possession, reach, report,
    slide, touch,
};
use crate::state::event::Events;
use crate::state::player::{Aim, Lunge, Motion};
use crate::state::{Match, Player, PlayerId, Squad};
use glam::Vec2;
use setpiece_scenario::vocabulary::{EventKind, Role};

/// A carrier's ball that they have again no sooner than this is stopped like one that nobody has,
/// seconds. (GRF's.)
const LOOSE_S: f32 = 0.4;
/// How a player brakes who stops for a ball, m/s².
const STOPPING_MPS2: f32 = 13.0;
/// A slower ball isn't trapped, m/s. (GRF's.)
const TRAPPED_MPS: f32 = 2.0;
/// A ball that meets a player faster than this can't be taken along, m/s. (GRF's.)
const TAKES_MPS: f32 = 15.0;
/// An unseen touch is judged `AHEAD_TICKS` ahead. If it moves the ball there by more than
/// `MISJUDGED_M`, the player doesn't reach for it. (GRF's.)
const AHEAD_TICKS: u32 = 100;
const MISJUDGED_M: f32 = 2.0;
/// The highest ball that a leg reaches, metres.
const LOW_M: f32 = 0.5;
/// Limits of the cosine that tells how far an opponent stands between a player and the ball: too
/// far to poke it, and to take it. (GRF's.)
const HIDDEN: [f32; 2] = [0.6, 0.5];
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
/// The same for a keeper, who clears the ball. Fitted to where balls go when a keeper comes out.
const KEEPER_MPS: f32 = 7.5;

/// Lets legs that have arrived meet the ball, and sends out those that can reach it. `legs`: the
/// players with a leg out when the tick began. `near`: the players that may send one.
pub fn contest(game: &mut Match, events: &mut Events, legs: Squad, near: Squad) {
    let now = game.tick as i32;
    for id in game.order_of(legs) {
        let Some(lunge) = game.player(id).body.lunge else { continue };
        if lunge.at == now && near.has(id) {
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

/// Reaches for the ball if a motion will meet it.
fn begin(game: &mut Match, events: &mut Events, id: PlayerId, rival: PlayerId) {
    let (player, other) = (*game.player(id), *game.player(rival));
    let seen = reach::has_seen(game, id);
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
    let sooner = player.body.meet_s < other.body.meet_s;
    let pace = player.vel.length();
    let slow = (game.ball.vel.truncate() - player.vel).length_squared() < TAKES_MPS * TAKES_MPS;
    let takes = first && slow && (sooner || hidden <= HIDDEN[1]) && player.role != Role::GK;
    let rolls = game.ball.vel.truncate().length_squared() > TRAPPED_MPS * TRAPPED_MPS;
    // An agent's player takes the ball as the keys say: `first_touch`.
    let loose = other.body.meet_s > LOOSE_S && !possession::has_ball(game, rival);
    let traps =
        first && (sooner || loose) && seen && rolls && pace >= TRAP.from_mps && !game.is_driven(id);
    let turn = turn_degrees(&player);
    let takes = if takes { motions(&TAKES, pace, turn) } else { &[] };
    if takes.iter().any(|way| lunges(game, id, way, Aim::Take)) {
        return;
    }
    if traps && turn > BACK_DEG && lunges(game, id, &TRAP, Aim::Take) {
        return;
    }
    let running = if player.role == Role::GK { &KEEPER_POKES[..] } else { &RUNNING_POKES[..] };
    let pokes = match motions(running, pace, 0.0) {
        _ if sooner || hidden > HIDDEN[0] => &[],
        [] => &STANDING_POKES[..],
        pokes => pokes,
    };
    if pokes.iter().any(|way| lunges(game, id, way, Aim::Poke)) {
        return;
    }
    if hidden <= SLIDES_TO && comes_late(game, id, &player, &other) {
        slide::begin(game, events, id, None);
    }
}

/// The angle between a player's run and the way that they want with the ball, degrees.
fn turn_degrees(player: &Player) -> f32 {
    let run = if player.vel.length_squared() < DRIBBLES_FROM_MPS * DRIBBLES_FROM_MPS {
        player.body.facing
    } else {
        player.vel.normalize_or_zero()
    };
    let cos = player.body.dribble.try_normalize().map_or(1.0, |wish| wish.dot(run));
    libm::acosf(cos.clamp(-1.0, 1.0)).to_degrees()
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

/// Reaches for the ball in a way, if that meets it where it will be.
fn lunges(game: &mut Match, id: PlayerId, way: &ReachMotion, aim: Aim) -> bool {
    let ball = reach::expected(game, id, way.ticks as u32);
    let now = game.tick as i32;
    let player = &mut game.players[id.index()];
    if ball.z >= LOW_M || !reaches(player, ball.truncate(), way) {
        return false;
    }
    player.body.left_leads = !foot::left_leads(player, now);
    let (at, place) = (now + way.ticks, ball.truncate());
    let (out, back) = (way.ticks as u8, (way.lasts - way.ticks) as u8);
    let motion = Motion::Reach { aim, stops: way.stops, place };
    player.body.lunge = Some(Lunge { at, out, back, changes_feet: true, motion });
    player.body.ready_at = now + way.lasts;
    true
}

/// Whether the foot's place is near enough to the ball.
fn reaches(player: &Player, ball: Vec2, way: &ReachMotion) -> bool {
    let run = if way.from_mps > 0.0 {
        player.vel.normalize_or(player.body.facing)
    } else {
        player.body.facing
    };
    let seconds = way.ticks as f32 * 0.01;
    let runs = if way.stops { brakes(player.vel, seconds) } else { player.vel * seconds };
    let to_ball = ball - player.pos - runs;
    let (along, across) =
        (to_ball.dot(run) - way.ahead_m, to_ball.perp_dot(run).abs() - way.aside_m);
    let (along, across) = (along / way.along_m, across / way.across_m);
    along * along + across * across <= 1.0
}

/// How far a player gets who brakes for this long, metres.
fn brakes(velocity: Vec2, seconds: f32) -> Vec2 {
    let until = seconds.min(velocity.length() / STOPPING_MPS2);
    velocity * until - velocity.normalize_or_zero() * (0.5 * STOPPING_MPS2 * until * until)
}

/// Lets a foot arrive where the ball was expected.
fn meet(game: &mut Match, events: &mut Events, id: PlayerId, lunge: Lunge) {
    let ball = game.ball.pos;
    if ball.z > 1.0 || !game.player(id).is_up() || game.play.hands.is_some() {
        return;
    }
    let (aim, place) = match lunge.motion {
        Motion::Reach { aim, place, .. } => (aim, place),
        Motion::Dribble { brakes, out_dmps, wish } => {
            let to = dribble_motion::out(game.player(id), wish, out_dmps, brakes);
            dribble_motion::touch(
                game,
                events,
                id,
                &Carry { wish, to, rest: lunge.back, first: game.last_touch != Some(id) },
            );
            return;
        }
    };
    let Some(missed) = leg::missed_share(game, place.extend(ball.z)) else { return };
    let rival = game.on_ball().filter(|rival| rival.team() != id.team());
    let before = game.ball.vel;
    let taken = first_touch::contested(game, id);
    let velocity = if aim == Aim::Poke {
        let tackler = game.player(id);
        let away = (ball.truncate() - tackler.pos).normalize_or_zero();
        let poked = if tackler.role == Role::GK { KEEPER_MPS } else { POKED_MPS };
        taken * 0.5 + (away * poked).extend(0.5 + noise::roll(game))
    } else {
        taken
    };
    let velocity = velocity.lerp(before, missed);
    if let Some(rival) = rival {
        report::did(game, events, EventKind::Tackle, id, Some(rival));
    }
    contact::push(game, events, id, velocity.truncate(), velocity.z);
    if aim == Aim::Poke {
        // A poke is no deliberate kick: the keeper may pick it up.
        game.play.kicked_by = None;
    }
}
