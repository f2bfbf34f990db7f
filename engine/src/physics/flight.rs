//! Contact-free motion of the ball: flight, bounce on grass, roll. Our own integrator takes a few
//! nanoseconds per tick.
//!
//! A tick has three acts: [`push`] turns forces into velocity, the ball moves along its velocity,
//! and [`land`] applies the ground's response. Near something hard, rapier moves the ball and the
//! other two acts stay the same. So a tick of free flight has the same result with and without
//! rapier.
//!
//! The method is semi-implicit Euler. In free fall its energy falls by ½ g² dt² per tick; it never
//! grows.

use super::constants::{
    BALL_RADIUS, BOUNCE_GRIPS, GRASS_DEPTH, GRASS_TURN, MAGNUS_SPEED_MAX, MAGNUS_SPIN_MAX,
    ROLL_TWIST_DECAY, TICK_S, WIND_SHELTER,
};
use super::{Ball, Conditions};
use glam::{Vec2, Vec3};

/// Angular over linear speed gained at the rim of a shell: 1 / (2/3 · R).
pub(super) const SPIN_PER_SPEED: f32 = 1.5 / BALL_RADIUS;

/// Whether the ball lies still on the ground. Such a ball stays there until something touches it.
pub fn lies_still(ball: &Ball) -> bool {
    ball.vel == Vec3::ZERO && ball.pos.z <= BALL_RADIUS
}

/// Moves the ball by one tick with nothing hard nearby.
pub(super) fn fly(ball: &mut Ball, conditions: &Conditions) {
    if lies_still(ball) {
        return;
    }
    push(ball, conditions);
    ball.pos += ball.vel * TICK_S;
    land(ball, conditions);
}

/// Applies gravity, air and grass to velocity and spin over one tick.
pub(super) fn push(ball: &mut Ball, conditions: &Conditions) {
    let vel = through_air(ball.vel, ball.pos.z, conditions);
    let speed = vel.length();
    let mut acceleration = vel * (-conditions.air_drag() * speed);
    acceleration.z -= conditions.gravity();
    if ball.spin != Vec3::ZERO {
        acceleration += magnus(ball.spin, vel, speed, conditions);
        ball.spin *= 1.0 - conditions.spin_decay() * TICK_S;
    }
    ball.vel += acceleration * TICK_S;
    let grass = 1.0 - (ball.pos.z - BALL_RADIUS) * (1.0 / GRASS_DEPTH);
    if grass > 0.0 {
        roll(ball, grass.min(1.0), conditions);
    }
}

/// The velocity of a ball relative to the air around it. `height_m`: that of its centre.
#[inline]
pub(super) fn through_air(vel: Vec3, height_m: f32, conditions: &Conditions) -> Vec3 {
    if conditions.wind() == Vec2::ZERO {
        return vel;
    }
    let share = ((height_m - BALL_RADIUS) * (1.0 / WIND_SHELTER)).clamp(0.0, 1.0);
    vel - (conditions.wind() * share).extend(0.0)
}

/// The sideways pull on a spinning ball, m/s².
pub(super) fn magnus(spin: Vec3, vel: Vec3, speed: f32, conditions: &Conditions) -> Vec3 {
    let spin_squared = spin.length_squared();
    let share = if spin_squared > MAGNUS_SPIN_MAX * MAGNUS_SPIN_MAX {
        MAGNUS_SPIN_MAX / spin_squared.sqrt()
    } else {
        1.0
    };
    spin.cross(vel) * (conditions.magnus() * share * speed.min(MAGNUS_SPEED_MAX))
}

/// Brakes the ball in the grass and turns it towards pure rolling. `grass`: how deep it is in, 0 to
/// 1.
fn roll(ball: &mut Ball, grass: f32, conditions: &Conditions) {
    let along = ball.vel.truncate();
    let speed = along.length();
    let drag = conditions.roll_drag() + conditions.roll_drag_square() * speed * speed;
    let seconds = grass * TICK_S;
    let lost = drag * seconds;
    if lost >= speed {
        ball.vel = Vec3::new(0.0, 0.0, ball.vel.z);
        return;
    }
    let rolled = along * (1.0 - lost / speed);
    ball.vel = slide(&mut ball.spin, rolled, seconds, conditions).extend(ball.vel.z);
}

/// What the grass leaves of a level velocity, m/s, for it brakes the sliding of the lowest point
/// and turns the spin towards pure rolling.
pub(super) fn slide(spin: &mut Vec3, vel: Vec2, seconds: f32, conditions: &Conditions) -> Vec2 {
    let rolling = Vec2::new(-vel.y, vel.x) / BALL_RADIUS;
    let slip = rolling - spin.truncate();
    let turned = slip.clamp_length_max(GRASS_TURN * seconds);
    *spin += turned.extend(-spin.z * ROLL_TWIST_DECAY * seconds);
    vel + slip.perp() * (BALL_RADIUS * conditions.slide_drag() * seconds)
}

/// Holds the ball up on the ground, and throws back one that came down fast.
pub(super) fn land(ball: &mut Ball, conditions: &Conditions) {
    if ball.pos.z > BALL_RADIUS {
        return;
    }
    ball.pos.z = BALL_RADIUS;
    if ball.vel.z < 0.0 {
        let impact = -ball.vel.z;
        if impact > conditions.bounce_least() {
            grip(ball, impact, conditions);
        }
        ball.vel.z = (conditions.bounce() * impact - conditions.bounce_loss()).max(0.0);
    }
    if ball.vel == Vec3::ZERO {
        ball.spin = Vec3::ZERO;
    }
}

/// Applies friction in a bounce: it acts against the sliding of the lowest point, and spins the
/// ball as it slows it.
fn grip(ball: &mut Ball, impact: f32, conditions: &Conditions) {
    let sliding =
        Vec2::new(ball.vel.x - BALL_RADIUS * ball.spin.y, ball.vel.y + BALL_RADIUS * ball.spin.x);
    let [from, to] = BOUNCE_GRIPS;
    let share = conditions.bounce_grip() * ((impact - from) / (to - from)).clamp(0.0, 1.0);
    let change = sliding * -share.min(1.0);
    ball.vel += change.extend(0.0);
    ball.spin += Vec3::new(change.y, -change.x, 0.0) * SPIN_PER_SPEED;
}
