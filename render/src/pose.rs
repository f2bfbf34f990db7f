//! How a body holds itself: a player's speed and posture as the angles of trunk and limbs.
//!
//! A scene has no history, so legs move with the step: the cadence is the same for everyone, and
//! the length of the stride follows the speed, as it mostly does with people. Nothing jumps when a
//! player turns or brakes.

use crate::math::{Vec3, cos, mix, sin, smooth, space, unit_or, within};
use crate::scene::{Id, Posture, Scene, ScenePlayer};

/// Strides (two steps) per second. Ten steps of the match are a second, so the pattern repeats
/// after five seconds.
const STRIDES_HZ: f32 = 1.4;
const PATTERN_STEPS: u32 = 50;

/// The angles of a limb, radians.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Limb {
    /// Forward from hanging down.
    pub(crate) swing: f32,
    /// Outward.
    pub(crate) spread: f32,
    /// Of knee or elbow.
    pub(crate) bend: f32,
}

/// A body's attitude. Sides are 0 for the side of `across`, 1 for the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LimbPose {
    /// Along the trunk, towards the head.
    pub(crate) up: Vec3,
    /// Where the chest faces.
    pub(crate) front: Vec3,
    /// Up and front of the legs.
    pub(crate) legs_up: Vec3,
    pub(crate) legs_front: Vec3,
    pub(crate) legs: [Limb; 2],
    pub(crate) arms: [Limb; 2],
    /// Height of the hips, or `None` where the lower foot is on the ground.
    pub(crate) hips_m: Option<f32>,
    /// Height above where the posture has its feet.
    pub(crate) lift_m: f32,
}

/// Seconds since the pattern of legs began.
pub(crate) fn time_s(scene: &Scene) -> f32 {
    ((scene.step % PATTERN_STEPS) as f32 + within(scene.between, 0.0, 1.0)) * 0.1
}

/// The share of a stride that a player's legs have made, and a little more: no two run in step.
fn phase(id: Id, time_s: f32) -> f32 {
    let own = (u32::from(id.slot) * 5 + id.team as u32 * 3) % 16;
    (time_s * STRIDES_HZ + own as f32 / 16.0) * std::f32::consts::TAU
}

impl LimbPose {
    /// A player's attitude at a time.
    pub(crate) fn of(player: &ScenePlayer, time_s: f32) -> LimbPose {
        let velocity = space([player.vel[0], player.vel[1], 0.0]);
        let facing = unit_or(space([player.facing[0], player.facing[1], 0.0]), Vec3::X);
        let progress = within(player.progress, 0.0, 1.0);
        let way = unit_or(velocity, facing);
        let speed = velocity.length().min(11.0);
        let mut pose = match player.posture {
            Posture::Upright => running(facing, way, speed, phase(player.id, time_s)),
            Posture::Stumbling => stumbling(facing, way, speed, phase(player.id, time_s)),
            Posture::Sliding => sliding(way, progress),
            Posture::Fallen => fallen(facing),
            Posture::Jumping => jumping(facing, progress),
            Posture::Diving => diving(facing, way, speed, progress),
            Posture::Kicking => kicking(facing, speed, progress),
        };
        pose.lift_m = if player.height_m.is_nan() { 0.0 } else { player.height_m.clamp(0.0, 3.0) };
        if matches!(player.posture, Posture::Upright) {
            // Tired people droop.
            let droop = within(player.tired, 0.0, 1.0) * 0.22;
            pose.up = unit_or(pose.up + facing * droop, Vec3::Z);
        }
        pose
    }
}

fn upright(facing: Vec3) -> LimbPose {
    LimbPose {
        up: Vec3::Z,
        front: facing,
        legs_up: Vec3::Z,
        legs_front: facing,
        legs: [Limb { spread: 0.08, ..Limb::default() }; 2],
        arms: [Limb { swing: 0.05, spread: 0.16, bend: 0.3 }; 2],
        hips_m: None,
        lift_m: 0.0,
    }
}

fn running(facing: Vec3, way: Vec3, speed: f32, phase: f32) -> LimbPose {
    let mut pose = upright(facing);
    if speed < 0.25 {
        // Shifting the weight.
        let sway = sin(phase * 0.5) * 0.04;
        pose.arms[0].swing += sway;
        pose.arms[1].swing -= sway;
        pose.legs[0].spread += 0.05;
        pose.legs[1].spread += 0.05;
        return pose;
    }
    let pace = speed / 8.0;
    let reach = within(0.28 + speed * 0.085, 0.0, 0.95);
    for (side, turn) in [(0, 0.0), (1, std::f32::consts::PI)] {
        let (swing, rising) = (sin(phase + turn), cos(phase + turn));
        // The knee folds while the leg comes forward, and is nearly straight while it carries.
        let fold = mix(0.5, 1.9, within(pace, 0.0, 1.0)) * smooth(rising * 0.75 + 0.25);
        pose.legs[side] = Limb {
            swing: swing * reach + 0.1 * pace,
            spread: 0.04,
            bend: 0.12 + 0.12 * pace + fold,
        };
        pose.arms[side] = Limb {
            swing: -swing * reach * 0.95 - 0.1,
            spread: 0.14,
            bend: mix(0.35, 1.65, within(pace * 1.3, 0.0, 1.0)),
        };
    }
    pose.legs_front = way;
    // Both feet leave the ground twice per stride.
    let bounce = sin(phase * 2.0 + 0.9).max(0.0) * 0.07 * within(pace, 0.0, 1.0);
    pose.lift_m = bounce;
    pose.up = unit_or(Vec3::Z + way * (0.05 + 0.2 * pace * pace), Vec3::Z);
    pose
}

fn stumbling(facing: Vec3, way: Vec3, speed: f32, phase: f32) -> LimbPose {
    let mut pose = running(facing, way, speed.max(2.0), phase);
    pose.up = unit_or(Vec3::Z + way * 0.7, Vec3::Z);
    pose.arms =
        [Limb { swing: 0.9, spread: 0.9, bend: 0.4 }, Limb { swing: 0.4, spread: 1.2, bend: 0.5 }];
    pose
}

fn sliding(way: Vec3, progress: f32) -> LimbPose {
    let down = smooth(progress * 4.0 + 0.5);
    let lean = Vec3::Z * 0.55 - way * 0.85 * down;
    LimbPose {
        up: unit_or(lean, Vec3::Z),
        front: unit_or(Vec3::Z * 0.8 + way * 0.6, way),
        legs_up: Vec3::Z,
        legs_front: way,
        legs: [
            Limb { swing: 1.48, spread: 0.06, bend: 0.08 },
            Limb { swing: 1.25, spread: 0.28, bend: 1.9 },
        ],
        arms: [
            Limb { swing: -0.7, spread: 0.5, bend: 0.2 },
            Limb { swing: 0.7, spread: 1.2, bend: 0.4 },
        ],
        hips_m: Some(mix(0.45, 0.17, down)),
        lift_m: 0.0,
    }
}

fn fallen(facing: Vec3) -> LimbPose {
    let along = -facing;
    LimbPose {
        up: unit_or(along + Vec3::Z * 0.06, along),
        front: unit_or(Vec3::new(-facing.y, facing.x, 0.0) * 0.6 + Vec3::Z, Vec3::Z),
        legs_up: along,
        legs_front: Vec3::Z,
        legs: [
            Limb { swing: 0.45, spread: 0.15, bend: 0.95 },
            Limb { swing: 0.06, spread: 0.2, bend: 0.15 },
        ],
        arms: [
            Limb { swing: 0.5, spread: 0.7, bend: 0.9 },
            Limb { swing: 0.0, spread: 1.2, bend: 0.3 },
        ],
        hips_m: Some(0.15),
        lift_m: 0.0,
    }
}

fn jumping(facing: Vec3, progress: f32) -> LimbPose {
    let high = sin(progress * std::f32::consts::PI).max(0.0);
    let mut pose = upright(facing);
    pose.up =
        unit_or(Vec3::Z - facing * 0.12 + facing * 0.3 * smooth(progress * 2.0 - 0.8), Vec3::Z);
    pose.legs = [
        Limb { swing: 0.35 * high, spread: 0.1, bend: 0.3 + 0.9 * high },
        Limb { swing: -0.25 * high, spread: 0.1, bend: 0.2 + 1.0 * high },
    ];
    pose.arms = [Limb { swing: mix(0.5, 1.9, high), spread: 0.6, bend: 0.5 }; 2];
    pose
}

fn diving(facing: Vec3, way: Vec3, speed: f32, progress: f32) -> LimbPose {
    // Who doesn't move dives where they face.
    let way = if speed < 0.5 { facing } else { way };
    let tilt = mix(0.5, 1.5, smooth(progress * 2.2));
    let up = Vec3::Z * cos(tilt) + way * sin(tilt);
    let chest = facing - up * facing.dot(up);
    let front = unit_or(chest, Vec3::new(-way.y, way.x, 0.0));
    let hips = if progress < 0.45 {
        mix(0.8, 0.95, progress / 0.45)
    } else {
        mix(0.95, 0.17, smooth(progress * 1.8 - 0.8))
    };
    LimbPose {
        up,
        front,
        legs_up: unit_or(up + Vec3::Z * 0.15, up),
        legs_front: front,
        legs: [
            Limb { swing: -0.1, spread: 0.2, bend: 0.25 },
            Limb { swing: 0.6, spread: 0.05, bend: 1.0 },
        ],
        arms: [
            Limb { swing: 2.85, spread: 0.1, bend: 0.12 },
            Limb { swing: 2.6, spread: 0.05, bend: 0.2 },
        ],
        hips_m: Some(hips),
        lift_m: 0.0,
    }
}

fn kicking(facing: Vec3, speed: f32, progress: f32) -> LimbPose {
    let mut pose = upright(facing);
    let (back, through) = (smooth(progress / 0.35), smooth((progress - 0.35) / 0.35));
    let swing = mix(mix(0.0, -1.0, back), 1.15, through) - 0.6 * smooth((progress - 0.75) / 0.25);
    let bend = mix(mix(0.2, 1.5, back), 0.12, smooth((progress - 0.38) / 0.2));
    pose.legs = [
        Limb { swing: mix(0.3, -0.2, progress), spread: 0.1, bend: 0.25 },
        Limb { swing, spread: 0.12, bend },
    ];
    pose.arms = [
        Limb { swing: mix(-0.4, 0.9, through), spread: 0.8, bend: 0.4 },
        Limb { swing: mix(0.5, -0.7, through), spread: 0.6, bend: 0.5 },
    ];
    pose.up = unit_or(Vec3::Z + facing * mix(0.12, -0.16, through) * (1.0 + speed * 0.05), Vec3::Z);
    pose
}
