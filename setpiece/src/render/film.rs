//! An episode, played and kept.

use super::scene::Scene;
use crate::Error;
use crate::engine::batch::{EpisodeError, Policy, ReadyMade, STEPS_MAX};
use crate::engine::control::agents::Agent;
use crate::engine::environment::{Environment, EnvironmentOptions, Scratch};
use crate::engine::event::Event;
use crate::engine::judge::Outcome;
use crate::engine::state::{Match, PlayerId};
use crate::scenario::pitch::PLAYERS_MAX;
use crate::scenario::vocabulary::{Action, EventKind, Role};
use crate::scenario::{Scenario, Team};
use std::sync::Arc;

/// What to play.
#[derive(Clone, Debug)]
pub struct FilmOptions {
    /// The seed.
    pub seed: u64,
    /// Which episode of the seed.
    pub episode: u64,
    /// Who plays for every agent.
    pub agent: Agent,
    /// Parameters and physics.
    pub environment: EnvironmentOptions,
    /// Stop after so many steps, whether or not the episode ends.
    pub until_step: Option<u32>,
}

/// An episode as it is drawn.
#[derive(Clone, Debug)]
pub struct Film {
    /// The scenario's name.
    pub name: String,
    /// The seed, the episode's index and who played.
    pub origin: String,
    /// The start and what every step led to; a step in which play was stopped has two: the stop, and the restart.
    pub scenes: Vec<Scene>,
    /// What happened, each with the scene that shows it best.
    pub events: Vec<(usize, Event)>,
    /// What everybody is called, by [`PlayerId::index`]: his name, else his role.
    pub names: [String; PLAYERS_MAX],
    /// Who keeps goal, by [`PlayerId::index`].
    pub keepers: [bool; PLAYERS_MAX],
    /// How the episode ended, if it did.
    pub outcome: Option<Outcome>,
}

impl Film {
    /// Steps played.
    pub fn length(&self) -> u32 {
        self.scenes.last().map_or(0, |scene| scene.step)
    }

    /// Whether a player keeps goal.
    pub fn is_keeper(&self, id: PlayerId) -> bool {
        self.keepers.get(id.index()).copied().unwrap_or_default()
    }

    /// The place among the scenes of what a step led to: where play was stopped in it, of the stop.
    pub fn moment_of(&self, step: u32) -> Option<usize> {
        self.scenes.iter().position(|scene| scene.step == step)
    }
}

/// Plays an episode and keeps every moment.
///
/// # Errors
/// [`Error::Environment`] where the options don't fit the scenario, [`Error::Episode`] where it has no start, a script
/// fails, or nothing ends it.
pub fn film(scenario: &Arc<Scenario>, options: &FilmOptions) -> Result<Film, Error> {
    let fault = |why| Error::Episode(Box::new(why));
    if options.until_step.is_none() && scenario.endings.list.is_empty() && scenario.start.limit.is_none() {
        return Err(fault(EpisodeError::Endless(0)));
    }
    let mut environment =
        Environment::new(scenario.clone(), options.environment.clone()).map_err(Error::Environment)?;
    environment.reset(Some(options.seed), Some(options.episode)).map_err(|why| fault(EpisodeError::Draw(why)))?;
    let mut policy = ReadyMade::new(options.agent);
    policy.begin(&environment);
    let agent = Agent::NAMED.iter().find(|(_, agent)| *agent == options.agent).map_or("", |(name, _)| *name);
    let episode = if options.episode == 0 { String::new() } else { format!(" · episode {}", options.episode) };
    let mut film = Film {
        name: scenario.name.clone(),
        origin: format!("seed {}{episode} · agent {agent}", options.seed),
        scenes: vec![Scene::of(environment.state(), true)],
        events: Vec::new(),
        names: names(scenario),
        keepers: keepers(scenario),
        outcome: None,
    };
    let mut scratch = Scratch::default();
    let mut actions = vec![Action::Idle; environment.n_agents()];
    while environment.is_running() && options.until_step.is_none_or(|step| environment.steps() < step) {
        for (agent, action) in actions.iter_mut().enumerate() {
            *action = policy.act(&environment, agent);
        }
        environment.step(&actions, &mut scratch).map_err(|why| fault(EpisodeError::Step(why)))?;
        film.take(&environment);
        if environment.is_running() && environment.steps() >= STEPS_MAX {
            return Err(fault(EpisodeError::Endless(STEPS_MAX)));
        }
    }
    film.outcome = environment.outcome().cloned();
    Ok(film)
}

impl Film {
    /// Keeps what a step led to.
    fn take(&mut self, environment: &Environment) {
        let (judged, now) = (environment.judged_state(), environment.state());
        let stop = self.scenes.len();
        let stopped = !std::ptr::eq::<Match>(judged, now);
        self.scenes.push(Scene::of(judged, false));
        // What a restart after the end would look like belongs to nothing.
        let goes_on = stopped && environment.is_running();
        if goes_on {
            self.scenes.push(Scene::of(now, true));
        }
        for event in environment.events() {
            let of_restart = goes_on && event.qualifier.is_none() && is_award(event.kind);
            self.events.push((stop + usize::from(of_restart), *event));
        }
    }
}

/// Whether the event is shown by how everybody stands at the restart.
fn is_award(kind: EventKind) -> bool {
    use EventKind::{Corner, FreeKick, GoalKick, Kickoff, Penalty, ThrowIn};
    matches!(kind, Kickoff | ThrowIn | Corner | GoalKick | FreeKick | Penalty)
}

fn names(scenario: &Scenario) -> [String; PLAYERS_MAX] {
    let mut names: [String; PLAYERS_MAX] = std::array::from_fn(|index| PlayerId(index as u8).in_team().to_string());
    for team in Team::ALL {
        for (id, slot) in scenario.team(*team) {
            if let Some(name) = names.get_mut(id) {
                *name = slot.name.clone().unwrap_or_else(|| slot.role.name().to_owned());
            }
        }
    }
    names
}

fn keepers(scenario: &Scenario) -> [bool; PLAYERS_MAX] {
    let mut keepers = [false; PLAYERS_MAX];
    for team in Team::ALL {
        for (id, slot) in scenario.team(*team) {
            if let Some(keeper) = keepers.get_mut(id) {
                *keeper = slot.role == Role::GK;
            }
        }
    }
    keepers
}
