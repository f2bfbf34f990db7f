//! An episode that people play, at the pace of the match.

use super::hands::{Hands, HeldKeys};
use super::players::ActingPolicy;
use crate::Error;
use crate::engine::batch::{EpisodeError, Policy};
use crate::engine::environment::{Environment, Scratch};
use crate::film::Film;
use crate::replay::{Recorder, Replay};
use crate::scenario::Team;
use std::time::{Duration, Instant};

/// The time of a step.
const STEP: Duration = Duration::from_millis(100);

/// The most people at one match.
const SEATS_MAX: usize = 4;

/// The match that is being played.
pub(super) struct LiveMatch {
    environment: Environment,
    player: ActingPolicy,
    /// The agents that people play, and their hands.
    seats: Vec<(usize, Hands)>,
    scratch: Scratch,
    recorder: Recorder,
    pub(super) film: Film,
    due: Instant,
}

impl LiveMatch {
    /// Begins: people play the agents of these ids, `player` the others.
    ///
    /// # Errors
    /// A sentence for the user if there is no such agent, or the start can't be drawn.
    pub(super) fn begin(
        mut environment: Environment,
        (seed, episode): (u64, u64),
        mut player: ActingPolicy,
        seats: &[String],
    ) -> Result<LiveMatch, String> {
        if seats.is_empty() || seats.len() > SEATS_MAX {
            return Err(format!("1 to {SEATS_MAX} people can play"));
        }
        let fault = |why: EpisodeError| Error::Episode(Box::new(why)).to_string();
        environment.reset(Some(seed), Some(episode)).map_err(|why| fault(why.into()))?;
        let mut taken: Vec<(usize, Hands)> = Vec::new();
        for id in seats {
            let agent = environment.agent_ids().iter().position(|known| known == id);
            let agent = agent.ok_or_else(|| format!("no agent `{id}`: see `agents {{ … }}`"))?;
            if taken.iter().any(|(other, _)| *other == agent) {
                return Err(format!("two people can't play `{id}`"));
            }
            taken.push((agent, Hands::default()));
        }
        player.begin(&environment);
        let film = Film::begun(&environment, String::new());
        let mut recorder = Recorder::default();
        recorder.begin(None);
        let due = Instant::now() + STEP;
        let scratch = Scratch::default();
        Ok(LiveMatch { environment, player, seats: taken, scratch, recorder, film, due })
    }

    /// Takes what a person holds now; a seat that isn't taken has no hands.
    pub(super) fn hold(&mut self, seat: usize, keys: HeldKeys) {
        if let Some((_, hands)) = self.seats.get_mut(seat) {
            hands.keys = keys;
        }
    }

    /// Whether the next step is due.
    pub(super) fn is_due(&self) -> bool {
        Instant::now() >= self.due
    }

    /// Plays the next step; false at the end of the episode.
    ///
    /// # Errors
    /// A sentence if a script or a policy fails.
    pub(super) fn step(&mut self) -> Result<bool, String> {
        // After a pause the match goes on from now.
        self.due = (self.due + STEP).max(Instant::now());
        let mut actions = Vec::new();
        for agent in 0..self.environment.n_agents() {
            let hands = self.seats.iter_mut().find(|(taken, _)| *taken == agent);
            let action = if let Some((_, hands)) = hands {
                hands.act(self.environment.agents()[agent].team == Team::Right)
            } else {
                self.player.act(&self.environment, agent)
            };
            self.recorder.note(action, None);
            actions.push(action);
        }
        if let Some(why) = self.player.fault() {
            return Err(why);
        }
        let played = self.environment.step(&actions, &mut self.scratch);
        let fault = |why| Error::Episode(Box::new(EpisodeError::Step(why))).to_string();
        played.map_err(fault)?;
        self.film.take(&self.environment);
        self.film.outcome = self.environment.outcome().cloned();
        Ok(self.environment.is_running())
    }

    /// What was played, as a recording.
    pub(super) fn replay(&self) -> Option<Replay> {
        Replay::of(&self.environment, &self.recorder).ok()
    }
}
