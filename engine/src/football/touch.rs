//! Who plays a ball within reach.
//!
//! `dribble_motion` and `dribble` handle the touches of a dribble, `first_touch` those of a free
//! ball, `duel` fights for an owned ball, and `keeper` hands. `contact` and `offside` decide what a
//! touch means (passes, offside).

use crate::football::{dribble, dribble_motion, first_touch};
use crate::state::event::Events;
use crate::state::play::ticks_since;
use crate::state::player::{Aim, Intent, Pose};
use crate::state::{Match, PlayerId, Squad};
use setpiece_scenario::Ai;
use setpiece_scenario::vocabulary::Rule;

/// A ball higher than this isn't at its owner's foot yet, metres.
pub(super) const FOOT_HIGH_M: f32 = 0.5;
/// Nobody further from the ball plays it in a tick, metres: a foot reaches 1.1, and the motion of a
/// touch begins at most this far off.
const NEAR_M: f32 = 1.3;
/// From how far somebody may reach for the ball, metres: as far as they run until their foot is
/// there.
const ABOUT_M: f32 = 4.5;
/// A stumbling player keeps a ball this near, metres, within `KEPT_TICKS` of their last touch.
/// (GRF's.)
const KEPT_M: f32 = 0.4;
const KEPT_TICKS: i32 = 45;
/// Ticks between two touches of one player.
const PAUSE_TICKS: i32 = 24;

/// The players near enough to touch the ball in this tick, or to begin the motion of a touch.
pub(super) fn near(game: &Match) -> Squad {
    let ball = game.ball.pos.truncate();
    let mut near = Squad::default();
    for id in game.squad.ids() {
        if game.player(id).pos.distance_squared(ball) <= NEAR_M * NEAR_M {
            near.add(id);
        }
    }
    near
}

/// The players near enough to reach for the ball.
pub(super) fn about(game: &Match) -> Squad {
    let ball = game.ball.pos.truncate();
    let free = !game.dead && game.play.hands.is_none() && game.play.set_piece.is_none();
    let near = |id: &PlayerId| game.player(*id).pos.distance_squared(ball) <= ABOUT_M * ABOUT_M;
    game.squad.ids().filter(|id| free && near(id)).collect()
}

/// Lets a player who can and wants to play the ball do so, at most one touch per tick. `near`: who
/// may be in reach. True unless the ball runs on untouched.
pub fn play_ball(game: &mut Match, events: &mut Events, near: Squad, about: Squad) -> bool {
    if game.dead || game.play.hands.is_some() || game.play.set_piece.is_some() {
        return true;
    }
    dribble_motion::begin(game, near, about);
    let ball = game.ball.pos;
    let flat = ball.truncate();
    let owner = game.on_ball().filter(|&id| plays_on(game, id));
    let mut nearest: Option<(f32, PlayerId)> = None;
    for id in game.order_of(near) {
        let player = game.player(id);
        let distance = player.pos.distance_squared(flat);
        if distance > 1.1 * 1.1
            || !(player.is_up() || keeps(game, id, distance))
            || ball.z > first_touch::CHEST_M
        {
            continue;
        }
        if owner == Some(id) {
            // The owner's own touch comes first. If the owner lets the ball be, a rival may try.
            let foot = dribble::foot_m(player);
            let reaches = distance <= foot * foot && ball.z < FOOT_HIGH_M;
            if reaches
                && wants_ball(game, id)
                && !player.body.swings()
                && !dribble_motion::waits(game, id)
                && dribble::touch(game, events, id)
            {
                return true;
            }
        } else if nearest.is_none_or(|(best, _)| distance < best) && wants_ball(game, id) {
            nearest = Some((distance, id));
        }
    }
    let Some((distance, id)) = nearest else { return false };
    let near = libm::sqrtf(distance);
    let contested = owner.is_some_and(|rival| rival.team() != id.team());
    let takes =
        !contested && near <= first_touch::reach_m(game, id) && !game.player(id).body.swings();
    if takes {
        first_touch::take(game, events, id);
    }
    takes
}

/// Whether a player would reach for a ball that a rival has.
pub(super) fn contests(game: &Match, id: PlayerId) -> bool {
    (game.player(id).ai != Ai::Lazy || game.is_driven(id)) && game.last_touch != Some(id)
}

/// Whether the last owner can play the ball on, or is in the motion of their next touch. Not right
/// after a poke at a rival's ball: then it is free.
fn plays_on(game: &Match, id: PlayerId) -> bool {
    let body = &game.player(id).body;
    let dribbles = body.lunge.is_some_and(|lunge| lunge.aim == Aim::Carry);
    dribbles || game.tick as i32 >= body.ready_at
}

/// Whether a player would play the nearby ball.
pub(super) fn wants_ball(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    if (game.tick as i32) < player.body.ready_at {
        return false;
    }
    if player.ai == Ai::Lazy && !game.is_driven(id) {
        return false;
    }
    if game.last_touch == Some(id) {
        // Players let a ball that they have taken come down.
        return game.ball.pos.z < FOOT_HIGH_M
            && ticks_since(game.tick, player.body.touched_at) >= PAUSE_TICKS;
    }
    let Some(last) = game.last_touch else { return true };
    if last.team() != id.team() {
        return true;
    }
    // Players leave alone a teammate's dribble and a teammate's pass to somebody else.
    if game.controller() == Some(last) {
        return false;
    }
    match game.play.pass.and_then(|pass| pass.to) {
        Some(to) if to != id => game.play.chaser[id.team().index()] == Some(id),
        _ => game.play.shot.is_none() || matches!(player.body.intent, Intent::Ball(_)),
    }
}

/// Whether a stumbling player keeps the ball at their feet. (GRF's.)
fn keeps(game: &Match, id: PlayerId, distance_squared: f32) -> bool {
    let player = game.player(id);
    matches!(player.body.pose, Pose::Stumbling { .. })
        && game.last_touch == Some(id)
        && distance_squared < KEPT_M * KEPT_M
        && ticks_since(game.tick, player.body.touched_at) >= KEPT_TICKS
}

/// Whether a keeper may use their hands: not if lazy, and not if driven by an agent under
/// `grf_keeper`.
pub fn may_handle(game: &Match, id: PlayerId) -> bool {
    let driven = game.is_driven(id);
    let player = game.player(id);
    let bound = if driven { game.rule(Rule::GrfKeeper) } else { player.ai == Ai::Lazy };
    player.active && !bound
}
