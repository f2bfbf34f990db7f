//! A ball that gets past a player: it comes off the body of whoever was to have it.

use crate::football::dribble_motion::{self, Sending};
use crate::football::{contact, reach};
use crate::state::event::Events;
use crate::state::play::ticks_since;
use crate::state::{Match, PlayerId};

/// The ball is this near now, metres, and further off than `THEN_M` after `SOON_TICKS`. (GRF's.)
const NEAR_M: f32 = 0.6;
const THEN_M: f32 = 0.65;
const SOON_TICKS: u32 = 20;
/// Up to which height it comes off a body, metres. (GRF's.)
const HIGH_M: f32 = 1.6;
/// How long before neither the player nor a rival has touched it, ticks. (GRF's.)
const OWN_TICKS: i32 = 149;
const RIVALS_TICKS: i32 = 24;
/// Until the end of the step in which it comes off a body, ticks: half of a step. (GRF's steps.)
const REST_TICKS: u8 = 12;

/// Lets a ball that gets past the player who is first at it come off their body.
pub fn off_body(game: &mut Match, events: &mut Events) {
    let first = game.owner.or_else(|| reach::first(game));
    let Some(id) = first.filter(|&id| gets_past(game, id)) else { return };
    let player = game.player(id);
    let sending = Sending { wish: player.body.dribble, to: player.vel, rest: REST_TICKS };
    let velocity = dribble_motion::sent(game, id, &sending);
    contact::push(game, events, id, velocity.truncate(), velocity.z);
}

/// Whether the ball is about to get past a player who runs or stands, and doesn't play it.
fn gets_past(game: &Match, id: PlayerId) -> bool {
    let (player, ball) = (game.player(id), game.ball.pos);
    let now_m = player.pos.distance(ball.truncate());
    if now_m >= NEAR_M || ball.z >= HIGH_M {
        return false;
    }
    let soon = game.play.forecast.at(game.tick + SOON_TICKS).truncate();
    let then_m = (player.pos + player.vel * (SOON_TICKS as f32 * 0.01)).distance(soon);
    let body = &player.body;
    let since = |touched| ticks_since(game.tick, touched);
    then_m > now_m.max(THEN_M)
        && player.is_up()
        && body.lunge.is_none()
        && !body.swings()
        && since(body.touched_at) >= OWN_TICKS
        && game
            .team(id.team().other())
            .all(|(_, rival)| since(rival.body.touched_at) >= RIVALS_TICKS)
}
