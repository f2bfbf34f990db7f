//! Nothing waits for longer than allowed.

use super::{Step, must};
use crate::pitch::LabError;
use glam::Vec2;
use setpiece::engine::state::{Match, PlayerId};
use setpiece::scenario::Ai;
use setpiece::scenario::vocabulary::Rule;

/// Steps that a set piece may wait: 20 until it is taken for the agent, plus the kick.
const WAIT_STEPS: u32 = 27;
/// Steps for which opponents keep out of the circle at a kick-off.
const KICK_OFF_STEPS: u32 = 21;
/// Steps that a keeper may hold the ball: six seconds, and a step.
const HOLD_STEPS: u32 = 61;

/// Steps for which the ball may lie if everybody is a bot: a run over the whole pitch, plus a
/// little.
const LYING_STEPS: u32 = 180;
/// A ball that stays within this distance lies, metres.
const LIES_M: f32 = 1.0;

/// How long the game has waited, steps. Delays that only an agent can cause count only while no
/// agent does.
#[derive(Debug, Default)]
pub(super) struct Waiting {
    set_piece: u32,
    kick_off: u32,
    hands: u32,
    lying: u32,
    /// Where the ball lay at that time.
    spot: Vec2,
}

impl Waiting {
    /// Checks a step.
    pub(super) fn hold(&mut self, step: &Step) -> Result<(), LabError> {
        let game = step.judged;
        if game.dead {
            *self = Waiting::default();
        }
        let game = step.after;
        let hurried = game.rule(Rule::AntiStalling);
        let taker = game.play.set_piece.map(|set_piece| set_piece.taker);
        count(&mut self.set_piece, game, taker, hurried);
        must(self.set_piece <= WAIT_STEPS, || {
            format!("{:?} has waited too long", game.play.set_piece)
        })?;
        let keeper = game.play.hands.map(|(keeper, _)| keeper);
        count(&mut self.hands, game, keeper, game.rule(Rule::SixSeconds));
        must(self.hands <= HOLD_STEPS, || format!("{keeper:?} holds the ball for too long"))?;
        let kept = game.play.kick_off.filter(|_| hurried && game.rule(Rule::KickoffCircle));
        self.kick_off = if kept.is_some() { self.kick_off + 1 } else { 0 };
        must(self.kick_off <= KICK_OFF_STEPS, || format!("{kept:?} has not kicked off"))?;
        self.lie(game);
        must(self.lying <= LYING_STEPS, || format!("nobody goes for the ball at {}", self.spot))
    }

    /// Counts the steps in which the ball lies although there are bots, and only bots.
    fn lie(&mut self, game: &Match) {
        let ball = game.ball.pos.truncate();
        let waits = game.play.set_piece.is_some()
            || game.play.hands.is_some()
            || game.play.led != [false; 2];
        let mut there = game.players.iter().filter(|player| player.active).peekable();
        let bots = there.peek().is_some() && there.all(|player| player.ai == Ai::Bot);
        if waits || !bots || ball.distance(self.spot) > LIES_M {
            (self.lying, self.spot) = (0, ball);
        }
        self.lying += 1;
    }
}

/// Counts a step in which a player could have continued. Without the rule that hurries them, it
/// counts only if no agent and no behaviour controlled them and they aren't lazy.
fn count(steps: &mut u32, game: &Match, who: Option<PlayerId>, hurried: bool) {
    let free = |id: PlayerId| !game.is_driven(id) && game.player(id).ai != Ai::Lazy;
    let could = who.is_some_and(|id| hurried || free(id));
    *steps = if could { *steps + 1 } else { 0 };
}
