//! Challenging the player on the ball: automatic standing tackles, and what a lost one costs.

use crate::event::Events;
use crate::football::{foul, noise, report, touch};
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{EventKind, Stat};

/// How near the ball the tackler's foot must come, metres.
const TACKLE_M: f32 = 0.85;
/// How often at least a try succeeds; chosen.
const LEAST: f32 = 0.025;
/// How much more often against a man who stands still with the ball; chosen.
const STANDS: f32 = 0.06;
/// How much more often against a carrier who runs into the tackler; chosen.
const INTO: f32 = 0.55;
/// A carrier runs head-on into a tackler from this cosine on; whoever is beaten so needs so many ticks to turn. Fitted to
/// what keepers lose there.
const HEAD_ON: f32 = 0.5;
const WRONG_FOOTED_TICKS: i8 = 50;
/// Ticks for which who has lost the ball can't try it; chosen.
const BEATEN_TICKS: f32 = 45.0;
/// Ticks between two tries of one player.
const RETRY_TICKS: i32 = 32;

/// A player within reach of the ball that a rival controls tries to win it.
pub fn challenge(game: &mut Match, events: &mut Events, id: PlayerId, rival: PlayerId, near: f32) {
    if near > TACKLE_M || game.ball.pos.z > 1.0 {
        return;
    }
    let (tackler, victim) = (*game.player(id), *game.player(rival));
    let ball = game.ball.pos.truncate();
    // Who has less way to the ball, from which side, and who is the better.
    let victim_m = victim.pos.distance(ball);
    let exposed = ((victim_m - near) * 0.3).clamp(-0.15, 0.15);
    // Close to his feet the ball is covered; a sprint pushes it away from them.
    let open = (0.25 + victim_m).clamp(0.5, 1.0);
    let tackle = tackler.skill(Stat::StandingTackle);
    let keep =
        0.5 * victim.skill(Stat::BallControl) + 0.3 * victim.skill(Stat::Dribble) + 0.2 * victim.skill(Stat::Balance);
    let behind = (victim.pos - tackler.pos).normalize_or_zero().dot((ball - victim.pos).normalize_or_zero());
    let chance = (0.14 + exposed + 0.20 * (tackle - keep) - 0.16 * behind.max(0.0)) * open;
    // Who stands with it is there to be tried from any side.
    let still = (1.0 - victim.vel.length() / 1.5).max(0.0);
    // Whoever runs into a defender with the ball runs it onto their feet.
    let run = victim.vel.normalize_or_zero();
    let into = (tackler.pos - victim.pos).normalize_or_zero().dot(run).max(0.0) * (1.0 - still);
    let chance = (chance + STANDS * still + INTO * into).clamp(LEAST, 0.9);
    let now = game.tick as i32;
    if noise::happens(game, chance) {
        win(game, events, id, rival, ball);
        game.players[rival.index()].body.ready_at = now + victim.shaken(BEATEN_TICKS) as i32;
        game.players[rival.index()].vel *= 0.6;
        return;
    }
    game.players[id.index()].body.ready_at = now + RETRY_TICKS;
    // Beaten: wrong-footed for a moment, and worst by who came head-on.
    let beaten = &mut game.players[id.index()];
    if into > HEAD_ON {
        beaten.vel = Vec2::ZERO;
        beaten.body.lag_ticks = -WRONG_FOOTED_TICKS;
    } else {
        beaten.vel *= 0.45;
    }
    if near < 0.7 && foul::trips(game, id, rival) {
        game.players[rival.index()].fall(foul::FALL_TICKS);
        foul::call_or_let_run(game, events, id, rival, severity_of(behind));
    }
}

/// How bad a standing foul is: from behind is worse.
fn severity_of(behind: f32) -> f32 {
    1.05 + 0.3 * behind.max(0.0)
}

/// The tackler takes the ball along, or pokes it away.
fn win(game: &mut Match, events: &mut Events, id: PlayerId, rival: PlayerId, ball: Vec2) {
    let tackler = *game.player(id);
    let clean = noise::happens(game, 0.35 + 0.4 * tackler.skill(Stat::BallControl));
    let away = (ball - tackler.pos).normalize_or_zero();
    let side = id.team().side() as f32;
    let velocity = if clean {
        tackler.vel * 0.6 + (away + Vec2::new(side * 0.4, 0.0)) * 1.8
    } else {
        tackler.vel * 0.4 + away * 4.5 + Vec2::new(-away.y, away.x) * (noise::bell(game) * 1.5)
    };
    let hop = if clean { 0.0 } else { 0.6 + 0.6 * noise::roll(game) };
    report::did(game, events, EventKind::Tackle, id, Some(rival));
    touch::push(game, events, id, velocity, hop);
    // A poke is no deliberate kick: the keeper may pick it up.
    game.play.kicked_by = None;
}
