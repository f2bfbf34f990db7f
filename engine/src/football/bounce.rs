//! Bounces of the ball off a player who could not see it coming.

use crate::football::{contact, forecast};
use crate::state::event::Events;
use crate::state::play::ticks_since;
use crate::state::player::Aim;
use crate::state::{Match, Squad};

/// For `UNSEEN_TICKS` nobody has seen where a rival's touch sends the ball. Between two bounces off
/// a body there are at least `BOUNCE_TICKS`. Legs are `LEGS_M` high. (GRF's.)
const UNSEEN_TICKS: i32 = 20;
const BOUNCE_TICKS: i32 = 15;
const LEGS_M: f32 = 1.0;
/// The ball meets the legs this near to a body's middle, metres. Fitted to how often the ball
/// changes sides at once.
const BODY_M: f32 = 0.45;

/// Lets the ball bounce off a player whose rival has just touched it. `near`: the players that it
/// may hit. Who takes the ball or kicks it minds their own motion, whether it meets the ball or
/// not; who pokes is hit by a ball that was touched after their leg went out. (GRF's.)
pub fn off_bodies(game: &mut Match, events: &mut Events, near: Squad) {
    let Some(last) = game.last_touch else { return };
    let touched = game.player(last).body.touched_at;
    let since = ticks_since(game.tick, touched);
    let ball = game.ball.pos;
    if since >= UNSEEN_TICKS
        || ball.z > LEGS_M
        || ticks_since(game.tick, game.play.bounced_at) <= BOUNCE_TICKS
    {
        return;
    }
    let hit = game.order_of(near).find(|&id| {
        let player = game.player(id);
        id.team() != last.team()
            && player.is_on_feet()
            && player.pos.distance_squared(ball.truncate()) < BODY_M * BODY_M
            && ticks_since(game.tick, player.body.touched_at) >= UNSEEN_TICKS
            && player
                .body
                .lunge
                .is_none_or(|lunge| lunge.aim() == Some(Aim::Poke) && lunge.from() < touched)
    });
    let Some(id) = hit else { return };
    let player = *game.player(id);
    let from = ball.truncate() - player.pos;
    let recent = 0.2 + 0.8 * (1.0 - since as f32 / UNSEEN_TICKS as f32);
    let away = (from.normalize_or(player.body.facing) * recent + player.vel * (1.0 - recent))
        .normalize_or_zero();
    let velocity = game.ball.vel;
    let speed = velocity.length();
    let full = away.extend(0.0) * (6.0 + 0.6 * speed) - velocity * 0.2;
    let squarely = 1.0 - 0.25 * from.length() / BODY_M;
    contact::sprang(game, events, id);
    game.play.bounced_at = game.tick as i32;
    game.ball.vel = velocity.lerp(full, squarely).clamp_length_max(speed) * 0.7;
    forecast::renew(game);
}
