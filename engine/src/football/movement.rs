//! How a body runs, turns and stops.
//!
//! The curves are fitted to the measured ones (speed step by step from a standstill, ticks to turn, length of a stop).
//! Decides where a player's body goes; leaves to `control` where he wants to go.

use crate::football::body::{Intent, Pose};
use crate::state::{Match, Player};
use glam::Vec2;
use setpiece_scenario::pitch::{RIM_X_M, RIM_Y_M};
use setpiece_scenario::vocabulary::Stat;

/// Speed with the dribble key, m/s.
pub const DRIBBLE_MPS: f32 = 3.5;
/// Speed without sprint, m/s.
pub const RUN_MPS: f32 = 5.0;
/// Speed asked for when sprinting, m/s: above everyone's top speed.
pub const SPRINT_MPS: f32 = 8.0;
/// Speed with the dribble key and the ball, m/s. Measured.
pub const DRIBBLE_WITH_BALL_MPS: f32 = 4.1;
/// Speed without sprint with the ball, m/s. Measured.
pub const RUN_WITH_BALL_MPS: f32 = 5.12;
/// Top speed with the ball against that without. Measured.
pub const WITH_BALL: f32 = 0.955;

/// Length of a tick, seconds.
pub const DT: f32 = 0.01;
/// Metres of distance to m/s of speed wanted.
pub const ARRIVAL_PER_S: f32 = 2.6;
/// Braking, m/s².
const BRAKE_MPS2: f32 = 14.0;
/// Sideways acceleration of a turn, m/s².
const TURN_MPS2: f32 = 17.0;
/// Ticks from the wish to the first push.
const LAG_TICKS: u8 = 3;

/// Moves every player on by a tick.
pub fn advance(game: &mut Match) {
    let ball = game.ball.pos.truncate();
    let ball_vel = game.ball.vel.truncate();
    let owner = game.owner;
    let frozen = game.play.set_piece.map(|set_piece| set_piece.taker);
    for (i, player) in game.players.iter_mut().enumerate() {
        if !player.active {
            continue;
        }
        match player.body.pose {
            Pose::Up => {}
            Pose::Sliding => {
                slow_down(player, 7.0);
                pass_time(player, Pose::Down, 35);
                go(player);
                continue;
            }
            Pose::Down | Pose::Diving => {
                slow_down(player, 12.0);
                pass_time(player, Pose::Up, 0);
                go(player);
                continue;
            }
        }
        let has_ball = owner.is_some_and(|id| id.index() == i);
        let mut want = match player.body.intent {
            Intent::Stand => Vec2::ZERO,
            Intent::Run(velocity) => velocity,
            Intent::Go(to, speed) => arrive(player.pos, to, speed),
            Intent::Ball(speed) => go_for_ball(player, ball, ball_vel, has_ball, speed),
        };
        if frozen.is_some_and(|taker| taker.index() != i) {
            want = Vec2::ZERO;
        }
        let top = if has_ball { WITH_BALL * player.body.speed_top_mps } else { player.body.speed_top_mps };
        keep_inside(player.pos, &mut want);
        steer(player, want, top);
        go(player);
        turn_body(player, ball);
    }
}

/// Carries a player along his velocity, no further than the rim.
fn go(player: &mut Player) {
    let rim = Vec2::new(RIM_X_M as f32, RIM_Y_M as f32);
    player.pos = (player.pos + player.vel * DT).clamp(-rim, rim);
}

/// The velocity that brings a player to a point and stops him there.
fn arrive(pos: Vec2, to: Vec2, speed: f32) -> Vec2 {
    let way = to - pos;
    let distance = way.length();
    if distance < 0.25 { Vec2::ZERO } else { way * ((distance * ARRIVAL_PER_S).min(speed) / distance) }
}

/// The velocity that brings a player to the ball and keeps him with it.
fn go_for_ball(player: &Player, ball: Vec2, ball_vel: Vec2, has_ball: bool, speed: f32) -> Vec2 {
    let to_ball = ball - player.pos;
    let distance = to_ball.length();
    if has_ball || distance < 1.2 {
        let wish = player.body.dribble;
        let behind = if wish.length_squared() > 0.25 {
            wish.normalize_or_zero() * 0.35
        } else {
            to_ball * (0.4 / distance.max(0.4))
        };
        if wish == Vec2::ZERO && distance < 0.8 && ball_vel.length_squared() < 2.0 * 2.0 {
            return Vec2::ZERO;
        }
        let catch_up = ball_vel + (to_ball - behind) * 3.5;
        // With the ball before his feet he runs on as he wants to: the next touch comes before he overruns it.
        let pace = wish.length().min(speed);
        let ahead = wish.dot(to_ball) > 0.2 * pace && wish.dot(catch_up) > 0.9 * pace * catch_up.length();
        return catch_up.clamp_length(if ahead { pace } else { 0.0 }, speed);
    }
    let to_meet = player.body.meet - player.pos;
    let meet_m = to_meet.length();
    if meet_m < 0.3 {
        // He is where the ball will come by: he waits, leaning towards it.
        return (to_ball * 0.6).clamp_length_max(1.5);
    }
    let needed = meet_m / player.body.meet_s.max(0.05);
    to_meet * ((needed * 1.25).clamp(2.0, speed.max(2.0)).min(speed) / meet_m)
}

/// Turns the wish back that leads further out than the rim.
fn keep_inside(pos: Vec2, want: &mut Vec2) {
    if pos.x.abs() > RIM_X_M as f32 - 0.5 && want.x * pos.x > 0.0 {
        want.x = 0.0;
    }
    if pos.y.abs() > RIM_Y_M as f32 - 0.5 && want.y * pos.y > 0.0 {
        want.y = 0.0;
    }
}

/// Brings the velocity nearer to the wish, as a body can in a tick.
pub fn steer(player: &mut Player, want: Vec2, top: f32) {
    let speed = player.vel.length();
    let wish = want.length().min(top);
    if wish < 0.15 {
        player.body.lag_ticks = 0;
        let slower = (speed - BRAKE_MPS2 * DT).max(0.0);
        player.vel = if speed > 1e-3 { player.vel * (slower / speed) } else { Vec2::ZERO };
        return;
    }
    let aim = want / want.length();
    if speed < 0.3 {
        if player.body.lag_ticks < LAG_TICKS {
            player.body.lag_ticks += 1;
            return;
        }
        player.vel = aim * (speed + push(speed, top, player) * DT).min(wish);
        return;
    }
    player.body.lag_ticks = LAG_TICKS;
    let ahead = player.vel / speed;
    let cos = ahead.dot(aim).clamp(-1.0, 1.0);
    let sin = ahead.perp_dot(aim);
    let mut next = if speed < wish {
        (speed + push(speed, top, player) * DT).min(wish)
    } else {
        (speed - BRAKE_MPS2 * DT).max(wish)
    };
    let mut direction = aim;
    // Beyond a few degrees he leans into an arc and loses speed; about turns brake first.
    if cos < 0.996 {
        if cos < -0.5 && speed > 2.0 {
            next = speed - BRAKE_MPS2 * DT;
            direction = ahead;
        } else {
            let agility = 0.85 + 0.2 * player.skill(Stat::Agility);
            let angle = (TURN_MPS2 * agility / speed.max(1.2) * DT).min(0.35);
            let turned = sin.abs().max(if cos < 0.0 { 1.0 } else { 0.0 });
            if turned > angle {
                let left = if sin < 0.0 { -angle } else { angle };
                direction = Vec2::new(ahead.x - ahead.y * left, ahead.y + ahead.x * left).normalize_or_zero();
            }
            let sharp = if cos > 0.0 { (1.05 * sin.abs()).min(1.0) } else { 1.0 };
            next = (speed - BRAKE_MPS2 * 0.9 * sharp * DT).max(next.min(1.5)).min(next);
        }
    }
    player.vel = direction * next.max(0.0);
}

/// Acceleration at a speed, m/s²: measured from standstill to sprint.
fn push(speed: f32, top: f32, player: &Player) -> f32 {
    let early = if speed < 2.0 { 18.0 } else { (9.4 - 1.8 * (speed - 2.4).max(0.0)).clamp(4.4, 9.4) };
    let stat = 0.9 + 0.13 * player.body.stats[Stat::Acceleration.index()];
    let pushed = (player.body.push_m * (10.0 - 5.0 * player.skill(Stat::Balance)) - 0.1).clamp(0.0, 0.3);
    early.min(3.0 * (top - speed) + 0.05) * stat * (1.0 - pushed)
}

/// Braking of a body that slides or lies.
fn slow_down(player: &mut Player, brake: f32) {
    let speed = player.vel.length();
    player.vel = if speed > 0.05 { player.vel * ((speed - brake * DT).max(0.0) / speed) } else { Vec2::ZERO };
}

/// Counts a pose down; the next one follows.
fn pass_time(player: &mut Player, next: Pose, ticks: u8) {
    player.body.pose_ticks = player.body.pose_ticks.saturating_sub(1);
    if player.body.pose_ticks == 0 {
        player.body.strike_pose(next, ticks);
    }
}

/// Faces where he runs, or the ball.
fn turn_body(player: &mut Player, ball: Vec2) {
    let towards = if player.vel.length_squared() > 1.0 { player.vel } else { ball - player.pos };
    let mixed = player.body.facing + towards.normalize_or_zero() * 0.12;
    let length = mixed.length();
    if length > 0.05 {
        player.body.facing = mixed / length;
    }
}
