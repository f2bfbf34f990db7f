//! The rapier world of rigid contact: one goal and the ball.
//!
//! There is only one goal, the right team's, at its place on the usual pitch. A ball in the left
//! half is turned by 180° about the centre spot, simulated with this goal, and turned back. So both
//! ends behave the same to the bit.
//! On a longer or shorter pitch everything is moved along by the difference.
//!
//! Grass isn't simulated here: [`super::flight`] handles bouncing and rolling in every mode.
//! Gravity isn't either: all forces are in the ball's velocity before rapier sees it.

use super::Contact;
use super::constants::{
    BALL_INERTIA_SHARE, BALL_MASS, BALL_RADIUS, FRAME_BOUNCE, FRAME_FRICTION, FRAME_RADIUS,
    NET_BOUNCE, NET_FRICTION, NET_HALF, TICK_S,
};
use glam::Vec3;
use rapier3d::dynamics::{
    CCDSolver, CoefficientCombineRule, ImpulseJointSet, IntegrationParameters, IslandManager,
    MassProperties, MultibodyJointSet, RigidBodyBuilder, RigidBodyHandle, RigidBodySet,
    SoftBodySet,
};
use rapier3d::geometry::{
    BroadPhaseBvh, ColliderBuilder, ColliderHandle, ColliderSet, NarrowPhase, SharedShape,
};
use rapier3d::math::Pose;
use rapier3d::pipeline::PhysicsPipeline;
use setpiece_scenario::{PitchSize, pitch};

/// x of the scene's goal line, m: that of the usual pitch, on pitches of every length.
const GOAL_X: f32 = pitch::HALF_LENGTH_M as f32;
const DEPTH: f32 = pitch::GOAL_DEPTH_M as f32;

/// How wide and high the goals are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GoalSize {
    /// y of a post's centre, m.
    post_y: f32,
    /// z of the crossbar's centre, m.
    bar_z: f32,
}

impl GoalSize {
    /// The goals of a pitch.
    pub(super) const fn of(pitch: &PitchSize) -> GoalSize {
        GoalSize { post_y: pitch.goal_half_width() as f32, bar_z: pitch.goal_height() as f32 }
    }
}

/// How far the right goal stands from its place in the scene, m.
pub(super) const fn goal_offset(pitch: &PitchSize) -> f32 {
    pitch.half_length() as f32 - GOAL_X
}

/// Lowest and highest corner of the hard parts of the right goal, m.
#[inline]
pub(super) const fn goal_bounds(pitch: &PitchSize) -> [Vec3; 2] {
    let GoalSize { post_y, bar_z } = GoalSize::of(pitch);
    let line = pitch.half_length() as f32;
    [
        Vec3::new(line - FRAME_RADIUS, -post_y - FRAME_RADIUS, 0.0),
        Vec3::new(line + DEPTH + NET_HALF, post_y + FRAME_RADIUS, bar_z + FRAME_RADIUS),
    ]
}

/// What else rapier needs: sets that stay empty, and working memory that carries nothing from step
/// to step.
pub(super) struct SolverSpace {
    pipeline: PhysicsPipeline,
    parameters: IntegrationParameters,
    impulse_joints: ImpulseJointSet,
    multibody_joints: MultibodyJointSet,
    soft: SoftBodySet,
    ccd: CCDSolver,
}

impl Default for SolverSpace {
    fn default() -> SolverSpace {
        SolverSpace {
            pipeline: PhysicsPipeline::new(),
            parameters: parameters(),
            impulse_joints: ImpulseJointSet::new(),
            multibody_joints: MultibodyJointSet::new(),
            soft: SoftBodySet::default(),
            ccd: CCDSolver::new(),
        }
    }
}

/// The parts of rapier's state that a tick changes and that must be restored before the next tick.
#[derive(Clone)]
pub(super) struct RapierWorld {
    pub(super) islands: IslandManager,
    pub(super) broad_phase: BroadPhaseBvh,
    pub(super) narrow_phase: NarrowPhase,
    pub(super) rigid: RigidBodySet,
    pub(super) colliders: ColliderSet,
    pub(super) ball: RigidBodyHandle,
    pub(super) ball_collider: ColliderHandle,
}

impl RapierWorld {
    /// Builds the world with a goal of this size, stepped once so that its trees and lists are laid
    /// out.
    pub(super) fn template(size: GoalSize, workspace: &mut SolverSpace) -> RapierWorld {
        let mut rigid = RigidBodySet::new();
        let mut colliders = ColliderSet::new();
        let goal = rigid.insert(RigidBodyBuilder::fixed());
        colliders.insert_with_parent(frame(size), goal, &mut rigid);
        colliders.insert_with_parent(net(size), goal, &mut rigid);
        let inertia = Vec3::splat(BALL_INERTIA_SHARE * BALL_MASS * BALL_RADIUS * BALL_RADIUS);
        let ball = rigid.insert(
            RigidBodyBuilder::dynamic()
                .translation(Vec3::new(0.0, 0.0, 20.0))
                .can_sleep(false)
                .additional_mass_properties(MassProperties::new(Vec3::ZERO, BALL_MASS, inertia)),
        );
        let ball_shape =
            ColliderBuilder::ball(BALL_RADIUS).density(0.0).restitution(1.0).friction(1.0);
        let ball_collider = colliders.insert_with_parent(ball_shape, ball, &mut rigid);
        let mut world = RapierWorld {
            islands: IslandManager::new(),
            broad_phase: BroadPhaseBvh::new(),
            narrow_phase: NarrowPhase::new(),
            rigid,
            colliders,
            ball,
            ball_collider,
        };
        world.step(workspace);
        world
    }

    /// Restores the template's state, part by part: that costs half as much as a whole clone.
    pub(super) fn restore(&mut self, template: &RapierWorld) {
        self.islands.clone_from(&template.islands);
        self.broad_phase.clone_from(&template.broad_phase);
        self.narrow_phase.clone_from(&template.narrow_phase);
        self.rigid.clone_from(&template.rigid);
        self.colliders.clone_from(&template.colliders);
        self.ball = template.ball;
        self.ball_collider = template.ball_collider;
    }

    /// Simulates one tick.
    pub(super) fn step(&mut self, workspace: &mut SolverSpace) {
        workspace.pipeline.step(
            Vec3::ZERO,
            &workspace.parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.rigid,
            &mut self.colliders,
            &mut workspace.impulse_joints,
            &mut workspace.multibody_joints,
            &mut workspace.soft,
            &mut workspace.ccd,
            &(),
            &(),
        );
    }

    /// What a ball that meets a collider touches.
    pub(super) fn contact(&self, collider: ColliderHandle) -> Option<Contact> {
        match self.colliders.get(collider)?.user_data {
            FRAME => Some(Contact::Woodwork),
            NET => Some(Contact::Net),
            _ => None,
        }
    }
}

/// User data of colliders.
const FRAME: u128 = 1;
const NET: u128 = 2;

/// The solver's settings. Every tick solves its contacts from scratch, so nothing is carried over.
fn parameters() -> IntegrationParameters {
    IntegrationParameters {
        dt: TICK_S,
        warmstart_coefficient: 0.0,
        num_solver_iterations: 2,
        max_ccd_substeps: 1,
        contact_clustering: false,
        contact_recycling: false,
        ..IntegrationParameters::default()
    }
}

/// Posts and crossbar.
fn frame(GoalSize { post_y, bar_z }: GoalSize) -> ColliderBuilder {
    let bar = |from: Vec3, to: Vec3| (Pose::IDENTITY, SharedShape::capsule(from, to, FRAME_RADIUS));
    let foot = |y: f32| Vec3::new(GOAL_X, y, 0.0);
    let corner = |y: f32| Vec3::new(GOAL_X, y, bar_z);
    ColliderBuilder::compound(vec![
        bar(foot(-post_y), corner(-post_y)),
        bar(foot(post_y), corner(post_y)),
        bar(corner(-post_y), corner(post_y)),
    ])
    .restitution(FRAME_BOUNCE)
    .restitution_combine_rule(CoefficientCombineRule::Min)
    .friction(FRAME_FRICTION)
    .friction_combine_rule(CoefficientCombineRule::Min)
    .user_data(FRAME)
}

/// Sides, rear and top of the net, tight between the frame and the rear.
fn net(GoalSize { post_y, bar_z }: GoalSize) -> ColliderBuilder {
    let panel = |centre: Vec3, half: Vec3| {
        (Pose::from_translation(centre), SharedShape::cuboid(half.x, half.y, half.z))
    };
    let (middle, reach) = (GOAL_X + 0.5 * DEPTH, 0.5 * DEPTH);
    let side =
        |y: f32| panel(Vec3::new(middle, y, 0.5 * bar_z), Vec3::new(reach, NET_HALF, 0.5 * bar_z));
    ColliderBuilder::compound(vec![
        side(-post_y),
        side(post_y),
        panel(
            Vec3::new(GOAL_X + DEPTH, 0.0, 0.5 * bar_z),
            Vec3::new(NET_HALF, post_y + NET_HALF, 0.5 * bar_z + NET_HALF),
        ),
        panel(Vec3::new(middle, 0.0, bar_z), Vec3::new(reach, post_y + NET_HALF, NET_HALF)),
    ])
    .restitution(NET_BOUNCE)
    .restitution_combine_rule(CoefficientCombineRule::Min)
    .friction(NET_FRICTION)
    .friction_combine_rule(CoefficientCombineRule::Min)
    .user_data(NET)
}
