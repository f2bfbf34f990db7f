//! The rapier world of one worker, reused by one tick after another.
//!
//! A used rapier world has a memory (its contact graph, the order of its lists), so the same ball
//! may take another path in it. Therefore every tick starts from a copy of the template, and the
//! result depends only on the ball and the goals.

use super::constants::RIGID_SPIN_MAX;
use super::scene::{GoalSize, RapierWorld, SolverSpace, goal_offset};
use super::{Ball, Contact};
use crate::laps::Laps;
use glam::Vec3;
use setpiece_scenario::PitchSize;

/// Memory that one worker lends to one tick: the scratch rapier world and its template.
///
/// Its contents never affect what a tick computes.
pub struct Scratch {
    template: RapierWorld,
    /// The goals of the template.
    goals: GoalSize,
    live: RapierWorld,
    workspace: SolverSpace,
    laps: Laps,
    rigid: u64,
}

impl Scratch {
    /// How many times rapier has run; each time it allocates.
    pub fn rigid(&self) -> u64 {
        self.rigid
    }

    /// The time its steps have taken, if that is measured.
    pub fn laps(&mut self) -> &mut Laps {
        &mut self.laps
    }
}

impl Default for Scratch {
    fn default() -> Scratch {
        let mut workspace = SolverSpace::default();
        let goals = GoalSize::of(&PitchSize::USUAL);
        let template = RapierWorld::template(goals, &mut workspace);
        Scratch {
            live: template.clone(),
            template,
            goals,
            workspace,
            laps: Laps::default(),
            rigid: 0,
        }
    }
}

impl std::fmt::Debug for Scratch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Scratch").finish_non_exhaustive()
    }
}

/// What happened to the ball in a tick of rigid contact.
pub(super) struct RigidTouch {
    /// The strongest contact.
    pub(super) contact: Contact,
    /// Whether some contact holds the ball up.
    pub(super) held_up: bool,
}

/// Turns a vector by 180° about the vertical axis, so that the other goal is where the template has
/// its own.
fn turned(v: Vec3) -> Vec3 {
    Vec3::new(-v.x, -v.y, v.z)
}

impl Scratch {
    /// Moves the ball along its velocity over one tick, rebounding off whatever is hard.
    pub(super) fn meet(&mut self, ball: &mut Ball, pitch: &PitchSize) -> Option<RigidTouch> {
        let goals = GoalSize::of(pitch);
        if goals != self.goals {
            self.template = RapierWorld::template(goals, &mut self.workspace);
            self.goals = goals;
        }
        // How far the goals stand from their place in the scene.
        let offset = Vec3::new(goal_offset(pitch), 0.0, 0.0);
        // On the halfway line the ball's direction decides.
        let left_half = ball.pos.x < 0.0 || ball.pos.x == 0.0 && ball.vel.x < 0.0;
        let frame = |v: Vec3| if left_half { turned(v) } else { v };
        self.rigid += 1;
        self.live.restore(&self.template);
        let given_spin = frame(ball.spin).clamp_length_max(RIGID_SPIN_MAX);
        self.place(frame(ball.pos) - offset, frame(ball.vel), given_spin);
        self.live.step(&mut self.workspace);
        let touch = self.touch();
        if let Some(moved) = self.live.rigid.get(self.live.ball) {
            ball.pos = frame(moved.translation() + offset);
            ball.vel = frame(moved.linvel());
            if touch.is_some() {
                ball.spin += frame(moved.angvel() - given_spin);
            }
        }
        touch
    }

    fn place(&mut self, pos: Vec3, vel: Vec3, spin: Vec3) {
        if let Some(ball) = self.live.rigid.get_mut(self.live.ball) {
            ball.set_translation(pos, true);
            ball.set_linvel(vel, true);
            ball.set_angvel(spin, true);
        }
    }

    /// The contacts of the tick just simulated.
    fn touch(&self) -> Option<RigidTouch> {
        let world = &self.live;
        let mut strongest = 0.0;
        let mut contact = None;
        let mut held_up = false;
        for pair in world.narrow_phase.contact_pairs_with(world.ball_collider) {
            let (impulse, normal) = pair.max_impulse();
            if impulse <= 0.0 {
                continue;
            }
            let ball_first = pair.collider1 == world.ball_collider;
            held_up |= if ball_first { -normal.z } else { normal.z } > FLAT;
            if impulse > strongest {
                strongest = impulse;
                contact = world.contact(if ball_first { pair.collider2 } else { pair.collider1 });
            }
        }
        contact.map(|contact| RigidTouch { contact, held_up })
    }
}

/// A contact whose normal is steeper than this (its z) holds a ball up.
const FLAT: f32 = 0.5;
