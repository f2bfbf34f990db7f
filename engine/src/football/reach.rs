//! Who reaches the ball first: everyone's time to the ball, and the player of each team who goes
//! for it.

use crate::physics::forecast::{Forecast, POINTS, SPACING_TICKS, time_s};
use crate::rows::WIDTH;
use crate::state::play::ticks_since;
use crate::state::player::Intent;
use crate::state::{Match, Player, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::{Role, Stat, Team};
use std::cmp::Ordering;
use std::ops::Range;
use wide::f32x4;

/// The highest ball that a player can play without hands, metres.
pub const PLAYABLE_M: f32 = 1.5;
/// A generous bound on the rounding error of sums of distances, metres.
const ROUNDING_M: f32 = 0.01;
/// Seconds between two points of a forecast.
const SPACING_S: f32 = SPACING_TICKS as f32 * 0.01;
/// The ball must come this near to be played (`REACH_M`), and is best this far ahead of a runner
/// (`FOOT_M`), metres. Runners reach `TOP_SHARE` of their top speed. (GRF's.)
const REACH_M: f32 = 0.28;
const FOOT_M: f32 = 0.1;
const TOP_SHARE: f32 = 0.94;
/// A ball that comes this far from one point of a forecast to the next may pass a player between
/// them, metres.
const FAST_M: f32 = 2.0 * REACH_M;
/// Seconds until a player runs another way. (GRF's.)
const CHANGES_S: f32 = 0.7;
/// A player who reaches the ball sooner than this is at it: seconds, and from how near, metres.
/// (GRF's.)
const AT_ONCE_S: f32 = 0.08;
const AT_ONCE_M: f32 = 0.6;

/// A ball faster than this, m/s, that passes within `COMES_M` is waited for; chosen.
const COMES_MPS: f32 = 10.0;
const COMES_M: f32 = 0.4;

/// The ball's path on the pitch from a moment on. Players don't follow the ball off the pitch.
pub struct Way<'a> {
    forecast: &'a Forecast,
    /// The points of the forecast that belong to the path.
    points: Range<usize>,
    /// The points at which the ball is low enough to play, one bit each.
    playable: u64,
    /// The start of the path, in seconds after the forecast's first point.
    offset_s: f32,
}

impl Way<'_> {
    /// The path of a forecast from a tick on.
    pub fn of(forecast: &Forecast, tick: u32) -> Way<'_> {
        let (first, offset_s) = forecast.first(tick);
        let points = forecast.on_pitch(first);
        let low = f32x4::splat(PLAYABLE_M);
        let playable = (points.start / WIDTH..points.end.div_ceil(WIDTH)).fold(0, |bits, row| {
            bits | u64::from(forecast.heights(row).simd_le(low).to_bitmask()) << (row * WIDTH)
        });
        Way {
            forecast,
            playable: playable & from(points.start) & !from(points.end),
            points,
            offset_s,
        }
    }
}

/// A point of a forecast and all later ones, one bit each.
fn from(point: usize) -> u64 {
    u64::MAX.checked_shl(point as u32).unwrap_or_default()
}

/// Where and when a player can first meet the ball. Their current run fades within [`CHANGES_S`],
/// after which they run wherever they want. (GRF's.)
pub fn meeting(player: &Player, way: &Way<'_>) -> (Vec2, f32) {
    const PLACES: [f32; WIDTH] = [0.0, 1.0, 2.0, 3.0];
    let speed = TOP_SHARE * player.body.speed_top_mps;
    let foot = player.pos + player.vel * 0.01 + player.vel.clamp_length_max(FOOT_M);
    let is = f32x4::splat;
    let (at_x, at_y, vel_x, vel_y) = (is(foot.x), is(foot.y), is(player.vel.x), is(player.vel.y));
    let Range { start, end } = way.points;
    // From one point to the next, the ball and the player can close at most this distance.
    let per_closing_m =
        1.0 / (way.forecast.stride_m() + speed.max(player.vel.length()) * SPACING_S);
    let fast = way.forecast.stride_m() > FAST_M;
    let off = |point: usize| {
        let changing_s = time_s(point, way.offset_s).clamp(0.0, CHANGES_S);
        let run_s = changing_s - changing_s * changing_s * (0.5 / CHANGES_S);
        way.forecast.point(point).truncate() - foot - player.vel * run_s
    };
    let mut row = start / WIDTH;
    while row * WIDTH < end {
        let [x, y] = way.forecast.row(row);
        let ticks = (is((row * WIDTH) as f32) + f32x4::new(PLACES)) * is(SPACING_TICKS as f32);
        let time_s = (ticks * is(0.01) - is(way.offset_s)).fast_max(f32x4::ZERO);
        let changing_s = time_s.fast_min(is(CHANGES_S));
        let changed_s = changing_s * changing_s * is(0.5 / CHANGES_S);
        let run_s = changing_s - changed_s;
        let radius = is(REACH_M) + is(speed) * (changed_s + time_s - changing_s);
        let (dx, dy) = (x - at_x - vel_x * run_s, y - at_y - vel_y * run_s);
        let (mut back, mut near_x, mut near_y) = (f32x4::ZERO, dx, dy);
        if fast {
            let before = (row * WIDTH).checked_sub(1).map(off);
            (back, [near_x, near_y]) = nearest([dx, dy], before, time_s);
        }
        let reached = (near_x * near_x + near_y * near_y).simd_le(radius * radius).to_bitmask();
        let reached = reached & (way.playable >> (row * WIDTH)) as u32;
        if reached != 0 {
            let lane = reached.trailing_zeros() as usize;
            let (first, back) = (row * WIDTH + lane, back.to_array()[lane]);
            let point = way.forecast.point(first).truncate();
            let point = point.lerp(way.forecast.point(first.saturating_sub(1)).truncate(), back);
            let time_s = (time_s.to_array()[lane] - back * SPACING_S).max(0.0);
            return (point, if time_s < AT_ONCE_S { at_once_s(player, point) } else { time_s });
        }
        // Skips rows in which the player can't have come near enough.
        let [.., dx] = dx.to_array();
        let [.., dy] = dy.to_array();
        let [.., radius] = radius.to_array();
        let missing_m = (dx * dx + dy * dy).sqrt() - radius - ROUNDING_M;
        row += 1 + (missing_m * per_closing_m).clamp(0.0, POINTS as f32) as usize / WIDTH;
    }
    let at = player.pos + player.vel * (0.5 * CHANGES_S);
    if way.points.is_empty() {
        return (player.pos, (player.pos.distance(at) / speed).max(0.0));
    }
    let (last, time_s) = (way.forecast.point(end - 1).truncate(), time_s(end - 1, way.offset_s));
    let lacks_m = last.distance(at) - speed * (time_s - 0.5 * CHANGES_S);
    (last, time_s + (lacks_m / speed).max(0.0))
}

/// How far back from four points, as a share of the way from the point before each, a ball is
/// nearest, and where it is then, all seen from a player. `before`: the point before the first;
/// `time_s`: when the ball is at the points: it is followed no further back than to now.
fn nearest([dx, dy]: [f32x4; 2], before: Option<Vec2>, time_s: f32x4) -> (f32x4, [f32x4; 2]) {
    let ([x0, x1, x2, _], [y0, y1, y2, _]) = (dx.to_array(), dy.to_array());
    let before = before.unwrap_or(Vec2::new(x0, y0));
    let to_x = f32x4::new([before.x, x0, x1, x2]) - dx;
    let to_y = f32x4::new([before.y, y0, y1, y2]) - dy;
    let way_m2 = (to_x * to_x + to_y * to_y).fast_max(f32x4::splat(f32::MIN_POSITIVE));
    let share = (-(dx * to_x + dy * to_y) / way_m2).fast_max(f32x4::ZERO);
    let back = share.fast_min(f32x4::ONE).fast_min(time_s * f32x4::splat(1.0 / SPACING_S));
    (back, [dx + to_x * back, dy + to_y * back])
}

/// The time of a player who is already at the ball; nearer means less. (GRF's.)
fn at_once_s(player: &Player, point: Vec2) -> f32 {
    let apart_m = (player.pos + player.vel * AT_ONCE_S).distance(point);
    AT_ONCE_S * (apart_m / AT_ONCE_M).min(1.0)
}

/// Whether a fast ball comes to a player low enough to take, so that they needn't move towards it.
pub fn comes_to(game: &Match, player: &Player) -> bool {
    let ball = &game.ball;
    let fast = ball.vel.truncate().length_squared() > COMES_MPS * COMES_MPS;
    let comes = |at: Vec3| {
        at.z <= PLAYABLE_M && at.truncate().distance_squared(player.pos) < COMES_M * COMES_M
    };
    fast && game.play.forecast.from(game.tick).any(|(_, at)| comes(at))
}

/// Ticks until a player sees where somebody else's touch sends the ball: 80 - 40 · reaction ms, and
/// up to 100 ms more for a bot, by the difficulty that it lacks (GRF's delay).
fn delay_ticks(player: &Player, driven: bool) -> i32 {
    let slow = if driven { 0.0 } else { 10.0 * (1.0 - player.difficulty) };
    (8.0 - 4.0 * player.body.stats[Stat::Reaction.index()] + slow) as i32
}

/// Whether a player has seen where the last touch sends the ball.
pub fn has_seen(game: &Match, id: PlayerId) -> bool {
    let (since, toucher) = last_touch(game);
    toucher == Some(id) || since >= delay_ticks(game.player(id), game.is_driven(id))
}

/// The tick up to which a player has seen the touches of the ball.
pub fn seen_until(game: &Match, id: PlayerId) -> i32 {
    game.tick as i32 - delay_ticks(game.player(id), game.is_driven(id))
}

/// Where a player expects the ball after this many ticks: on its earlier path, as long as they
/// haven't seen the last touch.
pub fn expected(game: &Match, id: PlayerId, ticks: u32) -> Vec3 {
    if has_seen(game, id) {
        return game.play.forecast.at(game.tick + ticks);
    }
    let [place, velocity] = game.play.unseen;
    let (since, _) = last_touch(game);
    (place + velocity * ((since as f32 + ticks as f32) * 0.01)).extend(game.ball.pos.z)
}

/// Ticks since the last touch, and who touched.
fn last_touch(game: &Match) -> (i32, Option<PlayerId>) {
    let since = |id: PlayerId| ticks_since(game.tick, game.player(id).body.touched_at);
    (game.last_touch.map_or(i32::MAX, since), game.last_touch)
}

/// Computes everyone's meeting with the ball, and who goes for it.
pub fn assess(game: &mut Match) {
    renew(game, |_| true);
    for team in [Team::Left, Team::Right] {
        choose(game, team);
    }
}

/// Updates the meetings of the players who are going for the ball.
pub fn refresh(game: &mut Match) {
    renew(game, |player| matches!(player.body.intent, Intent::Ball(_)));
}

/// Updates the meetings of some players. A player who hasn't seen the last touch keeps the old one.
fn renew(game: &mut Match, whose: impl Fn(&Player) -> bool) {
    let (since, toucher) = last_touch(game);
    let now = game.tick as i32;
    let way = Way::of(&game.play.forecast, game.tick);
    for id in game.squad.ids() {
        let driven = game.is_driven(id);
        let player = &mut game.players[id.index()];
        if !player.active || !whose(player) {
            continue;
        }
        let unseen = since < delay_ticks(player, driven);
        if unseen && toucher != Some(id) {
            continue;
        }
        let (meet, meet_s) = meeting(player, &way);
        player.body.meet = meet;
        player.body.meet_s = meet_s.min(touch_s(player, now));
    }
}

/// Seconds until the touch of a leg that is out for the ball, or swings at it. (GRF's.)
fn touch_s(player: &Player, now: i32) -> f32 {
    let lunge = player.body.lunge.map(|lunge| lunge.at);
    let swing = player.body.kick.and_then(|plan| plan.swing).map(|swing| swing.ready_at);
    let touches = [lunge, swing].into_iter().flatten().filter(|&at| at > now);
    touches.min().map_or(f32::MAX, |at| (at - now) as f32 * 0.01)
}

/// The player who will reach a free ball first. None if two players of both teams arrive together.
pub fn first(game: &Match) -> Option<PlayerId> {
    let [left, right] = game.play.chaser;
    let needs = |id: Option<PlayerId>| id.map_or(f32::MAX, |id| game.player(id).body.meet_s);
    match needs(left).total_cmp(&needs(right)) {
        Ordering::Less => left,
        Ordering::Greater => right,
        Ordering::Equal => None,
    }
}

/// Chooses the player of a team who goes for the ball, and the next two.
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
