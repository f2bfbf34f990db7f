//! The first touch of a free ball that no motion leads to: a player takes it, or loses it.

use crate::football::{contact, dribble, leg, noise};
use crate::state::event::Events;
use crate::state::play::ticks_since;
use crate::state::player::Pose;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::Stat;

/// A higher ball is left to come down, metres.
pub(super) const CHEST_M: f32 = 1.25;
/// How near a player must be to take a free ball, metres.
const TRAP_M: f32 = 0.75;
/// How fast a trapped ball is drawn to the foot of a standing player, per second, and its top
/// speed, m/s; fitted.
const SETTLES_PER_S: f32 = 4.0;
const SETTLED_MPS: f32 = 0.8;
/// A trapped ball runs ahead at most this much faster than its player, m/s. Measured of standing
/// players.
const FOLLOWED_MPS: f32 = 3.6;
/// A free ball is taken along for at most this pace (`FREE_MPS`), or for one that is so much faster
/// than the player's own. Fitted to first touches at starts.
const FREE_MPS: f32 = 5.5;
const FASTER_MPS: f32 = 2.9;
/// A ball met faster than this hops off the body that takes it, m/s; chosen.
const HOPS_MPS: f32 = 8.0;
/// Ticks until a player who has taken up such a ball plays it again; fitted.
const TAKING_TICKS: i32 = 33;

/// How near a player must be to take the free ball, metres. If both are at rest, the reach is
/// longer; whoever is about to kick it reaches less far.
pub(super) fn reach_m(game: &Match, id: PlayerId) -> f32 {
    let player = game.player(id);
    let rests = player.vel.length_squared() + game.ball.vel.length_squared()
        < dribble::STOPS_MPS * dribble::STOPS_MPS;
    let kicks = player.body.kick.is_some_and(|plan| !plan.held);
    let reach_m = if rests { dribble::SOLE_M } else { TRAP_M };
    if kicks { reach_m * leg::BEFORE_A_KICK.factor } else { reach_m }
}

/// Takes a free ball; ball control decides how much of its speed stays.
pub(super) fn take(game: &mut Match, events: &mut Events, id: PlayerId) {
    let player = *game.player(id);
    let ball = game.ball;
    let meeting = (ball.vel - player.vel.extend(0.0)).length();
    let taken_from_rival = game.play.pass.is_some_and(|pass| pass.by.team() != id.team());
    // A ball off a keeper that dives comes as a surprise; chosen.
    let off_hands = game.last_touch.is_some_and(|last| {
        last.team() != id.team() && matches!(game.player(last).body.pose, Pose::Diving | Pose::Down)
    });
    if taken_from_rival || off_hands || game.play.shot.is_some() {
        // A faster ball from an opponent is harder to read.
        let reaction = player.skill(Stat::Reaction);
        let chance = (1.25 - 0.028 * meeting)
            * (0.5 + 0.5 * reaction)
            * (1.0 - 0.95 * surprise(game, reaction));
        if !noise::happens(game, chance) {
            game.players[id.index()].body.ready_at = game.tick as i32 + 40;
            return;
        }
    }
    let control = player.skill(Stat::BallControl);
    let wildness = noise::roll(game);
    let from_mate = game.play.pass.is_some_and(|pass| pass.by.team() == id.team());
    let keep = if from_mate {
        0.0
    } else {
        ((meeting - 3.0) / 30.0).clamp(0.0, 1.0)
            * (0.85 - 0.55 * control)
            * (0.15 + 0.75 * wildness)
    };
    let wish = player.body.dribble;
    let to_ball = ball.pos.truncate() - player.pos;
    let lies = ball.vel.length_squared() < dribble::LIES_MPS * dribble::LIES_MPS;
    let care = dribble::Care { lines: dribble::minds_lines(game, id), lies };
    let ahead = wish.normalize_or_zero();
    let hard = meeting > HOPS_MPS;
    let soft = match (wish.length_squared() > 0.25, hard) {
        (true, _) => {
            let most = (player.vel.dot(ahead) + FASTER_MPS).max(FREE_MPS);
            let on = dribble::ahead(&player, to_ball, ahead, wish.length().min(most), &care);
            // A hard one runs ahead no faster than the player can follow.
            if hard {
                on.clamp_length_max(player.vel.dot(ahead).max(0.0) + FOLLOWED_MPS)
            } else {
                on * if lies { 1.0 } else { 0.85 }
            }
        }
        // Towards the foot, to come to rest there.
        (false, true) => ((player.body.facing * dribble::LAID_M - to_ball) * SETTLES_PER_S)
            .clamp_length_max(SETTLED_MPS),
        (false, false) => player.vel * 0.5,
    };
    let aside = noise::bell(game) * keep * 0.5;
    let left_over = ball.vel.truncate() * keep;
    let velocity = soft * (1.0 - keep) + left_over + Vec2::new(-left_over.y, left_over.x) * aside;
    contact::push(game, events, id, velocity, if hard { hop_mps(meeting) } else { 0.0 });
    if wish.length_squared() > 0.25 {
        dribble::note_turn(game, id, ahead);
    }
    if hard {
        game.players[id.index()].body.ready_at = game.tick as i32 + TAKING_TICKS;
    }
}

/// How fast a ball rises from the body that takes it, m/s, for the speed at which they meet.
/// Measured: a ball taken at hip height reaches the foot about 0.4 s later, about 0.9 s after a
/// head-on run.
fn hop_mps(meeting: f32) -> f32 {
    let hard = ((meeting - 12.0) / 11.0).clamp(0.0, 1.2);
    0.4 + 2.2 * hard * libm::sqrtf(hard)
}

/// How much a ball just struck surprises a player, 0 to 1: GRF's recency of the rival's touch, over
/// 1000 - 500 · reaction ms.
fn surprise(game: &Match, reaction: f32) -> f32 {
    let since = game
        .last_touch
        .map_or(i32::MAX, |last| ticks_since(game.tick, game.player(last).body.touched_at));
    let window = 100.0 - 50.0 * reaction;
    libm::powf((1.0 - since as f32 / window).clamp(0.0, 1.0), 0.6)
}
