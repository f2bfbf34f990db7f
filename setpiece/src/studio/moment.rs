//! Moments as pages get them: what stays the same once, and what moves in few digits.

use crate::render::Scene;
use crate::render::scene::{Id, Mode, Pitch, Posture, Role, ScenePlayer, Side, Term};
use serde::{Serialize, Serializer};

/// What stays the same of a player.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RosterReply {
    /// The player.
    pub id: Id,
    /// The number on their shirt.
    pub number: u8,
    /// Their role.
    pub role: Role,
}

/// The pitch of some scenes of one episode.
pub fn pitch(scenes: &[Scene]) -> Pitch {
    scenes.first().map(|scene| scene.pitch).unwrap_or_default()
}

/// Everyone of some scenes, in the order of their players.
pub fn roster(scenes: &[Scene]) -> Vec<RosterReply> {
    let players = scenes.first().map_or(&[][..], |scene| &scene.players);
    let entry = |player: &ScenePlayer| RosterReply {
        id: player.id,
        number: player.number,
        role: player.role,
    };
    players.iter().map(entry).collect()
}

/// A moment.
#[derive(Clone, Debug, Serialize)]
pub struct MomentReply {
    /// Steps since the start.
    pub step: u32,
    /// The ball's centre, metres.
    pub ball: [Short; 3],
    /// Who has it.
    pub owner: Option<Id>,
    /// Everyone, in the order of the roster.
    pub players: Vec<PlayerReply>,
    /// Goals, left and right.
    pub score: [u16; 2],
    /// Open play, or the set piece that is waiting.
    pub mode: Mode,
    /// The team that had the ball last.
    pub possession: Option<Side>,
    /// What each term paid in this step.
    pub rewards: Vec<Term>,
    /// Whether ball and players were placed since the moment before.
    pub placed: bool,
}

/// A player: x, y, their velocity, the way they face, their posture, yellow cards, whether they
/// play, whether an agent plays them.
#[derive(Clone, Debug, Serialize)]
pub struct PlayerReply(Short, Short, Short, Short, Short, Short, Posture, u8, bool, bool);

impl From<&Scene> for MomentReply {
    fn from(scene: &Scene) -> MomentReply {
        let player = |player: &ScenePlayer| {
            let ([x, y], [vx, vy], [fx, fy]) = (player.pos, player.vel, player.facing);
            PlayerReply(
                Short(x),
                Short(y),
                Short(vx),
                Short(vy),
                Short(fx),
                Short(fy),
                player.posture,
                player.yellow_cards,
                player.present,
                player.agent,
            )
        };
        MomentReply {
            step: scene.step,
            ball: scene.ball.pos.map(Short),
            owner: scene.ball.owner,
            players: scene.players.iter().map(player).collect(),
            score: scene.score,
            mode: scene.mode,
            possession: scene.possession,
            rewards: scene.rewards.clone(),
            placed: scene.placed,
        }
    }
}

/// A number that is written with two decimals: centimetres.
#[derive(Clone, Copy, Debug)]
pub struct Short(f32);

impl Serialize for Short {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f32((self.0 * 100.0).round() / 100.0)
    }
}
