//! The match: one simulation, plain data. A copy of it is a snapshot.
//!
//! Holds what the game knows, but none of its rules: [`crate::football`] and [`crate::control`]
//! change it. Inside: [`player`], [`play`] (internal state besides the public one) with [`recent`],
//! and [`event`].

pub mod event;
pub mod play;
pub mod player;
pub mod recent;
mod squad;

pub use player::{Player, PlayerId};
pub use squad::{Ids, Squad};

use crate::in_place::clone_in_place;
use crate::physics::{Ball, Conditions};
use crate::random::Stream;
use arrayvec::ArrayVec;
use glam::Vec2;
use play::Play;
use player::KickKind;
use setpiece_scenario::PitchSize;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{GameMode, PitchMeasure, Rule, Stat, Team};

/// One simulation. It has no heap data and no engine handle, so `clone` is a plain copy.
#[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Match {
    /// Ticks of 10 ms since the start, without dead time.
    pub tick: u32,
    /// Steps since the start.
    pub step: u32,
    /// Steps on the clock at the start.
    pub elapsed_at_start: u32,
    /// The episode is truncated after this many steps.
    pub limit_steps: Option<u32>,
    /// Goals, left and right.
    pub score: [u16; 2],
    /// The ball.
    pub ball: Ball,
    /// The players who take part in this episode, sent off or not.
    pub squad: Squad,
    /// Both teams, by [`PlayerId::index`]; slots outside the squad are empty.
    pub players: [Player; PLAYERS_MAX],
    /// Who has the ball now.
    pub owner: Option<PlayerId>,
    /// The team that had it last.
    pub possession: Option<Team>,
    /// Who touched it last.
    pub last_touch: Option<PlayerId>,
    /// Open play, or which set piece waits to be taken.
    pub mode: GameMode,
    /// Whether play was stopped in this step (a goal, the ball out, a foul). The restart comes
    /// after judging.
    pub dead: bool,
    /// Rules by [`Rule::index`].
    pub rules: [f64; Rule::ALL.len()],
    /// What nature does to the ball.
    pub conditions: Conditions,
    /// How large the pitch is.
    pub pitch: PitchSize,
    /// The bots' difficulty by team.
    pub difficulty: [f32; 2],
    /// The agents, left before right.
    pub agents: ArrayVec<AgentSlot, PLAYERS_MAX>,
    /// Noise of play.
    pub play_random: Stream,
    /// Decisions of bots.
    pub bot_random: Stream,
    /// Internal state: flights, set pieces, the teams' plans.
    pub play: Play,
}

clone_in_place! {
    Match {
        tick, step, elapsed_at_start, limit_steps, score, ball, squad, players, owner, possession,
        last_touch, mode, dead, rules, conditions, pitch, difficulty, agents, play_random,
        bot_random, play,
    }
}

impl Match {
    /// Whether a rule is on.
    pub fn rule(&self, rule: Rule) -> bool {
        self.rules[rule.index()] != 0.0
    }

    /// Half the pitch along each axis, metres.
    #[inline]
    pub fn half(&self) -> Vec2 {
        Vec2::new(self.pitch.half_length() as f32, self.pitch.half_width() as f32)
    }

    /// How far players may go along each axis, metres.
    #[inline]
    pub fn rim(&self) -> Vec2 {
        let (x, y) = self.pitch.rim();
        Vec2::new(x as f32, y as f32)
    }

    /// The middle of the attacked goal in a team's own frame, metres; the own goal is its negative.
    #[inline]
    pub fn goal(&self) -> Vec2 {
        Vec2::new(self.pitch.half_length() as f32, 0.0)
    }

    /// A measure of the pitch, metres.
    #[inline]
    pub fn measure(&self, measure: PitchMeasure) -> f32 {
        self.pitch.measure(measure) as f32
    }

    /// Whether a team has agents.
    pub fn has_agents(&self, team: Team) -> bool {
        self.agents.iter().any(|slot| slot.team == team)
    }

    /// The players on the pitch of a team, by id.
    pub fn team(&self, team: Team) -> impl Iterator<Item = (PlayerId, &Player)> {
        let squad = self.squad.of(team).ids();
        squad.map(|id| (id, self.player(id))).filter(|(_, player)| player.active)
    }

    /// The squad in the order of play: the leading team first.
    ///
    /// Every loop through both teams uses this order, so that a match turned by 180° gives exactly
    /// the turned result.
    pub fn order(&self) -> Ids {
        self.squad.ids_from(self.play.lead)
    }

    /// Some of the squad in the order of play.
    pub fn order_of(&self, some: Squad) -> Ids {
        some.ids_from(self.play.lead)
    }

    /// Calls `act` for those of some players who are on the pitch, by id.
    pub fn each(&mut self, of: Squad, mut act: impl FnMut(&mut Player)) {
        for id in of.ids() {
            let player = &mut self.players[id.index()];
            if player.active {
                act(player);
            }
        }
    }

    /// Both teams in the order of play.
    pub fn teams(&self) -> [Team; 2] {
        [self.play.lead, self.play.lead.other()]
    }

    /// Whether an agent or a behaviour controls a player in this step.
    pub fn is_driven(&self, id: PlayerId) -> bool {
        self.play.driven & (1 << id.0) != 0
    }

    /// A player.
    pub fn player(&self, id: PlayerId) -> &Player {
        &self.players[id.index()]
    }
}

/// Who comes on for a player, in their place in the team.
#[derive(Clone, Debug)]
pub struct ComingOn {
    /// The player they replace.
    pub player: PlayerId,
    /// 0 fresh to 1 exhausted.
    pub fatigue: f32,
    /// 0..1; as before if absent.
    pub difficulty: Option<f32>,
    /// Statistics that differ, 0..1.
    pub stats: ArrayVec<(Stat, f32), { Stat::ALL.len() }>,
}

/// An agent's slot.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct AgentSlot {
    /// Its team.
    pub team: Team,
    /// The player it controls now.
    pub player: Option<PlayerId>,
    /// Whether it keeps its player.
    pub fixed: bool,
    /// Held actions as GRF's flags, in the own frame: bit i is `StickyAction` i.
    pub sticky: u16,
    /// A direction with any angle and pace, held instead of one of the eight.
    pub steer: Option<Steer>,
    /// The kick whose key is still down since it requested that kick. A key that stays down
    /// requests only once.
    pub key: Option<KickKind>,
}

/// How an agent with continuous actions runs and kicks.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Steer {
    /// The direction, own frame; its length is the pace, from 0 to 1 (a sprint).
    pub way: Vec2,
    /// The power of a kick, 0..1; 0 lets the kicker decide.
    pub power: f32,
}
