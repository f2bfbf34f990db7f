//! A pose as joints in space.

use crate::math::{Vec3, cos, sin, unit_or};
use crate::pose::{Limb, LimbPose};

/// People are drawn so much larger than life, so that they can be read.
pub(crate) const GROWN: f32 = 1.14;
/// Lengths of the parts of a body, metres.
const HIP_M: f32 = 0.11;
const THIGH_M: f32 = 0.46;
const SHIN_M: f32 = 0.45;
const FOOT_M: f32 = 0.2;
const TRUNK_M: f32 = 0.5;
const SHOULDER_M: f32 = 0.2;
const UPPER_ARM_M: f32 = 0.31;
const FOREARM_M: f32 = 0.3;
const NECK_M: f32 = 0.12;
const HEAD_M: f32 = 0.15;
/// Height of an ankle above the ground.
const ANKLE_M: f32 = 0.09;

/// Where the joints of a body are, world metres. Pairs are the two sides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Skeleton {
    pub(crate) hips: Vec3,
    pub(crate) hip: [Vec3; 2],
    pub(crate) knee: [Vec3; 2],
    pub(crate) ankle: [Vec3; 2],
    pub(crate) toe: [Vec3; 2],
    pub(crate) chest: Vec3,
    pub(crate) shoulder: [Vec3; 2],
    pub(crate) elbow: [Vec3; 2],
    pub(crate) hand: [Vec3; 2],
    pub(crate) neck: Vec3,
    pub(crate) head: Vec3,
    /// Where the chest faces.
    pub(crate) front: Vec3,
    /// From hips to head.
    pub(crate) up: Vec3,
}

/// Three directions at right angles.
struct LimbFrame {
    up: Vec3,
    front: Vec3,
    across: Vec3,
}

impl LimbFrame {
    fn new(up: Vec3, front: Vec3) -> LimbFrame {
        let front = unit_or(front - up * front.dot(up), Vec3::new(-up.z, 0.0, up.x));
        LimbFrame { up, front, across: up.cross(front) }
    }

    /// The directions of a limb's two parts; `knee` bends the second back, otherwise forward.
    fn limb(&self, limb: Limb, side: usize, knee: bool) -> (Vec3, Vec3) {
        let outward = if side == 0 { self.across } else { -self.across };
        let (sin_swing, cos_swing) = (sin(limb.swing), cos(limb.swing));
        let hanging = self.front * sin_swing - self.up * cos_swing;
        let upper = hanging * cos(limb.spread) + outward * sin(limb.spread);
        // At right angles to the upper part, in the plane of the swing.
        let ahead = self.front * cos_swing + self.up * sin_swing;
        let turn = if knee { -limb.bend } else { limb.bend };
        (upper, upper * cos(turn) + ahead * sin(turn))
    }
}

impl Skeleton {
    /// The joints of a pose at a place on the ground.
    pub(crate) fn new(pose: &LimbPose, at: Vec3) -> Skeleton {
        let legs = LimbFrame::new(pose.legs_up, pose.legs_front);
        let trunk = LimbFrame::new(pose.up, pose.front);
        let sides = [0, 1];
        // First about hips at the origin.
        let hip = sides.map(|side| trunk.across * if side == 0 { HIP_M } else { -HIP_M });
        let parts = sides.map(|side| legs.limb(pose.legs[side], side, true));
        let knee = sides.map(|side| hip[side] + parts[side].0 * THIGH_M);
        let ankle = sides.map(|side| knee[side] + parts[side].1 * SHIN_M);
        let lowest = ankle[0].z.min(ankle[1].z);
        let height = pose.hips_m.unwrap_or(ANKLE_M - lowest) + pose.lift_m;
        let hips = Vec3::Z * height;
        // A foot is at a right angle to its shin.
        let toe = sides.map(|side| {
            let shin = parts[side].1;
            let ahead = unit_or(trunk.front - shin * trunk.front.dot(shin), legs.front);
            let toe = ankle[side] + ahead * FOOT_M + shin * 0.04;
            Vec3::new(toe.x, toe.y, toe.z.max(0.05 - height))
        });
        let chest = pose.up * TRUNK_M;
        let shoulder = sides.map(|side| {
            chest - pose.up * 0.04 + trunk.across * if side == 0 { SHOULDER_M } else { -SHOULDER_M }
        });
        let arms = sides.map(|side| trunk.limb(pose.arms[side], side, false));
        let elbow = sides.map(|side| shoulder[side] + arms[side].0 * UPPER_ARM_M);
        let hand = sides.map(|side| elbow[side] + arms[side].1 * FOREARM_M);
        // The head stays more upright than the trunk.
        let neck = chest + pose.up * 0.03;
        let head = neck
            + unit_or(pose.up * 2.0 + Vec3::Z, pose.up) * (NECK_M + HEAD_M * 0.5)
            + trunk.front * 0.03;
        let above = |p: Vec3| {
            let p = (hips + p) * GROWN;
            Vec3::new(at.x + p.x, at.y + p.y, p.z.max(0.03))
        };
        Skeleton {
            hips: above(Vec3::ZERO),
            hip: hip.map(above),
            knee: knee.map(above),
            ankle: ankle.map(above),
            toe: toe.map(above),
            chest: above(chest),
            shoulder: shoulder.map(above),
            elbow: elbow.map(above),
            hand: hand.map(above),
            neck: above(neck),
            head: above(head),
            front: trunk.front,
            up: pose.up,
        }
    }
}
