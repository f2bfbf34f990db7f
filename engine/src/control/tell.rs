//! The bot's play, expressed as an agent's actions: one press per step, relative to what is held.
//!
//! Decides how an intent, a planned kick and a slide are expressed in Google Research Football's
//! actions. It changes nothing of the match but its record of presses. A kick is pressed once, in
//! the step in which it is planned. If the held direction would send it elsewhere, it is pressed
//! one step later, after the direction that it needs. A clearance becomes a lofted pass, the
//! nearest thing that an agent can do.

use crate::control::behavior::steer::{Gait, rest, towards};
use crate::control::{agents, sticky};
use crate::football::{pace, pass_target, shot};
use crate::state::player::{Intent, KickKind, KickPlan, Pose};
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::Ai;
use setpiece_scenario::vocabulary::Action;

/// Nearer than this to their target, players stand, metres.
const THERE_M: f32 = 1.0;
/// A ball this near is at the player's feet; they run as they want to dribble, metres.
const AT_FEET_M: f32 = 1.2;
/// A player chasing a ball at another's feet predicts this far ahead, seconds.
const CHASE_AHEAD_S: f32 = 0.3;
/// Slower wishes count as standing, m/s.
const STAND_MPS: f32 = 0.3;
/// Sprint is pressed above the first speed and released below the second, m/s.
const SPRINT_MPS: [f32; 2] = [6.0, 5.5];
/// A player with the ball at their feet dribbles closely below this speed, m/s.
const CLOSE_MPS: f32 = 4.6;

/// What was under way before the bots decided, one bit per player.
#[derive(Clone, Copy, Debug)]
pub struct BeforeBots {
    /// A kick was planned.
    armed: u32,
    /// The player was sliding.
    sliding: u32,
}

impl BeforeBots {
    /// What is under way now.
    pub fn of(game: &Match) -> BeforeBots {
        let mut before = BeforeBots { armed: 0, sliding: 0 };
        for id in game.squad.ids() {
            let body = &game.player(id).body;
            before.armed |= u32::from(body.kick.is_some()) << id.0;
            before.sliding |= u32::from(body.pose == Pose::Sliding) << id.0;
        }
        before
    }
}

/// Records what everyone played by the bot has decided as a press, and what they would hold after
/// it.
pub fn record(game: &mut Match, before: &BeforeBots) {
    for id in game.squad.ids() {
        let player = game.player(id);
        let acting = game.play.acting[id.index()];
        if !player.active || player.ai == Ai::Lazy || acting.played.is_some() {
            continue;
        }
        let presses = tell(game, before, id, acting.sticky);
        let acting = &mut game.play.acting[id.index()];
        acting.played = Some(presses.press);
        acting.chosen = presses.owed;
        acting.sticky = sticky::next(acting.sticky, presses.press);
    }
}

/// A decision expressed as presses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Presses {
    /// The press of this step.
    pub press: Action,
    /// The kick pressed in the next step, if it is still planned then.
    pub owed: Option<Action>,
}

/// Expresses what the bot has just decided for a player who holds `held`.
pub fn tell(game: &Match, before: &BeforeBots, id: PlayerId, held: u16) -> Presses {
    let press = |press| Presses { press, owed: None };
    let body = &game.player(id).body;
    let was = |what: u32| what & (1 << id.0) != 0;
    if body.pose == Pose::Sliding && !was(before.sliding) {
        return press(Action::Sliding);
    }
    if let Some(plan) = &body.kick {
        if was(before.armed) {
            // While the leg swings nothing is pressed, so that the direction stays.
            return press(game.play.acting[id.index()].chosen.unwrap_or(Action::Idle));
        }
        let kick = kick_of(plan.kind);
        return match turn_for(game, id, plan, held) {
            Some(direction) => Presses { press: direction, owed: Some(kick) },
            None => press(kick),
        };
    }
    if body.pose != Pose::Up {
        return press(Action::Idle);
    }
    let (way, speed) = wish(game, id);
    if way == Vec2::ZERO {
        return press(rest(held));
    }
    let sprint = if sticky::sprints(held) { SPRINT_MPS[1] } else { SPRINT_MPS[0] };
    let gait = if speed > sprint {
        Gait::Sprint
    } else if speed < CLOSE_MPS && game.controller() == Some(id) {
        Gait::Dribble
    } else {
        Gait::Run
    };
    press(towards(held, way * id.team().side() as f32, gait))
}

/// The direction a player wants to go, world metres, and how fast; zero if they want to stand.
fn wish(game: &Match, id: PlayerId) -> (Vec2, f32) {
    let player = game.player(id);
    match player.body.intent {
        Intent::Stand => (Vec2::ZERO, 0.0),
        Intent::Run(velocity) => standing(velocity, velocity.length()),
        Intent::Go(to, speed) => {
            let way = to - player.pos;
            let distance = way.length();
            if distance < THERE_M {
                (Vec2::ZERO, 0.0)
            } else {
                (way, speed.min(distance * pace::ARRIVAL_PER_S))
            }
        }
        Intent::Ball(speed) => for_ball(game, id, speed),
    }
}

/// The direction of a player who goes for the ball or has it.
fn for_ball(game: &Match, id: PlayerId, speed: f32) -> (Vec2, f32) {
    let player = game.player(id);
    let to_ball = game.ball.pos.truncate() - player.pos;
    if game.owner == Some(id) || game.controller() == Some(id) {
        return standing(player.body.dribble, player.body.dribble.length().min(speed));
    }
    if to_ball.length() < AT_FEET_M {
        return standing(to_ball + game.ball.vel.truncate() * CHASE_AHEAD_S, speed);
    }
    let to_meet = player.body.meet - player.pos;
    let needed = to_meet.length() / player.body.meet_s.max(0.05);
    standing(to_meet, (1.25 * needed).min(speed))
}

/// A direction and its speed; zero if it is too slow.
fn standing(way: Vec2, speed: f32) -> (Vec2, f32) {
    if way.length() < STAND_MPS { (Vec2::ZERO, 0.0) } else { (way, speed) }
}

/// The press that requests a kind of kick.
fn kick_of(kind: KickKind) -> Action {
    match kind {
        KickKind::Short => Action::ShortPass,
        KickKind::Long => Action::LongPass,
        KickKind::High | KickKind::Clear => Action::HighPass,
        KickKind::Shot => Action::Shot,
    }
}

/// The direction that must be held first for a kick to go where it should. None if it already does.
fn turn_for(game: &Match, id: PlayerId, plan: &KickPlan, held: u16) -> Option<Action> {
    let side = id.team().side() as f32;
    let from = game.player(id).pos;
    let world = |direction: Vec2| direction * side;
    let now = sticky::direction(held).map(world);
    let toward = |way: Vec2| agents::direction_action(way * side);
    let unless_held = |direction: Action| (!sticky::holds(held, direction)).then_some(direction);
    match (plan.kind, plan.mate, plan.point) {
        (KickKind::Shot, ..) => {
            let aim = |dir| shot::aim_of(&game.pitch, from, side, dir);
            let goal = aim(None);
            let between = aim(now).distance(goal) < game.pitch.goal_half_width() as f32;
            if between { None } else { Some(toward(goal - from)) }
        }
        (KickKind::Clear, ..) => unless_held(toward(plan.dir.unwrap_or(Vec2::new(side, 0.0)))),
        (_, Some(mate), point) => {
            let finds = |dir: Option<Vec2>| {
                let pressed = KickPlan { dir, mate: None, point: None, ..*plan };
                pass_target::choose(game, id, &pressed).mate == Some(mate)
            };
            if finds(now) {
                return None;
            }
            let nearest = toward(point.unwrap_or(game.player(mate).pos) - from);
            let others = agents::WAYS.iter().map(|(direction, _)| *direction);
            let found = std::iter::once(nearest).chain(others).find(|direction| {
                finds(direction.direction().map(|(x, y)| world(Vec2::new(x as f32, y as f32))))
            });
            unless_held(found.unwrap_or(nearest))
        }
        (_, None, Some(point)) => unless_held(toward(point - from)),
        (_, None, None) => plan.dir.and_then(|dir| unless_held(toward(dir))),
    }
}
