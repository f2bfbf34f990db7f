//! Ready-made agents: idle, random, a script that runs at goal and shoots, the bot.

use crate::random::Stream;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{AGENTS, Action, StickyAction};

/// The point (1, 0) of the own frame, which the scripted agent runs to, metres.
const POINT: Vec2 = Vec2::new(54.4, 0.0);
/// The scripted agent shoots within this distance, metres.
const SHOOT_M: f32 = 16.0;

/// The eight directions in the order of their actions, as unit vectors of the own frame.
pub const WAYS: [(Action, Vec2); 8] = {
    const D: f32 = std::f64::consts::FRAC_1_SQRT_2 as f32;
    [
        (Action::Left, Vec2::new(-1.0, 0.0)),
        (Action::TopLeft, Vec2::new(-D, -D)),
        (Action::Top, Vec2::new(0.0, -1.0)),
        (Action::TopRight, Vec2::new(D, -D)),
        (Action::Right, Vec2::new(1.0, 0.0)),
        (Action::BottomRight, Vec2::new(D, D)),
        (Action::Bottom, Vec2::new(0.0, 1.0)),
        (Action::BottomLeft, Vec2::new(-D, D)),
    ]
};

/// A ready-made agent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Agent {
    /// Does nothing.
    Idle,
    /// Uniform over GRF's 19 actions.
    Random,
    /// Sprints at goal with the ball, shoots from 16 m, and chases the ball otherwise.
    RunAndShoot,
    /// The built-in bot.
    Bot,
}

impl Agent {
    /// Every agent with its name on the command line.
    pub const NAMED: &'static [(&'static str, Agent)] = &{
        let [random, idle, run_and_shoot, bot, _] = AGENTS;
        [
            (random, Agent::Random),
            (idle, Agent::Idle),
            (run_and_shoot, Agent::RunAndShoot),
            (bot, Agent::Bot),
        ]
    };

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        let named = Self::NAMED.iter().find(|(_, agent)| *agent == self);
        named.map_or("", |(name, _)| *name)
    }

    /// Finds an agent by its name.
    pub fn from_name(name: &str) -> Option<Agent> {
        Self::NAMED.iter().find(|(known, _)| *known == name).map(|&(_, agent)| agent)
    }

    /// The next action for a slot. Only [`Agent::Random`] uses `stream`.
    pub fn act(self, game: &Match, slot: usize, stream: &mut Stream) -> Action {
        match self {
            Agent::Idle => Action::Idle,
            Agent::Random => Action::from_index(stream.below(Action::DEFAULT_SET as u32) as usize)
                .unwrap_or(Action::Idle),
            Agent::RunAndShoot => run_and_shoot(game, slot),
            Agent::Bot => Action::BuiltinAi,
        }
    }
}

/// Sprints towards the middle of the goal with the ball, shoots when nearer than 16 m, and chases
/// the ball otherwise.
pub fn run_and_shoot(game: &Match, slot: usize) -> Action {
    let Some(agent) = game.agents.get(slot) else { return Action::Idle };
    let Some(id) = agent.player else { return Action::Idle };
    let side = id.team().side() as f32;
    let player = game.player(id);
    let own = player.pos * side;
    let to_goal = POINT - own;
    let has_ball = game.owner == Some(id);
    if has_ball && to_goal.length() < SHOOT_M {
        return Action::Shot;
    }
    let loose_ahead =
        game.last_touch == Some(id) && player.pos.distance_squared(game.ball.pos.truncate()) < 9.0;
    let way = if has_ball || loose_ahead { to_goal } else { game.ball.pos.truncate() * side - own };
    let wanted = direction_action(way);
    let held = agent.sticky;
    if held & (1 << (wanted.index() - Action::Left.index())) == 0 {
        wanted
    } else if held & (1 << StickyAction::Sprint.index()) == 0 {
        Action::Sprint
    } else {
        Action::Idle
    }
}

/// The direction action nearest to a direction in the own frame.
pub fn direction_action(way: Vec2) -> Action {
    let mut best = (f32::MIN, Action::Right);
    for (action, direction) in WAYS {
        let along = way.dot(direction);
        if along > best.0 {
            best = (along, action);
        }
    }
    best.1
}

/// The player that a slot controls now.
pub fn player_of(game: &Match, slot: usize) -> Option<PlayerId> {
    game.agents.get(slot).and_then(|agent| agent.player)
}
