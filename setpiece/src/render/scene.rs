//! The drawable data of a moment, copied from the match so that moments can be kept and overlaid.

use crate::engine::state::player::Pose;
use crate::engine::state::{Match, Player, PlayerId};
use crate::scenario::Team;
use crate::scenario::vocabulary::{GameMode, Role};

/// A moment of a match.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetScene {
    /// Steps since the episode's start.
    pub step: u32,
    /// Steps on the match's clock.
    pub clock_steps: u32,
    /// Goals, left and right.
    pub score: [u16; 2],
    /// Open play, or the pending set piece.
    pub mode: GameMode,
    /// Who has the ball.
    pub owner: Option<PlayerId>,
    /// The team that had it last.
    pub possession: Option<Team>,
    /// The ball's centre, world metres, z up.
    pub ball: [f32; 3],
    /// Everyone on the pitch.
    pub people: Vec<Person>,
    /// Whether the ball and the players were placed, so that no trail leads here.
    pub placed: bool,
}

/// A player to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Person {
    /// The player's id.
    pub id: PlayerId,
    /// Whether they keep goal.
    pub keeper: bool,
    /// Whether an agent controls them.
    pub agent: bool,
    /// Yellow cards so far.
    pub yellow_cards: u8,
    /// World metres.
    pub pos: [f32; 2],
    /// The direction they face, a unit vector.
    pub facing: [f32; 2],
    /// m/s.
    pub vel: [f32; 2],
    /// Their pose.
    pub pose: Pose,
}

impl SheetScene {
    /// Copies a match's current state.
    pub fn of(game: &Match, placed: bool) -> SheetScene {
        let everyone = Team::ALL.iter().flat_map(|team| game.team(*team));
        SheetScene {
            step: game.step,
            clock_steps: game.elapsed_at_start + game.step,
            score: game.score,
            mode: game.mode,
            owner: game.owner,
            possession: game.possession,
            ball: game.ball.pos.to_array(),
            people: everyone.map(|(id, player)| Person::of(game, id, player)).collect(),
            placed,
        }
    }

    /// A player, if on the pitch.
    pub fn person(&self, id: PlayerId) -> Option<&Person> {
        self.people.iter().find(|person| person.id == id)
    }
}

impl Person {
    fn of(game: &Match, id: PlayerId, player: &Player) -> Person {
        Person {
            id,
            keeper: player.role == Role::GK,
            agent: game.agents.iter().any(|agent| agent.player == Some(id)),
            yellow_cards: player.yellow_cards,
            pos: player.pos.to_array(),
            facing: player.body.facing.to_array(),
            vel: player.vel.to_array(),
            pose: player.body.pose,
        }
    }
}
