//! Traps: the motions in which a player takes down a free ball that is too fast or too high for a
//! touch of a dribble.

use crate::football::dribble_motion::MotionEnd::{self, Braked, On, Turned};
use crate::football::dribble_motion::{self, DribbleMotion, motion};
use crate::football::pace::{DRIBBLES_FROM_MPS, SPRINTS_FROM_MPS, WALKS_FROM_MPS};
use crate::state::{Match, PlayerId};
use TrapEnd::{Any, Runs, Stops};

/// A motion for a ball that comes from one side. (GRF's motions.)
struct Trap {
    motion: DribbleMotion,
    /// The angle from the run to the ball's course, degrees: 180 head-on, 90 from the other side.
    course_degrees: f32,
    /// How far the course may be off that, degrees.
    within_degrees: f32,
    /// What the player does who traps.
    end: TrapEnd,
}

/// What a player wants who traps a ball.
#[derive(Clone, Copy, PartialEq, Eq)]
enum TrapEnd {
    /// To run on with it.
    Runs,
    /// To stand, or to go another way.
    Stops,
    /// Either.
    Any,
}

/// `course`: the angle from the run to the ball's course, and how far it may be off that, degrees.
/// `ball_m`: where the ball is at the touch, metres ahead, aside and up. `speeds`: the mean until
/// the touch, and then, m/s, each as a base and a share of the pace.
const fn trap(
    [course_degrees, within_degrees]: [f32; 2],
    end: TrapEnd,
    ticks: [i32; 2],
    out: MotionEnd,
    [ahead_m, aside_m, high_m]: [f32; 3],
    [mean, mean_share, then, then_share]: [f32; 4],
) -> Trap {
    let motion =
        motion(0.0, ABOUT_DEG, ticks, out, ahead_m, [mean, mean_share], [then, then_share])
            .at(aside_m, high_m);
    Trap { motion, course_degrees, within_degrees, end }
}

const ABOUT_DEG: f32 = 180.0;

// GRF's motions. The shares of the pace are those of the dribble's motions that are like them.

/// The traps of a sprinter, who may also brake for those of a runner.
const SPRINTING: [Trap; 3] = [
    trap([90.0, 45.0], Runs, [14, 24], On, [0.52, 0.05, 0.11], [1.0, 0.76, 2.2, 0.5]),
    trap([180.0, 90.0], Runs, [35, 55], On, [0.2, 0.0, 1.34], [1.0, 0.83, 2.2, 0.6]),
    trap([79.0, 54.0], Runs, [17, 44], On, [0.95, 0.05, 0.65], [1.0, 0.73, 2.2, 0.44]),
];
/// The traps of whoever walks or runs.
const RUNNING: [Trap; 14] = [
    trap([180.0, 45.0], Stops, [28, 46], Braked(0.7), [0.5, 0.13, 0.11], [0.73, 0.4, 0.93, 0.1]),
    trap([90.0, 45.0], Stops, [33, 56], Braked(0.3), [0.53, -0.01, 0.11], [1.24, 0.4, 1.46, 0.1]),
    trap([90.0, 45.0], Stops, [34, 64], Braked(0.3), [0.31, -0.02, 0.11], [1.54, 0.4, 1.36, 0.1]),
    trap([45.0, 45.0], Stops, [36, 53], Braked(0.8), [-0.09, -0.21, 0.11], [1.51, 0.4, 1.48, 0.1]),
    trap([180.0, 45.0], Runs, [12, 25], On, [0.46, -0.07, 0.11], [0.8, 0.84, 1.2, 0.6]),
    trap([90.0, 45.0], Runs, [33, 48], On, [0.6, 0.0, 0.11], [0.56, 0.7, 1.2, 0.5]),
    trap([90.0, 45.0], Runs, [24, 48], On, [0.07, -0.15, 0.11], [0.54, 0.7, 0.94, 0.5]),
    trap([45.0, 22.5], Runs, [44, 66], On, [-0.25, -0.31, 0.11], [0.86, 0.7, 0.63, 0.5]),
    trap([141.0, 90.0], Stops, [19, 50], Braked(0.8), [0.18, -0.03, 1.44], [2.0, 0.5, 1.97, 0.2]),
    trap([180.0, 126.0], Runs, [25, 41], On, [0.42, 0.0, 1.13], [0.8, 0.84, 1.7, 0.6]),
    trap([180.0, 126.0], Runs, [12, 25], On, [0.43, -0.03, 0.81], [0.8, 0.84, 1.9, 0.6]),
    trap([0.0, 144.0], Any, [30, 51], Braked(3.0), [0.8, 0.03, 0.52], [1.0, 0.5, 1.4, 0.3]),
    trap([90.0, 90.0], Runs, [24, 50], On, [0.16, -0.27, 1.21], [0.7, 0.84, 1.9, 0.6]),
    trap([126.0, 90.0], Any, [47, 73], Braked(3.5), [0.18, -0.21, 1.3], [0.9, 0.8, 2.0, 0.5]),
];
/// The traps of whoever stands.
const STANDING: [Trap; 7] = [
    trap([180.0, 45.0], Stops, [20, 42], Braked(0.0), [0.2, -0.12, 0.11], [0.0, 0.0, 0.0, 0.0]),
    trap([180.0, 45.0], Runs, [12, 32], Turned(3.5), [0.08, -0.13, 0.11], [0.0, 0.0, 0.5, 0.0]),
    trap([180.0, 45.0], Runs, [14, 42], Turned(3.1), [0.08, -0.24, 0.11], [0.0, 0.0, 0.5, 0.0]),
    trap([180.0, 90.0], Runs, [11, 33], On, [0.48, -0.13, 0.78], [0.8, 0.0, 1.5, 0.0]),
    trap([180.0, 90.0], Runs, [15, 34], Braked(0.0), [0.21, 0.0, 0.89], [-0.1, 0.0, 0.0, 0.0]),
    trap([180.0, 90.0], Runs, [39, 67], Braked(0.0), [0.28, 0.01, 1.23], [-0.4, 0.0, 0.0, 0.0]),
    trap([180.0, 90.0], Runs, [51, 95], Braked(0.0), [0.21, -0.04, 1.57], [-0.4, 0.0, 0.0, 0.0]),
];
/// A ball counts as bouncy that is so high, metres, now or in `SOON_TICKS`, or rises or falls so
/// fast, m/s. (GRF's.)
const HIGH_M: f32 = 0.3;
const SOON_TICKS: u32 = 8;
const BOUNCES_MPS: f32 = 1.0;
/// Up to this cosine a player wants to run on.
const ON_COS: f32 = 0.38;

/// The first trap that meets the ball.
pub(super) fn find(game: &Match, id: PlayerId) -> Option<&'static DribbleMotion> {
    let player = game.player(id);
    let course = dribble_motion::course(game, id)?;
    let (run, wish) = (dribble_motion::run(player), dribble_motion::asks(game, id));
    let runs = wish.length_squared() > WALKS_FROM_MPS * WALKS_FROM_MPS
        && run.dot(wish) > ON_COS * wish.length();
    let other = if runs { Stops } else { Runs };
    let any = is_bouncy(game);
    let reach = dribble_motion::reach(game, id);
    let meets = |trap: &&Trap| {
        let made_for = [trap.course_degrees, trap.within_degrees];
        (any || trap.end != other) && trap.motion.meets(game, id, course, made_for, reach)
    };
    of_gait(player.vel.length()).into_iter().flatten().find(meets).map(|trap| &trap.motion)
}

/// Whether the ball is so high, or bounces so much, that players take it as they can. (GRF's.)
fn is_bouncy(game: &Match) -> bool {
    let high = |ticks| game.play.forecast.at(game.tick + ticks).z > HIGH_M;
    high(1) || high(SOON_TICKS) || game.ball.vel.z.abs() > BOUNCES_MPS
}

/// The traps of a pace, in the order in which they are tried.
fn of_gait(pace: f32) -> [&'static [Trap]; 2] {
    if pace < DRIBBLES_FROM_MPS {
        [&STANDING, &[]]
    } else if pace < SPRINTS_FROM_MPS {
        [&RUNNING, &[]]
    } else {
        [&SPRINTING, &RUNNING]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_gait_can_stop_and_run_on() {
        for pace in [0.0, 5.0, 7.5] {
            for end in [Stops, Runs] {
                let found = of_gait(pace).into_iter().flatten().any(|trap| trap.end == end);
                assert!(found, "at {pace} m/s");
            }
        }
    }
}
