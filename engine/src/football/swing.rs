//! The swings of kicks: how long they last, where they meet the ball, and what becomes of the run.
//!
//! A kick takes the first swing that leads its way and meets the ball; of a gait, those for the
//! foot that leads now come first. (Measured of GRF's motions.)

use crate::football::leg::{self, KICK, MotionTouch};
use crate::football::pace::{DRIBBLES_FROM_MPS, SPRINTS_FROM_MPS, WALKS_FROM_MPS};
use crate::football::{foot, reach};
use crate::math;
use crate::state::player::{KickKind, Stroke};
use crate::state::{Match, Player, PlayerId};
use glam::{Vec2, Vec3};

/// A swing.
pub(super) struct SwingMotion {
    /// Its kick goes this far to one side of the run, and as much to either side of that, degrees.
    to_degrees: f32,
    within_degrees: f32,
    /// Ticks until the foot meets the ball.
    pub(super) ticks: i32,
    /// Where the ball is then, metres from the body: along the run, to the kick's side, and up.
    ball_m: [f32; 3],
    /// How fast the player is on average until then, and then, m/s: base and share of their
    /// pace.
    mean: [f32; 2],
    end: [f32; 2],
    /// How fast the player comes out of it, m/s.
    out_mps: f32,
    /// Whether the foot away from the kick's side leads, not that of its side.
    crosses: bool,
    /// The share of their strength that a player can put into it, and how hard it is, both 0..1.
    power: f32,
    hard: f32,
    /// How fast its body counts as at the contact of a shot, m/s, whoever plays it, and how far it
    /// is then turned from the run to the kick's side, degrees. (GRF's: of the motion it is made
    /// from, whose turn counts twice.)
    body: [f32; 2],
}

impl SwingMotion {
    /// How far a player at this pace runs until the contact, metres.
    pub(super) fn way_m(&self, pace: f32) -> f32 {
        ((self.mean[0] + self.mean[1] * pace) * self.ticks as f32 * 0.01).max(0.0)
    }

    /// How fast a player at this pace is at the contact, m/s.
    pub(super) fn end_mps(&self, pace: f32) -> f32 {
        self.end[0] + self.end[1] * pace
    }
}

/// A swing at a ball on the grass, for which the foot of the kick's side leads.
const fn swing(
    [to_degrees, within_degrees]: [f32; 2],
    ticks: i32,
    [ahead_m, aside_m]: [f32; 2],
    mean: [f32; 2],
    end: [f32; 2],
    out_mps: f32,
) -> SwingMotion {
    let ball_m = [ahead_m, aside_m, 0.1];
    SwingMotion {
        to_degrees,
        within_degrees,
        ticks,
        ball_m,
        mean,
        end,
        out_mps,
        crosses: false,
        power: 1.0,
        hard: 0.0,
        body: [0.0; 2],
    }
}

/// A header.
const fn head(
    to: [f32; 2],
    ticks: i32,
    [ahead_m, aside_m, high_m]: [f32; 3],
    mean: [f32; 2],
    end_mps: f32,
    out_mps: f32,
) -> SwingMotion {
    swing(to, ticks, [ahead_m, aside_m], mean, [end_mps, 0.0], out_mps).at_height(high_m)
}

impl SwingMotion {
    /// The same at a ball in the air.
    const fn at_height(mut self, high_m: f32) -> SwingMotion {
        self.ball_m[2] = high_m;
        self
    }

    /// The same with the other foot in front.
    const fn crossed(mut self) -> SwingMotion {
        self.crosses = true;
        self
    }

    /// The same with this share of the player's power, and this hard.
    const fn limited(mut self, power: f32, hard: f32) -> SwingMotion {
        (self.power, self.hard) = (power, hard);
        self
    }

    /// The same for shots, with a body that moves like this.
    const fn moving(mut self, mps: f32, turned_degrees: f32) -> SwingMotion {
        self.body = [mps, turned_degrees];
        self
    }
}

/// The swings of a kind by the gait that they begin at: standing, dribbling, walking, sprinting.
type ByGait = [&'static [SwingMotion]; 4];

const SHOTS: ByGait = [
    &[
        swing([11.0, 45.0], 25, [0.45, -0.16], [1.88, 0.0], [1.4, 0.0], 0.3)
            .limited(0.7, 0.0)
            .moving(1.42, 0.0),
        swing([90.0, 45.0], 24, [0.67, 0.0], [0.0, 0.0], [0.0, 0.0], 0.9).limited(0.7, 0.0),
        swing([169.0, 45.0], 36, [-0.06, -0.06], [1.0, 0.0], [1.8, 0.0], 0.7)
            .limited(0.7, 0.0)
            .moving(1.72, 0.0),
    ],
    &[swing([90.0, 45.0], 29, [1.02, 0.0], [2.63, 0.2], [1.8, 0.0], 0.8)
        .at_height(0.73)
        .moving(1.84, 0.0)],
    &[
        swing([11.0, 45.0], 15, [0.22, -0.33], [0.53, 0.92], [2.28, 0.5], 3.4).moving(4.99, 0.0),
        swing([11.0, 45.0], 23, [0.22, -0.33], [2.14, 0.61], [4.8, 0.0], 3.3).moving(5.0, 0.0),
        swing([90.0, 45.0], 28, [0.83, 0.0], [1.45, 0.77], [2.05, 0.27], 0.7).moving(2.62, -29.0),
        swing([169.0, 45.0], 36, [-0.06, -0.06], [2.38, 0.28], [1.8, 0.0], 0.7)
            .crossed()
            .limited(0.7, 0.0)
            .moving(1.72, 0.0),
        head([22.0, 45.0], 33, [0.52, 0.3, 1.64], [1.0, 0.8], 4.83, 3.5)
            .limited(0.2, 0.0)
            .moving(4.83, 0.0),
    ],
    &[
        swing([11.0, 45.0], 15, [0.22, -0.28], [2.25, 0.69], [4.36, 0.23], 3.4).moving(6.0, 0.0),
        swing([11.0, 45.0], 24, [0.22, -0.33], [2.96, 0.51], [4.06, 0.11], 3.4).moving(4.44, 0.0),
        swing([31.0, 45.0], 26, [0.02, 0.64], [2.75, 0.51], [4.6, 0.0], 4.1)
            .crossed()
            .moving(4.54, 16.2),
        swing([25.0, 45.0], 17, [0.54, -0.14], [2.48, 0.65], [4.1, 0.27], 3.4).moving(4.46, 13.4),
        swing([80.0, 45.0], 29, [0.77, 0.0], [1.46, 0.77], [2.35, 0.19], 1.3).moving(2.77, -29.0),
        head([0.0, 45.0], 32, [0.98, 0.0, 1.05], [4.5, 0.6], 7.8, 0.5)
            .limited(0.3, 0.0)
            .moving(7.81, 0.0),
    ],
];
const PASSES: ByGait = [
    &[
        swing([22.0, 23.0], 35, [0.37, 0.03], [0.0, 0.0], [0.3, 0.0], 0.4).limited(0.8, 0.0),
        swing([90.0, 45.0], 31, [0.26, 0.17], [0.0, 0.0], [0.3, 0.0], 0.6).limited(0.7, 0.0),
        swing([90.0, 45.0], 30, [0.69, 0.05], [0.0, 0.0], [0.5, 0.0], 0.4)
            .at_height(0.36)
            .limited(0.7, 0.3),
        head([0.0, 45.0], 25, [0.44, 0.0, 1.65], [-0.2, 0.0], 0.0, 0.3).limited(0.4, 0.2),
        head([90.0, 45.0], 21, [0.19, 0.26, 1.65], [0.0, 0.0], 0.0, 0.3).limited(0.4, 0.2),
        head([0.0, 45.0], 37, [0.44, 0.03, 1.87], [-0.5, 0.0], -1.0, 0.3).limited(0.4, 0.3),
        head([11.0, 45.0], 43, [0.64, 0.07, 1.8], [1.3, 0.0], 1.4, 0.3).limited(0.5, 0.4),
        head([68.0, 45.0], 49, [0.28, 0.19, 1.88], [-0.3, 0.0], -1.0, 0.3).limited(0.4, 0.3),
        head([135.0, 45.0], 37, [-0.04, 0.26, 1.89], [-0.5, 0.0], -0.8, 0.3).limited(0.3, 0.5),
        swing([180.0, 45.0], 39, [0.0, 0.05], [0.72, 0.0], [1.3, 0.0], 0.8).limited(0.4, 0.4),
    ],
    &[
        swing([90.0, 45.0], 31, [0.95, 0.05], [2.69, 0.16], [2.5, 0.0], 0.6)
            .at_height(0.44)
            .limited(0.8, 0.5),
        swing([180.0, 23.0], 38, [-0.28, 0.18], [-0.92, 0.83], [1.73, 0.05], 0.8).limited(0.5, 0.6),
    ],
    &[
        swing([22.0, 23.0], 27, [0.33, -0.16], [1.78, 0.59], [1.87, 0.25], 2.9),
        swing([22.0, 23.0], 10, [0.42, 0.0], [0.77, 0.95], [1.85, 0.65], 3.6)
            .crossed()
            .limited(0.8, 0.0),
        swing([0.0, 45.0], 16, [0.68, 0.03], [2.33, 0.57], [3.89, 0.13], 3.3)
            .at_height(0.41)
            .limited(1.0, 0.6),
        swing([45.0, 23.0], 27, [0.36, -0.03], [1.6, 0.62], [1.79, 0.27], 4.4).limited(0.9, 0.0),
        swing([90.0, 23.0], 35, [0.18, 0.02], [2.73, 0.29], [3.6, 0.0], 3.4).limited(0.7, 0.2),
        swing([90.0, 23.0], 10, [0.26, 0.1], [0.96, 0.88], [1.84, 0.55], 3.4)
            .crossed()
            .limited(0.5, 0.3),
        swing([135.0, 23.0], 36, [0.05, 0.0], [2.7, 0.3], [3.0, 0.0], 2.0)
            .crossed()
            .limited(0.6, 0.4),
        head([0.0, 45.0], 13, [0.44, 0.19, 1.58], [0.8, 0.84], 3.7, 3.4).limited(0.5, 0.4),
        head([90.0, 45.0], 21, [0.05, 0.33, 1.74], [1.0, 0.75], 3.7, 3.4).limited(0.3, 0.7),
    ],
    &[
        swing([22.0, 23.0], 27, [0.32, -0.16], [3.28, 0.47], [4.61, 0.08], 5.0),
        swing([45.0, 23.0], 27, [0.36, -0.03], [3.43, 0.44], [5.15, 0.05], 5.3).limited(0.9, 0.0),
        swing([31.0, 18.0], 26, [0.03, 0.55], [2.46, 0.54], [4.6, 0.0], 4.1)
            .crossed()
            .limited(0.7, 0.1),
        swing([90.0, 23.0], 35, [0.3, 0.04], [2.82, 0.47], [4.4, 0.0], 3.4).limited(0.7, 0.2),
        swing([180.0, 45.0], 36, [-0.08, 0.03], [2.92, 0.55], [5.13, 0.08], 3.2).limited(0.3, 0.7),
        head([11.0, 45.0], 25, [0.51, 0.1, 1.78], [1.5, 0.7], 3.8, 3.0).limited(0.5, 0.4),
    ],
];
const LOFTS: ByGait = [
    &[
        swing([0.0, 45.0], 57, [0.62, 0.09], [2.4, 0.0], [2.65, 0.0], 0.5),
        swing([11.0, 45.0], 25, [0.34, -0.13], [1.88, 0.0], [1.4, 0.0], 0.3),
        swing([90.0, 45.0], 34, [0.41, 0.18], [0.0, 0.0], [0.1, 0.0], 0.6),
        swing([169.0, 45.0], 36, [-0.06, -0.09], [1.0, 0.0], [1.5, 0.0], 0.7),
    ],
    &[swing([0.0, 45.0], 27, [0.61, 0.09], [-1.18, 0.99], [0.35, 0.45], 1.1)],
    &[
        swing([0.0, 45.0], 12, [0.62, 0.07], [0.95, 0.9], [1.12, 0.71], 3.3),
        swing([0.0, 45.0], 41, [0.29, 0.1], [3.36, 0.33], [3.4, 0.0], 3.3),
        swing([84.0, 45.0], 14, [0.6, 0.0], [0.69, 0.89], [1.1, 0.65], 3.0).crossed(),
        swing([90.0, 45.0], 29, [0.79, 0.0], [1.35, 0.58], [1.12, 0.24], 0.4),
        swing([169.0, 45.0], 36, [-0.06, -0.09], [1.39, 0.54], [1.46, 0.08], 0.7)
            .crossed()
            .limited(0.7, 0.0),
        swing([39.0, 45.0], 24, [0.13, -1.06], [2.02, 0.44], [2.3, 0.0], 3.6).at_height(0.95),
    ],
    &[
        swing([90.0, 45.0], 30, [0.45, 0.06], [2.38, 0.63], [4.31, 0.15], 2.5),
        swing([90.0, 45.0], 16, [0.82, 0.06], [1.53, 0.83], [3.1, 0.49], 5.0).crossed(),
    ],
];
/// The gait of a player who stands: either foot may lead.
const STANDING: usize = 0;
/// The sides to which a swing goes.
const RIGHT: f32 = 1.0;
const LEFT: f32 = -1.0;
/// In which order a player at a gait tries the swings of the others.
const ORDER: [&[usize]; 4] = [&[0], &[1, 2, 3], &[2, 1, 3], &[3, 2, 1]];
/// The swings of a kind.
fn of(kind: KickKind) -> &'static ByGait {
    match kind {
        KickKind::Short | KickKind::Long => &PASSES,
        KickKind::High | KickKind::Clear => &LOFTS,
        KickKind::Shot => &SHOTS,
    }
}

/// The swing that a player chooses for a kick.
pub(super) struct ChosenSwing {
    pub(super) motion: &'static SwingMotion,
    /// Where it meets the ball, world metres.
    pub(super) place: Vec3,
    pub(super) stroke: Stroke,
}

/// How a player stands to a kick.
struct Stance {
    pace: f32,
    /// The index of their gait in [`ByGait`].
    gait: usize,
    /// The way of their run, or where they face if they stand.
    run: Vec2,
    /// The angle from there to the kick's way, degrees, positive to the right.
    turn: f32,
}

impl Stance {
    fn of(player: &Player, way: Vec2) -> Stance {
        let pace = player.vel.length();
        let gait = [DRIBBLES_FROM_MPS, WALKS_FROM_MPS, SPRINTS_FROM_MPS]
            .iter()
            .filter(|from| pace >= **from)
            .count();
        let run = if gait == STANDING { player.body.facing } else { player.vel / pace };
        let turn = math::atan2(run.perp_dot(way), run.dot(way)).to_degrees();
        Stance { pace, gait, run, turn }
    }

    /// Whether a swing to one side leads the kick's way.
    fn leads(&self, swing: &SwingMotion, side: f32) -> bool {
        let off = math::wrap((self.turn - side * swing.to_degrees).to_radians()).to_degrees();
        off.abs() <= swing.within_degrees
    }

    /// What the leg can do in a swing to one side.
    fn stroke(&self, swing: &SwingMotion, side: f32) -> Stroke {
        let turned = |degrees: f32| math::unit((side * degrees).to_radians()).rotate(self.run);
        let [mps, turned_degrees] = swing.body;
        Stroke {
            power: swing.power,
            hard: swing.hard,
            natural: turned(swing.to_degrees),
            body: turned(turned_degrees) * mps,
        }
    }
}

/// What a player's leg can do who kicks this way, world metres, wherever the ball is.
pub(super) fn stroke(player: &Player, kind: KickKind, way: Vec2) -> Stroke {
    let stance = Stance::of(player, way);
    let side = math::sign_or(stance.turn, RIGHT);
    let swings = ORDER[stance.gait].iter().flat_map(|gait| of(kind)[*gait]);
    let swing = swings.into_iter().find(|swing| stance.leads(swing, side));
    swing.map_or(
        Stroke {
            power: 1.0,
            hard: 0.0,
            natural: way.normalize_or(stance.run),
            body: stance.run * stance.pace,
        },
        |swing| stance.stroke(swing, side),
    )
}

/// The first swing of a kind that kicks the ball this way, world metres, from where it will be.
pub(super) fn find(game: &Match, id: PlayerId, kind: KickKind, way: Vec2) -> Option<ChosenSwing> {
    let player = game.player(id);
    let stance = Stance::of(player, way);
    let Stance { pace, run, .. } = stance;
    let ball_at = |swing: &SwingMotion| reach::expected(game, id, swing.ticks as u32);
    let meets = |swing: &SwingMotion, side: f32| {
        let ball = ball_at(swing);
        let place = ball.truncate() - player.pos - run * swing.way_m(pace);
        let place = Vec2::new(place.dot(run), run.perp_dot(place));
        leg::is_high_enough(ball.z, swing.ball_m[2], 0.0)
            && leg::meets(
                &swing.touch(pace, side),
                place,
                KICK,
                leg::freshness(game, id, swing.ticks),
            )
    };
    let left_leads = foot::left_leads(player, game.tick as i32);
    ORDER[stance.gait].iter().find_map(|&gait| {
        // Every swing has its mirror image.
        let suits = |swing: &SwingMotion, side: f32| {
            gait == STANDING || ((side == LEFT) != swing.crosses) == left_leads
        };
        let find = |first: bool| {
            of(kind)[gait].iter().find_map(|motion| {
                let side = [RIGHT, LEFT].into_iter().find(|&side| {
                    stance.leads(motion, side)
                        && suits(motion, side) == first
                        && meets(motion, side)
                })?;
                let place = ball_at(motion);
                Some(ChosenSwing { motion, place, stroke: stance.stroke(motion, side) })
            })
        };
        find(true).or_else(|| find(false))
    })
}

impl SwingMotion {
    /// The touch of this swing to one side (1 or -1).
    fn touch(&self, pace: f32, side: f32) -> MotionTouch {
        let [ahead_m, aside_m, _] = self.ball_m;
        MotionTouch {
            ticks: self.ticks,
            made_for: Vec2::new(ahead_m, side * aside_m),
            pace,
            at: Vec2::new(self.end_mps(pace), 0.0),
            out: Vec2::new(self.out_mps, 0.0),
            ends: Vec2::X,
        }
    }
}
