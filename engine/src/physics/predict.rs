//! Where a free ball will be, for players who run to meet it. Posts, nets and players are ignored.
//!
//! It takes strides of several ticks if possible: the roll has a closed form, and flight changes
//! slowly. A bounce is computed tick by tick with the physics itself. The error is mostly
//! centimetres. After a second it can reach a quarter of a metre if a fast ball falls steeply or
//! spins much.

use super::constants::{BALL_RADIUS, GRASS_DEPTH, MAGNUS_SPIN_MAX, ROLL_TWIST_DECAY, TICK_S};
use super::{Ball, Conditions, flight};
use glam::{Vec2, Vec3};

/// The ball's centre after `stride_ticks`, `2 * stride_ticks`, … ticks, in world metres; never
/// ends.
pub fn places(
    ball: &Ball,
    conditions: &Conditions,
    stride_ticks: u32,
) -> impl Iterator<Item = Vec3> + use<> {
    let mut ahead = *ball;
    let stride = Stride::of(stride_ticks, *conditions);
    std::iter::repeat_with(move || {
        stride.take(&mut ahead);
        ahead.pos
    })
}

/// A stride of several ticks.
struct Stride {
    conditions: Conditions,
    /// From this squared speed on, (m/s)², the air may press a rolling ball so hard to the ground
    /// that it grips.
    grips_mps2: f32,
    ticks: u32,
    seconds: f32,
    /// The weight of the initial velocity in a stride's way. Velocity changes first in every tick,
    /// so the last one counts more.
    first_share: f32,
    /// The speed at which the two parts of rolling resistance are the same, m/s.
    even_mps: f32,
    /// The speed, in units of `even_mps`, is the tangent of an angle that falls evenly while the
    /// ball rolls. This is the tangent of that fall in one stride.
    braked: f32,
}

impl Stride {
    fn of(ticks: u32, conditions: Conditions) -> Stride {
        let seconds = ticks as f32 * TICK_S;
        let constant = conditions.roll_drag();
        let square = conditions.roll_drag_square() + conditions.air_drag();
        Stride {
            grips_mps2: (conditions.bounce_least() / TICK_S - conditions.gravity())
                / (conditions.magnus() * MAGNUS_SPIN_MAX),
            conditions,
            ticks,
            seconds,
            first_share: 0.5 - 0.5 / ticks.max(1) as f32,
            even_mps: libm::sqrtf(constant / square),
            braked: libm::tanf(libm::sqrtf(constant * square) * seconds),
        }
    }

    /// Moves the ball on.
    fn take(&self, ball: &mut Ball) {
        let rolls = ball.pos.z <= BALL_RADIUS && ball.vel.z == 0.0;
        if rolls && ball.vel.length_squared() < self.grips_mps2 {
            return self.roll(ball);
        }
        let flown = self.fly(ball);
        if ball.pos.z.min(flown.pos.z) > BALL_RADIUS + GRASS_DEPTH {
            *ball = flown;
            return;
        }
        for _ in 0..self.ticks {
            flight::fly(ball, &self.conditions);
        }
    }

    /// Solves dv/dt = -(a + b v²): v is a tangent, whose angle falls evenly.
    fn roll(&self, ball: &mut Ball) {
        let before = ball.vel.truncate();
        let speed = before.length();
        if speed == 0.0 {
            return;
        }
        let share = speed / self.even_mps;
        let slower = self.even_mps * (share - self.braked) / (1.0 + share * self.braked);
        if slower <= 0.0 {
            // It comes to rest on the way, braked almost evenly.
            ball.pos += (before * (0.5 * self.seconds * share / self.braked)).extend(0.0);
            ball.vel = Vec3::ZERO;
            ball.spin = Vec3::ZERO;
            return;
        }
        let ahead = before / speed;
        let mut after = ahead * slower;
        if ball.spin.z != 0.0 {
            after += self.twist(ball, ahead * (0.5 * (speed + slower)));
        }
        after = flight::slide(&mut ball.spin, after, self.seconds, &self.conditions);
        ball.pos += self.way(before.extend(0.0), after.extend(0.0));
        ball.vel = after.extend(0.0);
    }

    /// What spin about the vertical axis adds to a rolling ball's velocity, m/s. `vel`: the
    /// velocity in the middle of the stride.
    fn twist(&self, ball: &Ball, vel: Vec2) -> Vec2 {
        let spin = ball.spin.with_z(ball.spin.z * (1.0 - 0.5 * ROLL_TWIST_DECAY * self.seconds));
        let pull = flight::magnus(spin, vel.extend(0.0), vel.length(), &self.conditions);
        pull.truncate() * self.seconds
    }

    /// The ball after a stride in the air, with the forces at the stride's middle.
    fn fly(&self, ball: &Ball) -> Ball {
        let height_m = ball.pos.z + ball.vel.z * (0.5 * self.seconds);
        let conditions = &self.conditions;
        let force = |vel: Vec3| {
            let vel = flight::through_air(vel, height_m, conditions);
            let speed = vel.length();
            let turn = if ball.spin == Vec3::ZERO {
                Vec3::ZERO
            } else {
                flight::magnus(ball.spin, vel, speed, conditions)
            };
            turn - vel * (conditions.air_drag() * speed) - Vec3::new(0.0, 0.0, conditions.gravity())
        };
        let middle = ball.vel + force(ball.vel) * (0.5 * self.seconds);
        let vel = ball.vel + force(middle) * self.seconds;
        let spin = ball.spin * (1.0 - self.conditions.spin_decay() * self.seconds);
        Ball { pos: ball.pos + self.way(ball.vel, vel), vel, spin }
    }

    /// The way of a stride between two velocities.
    fn way(&self, before: Vec3, after: Vec3) -> Vec3 {
        (before * self.first_share + after * (1.0 - self.first_share)) * self.seconds
    }
}
