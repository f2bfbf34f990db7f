//! An episode that a person plays, at the pace of the match.

use super::hands::{Hands, HeldKeys};
use crate::Error;
use crate::engine::batch::{EpisodeError, Policy, ReadyMade};
use crate::engine::environment::{Environment, Scratch};
use crate::film::Film;
use crate::scenario::{Action, Team};
use std::time::{Duration, Instant};

/// The time of a step.
const STEP: Duration = Duration::from_millis(100);

/// The match that is being played.
pub(super) struct LiveMatch {
    environment: Environment,
    policy: ReadyMade,
    hands: Hands,
    /// The agent that the person plays.
    agent: usize,
    scratch: Scratch,
    pub(super) film: Film,
    due: Instant,
}

impl LiveMatch {
    /// Begins: the person plays the first agent of a side, `policy` the others.
    ///
    /// # Errors
    /// A sentence for the user if the side has no agent, or the start can't be drawn.
    pub(super) fn begin(
        mut environment: Environment,
        (seed, episode): (u64, u64),
        mut policy: ReadyMade,
        side: Team,
    ) -> Result<LiveMatch, String> {
        let fault = |why: EpisodeError| Error::Episode(Box::new(why)).to_string();
        environment.reset(Some(seed), Some(episode)).map_err(|why| fault(why.into()))?;
        let agent = environment.agents().iter().position(|slot| slot.team == side);
        let agent = agent.ok_or_else(|| {
            format!("no agent plays on the {} side: see `agents {{ … }}`", side.name())
        })?;
        policy.begin(&environment);
        let film = Film::begun(&environment, String::new());
        let (hands, scratch) = (Hands::default(), Scratch::default());
        let due = Instant::now() + STEP;
        Ok(LiveMatch { environment, policy, hands, agent, scratch, film, due })
    }

    /// Takes what the person holds now.
    pub(super) fn hold(&mut self, keys: HeldKeys) {
        self.hands.keys = keys;
    }

    /// Whether the next step is due.
    pub(super) fn is_due(&self) -> bool {
        Instant::now() >= self.due
    }

    /// Plays the next step; false at the end of the episode.
    ///
    /// # Errors
    /// [`Error::Episode`] if a script fails.
    pub(super) fn step(&mut self) -> Result<bool, Error> {
        // After a pause the match goes on from now.
        self.due = (self.due + STEP).max(Instant::now());
        let turns = self.environment.agents()[self.agent].team == Team::Right;
        let pressed = self.hands.act(turns);
        let actions: Vec<Action> = (0..self.environment.n_agents())
            .map(|agent| {
                if agent == self.agent {
                    pressed
                } else {
                    self.policy.act(&self.environment, agent)
                }
            })
            .collect();
        let played = self.environment.step(&actions, &mut self.scratch);
        played.map_err(|why| Error::Episode(Box::new(EpisodeError::Step(why))))?;
        self.film.take(&self.environment);
        self.film.outcome = self.environment.outcome().cloned();
        Ok(self.environment.is_running())
    }
}
