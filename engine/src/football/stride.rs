//! Running, four players per instruction: steers velocities, moves bodies and turns them.
//!
//! Where code for one player would branch, every lane computes both sides and keeps one. The curves
//! are fitted to measured ones (speed per step from a standstill, ticks to turn, length of a stop).

use crate::football::pace::{ARRIVAL_PER_S, DT};
use crate::rows::{Lane, WIDTH};
use glam::Vec2;
use wide::f32x4;

/// Braking, m/s².
const BRAKE_MPS2: f32 = 14.0;
/// Sideways acceleration of a turn, m/s².
const TURN_MPS2: f32 = 17.0;
/// Ticks from the wish to the first push.
const LAG_TICKS: f32 = 3.0;
/// A player slower than this stands and must set off first, m/s.
const STANDS_MPS: f32 = 0.3;
/// A slower wish counts as none, m/s.
const WISH_MPS: f32 = 0.15;
/// From this cosine on, a change of direction costs nothing.
const STRAIGHT: f32 = 0.996;

/// The share of their run by which players drift to their left. It is invisible, but it matches
/// GRF's rounding: places on the border between two pixels of a map fall into the same pixel.
pub(super) const ASIDE: f32 = 1.0e-6;

/// The pace of a player who doesn't run to a point.
pub(super) const NO_POINT: f32 = -1.0;
/// Nearer than this a player has arrived, metres.
const THERE_M: f32 = 0.25;
/// The ball is at a player's feet within this distance, metres; chosen.
const AT_FEET_M: f32 = 0.8;
/// This close to the rim no player runs further outwards, metres.
const RIM_CARE_M: f32 = 0.5;

/// Four runners: the values that a stride reads and changes.
pub(super) struct Four {
    /// World metres.
    pub(super) x: Lane,
    /// World metres.
    pub(super) y: Lane,
    /// World m/s.
    pub(super) vx: Lane,
    /// World m/s.
    pub(super) vy: Lane,
    /// The wanted velocity, world m/s; or the way to a target point, metres, if `pace` is set.
    pub(super) want_x: Lane,
    /// The same along y.
    pub(super) want_y: Lane,
    /// Speed limit on the way to a point, m/s; [`NO_POINT`] without a point.
    pub(super) pace: Lane,
    /// Top speed, m/s.
    pub(super) top: Lane,
    /// Ticks spent so far on setting off.
    pub(super) lag: Lane,
    /// The factor of agility in a turn: about 1.
    pub(super) turn: Lane,
    /// The factor of acceleration in a push: about 1.
    pub(super) burst: Lane,
    /// How far others have pushed the player lately, metres.
    pub(super) shoved: Lane,
    /// Balance as it counts now.
    pub(super) balance: Lane,
    /// The unit vector that the player faces, x.
    pub(super) facing_x: Lane,
    /// The unit vector that the player faces, y.
    pub(super) facing_y: Lane,
}

/// Brings every velocity closer to its wish, moves everyone along it, and turns them.
///
/// All fours do one act before the next: acts of different fours overlap in the processor, while
/// acts of one four wait for each other. `rim`: how far they may go along each axis, metres.
pub(super) fn run(fours: &mut [Four], ball: Vec2, rim: Vec2) {
    for four in fours.iter_mut() {
        four.wish(rim);
    }
    for four in fours.iter_mut() {
        four.steer();
    }
    for four in fours.iter_mut() {
        four.go(rim);
        four.turn(ball.x, ball.y);
    }
}

impl Four {
    /// Four players at rest who want nothing.
    pub(super) const fn still() -> Four {
        let zero = [0.0; WIDTH];
        Four {
            x: zero,
            y: zero,
            vx: zero,
            vy: zero,
            want_x: zero,
            want_y: zero,
            pace: [NO_POINT; WIDTH],
            top: zero,
            lag: zero,
            turn: zero,
            burst: zero,
            shoved: zero,
            balance: zero,
            facing_x: zero,
            facing_y: zero,
        }
    }

    /// Turns ways to points into velocities that stop there, and turns back wishes that lead beyond
    /// the rim.
    fn wish(&mut self, rim: Vec2) {
        let (none, there) = (f32x4::ZERO, f32x4::splat(THERE_M));
        let rim_x = f32x4::splat(rim.x - RIM_CARE_M);
        let rim_y = f32x4::splat(rim.y - RIM_CARE_M);
        let (x, y, pace) =
            (f32x4::new(self.want_x), f32x4::new(self.want_y), f32x4::new(self.pace));
        let distance = (x * x + y * y).sqrt();
        let scale = (distance * f32x4::splat(ARRIVAL_PER_S)).fast_min(pace) / distance;
        let (runs, is_there) = (pace.simd_ge(none), distance.simd_lt(there));
        let want_x = runs.select(is_there.select(none, x * scale), x);
        let want_y = runs.select(is_there.select(none, y * scale), y);
        (self.want_x, self.want_y) = (want_x.to_array(), want_y.to_array());
        let (x, y) = (f32x4::new(self.x), f32x4::new(self.y));
        let (far_x, far_y) = (x.abs().simd_gt(rim_x), y.abs().simd_gt(rim_y));
        if (far_x | far_y).to_bitmask() != 0 {
            let out_x = far_x & (want_x * x).simd_gt(none);
            let out_y = far_y & (want_y * y).simd_gt(none);
            self.want_x = out_x.select(none, want_x).to_array();
            self.want_y = out_y.select(none, want_y).to_array();
        }
    }

    /// Brings every velocity closer to its wish, as far as a body can in one tick.
    fn steer(&mut self) {
        let is = f32x4::splat;
        let (none, one) = (f32x4::ZERO, f32x4::ONE);
        let (vx, vy) = (f32x4::new(self.vx), f32x4::new(self.vy));
        let (want_x, want_y) = (f32x4::new(self.want_x), f32x4::new(self.want_y));
        let (top, lag) = (f32x4::new(self.top), f32x4::new(self.lag));
        let speed = (vx * vx + vy * vy).sqrt();
        let wanted = (want_x * want_x + want_y * want_y).sqrt();
        let wish = wanted.fast_min(top);
        let braked = speed - is(BRAKE_MPS2 * DT);
        // Braking, for players who want to stand.
        let (kept, moves) = (braked.fast_max(none) / speed, speed.simd_gt(is(1e-3)));
        let (brake_x, brake_y) = (moves.select(vx * kept, none), moves.select(vy * kept, none));
        // Setting off, for players who stand.
        let (aim_x, aim_y) = (want_x / wanted, want_y / wanted);
        let later = is(9.4) - is(1.8) * (speed - is(2.4)).fast_max(none);
        let early =
            speed.simd_lt(is(2.0)).select(is(18.0), later.fast_max(is(4.4)).fast_min(is(9.4)));
        let shoved =
            f32x4::new(self.shoved) * (is(10.0) - is(5.0) * f32x4::new(self.balance)) - is(0.1);
        let free = one - shoved.fast_max(none).fast_min(is(0.3));
        let push =
            early.fast_min(is(3.0) * (top - speed) + is(0.05)) * f32x4::new(self.burst) * free;
        let pushed = (speed + push * is(DT)).fast_min(wish);
        let waits = lag.simd_lt(is(LAG_TICKS));
        let (off_x, off_y) = (waits.select(vx, aim_x * pushed), waits.select(vy, aim_y * pushed));
        // Running, for the others: straight on, or round a bend.
        let (rests, stands) = (wish.simd_lt(is(WISH_MPS)), speed.simd_lt(is(STANDS_MPS)));
        let (ahead_x, ahead_y) = (vx / speed, vy / speed);
        let cos = (ahead_x * aim_x + ahead_y * aim_y).fast_max(-one).fast_min(one);
        let next = speed.simd_lt(wish).select(pushed, braked.fast_max(wish));
        let bends = cos.simd_lt(is(STRAIGHT)) & !(rests | stands);
        let (mut way_x, mut way_y, mut pace) = (aim_x, aim_y, next);
        // A bend costs as much as all the rest, and most fours run straight on.
        if bends.to_bitmask() != 0 {
            // Players lean into an arc and lose speed; before an about-turn they brake.
            let sin = ahead_x * aim_y - ahead_y * aim_x;
            let about = cos.simd_lt(is(-0.5)) & speed.simd_gt(is(2.0));
            let angle = is(TURN_MPS2) * f32x4::new(self.turn) / speed.fast_max(is(1.2)) * is(DT);
            let angle = angle.fast_min(is(0.35));
            let back = cos.simd_lt(none);
            let turned = sin.abs().fast_max(back.select(one, none));
            let left = sin.simd_lt(none).select(-angle, angle);
            let (arc_x, arc_y) = unit(ahead_x - ahead_y * left, ahead_y + ahead_x * left);
            let leans = turned.simd_gt(angle);
            let (lean_x, lean_y) = (leans.select(arc_x, aim_x), leans.select(arc_y, aim_y));
            let sharp = cos.simd_gt(none).select((is(1.05) * sin.abs()).fast_min(one), one);
            let slowed = speed - is(BRAKE_MPS2 * 0.9) * sharp * is(DT);
            let leaning = slowed.fast_max(next.fast_min(is(1.5))).fast_min(next);
            way_x = bends.select(about.select(ahead_x, lean_x), aim_x);
            way_y = bends.select(about.select(ahead_y, lean_y), aim_y);
            pace = bends.select(about.select(braked, leaning), next);
        }
        let pace = pace.fast_max(none);
        let got_off = stands.select((lag + one).fast_min(is(LAG_TICKS)), is(LAG_TICKS));
        self.vx = rests.select(brake_x, stands.select(off_x, way_x * pace)).to_array();
        self.vy = rests.select(brake_y, stands.select(off_y, way_y * pace)).to_array();
        self.lag = rests.select(none, got_off).to_array();
    }

    /// Moves everyone along their velocity, no further than the rim.
    fn go(&mut self, rim: Vec2) {
        let (rim_x, rim_y) = (f32x4::splat(rim.x), f32x4::splat(rim.y));
        let (dt, aside) = (f32x4::splat(DT), f32x4::splat(DT * ASIDE));
        let (vx, vy) = (f32x4::new(self.vx), f32x4::new(self.vy));
        let x = f32x4::new(self.x) + vx * dt + vy * aside;
        let y = f32x4::new(self.y) + vy * dt - vx * aside;
        self.x = x.fast_max(-rim_x).fast_min(rim_x).to_array();
        self.y = y.fast_max(-rim_y).fast_min(rim_y).to_array();
    }

    /// Turns everyone to where they run, or to the ball.
    fn turn(&mut self, ball_x: f32, ball_y: f32) {
        let little = f32x4::splat(0.12);
        let (vx, vy) = (f32x4::new(self.vx), f32x4::new(self.vy));
        let runs = (vx * vx + vy * vy).simd_gt(f32x4::ONE);
        let (mut towards_x, mut towards_y, mut at_feet) = (vx, vy, f32x4::ZERO);
        if !runs.all() {
            let (ball_x, ball_y) = (
                f32x4::splat(ball_x) - f32x4::new(self.x),
                f32x4::splat(ball_y) - f32x4::new(self.y),
            );
            (towards_x, towards_y) = (runs.select(vx, ball_x), runs.select(vy, ball_y));
            // With the ball at their feet players keep facing the way they went.
            at_feet = !runs
                & (ball_x * ball_x + ball_y * ball_y).simd_lt(f32x4::splat(AT_FEET_M * AT_FEET_M));
        }
        let (towards_x, towards_y) = unit(towards_x, towards_y);
        let (facing_x, facing_y) = (f32x4::new(self.facing_x), f32x4::new(self.facing_y));
        let (mixed_x, mixed_y) = (facing_x + towards_x * little, facing_y + towards_y * little);
        let length = (mixed_x * mixed_x + mixed_y * mixed_y).sqrt();
        let turns = length.simd_gt(f32x4::splat(0.05)) & !at_feet;
        self.facing_x = turns.select(mixed_x / length, facing_x).to_array();
        self.facing_y = turns.select(mixed_y / length, facing_y).to_array();
    }
}

/// The unit vector along (x, y); zero where there is none.
fn unit(x: f32x4, y: f32x4) -> (f32x4, f32x4) {
    let scale = f32x4::ONE / (x * x + y * y).sqrt();
    let is_one = scale.simd_lt(f32x4::splat(f32::INFINITY)) & scale.simd_gt(f32x4::ZERO);
    (is_one.select(x * scale, f32x4::ZERO), is_one.select(y * scale, f32x4::ZERO))
}
