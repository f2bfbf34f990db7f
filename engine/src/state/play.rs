//! What the game keeps of a match beside what everyone may see.

use super::PlayerId;
use super::player::{KickKind, NEVER};
use super::recent::Recent;
use crate::physics::Forecast;
use glam::Vec2;
use setpiece_scenario::Others;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{Action, GameMode, Team};

/// The game's own memory of a match.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Play {
    /// Where the ball will be.
    pub forecast: Forecast,
    /// What team mates of an agent do without an agent.
    pub others: Others,
    /// The set piece that waits.
    pub set_piece: Option<SetPiece>,
    /// The restart that a stop of play calls for.
    pub pending: Option<Restart>,
    /// The foul that was let run.
    pub advantage: Option<Advantage>,
    /// The pass under way.
    pub pass: Option<Flight>,
    /// The shot under way.
    pub shot: Option<Flight>,
    /// The keeper who holds the ball in his hands, and since which tick.
    pub hands: Option<(PlayerId, u32)>,
    /// Who had the ball last.
    pub last_owner: Option<PlayerId>,
    /// Since which tick that player has had it.
    pub owned_since: u32,
    /// Where the ball was just before its last touch and how it moved, world metres and m/s: what somebody goes by who has
    /// not seen the touch yet.
    pub unseen: [Vec2; 2],
    /// When the ball sprang off a body last, ticks.
    pub bounced_at: i32,
    /// Who kicked the ball on purpose last (the back-pass rule), by foot.
    pub kicked_by: Option<PlayerId>,
    /// Players in an offside position when the ball was last touched, a bit each.
    pub offside: u32,
    /// Nearest to the ball in time, by team: the player who goes for it.
    pub chaser: [Option<PlayerId>; 2],
    /// The two who are there next.
    pub behind: [[Option<PlayerId>; 2]; 2],
    /// What the last seconds were like.
    pub recent: Recent,
    /// The team that goes first in everything that both do: the last to touch the ball, else whose restart it was.
    pub lead: Team,
    /// The team that has a kick-off and has not taken it yet.
    pub kick_off: Option<Team>,
    /// When that was awarded, ticks.
    pub kick_off_tick: u32,
    /// The team that kicked off first.
    pub first_kickoff: Team,
    /// The team whose slots are given out first, and whose marks last. (GRF's teams take turns; which begins is drawn.)
    pub early: Team,
    /// Whether half-time has been.
    pub second_half: bool,
    /// Which teams are led by an agent in this step (not handed to the bot).
    pub led: [bool; 2],
    /// Which teams' agents call their keeper out in this step.
    pub rush: [bool; 2],
    /// Which teams' agents have a mate press in this step.
    pub team_pressure: [bool; 2],
    /// Players whom an agent drives in this step, a bit each.
    pub driven: u32,
    /// What everyone presses who is played by presses, by id.
    pub acting: [Acting; PLAYERS_MAX],
    /// Agents' slots by turn: the next to be given a player.
    pub next_slot: [u8; 2],
    /// The keeper's plan against the ball on its way.
    pub save: [Option<Save>; 2],
}

/// The actions of a player who is played by actions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Acting {
    /// What his behaviour has chosen for the step to come, or the kick of the bot that is yet to be told.
    pub chosen: Option<Action>,
    /// What he played in the last step: his agent's action, else his behaviour's, else what is told of the bot.
    pub played: Option<Action>,
    /// As [`AgentSlot::key`](super::AgentSlot::key), for who is scripted.
    pub key: Option<KickKind>,
    /// What he holds by that, as [`AgentSlot::sticky`](super::AgentSlot::sticky).
    pub sticky: u16,
}

/// A set piece that waits to be taken.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SetPiece {
    /// Which.
    pub mode: GameMode,
    /// Whose.
    pub team: Team,
    /// Who takes it.
    pub taker: PlayerId,
    /// Where the ball lies.
    pub spot: Vec2,
    /// Steps it has waited.
    pub waited_steps: u16,
}

/// A restart that a stop of play calls for.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Restart {
    /// Which.
    pub mode: GameMode,
    /// Whose.
    pub team: Team,
    /// Where.
    pub spot: Vec2,
}

/// A foul that was let run.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Advantage {
    /// Who committed it.
    pub by: PlayerId,
    /// On whom.
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
    /// Whom it is meant for.
    pub to: Option<PlayerId>,
    /// From where.
    pub from: Vec2,
    /// When, ticks.
    pub tick: u32,
}

/// A keeper's plan against a ball on its way.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Save {
    /// The tick at which the ball meets his hands.
    pub at_tick: u32,
    /// The tick at which he moves.
    pub from_tick: u32,
    /// Where, in the ground plane.
    pub point: Vec2,
    /// Whether he will get there.
    pub reaches: bool,
    /// Whether he will hold it.
    pub holds: bool,
}

impl Play {
    /// Before `begin` has filled it in.
    pub const fn blank() -> Play {
        Play {
            forecast: Forecast::blank(),
            others: Others::Bot,
            set_piece: None,
            pending: None,
            advantage: None,
            pass: None,
            shot: None,
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
