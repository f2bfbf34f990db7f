//! Keeps bodies apart: overlapping circles of 0.36 m are pushed apart. A pushed player plays worse
//! for a moment, and may fall.

use crate::football::pace::{DT, SPRINT_MPS};
use crate::football::{frame, reach, stumble};
use crate::math;
use crate::rows::{ROWS, WIDTH};
use crate::state::event::Events;
use crate::state::player::{Aim, Pose};
use crate::state::{Match, Player, PlayerId};
use arrayvec::ArrayVec;
use glam::Vec2;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::Stat;
use wide::f32x4;

/// Distance at which two bodies touch, metres.
pub const CONTACT_M: f32 = 0.72;
/// Players keep this distance from a player on the ground, metres; chosen.
const LYING_M: f32 = 0.5;
/// The most that one collision moves a body in two ticks, metres. (GRF's: 0.08 a tick.)
const PUSH_MAX_M: f32 = 0.16;
/// Within this distance two players drag each other along, metres. `DRAG`: how much of the other's
/// velocity they take over at most. (GRF's.)
const SHELL_M: f32 = 1.872;
const DRAG: f32 = 0.25;
/// What else counts in a collision, besides balance: a turned back, speed, being this much nearer
/// to the ball. Being first at the ball counts too: where bodies touch, and where they only run
/// close. (GRF's.)
const BACK: f32 = 0.8;
const PACE: f32 = 0.2;
const BALL_M: f32 = 0.6;
/// Weight of a leg that is out for the ball, without any skill, and what full skill adds. (GRF's.)
const TACKLES: [f32; 2] = [0.1, 0.4];
const FIRST_PUSHED: f32 = 0.4;
const FIRST_DRAGGED: f32 = 0.6;
/// The share of a displacement that counts as a player's own run in a collision. (GRF's.)
const FELT: f32 = 0.5;
/// The share of a displacement in two ticks that a runner's own velocity takes over. Fitted to how
/// dribblers are slowed.
const TAKEN_OVER: f32 = 0.07;

/// The most that pushes add up to, metres. (GRF's.)
const SHOVE_MAX_M: f32 = 0.1;
/// The share of a push that is left after two ticks: 0.95 a tick.
const SHOVE_LEFT: f32 = 0.9025;

/// The place of empty lanes, metres: far from everybody.
const FAR_M: f32 = 1.0e6;

/// Pushes overlapping bodies apart, and keeps everyone within the rim and out of the goals' frames.
pub fn separate(game: &mut Match, events: &mut Events) {
    // Unused places lie too far off to touch anybody.
    let mut xs = [[FAR_M; WIDTH]; ROWS];
    let mut ys = [[0.0; WIDTH]; ROWS];
    let mut ids: ArrayVec<PlayerId, PLAYERS_MAX> = ArrayVec::new();
    for id in game.order() {
        let player = &mut game.players[id.index()];
        player.body.push_m *= SHOVE_LEFT;
        if player.active {
            let (row, at) = (ids.len() / WIDTH, ids.len() % WIDTH);
            (xs[row][at], ys[row][at]) = (player.pos.x, player.pos.y);
            ids.push(id);
        }
    }
    let near = f32x4::splat(SHELL_M * SHELL_M);
    let first = game.owner.or_else(|| reach::first(game));
    let rows = ids.len().div_ceil(WIDTH);
    for i in 0..ids.len() {
        let (x, y) =
            (f32x4::splat(xs[i / WIDTH][i % WIDTH]), f32x4::splat(ys[i / WIDTH][i % WIDTH]));
        let mut meets = 0u32;
        for row in i / WIDTH..rows {
            let (dx, dy) = (f32x4::new(xs[row]) - x, f32x4::new(ys[row]) - y);
            meets |= (dx * dx + dy * dy).simd_lt(near).to_bitmask() << (row * WIDTH);
        }
        // Earlier players have been paired with this one already.
        meets &= u32::MAX << i << 1;
        while meets != 0 {
            let j = meets.trailing_zeros() as usize;
            meets &= meets - 1;
            meet(game, events, [ids[i], ids[j]], first);
        }
    }
    let rim = game.rim();
    for id in ids {
        let player = &mut game.players[id.index()];
        if !player.active {
            continue;
        }
        player.pos = player.pos.clamp(-rim, rim);
        frame::keep_out(&game.pitch, &mut player.pos, &mut player.vel);
    }
}

/// Lets a player go round one on the ground. `away`: from that player to the one who moves.
fn go_round(game: &mut Match, id: PlayerId, away: Vec2, distance: f32) {
    let player = &mut game.players[id.index()];
    player.pos += away * (LYING_M - distance).clamp(0.0, PUSH_MAX_M);
    player.vel -= away * player.vel.dot(away).min(0.0);
}

/// Lets two players collide. Players who run close drag each other along, and bodies that touch are
/// pushed apart. The one who stands better yields less. (GRF's.)
fn meet(game: &mut Match, events: &mut Events, [i, j]: [PlayerId; 2], first: Option<PlayerId>) {
    let (a, b, now) = (game.player(i), game.player(j), game.tick as i32);
    let between = b.pos - a.pos;
    let distance = between.length();
    // Exactly on one spot: they part sideways, the first to their left.
    let away =
        if distance > 1e-4 { between / distance } else { Vec2::new(0.0, i.team().side() as f32) };
    let touching = distance < CONTACT_M;
    match (a.body.pose == Pose::Down, b.body.pose == Pose::Down) {
        (false, false) => {}
        (true, false) if touching => return go_round(game, j, away, distance),
        (false, true) if touching => return go_round(game, i, -away, distance),
        _ => return,
    }
    let back = |player: &Player, from: Vec2| 0.5 + 0.5 * player.body.facing.dot(from);
    let pace = (a.vel.length() - b.vel.length()) / SPRINT_MPS;
    let mut stands = BACK * (back(a, -away) - back(b, away)) - PACE * pace.clamp(-1.0, 1.0)
        + a.skill(Stat::Balance)
        - b.skill(Stat::Balance);
    stands += tackles(a, now) - tackles(b, now);
    if game.play.chaser[i.team().index()] == Some(i)
        && game.play.chaser[j.team().index()] == Some(j)
    {
        let ball = game.ball.pos.truncate();
        let off = |player: &Player| player.pos.distance(ball).min(2.0 * BALL_M);
        stands += (off(b) - off(a)).clamp(-BALL_M, BALL_M);
    }
    let is_first = f32::from(i8::from(first == Some(i)) - i8::from(first == Some(j)));
    // The first player's share of each displacement.
    let dragged = 0.5 - 0.45 * (stands + FIRST_DRAGGED * is_first).clamp(-1.0, 1.0);
    let close = 1.0 - ((distance - CONTACT_M) / (SHELL_M - CONTACT_M)).clamp(0.0, 1.0);
    let carried = (b.vel - a.vel) * (2.0 * DT * DRAG * math::eighths::<2>(close));
    let (mut of_a, mut of_b) = (carried * dragged, carried * (dragged - 1.0));
    if touching {
        let pushed = 0.5 - 0.25 * (stands + FIRST_PUSHED * is_first).clamp(-1.0, 1.0);
        let step = CONTACT_M - distance;
        of_a -= away * (step * pushed).min(PUSH_MAX_M);
        of_b += away * (step * (1.0 - pushed)).min(PUSH_MAX_M);
    }
    displace(game, i, of_a);
    displace(game, j, of_b);
    if touching {
        let felt = [(i, of_a), (j, of_b)].map(|(id, by)| felt(game.player(id).vel, by));
        stumble::meet(game, events, [i, j], felt, CONTACT_M);
    }
}

/// How much better a player stands whose leg is out for the ball. (GRF's.)
fn tackles(player: &Player, now: i32) -> f32 {
    let pokes = player.body.lunge.is_some_and(|lunge| lunge.aim == Aim::Poke && lunge.at > now);
    let stat =
        if player.body.pose == Pose::Sliding { Stat::SlidingTackle } else { Stat::StandingTackle };
    if pokes || stat == Stat::SlidingTackle {
        TACKLES[0] + TACKLES[1] * player.skill(stat)
    } else {
        0.0
    }
}

/// The velocity at which a player moves who is displaced by this much over two ticks, as far as it
/// counts for their next motion.
fn felt(vel: Vec2, by: Vec2) -> Vec2 {
    vel + by * (FELT / (2.0 * DT))
}

/// Moves a player by this much over two ticks, metres. Their own velocity takes over a part of it,
/// except in a stumble, which runs its course. (GRF's.)
fn displace(game: &mut Match, id: PlayerId, by: Vec2) {
    let player = &mut game.players[id.index()];
    player.pos += by;
    if let Some(lunge) = &mut player.body.lunge {
        lunge.place += by.extend(0.0);
    }
    if let Some(swing) = player.body.kick.as_mut().and_then(|plan| plan.swing.as_mut()) {
        swing.place += by.extend(0.0);
    }
    if !matches!(player.body.pose, Pose::Stumbling { .. }) {
        player.vel += by * (TAKEN_OVER / (2.0 * DT));
    }
    player.body.push_m = (player.body.push_m + by.length()).min(SHOVE_MAX_M);
}
