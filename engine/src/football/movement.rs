//! How a body runs, turns and stops.
//!
//! Decides where each player's body goes. What one player wants to run is computed here;
//! [`super::stride`] moves four at once. `control` decides where a player wants to go.

use crate::football::dribble::{LIES_MPS, SOLE_M};
use crate::football::dribble_motion;
use crate::football::pace::{ARRIVAL_PER_S, DRIBBLES_FROM_MPS, DT, SPRINT_MPS, SPRINTS_FROM_MPS};
use crate::football::stride::{self, Four, NO_POINT};
use crate::rows::{ROWS, WIDTH};
use crate::state::player::{Intent, Pose, Swing};
use crate::state::{Match, Player, PlayerId, Squad};
use arrayvec::ArrayVec;
use glam::Vec2;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::Stat;

/// A player who wants to stand stops for a ball this near, metres, and lays it where they stop.
const STOPPING_M: f32 = 1.1;

/// How a player who sets off in the motion of a touch speeds up to a dribbler's pace, m/s².
/// Measured of GRF's.
const SETS_OFF_MPS2: f32 = 25.0;

/// The players who do more in a tick than run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Busy {
    /// Players in a slide.
    pub slides: Squad,
    /// Players who intend a kick, on the pitch or not.
    pub kicks: Squad,
    /// Players with a leg out for the ball, on the pitch or not.
    pub legs: Squad,
}

/// Moves every player by one tick. Returns the players with more to do, so that the others are
/// skipped.
pub fn advance(game: &mut Match) -> Busy {
    let mut busy = Busy::default();
    let ball = game.ball.pos.truncate();
    let ball_vel = game.ball.vel.truncate();
    let (owner, last_touch, rim) = (game.owner, game.last_touch, game.rim());
    let now = game.tick as i32;
    let frozen = game.play.set_piece.map(|set_piece| set_piece.taker);
    let mut runners: ArrayVec<PlayerId, PLAYERS_MAX> = ArrayVec::new();
    let mut fours: ArrayVec<Four, ROWS> = ArrayVec::new();
    for id in game.squad.ids() {
        let player = &mut game.players[id.index()];
        if player.body.kick.is_some() {
            busy.kicks.add(id);
        }
        if player.body.lunge.is_some() {
            busy.legs.add(id);
        }
        if !player.active {
            continue;
        }
        match player.body.pose {
            Pose::Up => {}
            Pose::Sliding => {
                busy.slides.add(id);
                slow_down(player, 7.0);
                pass_time(player, Pose::Down, 35);
                go(player, rim);
                continue;
            }
            Pose::Stumbling { to_dmps } => {
                stumble(player, f32::from(to_dmps) * 0.1);
                pass_time(player, Pose::Up, 0);
                go(player, rim);
                continue;
            }
            Pose::Down | Pose::Diving => {
                slow_down(player, 12.0);
                pass_time(player, Pose::Up, 0);
                go(player, rim);
                continue;
            }
        }
        if commits(player, now) {
            go(player, rim);
            continue;
        }
        let has_ball = owner == Some(id);
        let strides = has_ball
            && last_touch == Some(id)
            && dribble_motion::is_within_stride(player, now)
            && player.body.kick.is_none();
        let wish = if strides { run_on(player) } else { player.body.dribble };
        let (want, pace) = match player.body.intent {
            _ if frozen.is_some_and(|taker| taker != id) => (Vec2::ZERO, NO_POINT),
            // A dribbler finishes the stride. (GRF's.)
            _ if strides => {
                let speed = wish.length().max(player.vel.length());
                (go_for_ball(player, wish, ball, ball_vel, true, speed), NO_POINT)
            }
            Intent::Stand => (Vec2::ZERO, NO_POINT),
            Intent::Run(velocity) => (velocity, NO_POINT),
            Intent::Go(to, speed) => (to - player.pos, speed),
            Intent::Ball(speed) => {
                (go_for_ball(player, wish, ball, ball_vel, has_ball, speed), NO_POINT)
            }
        };
        let (row, at) = (runners.len() / WIDTH, runners.len() % WIDTH);
        if at == 0 {
            fours.push(Four::still());
        }
        let four = &mut fours[row];
        (four.want_x[at], four.want_y[at], four.pace[at]) = (want.x, want.y, pace);
        take(four, at, player);
        runners.push(id);
    }
    stride::run(&mut fours, ball, rim);
    for (i, id) in runners.into_iter().enumerate() {
        give(&fours[i / WIDTH], i % WIDTH, &mut game.players[id.index()]);
    }
    busy
}

/// Puts a player into their lane.
fn take(four: &mut Four, at: usize, player: &Player) {
    let body = &player.body;
    (four.x[at], four.y[at]) = (player.pos.x, player.pos.y);
    (four.vx[at], four.vy[at]) = (player.vel.x, player.vel.y);
    four.top[at] = body.speed_top_mps;
    four.lag[at] = f32::from(body.lag_ticks);
    four.turn[at] = 0.85 + 0.2 * player.skill(Stat::Agility);
    let burst = 0.9 + 0.13 * body.stats[Stat::Acceleration.index()];
    four.burst[at] = burst;
    four.shoved[at] = body.push_m;
    four.balance[at] = player.skill(Stat::Balance);
    (four.facing_x[at], four.facing_y[at]) = (body.facing.x, body.facing.y);
}

/// Copies a lane back to its player.
fn give(four: &Four, at: usize, player: &mut Player) {
    player.pos = Vec2::new(four.x[at], four.y[at]);
    player.vel = Vec2::new(four.vx[at], four.vy[at]);
    player.body.lag_ticks = four.lag[at] as i8;
    player.body.facing = Vec2::new(four.facing_x[at], four.facing_y[at]);
}

/// Moves a player along their velocity, no further than the rim.
fn go(player: &mut Player, rim: Vec2) {
    let aside = Vec2::new(player.vel.y, -player.vel.x) * stride::ASIDE;
    player.pos = (player.pos + (player.vel + aside) * DT).clamp(-rim, rim);
}

/// The velocity of a dribbler who finishes a stride: straight on, whatever else they want by now.
fn run_on(player: &Player) -> Vec2 {
    let (vel, wish) = (player.vel, player.body.dribble);
    if vel.dot(wish) > 0.0 { vel.normalize_or_zero() * wish.length() } else { vel }
}

/// The velocity that brings a player to the ball and keeps them with it.
fn go_for_ball(
    player: &Player,
    wish: Vec2,
    ball: Vec2,
    ball_vel: Vec2,
    has_ball: bool,
    speed: f32,
) -> Vec2 {
    let to_ball = ball - player.pos;
    let distance = to_ball.length();
    let lies = ball_vel.length_squared() < LIES_MPS * LIES_MPS;
    if !has_ball && lies && wish.length_squared() > 0.25 && distance > SOLE_M * 0.5 {
        // Players don't slow down for a ball that lies there, nor do they speed up close to it, but
        // for a kick. (GRF's.)
        let kicks = player.body.kick.is_some();
        let most = if kicks { speed } else { player.vel.length().max(ARRIVAL_PER_S * distance) };
        return to_ball * (speed.min(most) / distance);
    }
    if has_ball || distance < 1.2 {
        let behind = if wish.length_squared() > 0.25 {
            // Who will turn with the ball stays behind it until then.
            let turns = has_ball && dribble_motion::turns(player);
            (if turns { player.vel } else { wish }).normalize_or_zero() * 0.35
        } else {
            to_ball * (0.4 / distance.max(0.4))
        };
        let resting = distance < 0.8 && ball_vel.length_squared() < 2.0 * 2.0;
        let lays_it = has_ball
            && distance < STOPPING_M
            && player.vel.length_squared() < SPRINTS_FROM_MPS * SPRINTS_FROM_MPS;
        if wish == Vec2::ZERO && (resting || lays_it) {
            return Vec2::ZERO;
        }
        let catch_up = ball_vel + (to_ball - behind) * 3.5;
        // With the ball at their feet, players run on as they want; the next touch comes before
        // they overrun it.
        let pace = wish.length().min(speed);
        let ahead =
            wish.dot(to_ball) > 0.2 * pace && wish.dot(catch_up) > 0.9 * pace * catch_up.length();
        return catch_up.clamp_length(if ahead { pace } else { 0.0 }, speed);
    }
    let to_meet = player.body.meet - player.pos;
    let meet_m = to_meet.length();
    if meet_m < 0.3 {
        // The ball will come past the player, who waits for it and leans towards it.
        return (to_ball * 0.6).clamp_length_max(1.5);
    }
    let needed = meet_m / player.body.meet_s.max(0.05);
    to_meet * ((needed * 1.25).clamp(2.0, speed.max(2.0)).min(speed) / meet_m)
}

/// Brakes a body that slides or lies.
fn slow_down(player: &mut Player, brake: f32) {
    let speed = player.vel.length();
    player.vel = if speed > 0.05 {
        player.vel * ((speed - brake * DT).max(0.0) / speed)
    } else {
        Vec2::ZERO
    };
}

/// Brings a stumbling body, which runs on where it faces, closer to the speed at which it regains
/// its balance.
fn stumble(player: &mut Player, to_mps: f32) {
    let end = player.body.facing * to_mps;
    player.vel += (end - player.vel) / f32::from(player.body.pose_ticks.max(1));
}

/// Brings the body of a dribbler closer to how it comes out of the motion of its touch.
fn carry_ball(player: &mut Player, wish: Vec2, to: Vec2, ticks: i32) {
    let left = 1.0 / ticks.max(1) as f32;
    let sets_off = player.vel.length_squared() < DRIBBLES_FROM_MPS * DRIBBLES_FROM_MPS;
    let change = (to - player.vel) * left;
    player.vel += if sets_off && to.dot(change) > 0.0 {
        change.clamp_length_min(SETS_OFF_MPS2 * DT).clamp_length_max((to - player.vel).length())
    } else {
        change
    };
    let wish = wish.normalize_or(player.body.facing);
    let facing = player.body.facing;
    let half_way = if facing.dot(wish) < -0.9 { wish.perp() } else { wish };
    player.body.facing = (facing + (half_way - facing) * (2.0 * left).min(1.0)).normalize_or(wish);
    player.body.lag_ticks = 0;
}

/// Moves the body of a player whose leg is out for the ball, or swings at it. False for
/// anybody else.
fn commits(player: &mut Player, now: i32) -> bool {
    if let Some(lunge) = player.body.lunge {
        let to = dribble_motion::out(player, &lunge);
        match lunge.at_dmps {
            Some(at_dmps) if now < lunge.at => {
                let at = player.vel.normalize_or(player.body.facing) * (f32::from(at_dmps) * 0.1);
                carry_ball(player, lunge.wish, at, lunge.at - now);
            }
            _ => carry_ball(player, lunge.wish, to, lunge.until() - now),
        }
        player.pos += if now < lunge.at { lunge.steps_before } else { lunge.steps_after };
        return true;
    }
    if let Some(plan) = &mut player.body.kick
        && let Some(swing) = &mut plan.swing
        && swing.ready_at >= now
        && swing.end_dmps != Swing::RUN
    {
        let pace = stride_of(player.vel.length(), swing, swing.ready_at - now + 1);
        swing.left_m -= pace * DT;
        player.vel = player.vel.normalize_or(player.body.facing) * pace;
        player.body.lag_ticks = 0;
        return true;
    }
    false
}

/// The pace in the next tick of a run in a swing: it changes smoothly, so that the player comes as
/// far, and is as fast then, as the swing takes them.
fn stride_of(pace: f32, swing: &Swing, ticks: i32) -> f32 {
    let left_s = ticks as f32 * DT;
    let end_mps = f32::from(swing.end_dmps) * 0.1;
    // The beginning of the parabola through both paces with that mean.
    let change = (6.0 * swing.left_m / left_s - 4.0 * pace - 2.0 * end_mps) / left_s;
    let next = if ticks > 2 { pace + change * DT } else { end_mps };
    next.clamp(0.0, SPRINT_MPS)
}

/// Counts down a pose and then changes to the next one.
fn pass_time(player: &mut Player, next: Pose, ticks: u8) {
    player.body.pose_ticks = player.body.pose_ticks.saturating_sub(1);
    if player.body.pose_ticks == 0 {
        player.body.strike_pose(next, ticks);
    }
}
