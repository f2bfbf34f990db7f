//! The internal state of a match, besides the public one.

use super::PlayerId;
use super::player::{KickKind, NEVER};
use super::recent::Recent;
use crate::physics::Forecast;
use glam::{Vec2, Vec3};
use setpiece_scenario::Others;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{Action, GameMode, Team};

/// The game's own memory of a match.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Play {
    /// Where the ball will be.
    pub forecast: Forecast,
    /// What an agent's teammates do while no agent controls them.
    pub others: Others,
    /// The pending set piece.
    pub set_piece: Option<SetPiece>,
    /// The restart that a stop of play requires.
    pub pending: Option<Restart>,
    /// The foul that was let run.
    pub advantage: Option<Advantage>,
    /// The pass under way.
    pub pass: Option<Flight>,
    /// The shot under way.
    pub shot: Option<Flight>,
    /// The last completed pass, while nobody but its receiver has touched the ball since.
    pub received: Option<Received>,
    /// The keeper who holds the ball in their hands, and since which tick.
    pub hands: Option<(PlayerId, u32)>,
    /// Who had the ball last.
    pub last_owner: Option<PlayerId>,
    /// Since which tick that player has had it.
    pub owned_since: u32,
    /// The ball's place and velocity just before its last touch, world metres and m/s. Players who
    /// haven't seen the touch yet go by these.
    pub unseen: [Vec2; 2],
    /// When the ball last bounced off a body, ticks.
    pub bounced_at: i32,
    /// Who last kicked the ball on purpose by foot (the back-pass rule).
    pub kicked_by: Option<PlayerId>,
    /// Players in an offside position when the ball was last touched, one bit each.
    pub offside: u32,
    /// Nearest to the ball in time, by team: the player who goes for it.
    pub chaser: [Option<PlayerId>; 2],
    /// The next two players to reach the ball.
    pub behind: [[Option<PlayerId>; 2]; 2],
    /// The memory of the last seconds.
    pub recent: Recent,
    /// The team that goes first in everything that both teams do: the last to touch the ball, or
    /// the one that had the restart.
    pub lead: Team,
    /// The team that has a kick-off and has not taken it yet.
    pub kick_off: Option<Team>,
    /// When the kick-off was awarded, ticks.
    pub kick_off_tick: u32,
    /// The team that kicked off first.
    pub first_kickoff: Team,
    /// The team whose slots are assigned first, and whose marks last. (GRF's teams take turns;
    /// which begins is drawn.)
    pub early: Team,
    /// Whether half-time has been.
    pub second_half: bool,
    /// Which teams are controlled by an agent in this step (not handed to the bot).
    pub led: [bool; 2],
    /// Which teams' agents call their keeper out in this step.
    pub rush: [bool; 2],
    /// Which teams' agents let a teammate press in this step.
    pub team_pressure: [bool; 2],
    /// Players driven by an agent in this step, one bit each.
    pub driven: u32,
    /// The presses of everyone who is played by presses, by id.
    pub acting: [Acting; PLAYERS_MAX],
    /// The slot of each team that is next in turn to get a player.
    pub next_slot: [u8; 2],
    /// Each team's keeper's hands that are on their way to the ball.
    pub save: [Option<Save>; 2],
}

/// The actions of a player who is played by actions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Acting {
    /// The action that their behaviour has chosen for the next step, or the bot's kick that is
    /// still to be pressed.
    pub chosen: Option<Action>,
    /// The action of the last step: their agent's, else their behaviour's, else the bot's play
    /// expressed as one.
    pub played: Option<Action>,
    /// Like [`AgentSlot::key`](super::AgentSlot::key), for scripted players.
    pub key: Option<KickKind>,
    /// What they hold after that, like [`AgentSlot::sticky`](super::AgentSlot::sticky).
    pub sticky: u16,
}

/// A pending set piece.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SetPiece {
    /// Its kind.
    pub mode: GameMode,
    /// The team that takes it.
    pub team: Team,
    /// The taker.
    pub taker: PlayerId,
    /// Where the ball lies.
    pub spot: Vec2,
    /// How many steps it has waited.
    pub waited_steps: u16,
}

/// A restart that a stop of play requires.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Restart {
    /// Its kind.
    pub mode: GameMode,
    /// The team that takes it.
    pub team: Team,
    /// Where.
    pub spot: Vec2,
}

/// A foul that was let run.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Advantage {
    /// Who committed it.
    pub by: PlayerId,
    /// The player who was fouled.
    pub victim: PlayerId,
    /// The free kick that it would be.
    pub restart: Restart,
    /// When, ticks.
    pub tick: u32,
}

/// A kick under way.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Flight {
    /// Who kicked.
    pub by: PlayerId,
    /// The intended receiver.
    pub to: Option<PlayerId>,
    /// From where.
    pub from: Vec2,
    /// When, ticks.
    pub tick: u32,
}

/// A completed pass.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Received {
    /// Who passed.
    pub from: PlayerId,
    /// Who received.
    pub by: PlayerId,
    /// How far the ball came, metres.
    pub length_m: f32,
}

/// A keeper's hands on their way to the ball.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Save {
    /// The tick at which the keeper began.
    pub from: u32,
    /// The tick up to which they had seen the touches of the ball then.
    pub saw: i32,
    /// The tick at which the hands meet the ball.
    pub at: u32,
    /// Where the ball is expected then, world metres.
    pub place: Vec3,
    /// Where the hands are then, world metres from the body.
    pub hands: Vec2,
    /// How high they are then, metres.
    pub high_m: f32,
    /// Where the keeper's body is then, world metres.
    pub spot: Vec2,
    /// Its velocity then, m/s.
    pub vel: Vec2,
    /// Whether the hands can hold the ball.
    pub holds: bool,
    /// For how many ticks the keeper lies on the ground afterwards; 0 if they stay up.
    pub lies: u8,
}

impl Play {
    /// An empty state, before `begin` fills it in.
    pub const fn blank() -> Play {
        Play {
            forecast: Forecast::blank(),
            others: Others::Bot,
            set_piece: None,
            pending: None,
            advantage: None,
            pass: None,
            shot: None,
            received: None,
            hands: None,
            unseen: [Vec2::ZERO; 2],
            bounced_at: NEVER,
            kicked_by: None,
            offside: 0,
            chaser: [None; 2],
            behind: [[None; 2]; 2],
            recent: Recent::blank(),
            last_owner: None,
            owned_since: 0,
            lead: Team::Left,
            kick_off: None,
            kick_off_tick: 0,
            first_kickoff: Team::Left,
            early: Team::Left,
            second_half: false,
            led: [false; 2],
            rush: [false; 2],
            team_pressure: [false; 2],
            driven: 0,
            acting: [Acting { chosen: None, played: None, key: None, sticky: 0 }; PLAYERS_MAX],
            next_slot: [0; 2],
            save: [None; 2],
        }
    }
}

/// Ticks since a moment that may be [`NEVER`].
pub fn ticks_since(now: u32, moment: i32) -> i32 {
    (now as i32).saturating_sub(moment.max(NEVER))
}
