//! The rapier worlds of one worker, reused by one tick after another.
//!
//! A used rapier world has a memory (its contact graph, the order of its lists), so the same ball
//! may take another path in it. Therefore every tick starts from a copy of the template, and the
//! result depends only on the ball and the bodies.

use super::Ball;
use super::constants::{BODY_LENGTH, RIGID_SPIN_MAX};
use super::scene::{BODIES_MAX, ColliderPart, GoalSize, RapierWorld, SolverSpace, goal_offset};
use super::{BallObstacle, Contact};
use crate::laps::Laps;
use glam::{Vec2, Vec3};
use setpiece_scenario::PitchSize;

/// Memory that one worker lends to one tick: the scratch rapier world, and its templates by number
/// of bodies.
///
/// Its contents never affect what a tick computes.
pub struct Scratch {
    templates: [RapierWorld; BODIES_MAX + 1],
    /// The goals of the templates.
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
        let templates = templates(goals, &mut workspace);
        Scratch {
            live: templates[0].clone(),
            templates,
            goals,
            workspace,
            laps: Laps::default(),
            rigid: 0,
        }
    }
}

fn templates(goals: GoalSize, workspace: &mut SolverSpace) -> [RapierWorld; BODIES_MAX + 1] {
    std::array::from_fn(|bodies| RapierWorld::template(bodies, goals, workspace))
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
    /// Whether both a body and a part of the goal were touched.
    squeezed: bool,
}

/// Turns a vector by 180° about the vertical axis, so that the other goal is where the template has
/// its own.
fn turned(v: Vec3) -> Vec3 {
    Vec3::new(-v.x, -v.y, v.z)
}

impl Scratch {
    /// Moves the ball along its velocity over one tick, rebounding off whatever is hard. At most
    /// [`BODIES_MAX`] bodies.
    pub(super) fn meet(
        &mut self,
        ball: &mut Ball,
        pitch: &PitchSize,
        bodies: &[BallObstacle],
    ) -> Option<RigidTouch> {
        let before = *ball;
        let goals = GoalSize::of(pitch);
        if goals != self.goals {
            (self.templates, self.goals) = (templates(goals, &mut self.workspace), goals);
        }
        let offset = goal_offset(pitch);
        let touch = self.carry(ball, offset, bodies)?;
        if touch.squeezed {
            // A body's proxy yields to nothing and would press the ball through the net. Here the
            // body gives way.
            *ball = before;
            let against = self.carry(ball, offset, &[]);
            return Some(RigidTouch { held_up: against.is_some_and(|t| t.held_up), ..touch });
        }
        Some(touch)
    }

    /// `offset`: how far the goals stand from their place in the scene, metres.
    fn carry(
        &mut self,
        ball: &mut Ball,
        offset: f32,
        bodies: &[BallObstacle],
    ) -> Option<RigidTouch> {
        let offset = Vec3::new(offset, 0.0, 0.0);
        let bodies = &bodies[..bodies.len().min(BODIES_MAX)];
        // On the halfway line the ball's direction decides.
        let left_half = ball.pos.x < 0.0 || ball.pos.x == 0.0 && ball.vel.x < 0.0;
        let frame = |v: Vec3| if left_half { turned(v) } else { v };
        self.rigid += 1;
        self.live.restore(&self.templates[bodies.len()]);
        let given_spin = frame(ball.spin).clamp_length_max(RIGID_SPIN_MAX);
        self.place(frame(ball.pos) - offset, frame(ball.vel), given_spin);
        for (i, body) in bodies.iter().enumerate() {
            self.place_body(i, body, left_half, offset);
        }
        self.live.step(&mut self.workspace);
        let touch = self.touch(bodies);
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

    fn place_body(&mut self, place: usize, body: &BallObstacle, left_half: bool, offset: Vec3) {
        let turn = |v: Vec2| if left_half { -v } else { v };
        let Some(handle) = self.live.bodies[place] else { return };
        if let Some(proxy) = self.live.rigid.get_mut(handle) {
            let middle = turn(body.pos).extend(body.height_m - 0.5 * BODY_LENGTH);
            proxy.set_translation(middle - offset, true);
            proxy.set_linvel(turn(body.vel).extend(0.0), true);
        }
    }

    /// The contacts of the tick just simulated.
    fn touch(&self, bodies: &[BallObstacle]) -> Option<RigidTouch> {
        let world = &self.live;
        let mut strongest = 0.0;
        let mut contact = None;
        let mut held_up = false;
        let (mut by_body, mut by_goal) = (false, false);
        for pair in world.narrow_phase.contact_pairs_with(world.ball_collider) {
            let (impulse, normal) = pair.max_impulse();
            if impulse <= 0.0 {
                continue;
            }
            let ball_first = pair.collider1 == world.ball_collider;
            held_up |= if ball_first { -normal.z } else { normal.z } > FLAT;
            let other = if ball_first { pair.collider2 } else { pair.collider1 };
            let Some(part) = world.part(other) else { continue };
            let met = match part {
                ColliderPart::Frame => Some(Contact::Woodwork),
                ColliderPart::Net => Some(Contact::Net),
                ColliderPart::Body(place) => bodies.get(place).map(|body| Contact::Body(body.id)),
            };
            by_body |= matches!(part, ColliderPart::Body(_));
            by_goal |= !matches!(part, ColliderPart::Body(_));
            if impulse > strongest {
                strongest = impulse;
                contact = met;
            }
        }
        contact.map(|contact| RigidTouch { contact, held_up, squeezed: by_body && by_goal })
    }
}

/// A contact whose normal is steeper than this (its z) holds a ball up.
const FLAT: f32 = 0.5;
