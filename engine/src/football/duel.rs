//! Challenging the player on the ball: automatic standing tackles, and what a lost one costs.

use crate::event::Events;
use crate::football::{foul, noise, report, touch};
use crate::math;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{EventKind, Role, Stat};

/// How near the ball the tackler's foot must come, metres.
const TACKLE_M: f32 = 0.65;
/// How often a try meets the ball between players of like skill; fitted to how soon a runner loses it to one at their side.
const TRIES: f32 = 0.6;
/// How often at least; chosen.
const LEAST: f32 = 0.025;
/// How much more often against somebody who stands still with the ball; chosen.
const STANDS: f32 = 0.06;
/// How much more often against a carrier who runs into the tackler; fitted to how soon a runner loses it head-on.
const INTO: f32 = 0.6;
/// How far behind a carrier that begins to count, a cosine; chosen.
const BESIDE: f32 = 0.5;
/// The tackling for which these hold: a centre back's of the middle difficulty. Somebody with none meets the ball by this
/// share less often: GRF's weak players are only later to see it.
const AVERAGE: f32 = 0.5;
const UNABLE: f32 = 0.25;
/// How much a lead in skill counts; chosen.
const SKILL: f32 = 0.1;
/// Between these speeds past the tackler, m/s, a ball is met the less often, at the faster by this share less; fitted to
/// how many get through at a sprint.
const PASSING_MPS: std::ops::Range<f32> = 3.0..7.0;
const SURPRISED: f32 = 0.3;
/// How fast a tackle that meets the ball fully pokes it away, m/s. (GRF's: 4.)
const POKED_MPS: f32 = 5.0;
/// How much of the tackler's velocity the ball takes over, and how softly it may be poked; fitted to how near it stays.
const FOLLOWS: f32 = 0.5;
const SOFTEST: f32 = 1.0;
/// What a ball that is only brushed keeps of its speed past the tackler. Measured.
const LEFT: f32 = 0.85;
/// How seldom a tackle that meets the ball meets it fully: above 1 fully more often, below 1 brushed more often; fitted to
/// how often the runner has it again soon.
const BRUSHED: f32 = 0.7;
/// The same of keepers; fitted to where the ball goes from those who come out.
const KEEPER_MPS: f32 = 7.5;
const KEEPER_BRUSHED: f32 = 1.5;
/// Ticks for which whoever has lost the ball can't try it, and for which who has poked it can't play on; chosen.
const BEATEN_TICKS: f32 = 6.0;
const POKED_TICKS: i32 = 110;
/// Whoever is nearer to the ball by this share takes it along; how much of its own way at most is left then, how much faster
/// than they it runs, m/s, and for how many ticks whoever has lost it can't try it; chosen.
const SOONER: f32 = 0.85;
const BUMPY: f32 = 0.7;
const TAKEN_ON_MPS: [f32; 2] = [1.0, 5.0];
const STUMBLES: f32 = 0.6;
const TAKEN_TICKS: i32 = 100;
const LOST_TICKS: i32 = 30;
/// Ticks for which whoever has taken the ball along gathers it before they begin a kick; fitted to how often whoever lost it has it
/// again soon.
const GATHERS_TICKS: i32 = 100;
/// Ticks between two tries of one player, and what share of their pace a failed one leaves them; chosen.
const RETRY_TICKS: i32 = 24;
const FAILED: f32 = 0.9;

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
    let chance = (TRIES + exposed + SKILL * (tackle - keep)) * open;
    // Who stands with it is there to be tried from any side.
    let still = (1.0 - victim.vel.length() / 1.5).max(0.0);
    // Whoever runs into a defender with the ball runs it onto their feet.
    let run = victim.vel.normalize_or_zero();
    let into = (tackler.pos - victim.pos).normalize_or_zero().dot(run);
    let into = ((into + BESIDE) / (1.0 + BESIDE)).max(0.0) * (1.0 - still);
    // A ball that goes past the tackler fast is not where they thought.
    let passing = (game.ball.vel.truncate() - tackler.vel).length();
    let pushed = (passing - PASSING_MPS.start) / (PASSING_MPS.end - PASSING_MPS.start);
    let meets = 1.0 - SURPRISED * pushed.clamp(0.0, 1.0);
    let able = 1.0 - UNABLE * (1.0 - tackle / AVERAGE).clamp(-1.0, 1.0);
    let chance = ((chance + INTO * into) * meets * able + STANDS * still).clamp(LEAST, 0.9);
    let now = game.tick as i32;
    if noise::happens(game, chance) {
        if near < SOONER * victim_m && tackler.role != Role::GK {
            take_over(game, events, id, rival);
            return;
        }
        let brushed = win(game, events, id, rival, ball);
        let loser = &mut game.players[rival.index()].body;
        loser.ready_at = loser.ready_at.max(now + victim.shaken((1.0 - brushed) * BEATEN_TICKS) as i32);
        let winner = &mut game.players[id.index()].body;
        winner.ready_at = winner.ready_at.max(now + POKED_TICKS);
        return;
    }
    let beaten = &mut game.players[id.index()];
    beaten.body.ready_at = now + RETRY_TICKS;
    beaten.vel *= FAILED;
    if near < 0.7 && foul::trips(game, id, rival) {
        game.players[rival.index()].fall(foul::FALL_TICKS);
        foul::call_or_let_run(game, events, id, rival, severity_of(behind));
    }
}

/// Somebody who runs beside the ball, nearer to it than whoever had it, takes it along: what is left of its own way is by
/// chance.
fn take_over(game: &mut Match, events: &mut Events, id: PlayerId, rival: PlayerId) {
    let tackler = *game.player(id);
    let left = noise::roll(game) * BUMPY;
    let faster = TAKEN_ON_MPS[0] + (TAKEN_ON_MPS[1] - TAKEN_ON_MPS[0]) * noise::roll(game);
    let on = tackler.vel * STUMBLES + tackler.vel.normalize_or(tackler.body.facing) * faster;
    let velocity = on.lerp(game.ball.vel.truncate(), left);
    let hop = hop_mps(game);
    report::did(game, events, EventKind::Tackle, id, Some(rival));
    touch::push(game, events, id, velocity, hop);
    game.play.kicked_by = None;
    let now = game.tick as i32;
    let loser = &mut game.players[rival.index()].body;
    loser.ready_at = loser.ready_at.max(now + LOST_TICKS);
    let winner = &mut game.players[id.index()];
    winner.vel *= STUMBLES;
    let winner = &mut winner.body;
    winner.ready_at = winner.ready_at.max(now + TAKEN_TICKS);
    (winner.kick, winner.turned_at) = (None, now + GATHERS_TICKS);
}

/// How fast a ball hops off a tackle, m/s. Measured.
fn hop_mps(game: &mut Match) -> f32 {
    1.5 + 2.5 * noise::roll(game)
}

/// How bad a standing foul is: from behind is worse.
fn severity_of(behind: f32) -> f32 {
    1.05 + 0.3 * behind.max(0.0)
}

/// The tackler's foot meets the ball, fully or in part: what is left of its way is returned, 0..1.
fn win(game: &mut Match, events: &mut Events, id: PlayerId, rival: PlayerId, ball: Vec2) -> f32 {
    let tackler = *game.player(id);
    let away = (ball - tackler.pos).normalize_or_zero();
    // A keeper who has come out wants it gone.
    let keeper = tackler.role == Role::GK;
    let (poked, brush) = if keeper { (KEEPER_MPS, KEEPER_BRUSHED) } else { (POKED_MPS, BRUSHED) };
    let met = tackler.vel * FOLLOWS + away * (poked * (SOFTEST + (1.0 - SOFTEST) * noise::roll(game)));
    let passing = game.ball.vel.truncate() - tackler.vel;
    let brushed = math::smooth(math::smooth(libm::powf(noise::roll(game), brush)));
    let velocity = met.lerp(tackler.vel + passing * LEFT, brushed);
    let hop = hop_mps(game);
    report::did(game, events, EventKind::Tackle, id, Some(rival));
    touch::push(game, events, id, velocity, hop);
    // A poke is no deliberate kick: the keeper may pick it up.
    game.play.kicked_by = None;
    brushed
}
