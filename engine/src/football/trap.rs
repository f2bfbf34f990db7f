//! Traps: the motions in which a player takes down a free ball that is too fast or too high for a
//! touch of a dribble.

use crate::football::dribble_motion::{self, DribbleMotion, MotionEnd, motion};
use crate::football::pace::{DRIBBLES_FROM_MPS, SPRINTS_FROM_MPS, WALKS_FROM_MPS};
use crate::football::reach;
use crate::math;
use crate::state::{Match, Player, PlayerId};

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

const fn trap(
    course_degrees: f32,
    within_degrees: f32,
    end: TrapEnd,
    motion: DribbleMotion,
) -> Trap {
    Trap { motion, course_degrees, within_degrees, end }
}

const ABOUT_DEG: f32 = 180.0;
const RUNS: f32 = DRIBBLES_FROM_MPS;
const SPRINTS: f32 = SPRINTS_FROM_MPS;

/// The traps, those of the fastest gait first.
const TRAPS: [Trap; 24] = [
    trap(
        90.0,
        45.0,
        TrapEnd::Runs,
        motion(SPRINTS, ABOUT_DEG, [14, 24], MotionEnd::On, 0.52, [1.0, 0.76], [2.2, 0.5])
            .at(0.05, 0.11),
    ),
    trap(
        180.0,
        90.0,
        TrapEnd::Runs,
        motion(SPRINTS, ABOUT_DEG, [35, 55], MotionEnd::On, 0.2, [1.0, 0.83], [2.2, 0.6])
            .at(0.0, 1.34),
    ),
    trap(
        79.0,
        54.0,
        TrapEnd::Runs,
        motion(SPRINTS, ABOUT_DEG, [17, 44], MotionEnd::On, 0.95, [1.0, 0.73], [2.2, 0.44])
            .at(0.05, 0.65),
    ),
    trap(
        180.0,
        45.0,
        TrapEnd::Stops,
        motion(RUNS, ABOUT_DEG, [28, 46], MotionEnd::Braked(0.7), 0.5, [0.73, 0.4], [0.93, 0.1])
            .at(0.13, 0.11),
    ),
    trap(
        90.0,
        45.0,
        TrapEnd::Stops,
        motion(RUNS, ABOUT_DEG, [33, 56], MotionEnd::Braked(0.3), 0.53, [1.24, 0.4], [1.46, 0.1])
            .at(-0.01, 0.11),
    ),
    trap(
        90.0,
        45.0,
        TrapEnd::Stops,
        motion(RUNS, ABOUT_DEG, [34, 64], MotionEnd::Braked(0.3), 0.31, [1.54, 0.4], [1.36, 0.1])
            .at(-0.02, 0.11),
    ),
    trap(
        45.0,
        45.0,
        TrapEnd::Stops,
        motion(RUNS, ABOUT_DEG, [36, 53], MotionEnd::Braked(0.8), -0.09, [1.51, 0.4], [1.48, 0.1])
            .at(-0.21, 0.11),
    ),
    trap(
        180.0,
        45.0,
        TrapEnd::Runs,
        motion(RUNS, ABOUT_DEG, [12, 25], MotionEnd::On, 0.46, [0.8, 0.84], [1.2, 0.6])
            .at(-0.07, 0.11),
    ),
    trap(
        90.0,
        45.0,
        TrapEnd::Runs,
        motion(RUNS, ABOUT_DEG, [33, 48], MotionEnd::On, 0.6, [0.56, 0.7], [1.2, 0.5])
            .at(0.0, 0.11),
    ),
    trap(
        90.0,
        45.0,
        TrapEnd::Runs,
        motion(RUNS, ABOUT_DEG, [24, 48], MotionEnd::On, 0.07, [0.54, 0.7], [0.94, 0.5])
            .at(-0.15, 0.11),
    ),
    trap(
        45.0,
        22.5,
        TrapEnd::Runs,
        motion(RUNS, ABOUT_DEG, [44, 66], MotionEnd::On, -0.25, [0.86, 0.7], [0.63, 0.5])
            .at(-0.31, 0.11),
    ),
    trap(
        141.0,
        90.0,
        TrapEnd::Stops,
        motion(RUNS, ABOUT_DEG, [19, 50], MotionEnd::Braked(0.8), 0.18, [2.0, 0.5], [1.97, 0.2])
            .at(-0.03, 1.44),
    ),
    trap(
        180.0,
        126.0,
        TrapEnd::Runs,
        motion(RUNS, ABOUT_DEG, [25, 41], MotionEnd::On, 0.42, [0.8, 0.84], [1.7, 0.6])
            .at(0.0, 1.13),
    ),
    trap(
        180.0,
        126.0,
        TrapEnd::Runs,
        motion(RUNS, ABOUT_DEG, [12, 25], MotionEnd::On, 0.43, [0.8, 0.84], [1.9, 0.6])
            .at(-0.03, 0.81),
    ),
    trap(
        0.0,
        144.0,
        TrapEnd::Any,
        motion(RUNS, ABOUT_DEG, [30, 51], MotionEnd::Braked(3.0), 0.8, [1.0, 0.5], [1.4, 0.3])
            .at(0.03, 0.52),
    ),
    trap(
        90.0,
        90.0,
        TrapEnd::Runs,
        motion(RUNS, ABOUT_DEG, [24, 50], MotionEnd::On, 0.16, [0.7, 0.84], [1.9, 0.6])
            .at(-0.27, 1.21),
    ),
    trap(
        126.0,
        90.0,
        TrapEnd::Any,
        motion(RUNS, ABOUT_DEG, [47, 73], MotionEnd::Braked(3.5), 0.18, [0.9, 0.8], [2.0, 0.5])
            .at(-0.21, 1.3),
    ),
    trap(
        180.0,
        45.0,
        TrapEnd::Stops,
        motion(0.0, ABOUT_DEG, [20, 42], MotionEnd::Braked(0.0), 0.2, [0.0, 0.0], [0.0, 0.0])
            .at(-0.12, 0.11),
    ),
    trap(
        180.0,
        45.0,
        TrapEnd::Runs,
        motion(0.0, ABOUT_DEG, [12, 32], MotionEnd::Turned(3.5), 0.08, [0.0, 0.0], [0.5, 0.0])
            .at(-0.13, 0.11),
    ),
    trap(
        180.0,
        45.0,
        TrapEnd::Runs,
        motion(0.0, ABOUT_DEG, [14, 42], MotionEnd::Turned(3.1), 0.08, [0.0, 0.0], [0.5, 0.0])
            .at(-0.24, 0.11),
    ),
    trap(
        180.0,
        90.0,
        TrapEnd::Runs,
        motion(0.0, ABOUT_DEG, [11, 33], MotionEnd::On, 0.48, [0.8, 0.0], [1.5, 0.0])
            .at(-0.13, 0.78),
    ),
    trap(
        180.0,
        90.0,
        TrapEnd::Runs,
        motion(0.0, ABOUT_DEG, [15, 34], MotionEnd::Braked(0.0), 0.21, [-0.1, 0.0], [0.0, 0.0])
            .at(0.0, 0.89),
    ),
    trap(
        180.0,
        90.0,
        TrapEnd::Runs,
        motion(0.0, ABOUT_DEG, [39, 67], MotionEnd::Braked(0.0), 0.28, [-0.4, 0.0], [0.0, 0.0])
            .at(0.01, 1.23),
    ),
    trap(
        180.0,
        90.0,
        TrapEnd::Runs,
        motion(0.0, ABOUT_DEG, [51, 95], MotionEnd::Braked(0.0), 0.21, [-0.4, 0.0], [0.0, 0.0])
            .at(-0.04, 1.57),
    ),
];
/// A ball that is expected to be slower isn't trapped, m/s. (GRF's.)
const ROLLS_MPS: f32 = 2.0;
/// Between which ticks from now the ball's course is seen. (GRF's.)
const COURSE_TICKS: [u32; 2] = [12, 18];
/// Up to this cosine a player wants to run on.
const ON_COS: f32 = 0.38;
/// The sides to which a motion is made.
const SIDES: [f32; 2] = [1.0, -1.0];

/// The first trap that meets the free ball.
pub(super) fn find(game: &Match, id: PlayerId) -> Option<&'static DribbleMotion> {
    let player = game.player(id);
    let run = dribble_motion::run(player);
    let [from, to] = COURSE_TICKS.map(|ticks| reach::expected(game, id, ticks).truncate());
    let course = to - from;
    if course.length() < ROLLS_MPS * 0.01 * (COURSE_TICKS[1] - COURSE_TICKS[0]) as f32 {
        return None;
    }
    let course = math::atan2(run.perp_dot(course), run.dot(course)).to_degrees();
    let wish = player.body.dribble;
    let runs = wish.length_squared() > WALKS_FROM_MPS * WALKS_FROM_MPS
        && run.dot(wish) > ON_COS * wish.length();
    let other = if runs { TrapEnd::Stops } else { TrapEnd::Runs };
    let traps = TRAPS.iter().filter(|trap| suits(player, trap) && trap.end != other);
    traps.into_iter().find_map(|trap| {
        let comes = |side: f32| {
            let off = math::wrap((course - side * trap.course_degrees).to_radians()).to_degrees();
            off.abs() <= trap.within_degrees && trap.motion.fits(game, id, side)
        };
        SIDES.into_iter().any(comes).then_some(&trap.motion)
    })
}

/// Whether a trap is of a player's gait. Sprinters may brake for those of a walk.
fn suits(player: &Player, trap: &Trap) -> bool {
    let pace = player.vel.length();
    let from = trap.motion.from_mps;
    if pace < DRIBBLES_FROM_MPS { from == 0.0 } else { from > 0.0 && pace >= from }
}
