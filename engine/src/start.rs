//! A concrete start: what a draw of a scenario gives, and what a match begins from.

use crate::state::PlayerId;
use glam::{Vec2, Vec3};
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{Role, Rule, StartKind, Stat, Team};
use setpiece_scenario::{Ai, Others};

/// One concrete start.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The seed the match's own streams are keyed by.
    pub seed: u64,
    /// The episode's index, likewise.
    pub index: u64,
    /// The players, by id (`team * 11 + index`); `None` where nobody is.
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
    /// Who takes it.
    pub taker: Option<Team>,
    /// The team that kicks off first, where the scenario says so.
    pub first_kickoff: Option<Team>,
    /// Goals at the start.
    pub score: [u16; 2],
    /// Steps on the clock at the start.
    pub elapsed_steps: u32,
    /// The bots' difficulty by team, 0..1.
    pub difficulty: [f32; 2],
    /// Rules by [`Rule::index`]; see [`Rule::default_value`].
    pub rules: [f64; Rule::ALL.len()],
    /// Truncation after so many steps.
    pub limit_steps: Option<u32>,
    /// What players without an agent do where they have no `ai` of their own.
    pub others: Others,
    /// Agent slots, left before right.
    pub agents: Vec<DrawnAgent>,
    /// The scenario's `let`s.
    pub lets: Vec<f64>,
}

/// A player of a concrete start.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPlayer {
    /// His role.
    pub role: Role,
    /// Who plays him without an agent.
    pub ai: Ai,
    /// Whether an agent may be given him.
    pub controllable: bool,
    /// World metres.
    pub pos: Vec2,
    /// m/s.
    pub vel: Vec2,
    /// World radians; towards the ball if absent.
    pub heading_rad: Option<f32>,
    /// 0 fresh to 1 exhausted.
    pub fatigue: f32,
    /// Cards he starts with.
    pub yellow_cards: u8,
    /// His difficulty, 0..1.
    pub difficulty: f32,
    /// Statistics that replace the table's.
    pub stats: Vec<(Stat, f32)>,
    /// Where he stands when his team kicks off, and when the others do; `pos` in open starts without layouts.
    pub kickoff: Option<[Vec2; 2]>,
}

/// An agent of a concrete start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawnAgent {
    /// Its team.
    pub team: Team,
    /// Its player, for ever; or `None`: the match gives it one and may switch.
    pub fixed: Option<PlayerId>,
}
