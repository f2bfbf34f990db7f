//! What must be true after every step of any match.

use crate::pitch::Failure;
use setpiece::engine::event::Event;
use setpiece::engine::physics::lines::{OUT_X, OUT_Y};
use setpiece::engine::state::Match;
use setpiece::scenario::pitch::{GOAL_HALF_WIDTH_M, GOAL_HEIGHT_M, PLAYERS_MAX, RIM_X_M, RIM_Y_M};
use setpiece::scenario::vocabulary::{EventKind, Rule};

/// Steps that a set piece may wait: 20 until it is taken for the agent, and what the kick takes.
const WAIT_MAX: u16 = 26;
/// Ticks that a keeper may hold the ball: six seconds, and a step.
const HOLD_MAX: u32 = 610;
/// The fastest that a ball ever is, m/s.
const BALL_MPS: f32 = 60.0;
/// The fastest that a player ever is, m/s.
const PLAYER_MPS: f32 = 12.0;

/// What a step has shown.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Seen {
    pub(super) goals: u64,
    pub(super) set_pieces: u64,
    pub(super) cards: u64,
}

/// What is remembered from step to step.
pub(super) struct Witness {
    before: Match,
}

/// An error unless something is true.
fn must(holds: bool, why: impl FnOnce() -> String) -> Result<(), Failure> {
    if holds { Ok(()) } else { Err(why()) }
}

impl Witness {
    /// Begins at a start.
    pub(super) fn new(start: &Match) -> Result<Witness, Failure> {
        sound(start)?;
        Ok(Witness { before: start.clone() })
    }

    /// Looks at a step: the state in which it was judged, the state after a restart, and its events.
    pub(super) fn see(&mut self, judged: &Match, after: &Match, events: &[Event]) -> Result<Seen, Failure> {
        use EventKind::{Corner, FreeKick, GoalKick, Kickoff, Penalty, RedCard, ThrowIn, YellowCard};
        let before = &self.before;
        sound(judged)?;
        sound(after)?;
        clock(before, judged)?;
        people(before, judged, events)?;
        let goals = score(before, judged, events)?;
        ball(before, judged, goals)?;
        waiting(after)?;
        must(after.rule(Rule::AntiStalling), || "anti-stalling was switched off".to_owned())?;
        let of = |kinds: &[EventKind]| {
            events.iter().filter(|event| kinds.contains(&event.kind) && event.qualifier.is_none()).count() as u64
        };
        let seen = Seen {
            goals,
            set_pieces: of(&[Corner, FreeKick, GoalKick, Kickoff, Penalty, ThrowIn]),
            cards: of(&[YellowCard, RedCard]),
        };
        self.before = after.clone();
        Ok(seen)
    }
}

/// Every number is one, everyone is within the rim, the ball above the grass.
fn sound(game: &Match) -> Result<(), Failure> {
    let ball = game.ball;
    must(ball.pos.is_finite() && ball.vel.is_finite() && ball.spin.is_finite(), || format!("the ball: {ball:?}"))?;
    must(ball.pos.z >= 0.1099, || format!("the ball is in the ground: {ball:?}"))?;
    must(ball.vel.length() < BALL_MPS, || format!("the ball is too fast: {ball:?}"))?;
    let (x, y) = (RIM_X_M as f32 + 0.001, RIM_Y_M as f32 + 0.001);
    for (i, player) in game.players.iter().enumerate().filter(|(_, player)| player.active) {
        let finite = player.pos.is_finite() && player.vel.is_finite() && player.body.facing.is_finite();
        must(finite, || format!("player {i}: {:?} {:?}", player.pos, player.vel))?;
        must(player.pos.x.abs() <= x && player.pos.y.abs() <= y, || format!("player {i} is lost: {:?}", player.pos))?;
        must(player.vel.length() < PLAYER_MPS, || format!("player {i} is too fast: {:?}", player.vel))?;
        must((0.0..=1.0).contains(&player.fatigue), || format!("player {i} is tired by {}", player.fatigue))?;
        must((player.body.facing.length() - 1.0).abs() < 0.01, || format!("player {i} faces nowhere"))?;
    }
    for id in [game.owner, game.last_touch].into_iter().flatten() {
        must(game.player(id).present, || format!("{id:?} is nobody"))?;
    }
    must(game.owner.is_none_or(|id| game.player(id).active), || "a man sent off has the ball".to_owned())
}

/// A step is one step, of at most ten ticks.
fn clock(before: &Match, judged: &Match) -> Result<(), Failure> {
    must(judged.step == before.step + 1, || format!("step {} follows {}", judged.step, before.step))?;
    let ticks = judged.tick - before.tick;
    must(ticks == 10 || judged.dead && ticks <= 10, || format!("a step of {ticks} ticks"))
}

/// Nobody appears; who leaves has been sent off; cards are never taken back; nobody jumps.
fn people(before: &Match, judged: &Match, events: &[Event]) -> Result<(), Failure> {
    for i in 0..PLAYERS_MAX {
        let (was, is) = (&before.players[i], &judged.players[i]);
        must(was.present == is.present && (was.active || !is.active), || format!("player {i} has appeared"))?;
        must(is.yellow_cards >= was.yellow_cards, || format!("player {i} has lost a card"))?;
        if was.active && !is.active {
            let sent = events
                .iter()
                .any(|event| event.kind == EventKind::RedCard && event.by.is_some_and(|id| id.index() == i));
            must(sent, || format!("player {i} has left without a red card"))?;
        }
        if is.active {
            let way = is.pos.distance(was.pos);
            must(way < 2.0, || format!("player {i} has jumped {way} m: {:?} to {:?}", was.pos, is.pos))?;
        }
    }
    Ok(())
}

/// The score is the number of goals.
fn score(before: &Match, judged: &Match, events: &[Event]) -> Result<u64, Failure> {
    let goals = events.iter().filter(|event| event.kind == EventKind::Goal).count() as u64;
    let sum = |game: &Match| u64::from(game.score[0]) + u64::from(game.score[1]);
    must(sum(judged) == sum(before) + goals, || {
        format!("{:?} after {:?} and {goals} goals", judged.score, before.score)
    })?;
    Ok(goals)
}

/// The ball is on the pitch, or play has been stopped; into a goal it came through its mouth; it flies, it never jumps.
fn ball(before: &Match, judged: &Match, goals: u64) -> Result<(), Failure> {
    let pos = judged.ball.pos;
    let inside = pos.x.abs() <= OUT_X && pos.y.abs() <= OUT_Y;
    must(inside || judged.dead, || format!("the ball is out at {pos:?} and play goes on"))?;
    let in_net = pos.x.abs() > OUT_X + 0.05
        && pos.x.abs() < 57.4
        && pos.y.abs() < GOAL_HALF_WIDTH_M as f32 - 0.2
        && pos.z < GOAL_HEIGHT_M as f32 - 0.2;
    must(!in_net || goals > 0, || format!("the ball is in the goal at {pos:?} and nobody has scored"))?;
    let way = pos.distance(before.ball.pos);
    // Hands and set pieces carry it to their holder.
    let carried = judged.play.hands.is_some() || before.play.hands.is_some() || before.play.set_piece.is_some();
    let most = if carried { 12.0 } else { 6.0 };
    must(way < most, || format!("the ball has jumped {way} m: {:?} to {pos:?}", before.ball.pos))
}

/// Nothing waits for longer than it may.
fn waiting(after: &Match) -> Result<(), Failure> {
    if let Some(set_piece) = after.play.set_piece {
        must(set_piece.waited_steps <= WAIT_MAX, || format!("{set_piece:?} has waited too long"))?;
    }
    if let Some((keeper, since)) = after.play.hands.filter(|_| after.rule(Rule::SixSeconds)) {
        let held = after.tick - since;
        must(held <= HOLD_MAX, || format!("{keeper:?} holds the ball for {held} ticks"))?;
    }
    Ok(())
}
