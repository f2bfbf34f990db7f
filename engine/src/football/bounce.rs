//! Bounces of the ball off a player who could not see it coming.

use crate::football::{contact, forecast, foul, offside};
use crate::math;
use crate::state::event::Events;
use crate::state::play::{Save, ticks_since};
use crate::state::player::{Aim, Pose};
use crate::state::{Match, PlayerId, Squad};
use glam::Vec2;

/// For `UNSEEN_TICKS` nobody has seen where a rival's touch sends the ball. Between two bounces off
/// a body there are more than `BOUNCE_TICKS`. (GRF's.)
const UNSEEN_TICKS: i32 = 20;
const BOUNCE_TICKS: i32 = 15;
/// The ball meets a body this near to its middle, metres. Measured of GRF's bounces; fitted to how
/// many there are in a match.
const BODY_M: f32 = 0.3;
/// How much wider a keeper is whose hands are out, and how near to the hands the ball bounces off
/// them, metres. (GRF's.)
const WIDER_M: f32 = 0.2;
const HANDS_M: f32 = 0.25;
/// How fast the ball leaves a body at least, m/s, how much of its speed adds to that, and how much
/// of its own way it loses. (GRF's.)
const LEAVES_MPS: f32 = 6.0;
const LEAVES: f32 = 0.6;
const BACK: f32 = 0.2;
/// What is left of the speed. (GRF's.)
const LEFT: f32 = 0.7;
/// How much of a bounce is left at the edge of a body, and of the way back how much there. (GRF's.)
const AT_EDGE: [f32; 2] = [0.5, 0.1];
/// How much a bounce is pressed down by the leg above the ball. Measured of GRF's bounces.
const DOWN: f32 = 0.3;
/// How much the body's own run counts in the way of a bounce: least right after the touch. (GRF's.)
const RUN: f32 = 0.8;

/// Lets the ball bounce off a player whose rival has just touched it. `near`: the players that it
/// may hit. Who takes the ball or kicks it minds their own motion, whether it meets the ball or
/// not; who pokes, and a keeper whose hands are out, is hit by a ball that was touched after they
/// began. (GRF's.)
pub fn off_bodies(game: &mut Match, events: &mut Events, near: Squad) {
    let Some(last) = game.last_touch else { return };
    let touched = game.player(last).body.touched_at;
    let since = ticks_since(game.tick, touched);
    let (ball, velocity) = (game.ball.pos, game.ball.vel);
    if since >= UNSEEN_TICKS || ticks_since(game.tick, game.play.bounced_at) <= BOUNCE_TICKS {
        return;
    }
    let hit = game.order_of(near).find_map(|id| {
        let player = game.player(id);
        let may = id.team() != last.team()
            && player.active
            && ball.z < player.body.height_m
            && ticks_since(game.tick, player.body.touched_at) >= UNSEEN_TICKS
            && !player.body.swings();
        if !may {
            return None;
        }
        let (middle, radius_m) =
            bodies(game, id, touched).into_iter().flatten().find(|(middle, radius_m)| {
                middle.distance_squared(ball.truncate()) < radius_m * radius_m
            })?;
        Some((id, middle, radius_m))
    });
    let Some((id, middle, radius_m)) = hit else { return };
    let player = *game.player(id);
    let from = ball.truncate() - middle;
    let run = RUN * since as f32 / UNSEEN_TICKS as f32;
    let away = from.normalize_or(player.body.facing) * (1.0 - run) + player.vel * run;
    let away = (away.normalize_or_zero().extend(-DOWN)).normalize();
    let speed = velocity.length();
    let full = away * (LEAVES_MPS + LEAVES * speed) - velocity * BACK;
    let inside = 1.0 - from.length() / radius_m;
    let squarely = math::mix(AT_EDGE[0], 1.0, math::mix(AT_EDGE[1], 1.0, inside));
    if offside::caught(game, events, id) {
        return;
    }
    let shot = game.play.shot.is_some_and(|shot| shot.by.team() != id.team());
    contact::sprang(game, events, id);
    game.play.bounced_at = game.tick as i32;
    game.ball.vel = velocity.lerp(full, squarely).clamp_length_max(speed) * LEFT;
    forecast::renew(game);
    // Last, because it may stop play.
    foul::handball(game, events, id, shot);
}

/// The bodies of a player that a ball touched in that tick bounces off: their middles and how near
/// it comes, metres. None if they mind only their own motion: all but those whose motion began
/// before the touch.
fn bodies(game: &Match, id: PlayerId, touched: i32) -> [Option<(Vec2, f32)>; 2] {
    let player = game.player(id);
    let body = &player.body;
    if body.pose == Pose::Diving {
        let save = game.play.save[id.team().index()].filter(|save| save.saw < touched);
        let hands = |save: Save| {
            let ticks = |until: u32| until.saturating_sub(save.from) as f32;
            let out = ticks(game.tick) / ticks(save.at).max(1.0);
            player.pos + save.hands * out
        };
        return [
            save.map(|_| (player.pos, BODY_M + WIDER_M)),
            save.map(|save| (hands(save), HANDS_M)),
        ];
    }
    let minds = body.lunge.is_none_or(|lunge| lunge.aim != Aim::Carry && lunge.from() < touched);
    [minds.then_some((player.pos, BODY_M)), None]
}
