//! Pokes: the motions in which a leg goes out to knock the ball away from a rival.

use crate::football::dribble_motion::MotionEnd::{self, Braked};
use crate::football::dribble_motion::{self, DribbleMotion, motion};
use crate::football::leg;
use crate::football::pace::{DRIBBLES_FROM_MPS, SPRINTS_FROM_MPS};
use crate::state::{Match, PlayerId};

/// A motion for a ball that comes from one side. (GRF's motions.)
struct Poke {
    motion: DribbleMotion,
    /// The angle from the run to the ball's course, degrees.
    course_degrees: f32,
}

/// Like [`super::trap`]'s.
const fn poke(
    course_degrees: f32,
    ticks: [i32; 2],
    out: MotionEnd,
    [ahead_m, aside_m, high_m]: [f32; 3],
    [mean, mean_share, then, then_share]: [f32; 4],
) -> Poke {
    let motion = motion(0.0, 180.0, ticks, out, ahead_m, [mean, mean_share], [then, then_share])
        .at(aside_m, high_m);
    Poke { motion, course_degrees }
}

/// The pokes of whoever stands: ahead, aside, and with the head.
const STANDING: [Poke; 3] = [
    poke(169.0, [11, 28], Braked(0.9), [0.88, 0.1, 0.11], [0.8, 0.66, 0.9, 0.8]),
    poke(169.0, [15, 35], Braked(0.5), [0.09, 1.25, 0.11], [0.0, 0.0, 0.5, 0.0]),
    poke(169.0, [43, 93], Braked(0.4), [0.64, -0.07, 1.8], [1.0, 0.6, 1.2, 0.4]),
];
/// Those of a runner who runs on: a stretched leg; and of one who doesn't: back to the side.
const RUNNING: [Poke; 1] =
    [poke(68.0, [9, 26], Braked(3.5), [0.81, 0.05, 0.11], [1.0, 0.91, 1.0, 0.67])];
const TURNING: [Poke; 1] =
    [poke(122.0, [24, 58], Braked(2.2), [-0.55, -0.65, 0.11], [1.0, 0.41, 1.0, 0.17])];
/// The same for a sprinter: at full stretch, and with the head.
const SPRINTING: [Poke; 1] =
    [poke(58.0, [12, 39], Braked(5.0), [0.91, -0.14, 0.11], [0.0, 1.0, 1.8, 0.72])];
const STOPPING: [Poke; 1] =
    [poke(169.0, [25, 66], Braked(1.0), [0.51, -0.1, 1.78], [0.0, 0.63, 1.0, 0.4])];
/// How far off a motion's the ball's course may be, degrees. (GRF's.)
const WITHIN_DEG: f32 = 45.0;
/// Up to this cosine a player wants to run on.
const ON_COS: f32 = 0.92;

/// The first poke that meets the ball.
pub(super) fn find(game: &Match, id: PlayerId) -> Option<&'static DribbleMotion> {
    let player = game.player(id);
    let course = dribble_motion::course(game, id)?;
    let meets = |poke: &&Poke| {
        poke.motion.meets(game, id, course, [poke.course_degrees, WITHIN_DEG], leg::POKE)
    };
    let (run, wish) = (dribble_motion::run(player), player.body.dribble);
    let on = wish.length() > DRIBBLES_FROM_MPS && run.dot(wish) > ON_COS * wish.length();
    of_gait(player.vel.length(), on).iter().find(meets).map(|poke| &poke.motion)
}

/// The pokes of a pace, for a player who runs on or doesn't.
fn of_gait(pace: f32, on: bool) -> &'static [Poke] {
    if pace < DRIBBLES_FROM_MPS {
        &STANDING
    } else if pace < SPRINTS_FROM_MPS {
        if on { &RUNNING } else { &TURNING }
    } else if on {
        &SPRINTING
    } else {
        &STOPPING
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_gait_has_a_poke_for_who_runs_on_and_who_does_not() {
        for pace in [0.0, 4.0, 7.5] {
            for on in [false, true] {
                assert!(!of_gait(pace, on).is_empty(), "at {pace} m/s");
            }
        }
        let ahead = |pace, on| of_gait(pace, on).iter().all(|poke| poke.course_degrees > 100.0);
        assert!(!ahead(7.5, true) && ahead(4.0, false), "who turns pokes what comes from ahead");
    }
}
