//! Running, four players with one instruction: velocities are steered, bodies carried on and turned.
//!
//! Every lane computes both sides of what would be a branch for one man and keeps one. The curves are fitted to the
//! measured ones (speed step by step from a standstill, ticks to turn, length of a stop).

use crate::football::movement::{ARRIVAL_PER_S, DT};
use setpiece_scenario::pitch::{PLAYERS_MAX, RIM_X_M, RIM_Y_M};
use wide::f32x4;

/// Players of a vector.
pub(super) const WIDTH: usize = 4;
/// Vectors that hold everybody.
const ROWS: usize = PLAYERS_MAX.div_ceil(WIDTH);

/// Braking, m/s².
const BRAKE_MPS2: f32 = 14.0;
/// Sideways acceleration of a turn, m/s².
const TURN_MPS2: f32 = 17.0;
/// Ticks from the wish to the first push.
const LAG_TICKS: f32 = 3.0;
/// Slower than this he stands and must get off first, m/s.
const STANDS_MPS: f32 = 0.3;
/// A slower wish is none, m/s.
const WISH_MPS: f32 = 0.15;
/// The cosine from which a change of way costs nothing.
const STRAIGHT: f32 = 0.996;

/// The pace of who runs to no point.
pub(super) const NO_POINT: f32 = -1.0;
/// Nearer than this he is there, metres.
const THERE_M: f32 = 0.25;
/// How far within the rim nobody runs on outwards, metres.
const RIM_CARE_M: f32 = 0.5;

/// A number for each player, in rows.
pub(super) type Lane = [[f32; WIDTH]; ROWS];

/// What a stride takes and changes, by player: a structure of arrays.
pub(super) struct Strides {
    /// Whether anybody is in a row: the others are left alone.
    pub(super) taken: [bool; ROWS],
    /// World metres.
    pub(super) x: Lane,
    /// World metres.
    pub(super) y: Lane,
    /// World m/s.
    pub(super) vx: Lane,
    /// World m/s.
    pub(super) vy: Lane,
    /// The velocity he wants, world m/s; the way to the point that he runs to, metres, where `pace` says so.
    pub(super) want_x: Lane,
    /// The same along y.
    pub(super) want_y: Lane,
    /// How fast he runs to a point at most, m/s; [`NO_POINT`] where he runs to none.
    pub(super) pace: Lane,
    /// His top speed, m/s.
    pub(super) top: Lane,
    /// Ticks spent on getting off a standstill.
    pub(super) lag: Lane,
    /// What agility makes of a turn: about 1.
    pub(super) turn: Lane,
    /// What acceleration makes of a push: about 1.
    pub(super) burst: Lane,
    /// How much he has been pushed lately, metres.
    pub(super) shoved: Lane,
    /// His balance as it counts now.
    pub(super) balance: Lane,
    /// The unit vector he faces.
    pub(super) facing_x: Lane,
    /// The unit vector he faces.
    pub(super) facing_y: Lane,
}

impl Strides {
    /// All at rest, nobody wanting anything.
    pub(super) fn still() -> Strides {
        let zero = [[0.0; WIDTH]; ROWS];
        Strides {
            taken: [false; ROWS],
            x: zero,
            y: zero,
            vx: zero,
            vy: zero,
            want_x: zero,
            want_y: zero,
            pace: [[NO_POINT; WIDTH]; ROWS],
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

    /// The rows that somebody is in.
    fn rows(&self) -> impl Iterator<Item = usize> + use<> {
        let taken = self.taken;
        (0..ROWS).filter(move |row| taken[*row])
    }

    /// Turns the ways to points into velocities that stop there, and wishes back that lead further out than the rim.
    pub(super) fn wish(&mut self) {
        let (none, there) = (f32x4::ZERO, f32x4::splat(THERE_M));
        let rim_x = f32x4::splat(RIM_X_M as f32 - RIM_CARE_M);
        let rim_y = f32x4::splat(RIM_Y_M as f32 - RIM_CARE_M);
        for at in self.rows() {
            let (x, y, pace) = (load(&self.want_x, at), load(&self.want_y, at), load(&self.pace, at));
            let distance = (x * x + y * y).sqrt();
            let scale = (distance * f32x4::splat(ARRIVAL_PER_S)).fast_min(pace) / distance;
            let (runs, is_there) = (pace.simd_ge(none), distance.simd_lt(there));
            let want_x = runs.select(is_there.select(none, x * scale), x);
            let want_y = runs.select(is_there.select(none, y * scale), y);
            let (x, y) = (load(&self.x, at), load(&self.y, at));
            let out_x = x.abs().simd_gt(rim_x) & (want_x * x).simd_gt(none);
            let out_y = y.abs().simd_gt(rim_y) & (want_y * y).simd_gt(none);
            store(&mut self.want_x, at, out_x.select(none, want_x));
            store(&mut self.want_y, at, out_y.select(none, want_y));
        }
    }

    /// Brings every velocity nearer to its wish, as a body can in a tick.
    pub(super) fn steer(&mut self) {
        let is = f32x4::splat;
        let (none, one) = (f32x4::ZERO, f32x4::ONE);
        for at in self.rows() {
            let (vx, vy) = (load(&self.vx, at), load(&self.vy, at));
            let (want_x, want_y) = (load(&self.want_x, at), load(&self.want_y, at));
            let (top, lag) = (load(&self.top, at), load(&self.lag, at));
            let speed = (vx * vx + vy * vy).sqrt();
            let wanted = (want_x * want_x + want_y * want_y).sqrt();
            let wish = wanted.fast_min(top);
            let braked = speed - is(BRAKE_MPS2 * DT);
            // Where he wants to stand: he brakes.
            let (kept, moves) = (braked.fast_max(none) / speed, speed.simd_gt(is(1e-3)));
            let (brake_x, brake_y) = (moves.select(vx * kept, none), moves.select(vy * kept, none));
            // Where he stands: he gets off.
            let (aim_x, aim_y) = (want_x / wanted, want_y / wanted);
            let later = is(9.4) - is(1.8) * (speed - is(2.4)).fast_max(none);
            let early = speed.simd_lt(is(2.0)).select(is(18.0), later.fast_max(is(4.4)).fast_min(is(9.4)));
            let shoved = load(&self.shoved, at) * (is(10.0) - is(5.0) * load(&self.balance, at)) - is(0.1);
            let free = one - shoved.fast_max(none).fast_min(is(0.3));
            let push = early.fast_min(is(3.0) * (top - speed) + is(0.05)) * load(&self.burst, at) * free;
            let pushed = (speed + push * is(DT)).fast_min(wish);
            let waits = lag.simd_lt(is(LAG_TICKS));
            let (off_x, off_y) = (waits.select(vx, aim_x * pushed), waits.select(vy, aim_y * pushed));
            // Where he runs: he leans into an arc and loses speed; about turns brake first.
            let (ahead_x, ahead_y) = (vx / speed, vy / speed);
            let cos = (ahead_x * aim_x + ahead_y * aim_y).fast_max(-one).fast_min(one);
            let sin = ahead_x * aim_y - ahead_y * aim_x;
            let next = speed.simd_lt(wish).select(pushed, braked.fast_max(wish));
            let about = cos.simd_lt(is(-0.5)) & speed.simd_gt(is(2.0));
            let angle = is(TURN_MPS2) * load(&self.turn, at) / speed.fast_max(is(1.2)) * is(DT);
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
            let bends = cos.simd_lt(is(STRAIGHT));
            let way_x = bends.select(about.select(ahead_x, lean_x), aim_x);
            let way_y = bends.select(about.select(ahead_y, lean_y), aim_y);
            let pace = bends.select(about.select(braked, leaning), next).fast_max(none);
            let (rests, stands) = (wish.simd_lt(is(WISH_MPS)), speed.simd_lt(is(STANDS_MPS)));
            let got_off = stands.select((lag + one).fast_min(is(LAG_TICKS)), is(LAG_TICKS));
            store(&mut self.vx, at, rests.select(brake_x, stands.select(off_x, way_x * pace)));
            store(&mut self.vy, at, rests.select(brake_y, stands.select(off_y, way_y * pace)));
            store(&mut self.lag, at, rests.select(none, got_off));
        }
    }

    /// Carries everyone along his velocity, no further than the rim.
    pub(super) fn go(&mut self) {
        let (rim_x, rim_y) = (f32x4::splat(RIM_X_M as f32), f32x4::splat(RIM_Y_M as f32));
        let dt = f32x4::splat(DT);
        for at in self.rows() {
            let x = load(&self.x, at) + load(&self.vx, at) * dt;
            let y = load(&self.y, at) + load(&self.vy, at) * dt;
            store(&mut self.x, at, x.fast_max(-rim_x).fast_min(rim_x));
            store(&mut self.y, at, y.fast_max(-rim_y).fast_min(rim_y));
        }
    }

    /// Turns everyone to where he runs, or to the ball.
    pub(super) fn turn(&mut self, ball_x: f32, ball_y: f32) {
        let little = f32x4::splat(0.12);
        for at in self.rows() {
            let (vx, vy) = (load(&self.vx, at), load(&self.vy, at));
            let (ball_x, ball_y) = (f32x4::splat(ball_x) - load(&self.x, at), f32x4::splat(ball_y) - load(&self.y, at));
            let runs = (vx * vx + vy * vy).simd_gt(f32x4::ONE);
            let (towards_x, towards_y) = unit(runs.select(vx, ball_x), runs.select(vy, ball_y));
            let (facing_x, facing_y) = (load(&self.facing_x, at), load(&self.facing_y, at));
            let (mixed_x, mixed_y) = (facing_x + towards_x * little, facing_y + towards_y * little);
            let length = (mixed_x * mixed_x + mixed_y * mixed_y).sqrt();
            let turns = length.simd_gt(f32x4::splat(0.05));
            store(&mut self.facing_x, at, turns.select(mixed_x / length, facing_x));
            store(&mut self.facing_y, at, turns.select(mixed_y / length, facing_y));
        }
    }
}

/// The four of a lane in a row.
fn load(lane: &Lane, row: usize) -> f32x4 {
    f32x4::new(lane[row])
}

/// Puts four back into a lane.
fn store(lane: &mut Lane, row: usize, four: f32x4) {
    lane[row] = four.to_array();
}

/// The unit vector along (x, y); zero where there is none.
fn unit(x: f32x4, y: f32x4) -> (f32x4, f32x4) {
    let scale = f32x4::ONE / (x * x + y * y).sqrt();
    let is_one = scale.simd_lt(f32x4::splat(f32::INFINITY)) & scale.simd_gt(f32x4::ZERO);
    (is_one.select(x * scale, f32x4::ZERO), is_one.select(y * scale, f32x4::ZERO))
}
