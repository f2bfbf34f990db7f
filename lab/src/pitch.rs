//! A scenario being measured: compiled from a text or the library, stepped with actions.

use glam::{Vec2, Vec3};
use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::engine::state::event::Event;
use setpiece::engine::state::{Match, Player};
use setpiece::scenario::vocabulary::Action;

/// How much further out than the ball a GRF script places a player: 55 and 84.96 m for 54.4 and
/// 83.6 m.
const PLACED: [f64; 2] = [55.0 / 54.4, 84.96 / 83.6];

/// An error message.
pub(crate) type LabError = String;

/// The environment of a library scenario with parameters.
pub(crate) fn library(name: &str, params: &[(&str, String)]) -> Result<Environment, LabError> {
    let loaded = setpiece::load(name).map_err(|why| format!("{name}: {why}"))?;
    let pairs = params.iter().map(|(key, value)| (*key, value.as_str()));
    let bindings =
        setpiece::bind(&loaded.scenario, pairs).map_err(|why| format!("{name}: {why}"))?;
    let options = EnvironmentOptions { bindings: Some(bindings), ..EnvironmentOptions::default() };
    Environment::new(loaded.scenario, options).map_err(|why| format!("{name}: {why}"))
}

/// The environment of a scenario's text.
pub(crate) fn text(source: &str) -> Result<Environment, LabError> {
    let loaded = setpiece::compile_text(source, "<lab>").map_err(|why| why.to_string())?;
    Environment::new(loaded.scenario, EnvironmentOptions::default()).map_err(|why| why.to_string())
}

/// The environment of a text whose players stand where a GRF script places them: on a wider scale
/// than the ball.
pub(crate) fn script(source: &str) -> Result<Environment, LabError> {
    let mut pieces = source.split(" at (");
    let mut placed = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let of_ball = placed.ends_with("ball");
        placed.push_str(" at (");
        let point =
            piece.split_once(')').and_then(|(point, rest)| Some((point.split_once(", ")?, rest)));
        match point
            .and_then(|((x, y), rest)| Some((x.parse::<f64>().ok()?, y.parse::<f64>().ok()?, rest)))
        {
            Some((x, y, rest)) if !of_ball => {
                placed.push_str(&format!("{:.4}, {:.4}){rest}", x * PLACED[0], y * PLACED[1]));
            }
            _ => placed.push_str(piece),
        }
    }
    text(&placed)
}

/// A running episode whose first agent is controlled by hand.
pub(crate) struct Trial {
    environment: Environment,
    scratch: Scratch,
}

impl Trial {
    /// Begins the first episode of a seed.
    pub(crate) fn new(mut environment: Environment, seed: u64) -> Result<Trial, LabError> {
        environment.reset(Some(seed), None).map_err(|why| why.to_string())?;
        Ok(Trial { environment, scratch: Scratch::default() })
    }

    /// Begins the first episode of another seed.
    pub(crate) fn again(&mut self, seed: u64) -> Result<(), LabError> {
        self.environment.reset(Some(seed), None).map_err(|why| why.to_string())
    }

    /// Plays a step; false once the episode has ended.
    pub(crate) fn step(&mut self, action: Action) -> Result<bool, LabError> {
        self.step_all(&[action])
    }

    /// Plays a step of several agents, the left team's first; false once the episode has ended.
    pub(crate) fn step_all(&mut self, actions: &[Action]) -> Result<bool, LabError> {
        if !self.environment.is_running() {
            return Ok(false);
        }
        self.environment.step(actions, &mut self.scratch).map_err(|why| why.to_string())?;
        Ok(true)
    }

    /// Plays several steps of one action.
    pub(crate) fn steps(&mut self, action: Action, count: usize) -> Result<(), LabError> {
        for _ in 0..count {
            self.step(action)?;
        }
        Ok(())
    }

    /// The match.
    pub(crate) fn state(&self) -> &Match {
        self.environment.state()
    }

    /// The events of the last step.
    pub(crate) fn events(&self) -> &[Event] {
        self.environment.events()
    }

    /// The agent's player.
    pub(crate) fn me(&self) -> Result<&Player, LabError> {
        let game = self.state();
        let id =
            game.agents.first().and_then(|slot| slot.player).ok_or("the agent has no player")?;
        Ok(game.player(id))
    }

    /// The place of the agent's player.
    pub(crate) fn place(&self) -> Result<Vec2, LabError> {
        Ok(self.me()?.pos)
    }

    /// The ball.
    pub(crate) fn ball(&self) -> Vec3 {
        self.state().ball.pos
    }
}

/// The mean of some figures.
pub(crate) fn mean(of: &[f64]) -> f64 {
    if of.is_empty() { f64::NAN } else { of.iter().sum::<f64>() / of.len() as f64 }
}

/// The standard deviation of some figures.
pub(crate) fn deviation(of: &[f64]) -> f64 {
    let middle = mean(of);
    (of.iter().map(|value| (value - middle).powi(2)).sum::<f64>()
        / (of.len() as f64 - 1.0).max(1.0))
    .sqrt()
}
