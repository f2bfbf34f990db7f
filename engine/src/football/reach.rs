//! Who can be at the ball first: time to the ball for everyone, and the player of each team who goes for it.

use crate::football::body::Intent;
use crate::football::forecast::{Forecast, POINTS};
use crate::football::play::ticks_since;
use crate::physics::lines::{OUT_X, OUT_Y};
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{Role, Stat, Team};
use wide::f32x4;

/// Highest ball that a player can play without his hands, metres.
pub const PLAYABLE_M: f32 = 1.25;
/// How near the ball must come to be played, metres.
const REACH_M: f32 = 0.45;

/// Points that are looked at with one instruction.
const WIDTH: usize = 4;

/// The ball's way on the pitch from a moment on: a structure of arrays.
pub struct Way {
    /// World metres; far away where the ball is too high to be played, and behind the last point.
    x: [f32; POINTS],
    y: [f32; POINTS],
    /// Seconds from that moment.
    time_s: [f32; POINTS],
    /// How many points there are.
    count: usize,
    /// The last, and when.
    last: Option<(Vec2, f32)>,
}

impl Way {
    /// The way of a forecast from a tick on: off the pitch nobody follows the ball.
    pub fn of(forecast: &Forecast, tick: u32) -> Way {
        let mut way = Way { x: [1.0e6; POINTS], y: [1.0e6; POINTS], time_s: [0.0; POINTS], count: 0, last: None };
        for (i, (time_s, point)) in forecast.from(tick).enumerate() {
            let flat = point.truncate();
            if flat.x.abs() > OUT_X || flat.y.abs() > OUT_Y {
                break;
            }
            way.last = Some((flat, time_s));
            way.count = i + 1;
            way.time_s[i] = time_s;
            if point.z <= PLAYABLE_M {
                (way.x[i], way.y[i]) = (flat.x, flat.y);
            }
        }
        way
    }
}

/// Where and when a player can first meet the ball.
pub fn meeting(player: &Player, way: &Way) -> (Vec2, f32) {
    let speed = 0.94 * player.body.speed_top_mps;
    let from = player.pos + player.vel * 0.12;
    let (from_x, from_y, speeds) = (f32x4::splat(from.x), f32x4::splat(from.y), f32x4::splat(speed));
    let rows = [&way.x, &way.y, &way.time_s].map(|lane| lane.as_chunks::<WIDTH>().0);
    for row in 0..way.count.div_ceil(WIDTH) {
        let [x, y, time_s] = rows.map(|lane| f32x4::new(lane[row]));
        let radius = f32x4::splat(REACH_M) + speeds * (time_s - f32x4::splat(0.12)).fast_max(f32x4::ZERO);
        let (dx, dy) = (x - from_x, y - from_y);
        let reached = (dx * dx + dy * dy).simd_le(radius * radius).to_bitmask();
        if reached != 0 {
            let first = row * WIDTH + reached.trailing_zeros() as usize;
            return (Vec2::new(way.x[first], way.y[first]), way.time_s[first]);
        }
    }
    let (flat, time_s) = way.last.unwrap_or((player.pos, 0.0));
    (flat, time_s + ((flat.distance(from) - speed * time_s) / speed).max(0.0))
}

/// Ticks until a player sees what somebody else's touch has made of the ball: 80 - 40 · reaction ms, and a bot 100 ms
/// more for all the difficulty it lacks (the fact sheet's delay).
fn delay_ticks(player: &Player, driven: bool) -> i32 {
    let slow = if driven { 0.0 } else { 10.0 * (1.0 - player.difficulty) };
    (8.0 - 4.0 * player.body.stats[Stat::Reaction.index()] + slow) as i32
}

/// Ticks since the last touch, and whose it was.
fn last_touch(game: &Match) -> (i32, Option<PlayerId>) {
    let since = |id: PlayerId| ticks_since(game.tick, game.player(id).body.touched_at);
    (game.last_touch.map_or(i32::MAX, since), game.last_touch)
}

/// Reckons everyone's meeting with the ball, and who goes for it.
pub fn assess(game: &mut Match) {
    renew(game, |_| true);
    for team in [Team::Left, Team::Right] {
        choose(game, team);
    }
}

/// Renews the meetings of those who are going for the ball.
pub fn refresh(game: &mut Match) {
    renew(game, |player| matches!(player.body.intent, Intent::Ball(_)));
}

/// Renews the meetings of some players; who has not seen the last touch yet keeps his.
fn renew(game: &mut Match, whose: impl Fn(&Player) -> bool) {
    let driven = game.play.driven;
    let way = Way::of(&game.play.forecast, game.tick);
    let (since, toucher) = last_touch(game);
    for (i, player) in game.players.iter_mut().enumerate().filter(|(_, player)| player.active && whose(player)) {
        let unseen = since < delay_ticks(player, driven & (1 << i) != 0);
        if unseen && toucher.is_none_or(|id| id.index() != i) {
            continue;
        }
        let (meet, meet_s) = meeting(player, &way);
        player.body.meet = meet;
        player.body.meet_s = meet_s;
    }
}

/// Chooses the player of a team who goes for the ball, and the two behind him.
fn choose(game: &mut Match, team: Team) {
    let index = team.index();
    let current = game.play.chaser[index];
    let receiver = game.play.pass.and_then(|pass| pass.to);
    let owner = game.owner;
    let mut best: [(f32, Option<PlayerId>); 3] = [(f32::MAX, None); 3];
    for (id, player) in game.team(team) {
        let mut time = player.body.meet_s + 0.1;
        if Some(id) == current {
            time *= 0.85;
        }
        if Some(id) == receiver {
            time = time * 0.6 - 0.2;
        }
        if Some(id) == owner {
            time *= 0.3;
        }
        if player.role == Role::GK && Some(id) != owner {
            time = time * 1.4 + 0.4;
        }
        if game.play.pass.is_some_and(|pass| pass.by == id) && Some(id) != owner {
            time += 0.6;
        }
        if let Some(place) = best.iter().position(|(least, _)| time < *least) {
            best[place..].rotate_right(1);
            best[place] = (time, Some(id));
        }
    }
    game.play.chaser[index] = best[0].1;
    game.play.behind[index] = [best[1].1, best[2].1];
}
