//! The motions of a keeper's hands: how long they last, where they meet the ball, and where the
//! body goes.
//!
//! A keeper takes the first motion whose hands meet the ball where it will be. Motions that hold
//! the ball come first, then those made for the keeper's gait, then those made for how the body is
//! turned. (Measured of GRF's motions; the order is GRF's.)

use crate::football::leg::{self, HANDS, MotionTouch};
use crate::football::pace::{DRIBBLES_FROM_MPS, SPRINTS_FROM_MPS, WALKS_FROM_MPS};
use crate::football::{foot, reach};
use crate::math;
use crate::state::{Match, Player, PlayerId};
use glam::{Vec2, Vec3};

/// A motion of the hands. What is aside of the run is so for the one of two mirror images.
pub(super) struct SaveMotion {
    /// Ticks until the hands meet the ball, and until the motion is over.
    pub(super) ticks: i32,
    pub(super) lasts: i32,
    /// Where the hands are then, metres from the body: along the run, aside, and up.
    hands_m: [f32; 3],
    /// How fast the keeper is along the run on average until then, and then, m/s: base and share
    /// of their pace.
    mean: [f32; 2],
    end: [f32; 2],
    /// How far aside the body comes until then, metres, and how fast it is then, m/s.
    aside: [f32; 2],
    /// The velocity at its end, along the run and aside, m/s.
    out: [f32; 2],
    /// From where the ball comes that it is made for: the angle from straight ahead to one side,
    /// degrees.
    from_degrees: f32,
    /// Whether the body is turned aside by half a right angle when it begins.
    turned: bool,
    /// Whether the hands can hold the ball.
    pub(super) holds: bool,
    /// Whether the keeper lies on the ground at its end.
    pub(super) falls: bool,
    /// How far the body is turned aside then, degrees.
    ends_degrees: f32,
}

/// A motion of a keeper who faces the ball, pushes it away and stays up.
const fn save(
    [ticks, lasts]: [i32; 2],
    hands_m: [f32; 3],
    mean: [f32; 2],
    end: [f32; 2],
) -> SaveMotion {
    SaveMotion {
        ticks,
        lasts,
        hands_m,
        mean,
        end,
        aside: [0.0; 2],
        out: [0.0; 2],
        from_degrees: 0.0,
        turned: false,
        holds: false,
        falls: false,
        ends_degrees: 0.0,
    }
}

impl SaveMotion {
    /// The same with a body that comes aside.
    const fn aside(mut self, metres: f32, mps: f32) -> SaveMotion {
        self.aside = [metres, mps];
        self
    }

    /// The same that ends in a run.
    const fn out(mut self, along_mps: f32, aside_mps: f32) -> SaveMotion {
        self.out = [along_mps, aside_mps];
        self
    }

    /// The same for a ball from one side.
    const fn of_a_ball_from(mut self, degrees: f32) -> SaveMotion {
        self.from_degrees = degrees;
        self
    }

    /// The same for a body turned aside.
    const fn turned(mut self) -> SaveMotion {
        self.turned = true;
        self
    }

    /// The same that can hold the ball.
    const fn holds(mut self) -> SaveMotion {
        self.holds = true;
        self
    }

    /// The same that ends on the ground, turned so far aside.
    const fn falls(mut self, degrees: f32) -> SaveMotion {
        self.falls = true;
        self.ends_degrees = degrees;
        self
    }
}

/// The motions of a keeper who stands.
const STANDING: [SaveMotion; 13] = [
    save([14, 81], [0.61, -0.08, 0.13], [0.85, 0.0], [0.54, 0.0])
        .out(0.4, 0.0)
        .of_a_ball_from(17.0)
        .holds(),
    save([12, 39], [0.28, 0.58, 2.21], [0.28, 0.0], [-0.33, 0.0]).aside(0.01, 0.83).out(0.0, 0.47),
    save([18, 66], [0.13, 0.08, 2.55], [0.62, 0.0], [0.91, 0.0]).aside(0.15, 1.24).out(0.44, 0.1),
    save([29, 59], [0.48, -0.61, 2.23], [0.57, 0.0], [0.88, 0.0])
        .aside(-0.26, -1.09)
        .out(0.2, -0.6),
    save([12, 50], [0.3, 0.22, 2.06], [0.23, 0.0], [-0.2, 0.0])
        .aside(0.02, 0.57)
        .out(0.0, 0.33)
        .of_a_ball_from(17.0)
        .holds(),
    save([9, 48], [0.48, -0.05, 0.63], [0.44, 0.0], [0.13, 0.0])
        .out(0.5, 0.0)
        .of_a_ball_from(17.0)
        .holds(),
    save([10, 46], [0.55, 0.0, 1.42], [0.34, 0.0], [-0.33, 0.0]).of_a_ball_from(17.0).holds(),
    save([36, 53], [0.03, 1.36, 0.11], [0.73, 0.0], [0.83, 0.0])
        .aside(1.07, 4.27)
        .out(0.0, 1.75)
        .falls(90.0),
    save([36, 57], [0.41, 0.77, 0.11], [0.74, 0.0], [0.79, 0.0])
        .aside(0.85, 3.09)
        .out(0.0, 0.59)
        .holds()
        .falls(90.0),
    save([31, 83], [0.21, -0.84, 2.09], [0.31, 0.0], [0.28, 0.0])
        .aside(-0.41, -1.63)
        .out(0.08, -0.73)
        .falls(-86.0),
    save([31, 79], [0.36, -1.16, 0.94], [0.41, 0.0], [0.83, 0.0])
        .aside(-0.71, -4.67)
        .out(0.0, -1.0)
        .falls(-56.0),
    save([17, 49], [0.07, -1.04, 0.76], [0.0, 0.0], [0.0, 0.0])
        .aside(-0.28, -2.52)
        .out(0.0, -0.67)
        .holds()
        .falls(-90.0),
    save([31, 80], [0.35, -0.98, 1.64], [0.43, 0.0], [0.83, 0.0])
        .aside(-0.54, -2.56)
        .out(0.31, -0.37)
        .falls(-71.0),
];
/// The motions of a keeper who dribbles or walks.
const WALKING: [SaveMotion; 12] = [
    save([17, 84], [0.59, -0.08, 0.13], [3.13, 0.22], [2.27, 0.0])
        .out(0.43, 0.0)
        .of_a_ball_from(17.0)
        .holds(),
    save([9, 48], [0.1, -0.05, 0.63], [2.7, 0.43], [4.19, 0.05])
        .out(0.77, 0.0)
        .of_a_ball_from(17.0)
        .holds(),
    save([13, 49], [0.58, -0.02, 1.44], [3.0, 0.29], [2.95, 0.01])
        .out(0.48, 0.0)
        .of_a_ball_from(17.0)
        .holds(),
    save([22, 65], [0.67, 1.21, 0.47], [3.8, 0.21], [4.31, 0.0])
        .aside(0.36, 3.97)
        .out(0.29, 0.76)
        .of_a_ball_from(45.0)
        .falls(47.0),
    save([35, 70], [1.28, -0.25, 0.15], [4.33, 0.12], [4.13, 0.0])
        .out(0.06, 0.0)
        .of_a_ball_from(90.0)
        .turned()
        .falls(-8.0),
    save([28, 55], [0.67, -0.44, 0.27], [2.73, 0.15], [1.48, 0.0])
        .out(0.04, 0.0)
        .of_a_ball_from(90.0)
        .turned()
        .holds()
        .falls(0.0),
    save([32, 83], [0.77, -0.28, 2.0], [3.09, 0.13], [2.66, 0.0])
        .out(0.16, 0.0)
        .of_a_ball_from(90.0)
        .turned()
        .falls(-1.0),
    save([18, 36], [0.22, -0.3, 2.28], [3.62, 0.27], [4.21, 0.0])
        .out(3.33, 0.0)
        .of_a_ball_from(90.0)
        .turned()
        .holds(),
    save([35, 70], [1.22, -0.25, 0.97], [4.04, 0.12], [4.16, 0.0])
        .out(0.6, 0.0)
        .of_a_ball_from(90.0)
        .turned()
        .falls(-4.0),
    save([20, 55], [0.34, -0.45, 0.88], [3.07, 0.2], [2.24, 0.0])
        .out(0.04, 0.0)
        .of_a_ball_from(90.0)
        .turned()
        .holds()
        .falls(0.0),
    save([35, 81], [1.14, -0.26, 1.48], [3.29, 0.12], [2.97, 0.0])
        .out(0.16, 0.0)
        .of_a_ball_from(90.0)
        .turned()
        .falls(-1.0),
    save([18, 36], [0.31, -0.43, 1.53], [3.62, 0.27], [4.21, 0.0])
        .out(3.33, 0.0)
        .of_a_ball_from(90.0)
        .turned()
        .holds(),
];
/// The motions of a keeper who sprints.
const SPRINTING: [SaveMotion; 3] = [
    save([17, 40], [1.33, -0.4, 0.11], [2.92, 0.71], [4.81, 0.62])
        .out(2.61, 0.0)
        .of_a_ball_from(90.0)
        .falls(176.0),
    save([19, 51], [0.72, -0.4, 0.11], [5.01, 0.25], [5.86, 0.0])
        .out(0.33, 0.0)
        .holds()
        .falls(-34.0),
    save([17, 39], [0.75, -0.61, 0.19], [2.92, 0.71], [4.81, 0.62])
        .out(2.95, 0.0)
        .of_a_ball_from(90.0)
        .holds()
        .falls(176.0),
];

/// A gait, and the motions that are made for it.
#[derive(Clone, Copy, PartialEq)]
enum SaveGait {
    Stands,
    Walks,
    Sprints,
}

/// Which motions a keeper at a gait tries first, and which then.
const fn of(gait: SaveGait) -> [&'static [SaveMotion]; 2] {
    match gait {
        SaveGait::Stands => [&STANDING, &[]],
        SaveGait::Walks => [&WALKING, &SPRINTING],
        SaveGait::Sprints => [&SPRINTING, &WALKING],
    }
}

/// How a keeper's body is turned away from the run: not, by half a right angle, or backwards.
/// (GRF's.)
#[derive(Clone, Copy, PartialEq)]
enum BodyTurn {
    Ahead,
    Half,
    Back,
}

/// From which angle between the run and the ball on a keeper is turned aside, and from which on
/// one is turned back, degrees. Only who dribbles runs backwards, and who sprints looks ahead.
/// (GRF's.)
const HALF_DEG: f32 = 22.5;
const BACK_DEG: f32 = 90.0;
/// The ball may come from this much beside where a motion is made for, degrees. It is judged
/// between these ticks. (GRF's.)
const OFF_DEG: f32 = 72.0;
const FROM_TICKS: [u32; 2] = [12, 18];
/// The height of the keeper that the motions are made for, metres. (GRF's.)
const TALL_M: f32 = 1.92;
/// How much easier it is for hands to meet a ball at another height. Above these heights, metres, a
/// ball can't be this much above the hands, by these factors. (GRF's.)
const EASIER: f32 = 0.8;
const HIGH: [[f32; 3]; 2] = [[1.8, 0.12, 2.0], [2.6, 0.08, 20.0]];
/// The hands meet the ball wherever it is within these times of the touch, seconds. (GRF's.)
const WHILE_S: [f32; 2] = [0.006, 0.003];
/// The ball must not be further beyond the goal line than this, metres. (GRF's.)
const BEHIND_M: f32 = 0.17;
/// The sides to which a motion goes: as it is measured, and its mirror image.
const SIDES: [f32; 2] = [1.0, -1.0];

/// The motion that a keeper chooses.
pub(super) struct ChosenSave {
    pub(super) motion: &'static SaveMotion,
    /// Where the ball is expected then, world metres.
    pub(super) place: Vec3,
    /// Where the hands are then, world metres from the body, and how high, metres.
    pub(super) hands: Vec2,
    pub(super) high_m: f32,
    /// Where the body is then, world metres, and how fast, m/s.
    pub(super) spot: Vec2,
    pub(super) vel: Vec2,
}

/// How a keeper stands to the ball.
struct KeeperStance {
    pace: f32,
    gait: SaveGait,
    /// The way of the run, or to the ball of a keeper who stands.
    run: Vec2,
    turn: BodyTurn,
    /// The side to which the body is turned.
    turned_to: f32,
}

impl KeeperStance {
    /// A keeper looks at the ball, whichever way they run.
    fn of(player: &Player, ball: Vec2) -> KeeperStance {
        let mps = player.vel.length();
        let to_ball = (ball - player.pos).normalize_or(player.body.facing);
        if mps < DRIBBLES_FROM_MPS {
            return KeeperStance {
                pace: 0.0,
                gait: SaveGait::Stands,
                run: to_ball,
                turn: BodyTurn::Ahead,
                turned_to: SIDES[0],
            };
        }
        let run = player.vel / mps;
        let degrees = math::atan2(run.perp_dot(to_ball), run.dot(to_ball)).to_degrees();
        let turn = if mps >= SPRINTS_FROM_MPS || degrees.abs() < HALF_DEG {
            BodyTurn::Ahead
        } else if degrees.abs() > BACK_DEG && mps < WALKS_FROM_MPS {
            BodyTurn::Back
        } else {
            BodyTurn::Half
        };
        let gait = if mps >= SPRINTS_FROM_MPS { SaveGait::Sprints } else { SaveGait::Walks };
        KeeperStance { pace: mps, gait, run, turn, turned_to: math::sign_or(degrees, SIDES[0]) }
    }

    /// How far off the body is turned from how a motion to one side begins: 0, 1 or 2 times half a
    /// right angle. None if it can't begin so. (GRF's.)
    fn turns_off(&self, motion: &SaveMotion, side: f32) -> Option<u8> {
        // The measured motions are turned to the other side than the one that counts as theirs.
        let same = -side == self.turned_to;
        match (motion.turned, self.turn) {
            (false, BodyTurn::Ahead) => Some(0),
            (false, BodyTurn::Half) => Some(1),
            (false, BodyTurn::Back) | (true, BodyTurn::Ahead) => None,
            (true, BodyTurn::Half) => Some(if same { 0 } else { 2 }),
            (true, BodyTurn::Back) => same.then_some(2),
        }
    }
}

impl SaveMotion {
    /// The touch of a motion to one side, in the frame of the run.
    fn touch(&self, pace: f32, side: f32) -> MotionTouch {
        let [ahead_m, aside_m, _] = self.hands_m;
        let ends = math::unit((side * self.ends_degrees).to_radians());
        MotionTouch {
            ticks: self.ticks,
            made_for: Vec2::new(ahead_m, side * aside_m),
            pace,
            at: Vec2::new(self.end[0] + self.end[1] * pace, side * self.aside[1]),
            out: Vec2::new(self.out[0], side * self.out[1]),
            ends,
        }
    }

    /// Where the body of a keeper at a pace is at the touch, in the frame of the run.
    fn body_m(&self, pace: f32, side: f32) -> Vec2 {
        let along_m = (self.mean[0] + self.mean[1] * pace) * self.ticks as f32 * 0.01;
        Vec2::new(along_m, side * self.aside[0])
    }

    /// Whether the motion is made for a ball that flies this way, in the frame of the run.
    fn suits(&self, way: Vec2, side: f32) -> bool {
        // The measured motions are made for balls from the side to which the body is turned.
        let comes = math::unit((-side * self.from_degrees).to_radians());
        way == Vec2::ZERO || comes.dot(-way) >= libm::cosf(OFF_DEG.to_radians())
    }
}

/// What decides between motions, the least first: whether it doesn't hold the ball, whether it is
/// made for another gait, how far the body is turned off, and whether the other foot is in front.
type Rank = (bool, usize, u8, bool);

/// The motion whose hands meet the ball. `only_holds`: the keeper wants no other.
pub(super) fn find(game: &Match, id: PlayerId, only_holds: bool) -> Option<ChosenSave> {
    let player = game.player(id);
    let [from, to] = FROM_TICKS.map(|ticks| reach::expected(game, id, ticks).truncate());
    let stance = KeeperStance::of(player, game.ball.pos.truncate());
    let frame = |world: Vec2| Vec2::new(world.dot(stance.run), stance.run.perp_dot(world));
    let way = frame((to - from).normalize_or_zero());
    let left_leads = foot::left_leads(player, game.tick as i32);
    let mut best: Option<(Rank, &SaveMotion, f32)> = None;
    for (later, motions) in of(stance.gait).into_iter().enumerate() {
        for motion in motions.iter().filter(|motion| motion.holds || !only_holds) {
            for side in SIDES {
                let Some(off) = stance.turns_off(motion, side) else { continue };
                let other_foot = stance.gait != SaveGait::Stands && (side < 0.0) != left_leads;
                let rank = (!motion.holds, later, off, other_foot);
                if best.as_ref().is_none_or(|(least, ..)| rank < *least)
                    && motion.suits(way, side)
                    && meets(game, id, motion, side, &stance)
                {
                    best = Some((rank, motion, side));
                }
            }
        }
    }
    let (_, motion, side) = best?;
    let world = |place: Vec2| stance.run * place.x + stance.run.perp() * place.y;
    let touch = motion.touch(stance.pace, side);
    Some(ChosenSave {
        motion,
        hands: world(touch.made_for),
        place: reach::expected(game, id, motion.ticks as u32),
        high_m: motion.hands_m[2],
        spot: player.pos + world(motion.body_m(stance.pace, side)),
        vel: world(touch.at),
    })
}

/// Whether the hands of a motion to one side meet the ball.
fn meets(
    game: &Match,
    id: PlayerId,
    motion: &SaveMotion,
    side: f32,
    stance: &KeeperStance,
) -> bool {
    let player = game.player(id);
    let ticks = motion.ticks as u32;
    let goes_to = game.play.forecast.at(game.tick + ticks);
    if goes_to.x.abs() > game.goal().x + BEHIND_M {
        return false;
    }
    let ball = reach::expected(game, id, ticks);
    let vel = (reach::expected(game, id, ticks + 1) - ball) * 100.0;
    let touch = motion.touch(stance.pace, side);
    let off = ball.truncate() - player.pos;
    let frame = |world: Vec2| Vec2::new(world.dot(stance.run), stance.run.perp_dot(world));
    let ball = (frame(off) - motion.body_m(stance.pace, side)).extend(ball.z);
    let vel = frame(vel.truncate()).extend(vel.z);
    let high_m = motion.hands_m[2] * player.body.height_m / TALL_M;
    let hands = touch.made_for.extend(high_m);
    let nearest_s = (hands - ball).dot(vel) / vel.length_squared().max(1e-6);
    let ball = ball + vel * nearest_s.clamp(-WHILE_S[0], WHILE_S[1]);
    is_high_enough(ball.z, high_m)
        && leg::meets(&touch, ball.truncate(), HANDS, leg::freshness(game, id, motion.ticks))
}

/// Whether hands at a height meet a ball at another.
fn is_high_enough(ball_m: f32, hands_m: f32) -> bool {
    let mut apart_m = leg::heights_apart_m(ball_m, hands_m) * EASIER;
    for [from_m, above_m, factor] in HIGH {
        if ball_m > from_m && ball_m > hands_m + above_m {
            apart_m *= factor;
        }
    }
    apart_m < leg::UP_M
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A keeper who moves like this, with the ball in front of them.
    fn stance(vel: Vec2) -> KeeperStance {
        let body = crate::state::player::Body::blank();
        let player = Player { vel, ..player(&body) };
        KeeperStance::of(&player, Vec2::new(10.0, 0.0))
    }

    fn player(body: &crate::state::player::Body) -> Player {
        Player {
            active: true,
            role: setpiece_scenario::vocabulary::Role::GK,
            ai: setpiece_scenario::Ai::Bot,
            controllable: false,
            pos: Vec2::ZERO,
            vel: Vec2::ZERO,
            heading_rad: 0.0,
            fatigue: 0.0,
            yellow_cards: 0,
            difficulty: 1.0,
            body: *body,
        }
    }

    #[test]
    fn the_highest_hands_of_a_tall_keeper_reach_just_above_the_crossbar() {
        let highest = STANDING.iter().map(|motion| motion.hands_m[2]).fold(0.0, f32::max);
        assert!(is_high_enough(2.6, highest));
        assert!(!is_high_enough(2.8, highest), "a ball that is too high goes over");
    }

    #[test]
    fn a_ball_that_rolls_is_met_on_the_ground_and_by_no_leap() {
        let meets = |motion: &&SaveMotion| is_high_enough(0.11, motion.hands_m[2]);
        let met: Vec<_> = STANDING.iter().filter(meets).map(|motion| motion.hands_m[2]).collect();
        assert_eq!(met, [0.13, 0.11, 0.11]);
    }

    #[test]
    fn a_keeper_who_runs_across_looks_at_the_ball_and_one_who_sprints_looks_ahead() {
        let across = stance(Vec2::new(0.0, 5.0));
        assert!(across.gait == SaveGait::Walks && across.turn == BodyTurn::Half);
        let sprints = stance(Vec2::new(0.0, 7.0));
        assert!(sprints.gait == SaveGait::Sprints && sprints.turn == BodyTurn::Ahead);
        let back = stance(Vec2::new(-3.0, 0.5));
        assert!(back.turn == BodyTurn::Back);
        let turned = WALKING.iter().find(|motion| motion.turned).unwrap();
        let sides = SIDES.map(|side| across.turns_off(turned, side));
        assert!(sides.contains(&Some(0)) && sides.contains(&Some(2)));
        assert!(SIDES.iter().all(|&side| sprints.turns_off(turned, side).is_none()));
    }

    #[test]
    fn a_dive_reaches_much_further_aside_than_a_step() {
        let dive = STANDING.iter().find(|motion| motion.falls && motion.holds).unwrap();
        let step = STANDING.iter().find(|motion| motion.holds && !motion.falls).unwrap();
        let meets = |motion: &SaveMotion, aside_m: f32| {
            let ball = Vec2::new(0.6, aside_m) - motion.body_m(0.0, 1.0);
            leg::meets(&motion.touch(0.0, 1.0), ball, HANDS, 1.0)
        };
        assert!(meets(step, 0.0) && !meets(step, 1.6));
        assert!(meets(dive, 1.6) && !meets(dive, 3.2));
    }
}
