//! How awkward it is for a player to play the ball as it is now. (GRF's.)

use crate::football::noise;
use crate::state::play::ticks_since;
use crate::state::{Match, PlayerId};
use setpiece_scenario::vocabulary::Stat;

/// A push of this much, metres, counts in full, for this much.
const PUSHED_M: f32 = 0.1;
const PUSHED: f32 = 2.0;
/// From which to which speed between ball and player a ball counts as fast, m/s, by which power,
/// and for how much.
const FAST_MPS: [f32; 2] = [10.0, 50.0];
const FASTER: f32 = 1.5;
const FAST: f32 = 5.0;
/// From how far to how far off a place `FRONT_M` before the player a ball counts as far away,
/// metres, by which power, and for how much.
const FRONT_M: f32 = 0.2;
const AWAY_M: [f32; 2] = [0.7, 1.3];
const FURTHER: f32 = 2.0;
const AWAY: f32 = 2.0;
/// How long a rival's touch surprises a player without any reaction, seconds, by which share of
/// that less who has all of it, by which power, and for how much; and how much of that lets the
/// ball keep its own way, at most.
const SURPRISED_S: f32 = 1.0;
const REACTS: f32 = 0.5;
const RECENT: f32 = 0.6;
const SURPRISE: f32 = 5.0;
const KEPT: f32 = 0.1;
const KEPT_MOST: f32 = 0.9;

/// What an awkward ball does, 0..1 each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Awkward {
    /// How far it springs off the foot.
    pub(super) far: f32,
    /// How high.
    pub(super) high: f32,
    /// How much of its own velocity it keeps.
    pub(super) kept: f32,
}

/// How awkward the ball is to a player. Those who control it well have it easier; the rest is luck.
pub(super) fn to(game: &mut Match, id: PlayerId) -> Awkward {
    let player = game.player(id);
    let ball = game.ball;
    let share = |value: f32, [from, to]: [f32; 2]| ((value - from) / (to - from)).clamp(0.0, 1.0);
    let pushed = (player.body.push_m / PUSHED_M).min(1.0) * PUSHED;
    let meeting = (ball.vel - player.vel.extend(0.0)).length();
    let fast = libm::powf(share(meeting, FAST_MPS), FASTER) * FAST;
    let front = player.pos + player.vel.normalize_or(player.body.facing) * FRONT_M;
    let away = libm::powf(share(front.distance(ball.pos.truncate()), AWAY_M), FURTHER) * AWAY;
    let surprise = surprise(game, id) * SURPRISE;
    let luck = 0.5 + 0.5 * noise::roll(game);
    let skill = (1.0 - 0.5 * game.player(id).skill(Stat::BallControl)) * luck;
    Awkward {
        far: ((2.0 * pushed + fast + 4.0 * away + surprise) * skill).min(1.0),
        high: ((0.5 * pushed + 2.0 * fast + away + surprise) * skill).min(1.0),
        kept: (KEPT * surprise).min(KEPT_MOST) * skill,
    }
}

/// How much a ball that a rival has just touched surprises a player, 0..1.
fn surprise(game: &Match, id: PlayerId) -> f32 {
    let Some(last) = game.last_touch.filter(|last| last.team() != id.team()) else { return 0.0 };
    let since_s = ticks_since(game.tick, game.player(last).body.touched_at) as f32 * 0.01;
    let lasts_s = SURPRISED_S * (1.0 - REACTS * game.player(id).skill(Stat::Reaction));
    libm::powf((1.0 - since_s / lasts_s).max(0.0), RECENT)
}
