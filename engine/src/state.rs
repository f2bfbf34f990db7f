//! The match: one simulation, plain data. A copy of it is a snapshot.
//!
//! Holds what the game knows, and no rule of it: [`crate::football`] and [`crate::control`] change it. Inside:
//! [`player`], [`play`] (what the game keeps beside what everyone may see) with [`recent`], and [`event`].

pub mod event;
pub mod play;
pub mod player;
pub mod recent;
mod squad;

pub use player::{Player, PlayerId};
pub use squad::{Ids, Squad};

use crate::in_place::clone_in_place;
use crate::physics::Ball;
use crate::random::Stream;
use arrayvec::ArrayVec;
use glam::Vec2;
use play::Play;
use player::KickKind;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{GameMode, Rule, Team};

/// One simulation: no heap but the agent list's inline storage, no engine handle; `clone` is a copy.
#[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Match {
    /// Ticks of 10 ms since the start, dead time not counted.
    pub tick: u32,
    /// Steps since the start.
    pub step: u32,
    /// Steps on the clock at the start.
    pub elapsed_at_start: u32,
    /// Truncation after so many steps.
    pub limit_steps: Option<u32>,
    /// Goals, left and right.
    pub score: [u16; 2],
    /// The ball.
    pub ball: Ball,
    /// The roster of this episode: who takes part, sent off or not.
    pub squad: Squad,
    /// Both teams, by [`PlayerId::index`]; nobody is in a slot that the squad lacks.
    pub players: [Player; PLAYERS_MAX],
    /// Who has the ball now.
    pub owner: Option<PlayerId>,
    /// The team that had it last.
    pub possession: Option<Team>,
    /// Who touched it last.
    pub last_touch: Option<PlayerId>,
    /// Open play, or which set piece waits to be taken.
    pub mode: GameMode,
    /// Play was stopped in this step: a goal, the ball out, a foul; the restart comes after judging.
    pub dead: bool,
    /// Rules by [`Rule::index`].
    pub rules: [f64; Rule::ALL.len()],
    /// The bots' difficulty by team.
    pub difficulty: [f32; 2],
    /// The agents, left before right.
    pub agents: ArrayVec<AgentSlot, PLAYERS_MAX>,
    /// Noise of play.
    pub play_random: Stream,
    /// Decisions of bots.
    pub bot_random: Stream,
    /// What the game keeps beside that: flights, set pieces, the teams' plans.
    pub play: Play,
}

clone_in_place! {
    Match {
        tick, step, elapsed_at_start, limit_steps, score, ball, squad, players, owner, possession, last_touch,
        mode, dead, rules, difficulty, agents, play_random, bot_random, play,
    }
}

impl Match {
    /// Whether a rule is on.
    pub fn rule(&self, rule: Rule) -> bool {
        self.rules[rule.index()] != 0.0
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

    /// The squad in the order of play: the team that leads, then the other.
    ///
    /// Whatever goes through both teams goes by it, so that a match turned by 180° is the turned match to the bit.
    pub fn order(&self) -> Ids {
        self.squad.ids_from(self.play.lead)
    }

    /// Some of the squad in the order of play.
    pub fn order_of(&self, some: Squad) -> Ids {
        some.ids_from(self.play.lead)
    }

    /// Does something with everyone on the pitch of some players, by id.
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

    /// Whether an agent, or a behaviour, presses for a player in this step.
    pub fn is_driven(&self, id: PlayerId) -> bool {
        self.play.driven & (1 << id.0) != 0
    }

    /// A player.
    pub fn player(&self, id: PlayerId) -> &Player {
        &self.players[id.index()]
    }
}

/// An agent's slot.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct AgentSlot {
    /// Its team.
    pub team: Team,
    /// The player it controls now.
    pub player: Option<PlayerId>,
    /// Whether it may be given another.
    pub fixed: bool,
    /// Held actions as GRF's flags, in the own frame: bit i is `StickyAction` i.
    pub sticky: u16,
    /// A direction of any angle and pace, held in place of one of the eight.
    pub steer: Option<Steer>,
    /// The kick that the key asks for which has been down since it was asked for: a key that stays down asks once.
    pub key: Option<KickKind>,
}

/// How an agent with continuous actions runs and kicks.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Steer {
    /// The way, own frame; its length is the pace, 0 to 1 (a sprint).
    pub way: Vec2,
    /// The power of a kick, 0..1; 0 leaves it to the kicker.
    pub power: f32,
}
