//! A concrete start: the result of drawing a scenario, from which a match begins.

use crate::physics::Conditions;
use crate::state::PlayerId;
use glam::{Vec2, Vec3};
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{Role, Rule, StartKind, Stat, Team};
use setpiece_scenario::{Ai, Others, PitchSize};

/// One concrete start.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The seed of the match's own streams.
    pub seed: u64,
    /// The episode's index, also part of their key.
    pub index: u64,
    /// The players, by id (`team * 11 + index`); `None` for empty slots.
    pub players: [Option<DrawnPlayer>; PLAYERS_MAX],
    /// The ball's centre, world metres.
    pub ball_pos: Vec3,
    /// The ball's velocity, m/s.
    pub ball_vel: Vec3,
    /// The ball's spin, rad/s.
    pub ball_spin: Vec3,
    /// Who has the ball at the start.
    pub owner: Option<PlayerId>,
    /// The kind of start.
    pub kind: StartKind,
    /// The team that takes it.
    pub taker: Option<Team>,
    /// The team that kicks off first, if the scenario says so.
    pub first_kickoff: Option<Team>,
    /// Goals at the start.
    pub score: [u16; 2],
    /// Steps on the clock at the start.
    pub elapsed_steps: u32,
    /// The bots' difficulty by team, 0..1.
    pub difficulty: [f32; 2],
    /// Rules by [`Rule::index`]; see [`Rule::default_value`].
    pub rules: [f64; Rule::ALL.len()],
    /// What nature does to the ball.
    pub conditions: Conditions,
    /// How large the pitch is.
    pub pitch: PitchSize,
    /// The episode is truncated after this many steps.
    pub limit_steps: Option<u32>,
    /// How many rounds the episode has.
    pub rounds: u32,
    /// Steps of the episode in the rounds before this one.
    pub steps_before: u32,
    /// What players without an agent or an `ai` of their own do.
    pub others: Others,
    /// Agent slots, left before right.
    pub agents: Vec<DrawnAgent>,
    /// The scenario's `let`s.
    pub lets: Vec<f64>,
}

/// A player of a concrete start.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPlayer {
    /// The player's role.
    pub role: Role,
    /// Who plays them if no agent does.
    pub ai: Ai,
    /// Whether an agent may control them.
    pub controllable: bool,
    /// Whether they are on the pitch; who isn't is as if sent off.
    pub active: bool,
    /// World metres.
    pub pos: Vec2,
    /// m/s.
    pub vel: Vec2,
    /// World radians; towards the ball if absent.
    pub heading_rad: Option<f32>,
    /// 0 fresh to 1 exhausted.
    pub fatigue: f32,
    /// Cards at the start.
    pub yellow_cards: u8,
    /// Their difficulty, 0..1.
    pub difficulty: f32,
    /// Statistics that replace the table's.
    pub stats: Vec<(Stat, f32)>,
    /// Where they stand when their team kicks off, and when the other team does. Starts in open
    /// play without layouts use `pos`.
    pub kickoff: Option<[Vec2; 2]>,
}

/// An agent of a concrete start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawnAgent {
    /// Its team.
    pub team: Team,
    /// Its player for the whole match. `None`: the match assigns a player and may switch.
    pub fixed: Option<PlayerId>,
}
