//! What a primitive presses in a step, and when it ends.

use super::actor::NodeProgress;
use super::steer::{Gait, rest, towards};
use crate::control::driver::may_play;
use crate::control::{agents, sticky};
use crate::football::pace::RUN_MPS;
use crate::football::shot;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::Action;

/// A player has arrived within this distance, metres.
const THERE_M: f32 = 1.0;
/// A marker stands this far from their opponent, metres.
const MARK_M: f32 = 1.0;
/// A marker predicts this far ahead, seconds.
const MARK_AHEAD_S: f32 = 0.25;
/// A chaser of the ball predicts this far ahead, seconds.
const CHASE_AHEAD_S: f32 = 0.3;
/// Players sprint to their opponent or the ball if it is further away than this, metres.
const HURRY_M: f32 = 1.5;
/// A ball that a player will reach first counts as theirs within this distance, metres.
const NEAR_M: f32 = 3.0;
/// A marker this near to where they should be has arrived, metres.
const AT_MARK_M: f32 = 0.7;
/// A slower opponent counts as standing, m/s.
const STROLL_MPS: f32 = 1.5;
/// A tackle is given up after this many steps.
const TACKLE_STEPS: u32 = 10;

/// What a player wants to do; world metres and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wish {
    /// Go to a place.
    MoveTo(Vec2),
    /// Run in a direction.
    Run(f32),
    /// Take the ball to a place.
    DribbleTo(Vec2),
    /// Kick the ball to a teammate.
    Pass(Action, Option<PlayerId>),
    /// Shoot, at a point if one is given.
    Shoot(Option<Vec2>),
    /// Challenge for the ball.
    Tackle,
    /// Slide once.
    Slide,
    /// Stay between an opponent and the own goal.
    Mark(Option<PlayerId>),
    /// Go for the ball.
    Press,
    /// Stand.
    Hold,
    /// Be played by the bot.
    Bot,
}

/// The result of a wish in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WishStep {
    /// The player presses this.
    Act(Action),
    /// It is done, or can't be done.
    Ended,
    /// It is impossible: a place that can't be computed.
    Impossible,
}

/// The next press of a wish.
pub fn perform(
    game: &Match,
    id: PlayerId,
    wish: Wish,
    sprint: bool,
    frame: &mut NodeProgress,
) -> WishStep {
    let body = Legs { game, id, held: game.play.acting[id.index()].sticky, sprint };
    match wish {
        Wish::MoveTo(to) => body.to(to, Gait::Run),
        Wish::Run(angle) if angle.is_nan() => WishStep::Impossible,
        Wish::Run(angle) => WishStep::Act(
            body.along(Vec2::new(libm::cosf(angle), libm::sinf(angle)) * 100.0, Gait::Run),
        ),
        Wish::DribbleTo(_) if !has_claim(game, id) => WishStep::Ended,
        Wish::DribbleTo(to) => body.to(to, Gait::Dribble),
        Wish::Pass(kick, mate) => body.pass(kick, mate, frame),
        Wish::Shoot(at) => body.shoot(at, frame),
        Wish::Tackle => body.tackle(frame),
        Wish::Slide => body.slide(frame),
        Wish::Mark(who) => body.mark(who),
        Wish::Press => WishStep::Act(body.press()),
        Wish::Hold => WishStep::Act(rest(body.held)),
        Wish::Bot => WishStep::Act(Action::BuiltinAi),
    }
}

/// Whether the ball is the player's: they have it, dribble it, are about to take it, or will reach
/// it first.
fn has_claim(game: &Match, id: PlayerId) -> bool {
    let near = game.player(id).pos.distance(game.ball.pos.truncate()) < NEAR_M;
    let taker = game.play.set_piece.is_some_and(|set_piece| set_piece.taker == id);
    game.controller() == Some(id)
        || ((near || taker || game.owner == Some(id)) && may_play(game, id))
}

/// A player and what they hold.
struct Legs<'a> {
    game: &'a Match,
    id: PlayerId,
    held: u16,
    sprint: bool,
}

impl Legs<'_> {
    fn pos(&self) -> Vec2 {
        self.game.player(self.id).pos
    }

    /// The press that runs along a world direction.
    fn along(&self, way: Vec2, gait: Gait) -> Action {
        let gait = if self.sprint { Gait::Sprint } else { gait };
        towards(self.held, way * self.id.team().side() as f32, gait)
    }

    fn to(&self, to: Vec2, gait: Gait) -> WishStep {
        let way = to - self.pos();
        if way.is_nan() {
            WishStep::Impossible
        } else if way.length() < THERE_M {
            WishStep::Ended
        } else {
            WishStep::Act(self.along(way, gait))
        }
    }

    /// After a kick has been requested, waits for it.
    fn swinging(&self, frame: &NodeProgress) -> Option<WishStep> {
        let waits = self.game.player(self.id).body.kick.is_some();
        match (frame.pressed, waits) {
            (true, true) => Some(WishStep::Act(Action::Idle)),
            (true, false) => Some(WishStep::Ended),
            (false, _) => (!has_claim(self.game, self.id)).then_some(WishStep::Ended),
        }
    }

    fn pass(&self, kick: Action, mate: Option<PlayerId>, frame: &mut NodeProgress) -> WishStep {
        let mate = mate.filter(|mate| *mate != self.id && mate.team() == self.id.team());
        let Some(mate) = mate.filter(|mate| self.game.player(*mate).active) else {
            return WishStep::Ended;
        };
        if let Some(step) = self.swinging(frame) {
            return step;
        }
        let way = (self.game.player(mate).pos - self.pos()) * self.id.team().side() as f32;
        let direction = agents::direction_action(way);
        WishStep::Act(self.aimed(direction, kick, frame))
    }

    /// Holds the direction first, then kicks.
    fn aimed(&self, direction: Action, kick: Action, frame: &mut NodeProgress) -> Action {
        if self.held & (1 << (direction.index() - Action::Left.index())) == 0 {
            return direction;
        }
        frame.pressed = true;
        kick
    }

    fn shoot(&self, at: Option<Vec2>, frame: &mut NodeProgress) -> WishStep {
        if let Some(step) = self.swinging(frame) {
            return step;
        }
        let side = self.id.team().side() as f32;
        let from = self.game.ball.pos.truncate();
        let (goal, pitch) = (self.game.goal() * side, &self.game.pitch);
        let meant = at.unwrap_or(goal);
        if meant.is_nan() {
            return WishStep::Impossible;
        }
        let off = |dir: Option<Vec2>| {
            shot::aim_of(pitch, from, side, dir.map(|dir| dir * side)).distance(meant)
        };
        let held = sticky::direction(self.held);
        // Without a point, anything between the posts will do.
        if at.is_none() && off(held) < pitch.goal_half_width() as f32 {
            frame.pressed = true;
            return WishStep::Act(Action::Shot);
        }
        let mut best: Option<(f32, Action)> = None;
        for index in Action::Left.index()..=Action::BottomLeft.index() {
            let Some(action) = Action::from_index(index) else { continue };
            let dir = action.direction().map(|(x, y)| Vec2::new(x as f32, y as f32));
            let far = off(dir);
            if best.is_none_or(|(least, _)| far < least) {
                best = Some((far, action));
            }
        }
        match best {
            // Holding nothing means the middle of the goal.
            Some((least, _)) if off(None) <= least => {
                if held.is_some() {
                    return WishStep::Act(Action::ReleaseDirection);
                }
                frame.pressed = true;
                WishStep::Act(Action::Shot)
            }
            Some((_, direction)) => WishStep::Act(self.aimed(direction, Action::Shot, frame)),
            None => WishStep::Ended,
        }
    }

    /// The player who has the ball or dribbles it.
    fn owner(&self) -> Option<PlayerId> {
        self.game.on_ball()
    }

    fn to_ball(&self) -> Action {
        let ball = &self.game.ball;
        let way = ball.pos.truncate() + ball.vel.truncate() * CHASE_AHEAD_S - self.pos();
        self.along(way, if way.length() > HURRY_M { Gait::Sprint } else { Gait::Run })
    }

    fn tackle(&self, frame: &NodeProgress) -> WishStep {
        let ours = self.owner().is_some_and(|owner| owner.team() == self.id.team());
        if ours || frame.steps >= TACKLE_STEPS {
            WishStep::Ended
        } else {
            WishStep::Act(self.to_ball())
        }
    }

    fn slide(&self, frame: &mut NodeProgress) -> WishStep {
        let up = self.game.player(self.id).is_up();
        match (frame.pressed, up) {
            (true, true) => WishStep::Ended,
            (_, false) => WishStep::Act(Action::Idle),
            (false, true) if has_claim(self.game, self.id) => WishStep::Ended,
            (false, true) => {
                frame.pressed = true;
                WishStep::Act(Action::Sliding)
            }
        }
    }

    fn press(&self) -> Action {
        match self.owner() {
            Some(owner) if owner.team() == self.id.team() => rest(self.held),
            _ => self.to_ball(),
        }
    }

    fn mark(&self, who: Option<PlayerId>) -> WishStep {
        let Some(who) = who.filter(|who| *who != self.id && self.game.player(*who).active) else {
            return WishStep::Ended;
        };
        let rival = self.game.player(who);
        let goal = -self.game.goal() * self.id.team().side() as f32;
        let ahead = rival.pos + rival.vel * MARK_AHEAD_S;
        let spot = ahead + (goal - ahead).clamp_length_max(MARK_M);
        let way = spot - self.pos();
        let (distance, speed) = (way.length(), rival.vel.length());
        let gait = if distance > HURRY_M || speed > RUN_MPS { Gait::Sprint } else { Gait::Run };
        WishStep::Act(if distance > AT_MARK_M {
            self.along(way, gait)
        } else if speed > STROLL_MPS {
            // In place: moves as the marked opponent does.
            self.along(rival.vel.normalize_or_zero() * 10.0, gait)
        } else {
            rest(self.held)
        })
    }
}
