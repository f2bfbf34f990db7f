//! The match: one simulation, plain data. A copy of it is a snapshot.

mod squad;

pub use squad::{Ids, Squad};

use crate::football::body::{Body, KickKind};
use crate::football::play::Play;
use crate::in_place::clone_in_place;
use crate::random::Stream;
use crate::start::Drawn;
use arrayvec::ArrayVec;
use glam::{Vec2, Vec3};
use setpiece_scenario::Ai;
use setpiece_scenario::pitch::{PLAYERS_MAX, TEAM_MAX};
use setpiece_scenario::vocabulary::{GameMode, Role, Rule, Team};

/// A player: `team * 11 + index`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
#[serde(try_from = "u8")]
pub struct PlayerId(pub u8);

impl TryFrom<u8> for PlayerId {
    type Error = &'static str;

    fn try_from(id: u8) -> Result<PlayerId, &'static str> {
        if usize::from(id) < PLAYERS_MAX { Ok(PlayerId(id)) } else { Err("a player's id is below 22") }
    }
}

impl PlayerId {
    /// The id of a team's player.
    pub fn new(team: Team, index: usize) -> PlayerId {
        PlayerId((team.index() * TEAM_MAX + index) as u8)
    }

    /// As an index into [`Match::players`].
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// His team.
    pub const fn team(self) -> Team {
        if self.index() < TEAM_MAX { Team::Left } else { Team::Right }
    }

    /// His place in the team, source order.
    pub const fn in_team(self) -> usize {
        self.index() % TEAM_MAX
    }
}

/// The ball: world metres, m/s, rad/s.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Ball {
    /// Its centre.
    pub pos: Vec3,
    /// Its velocity.
    pub vel: Vec3,
    /// Its spin.
    pub spin: Vec3,
}

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

    /// A player.
    pub fn player(&self, id: PlayerId) -> &Player {
        &self.players[id.index()]
    }
}

/// A player: what everyone may see of him. What `football` needs beside it stands in his `body`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Player {
    /// Is on the pitch: of the squad and not sent off.
    pub active: bool,
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
    /// The way he faces, world radians.
    pub heading_rad: f32,
    /// 0 fresh to 1 exhausted.
    pub fatigue: f32,
    /// Cards so far.
    pub yellow_cards: u8,
    /// 0..1.
    pub difficulty: f32,
    /// What `football` and `control` keep of him.
    pub body: Body,
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

impl Match {
    /// The match that a drawn start begins with; `football::begin` fills in what the game needs.
    pub fn blank(drawn: &Drawn) -> Match {
        use crate::football::noise;
        use crate::random::Purpose;
        let player = |slot: &Option<crate::start::DrawnPlayer>| {
            let drawn_player = slot.as_ref();
            Player {
                active: drawn_player.is_some(),
                role: drawn_player.map_or(Role::GK, |p| p.role),
                ai: drawn_player.map_or(Ai::Lazy, |p| p.ai),
                controllable: drawn_player.is_some_and(|p| p.controllable),
                pos: drawn_player.map_or(Vec2::ZERO, |p| p.pos),
                vel: drawn_player.map_or(Vec2::ZERO, |p| p.vel),
                heading_rad: drawn_player.and_then(|p| p.heading_rad).unwrap_or_default(),
                fatigue: drawn_player.map_or(0.0, |p| p.fatigue),
                yellow_cards: drawn_player.map_or(0, |p| p.yellow_cards),
                difficulty: drawn_player.map_or(0.0, |p| p.difficulty),
                body: Body::blank(),
            }
        };
        Match {
            tick: 0,
            step: 0,
            elapsed_at_start: drawn.elapsed_steps,
            limit_steps: drawn.limit_steps,
            score: drawn.score,
            ball: Ball { pos: drawn.ball_pos, vel: drawn.ball_vel, spin: drawn.ball_spin },
            squad: (0..).zip(&drawn.players).filter(|(_, slot)| slot.is_some()).map(|(id, _)| PlayerId(id)).collect(),
            players: std::array::from_fn(|i| player(&drawn.players[i])),
            owner: drawn.owner,
            possession: drawn.owner.map(PlayerId::team),
            last_touch: drawn.owner,
            mode: GameMode::Normal,
            dead: false,
            rules: drawn.rules,
            difficulty: drawn.difficulty,
            agents: drawn
                .agents
                .iter()
                .map(|agent| AgentSlot {
                    team: agent.team,
                    player: agent.fixed,
                    fixed: agent.fixed.is_some(),
                    sticky: 0,
                    steer: None,
                    key: None,
                })
                .collect(),
            play_random: noise::stream(drawn, Purpose::Play),
            bot_random: noise::stream(drawn, Purpose::Bot),
            play: Play::blank(),
        }
    }
}
