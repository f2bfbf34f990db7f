//! A played episode, kept scene by scene.

use crate::Error;
use crate::agent::ChosenAgent;
use crate::engine::batch::{EpisodeError, Policy, STEPS_MAX};
use crate::engine::environment::{Environment, EnvironmentOptions, Scratch};
use crate::engine::judge::Outcome;
use crate::engine::state::event::Event;
use crate::engine::state::{Match, PlayerId};
use crate::replay::{Recorder, Replay};
use crate::scenario::pitch::PLAYERS_MAX;
use crate::scenario::vocabulary::{Action, EventKind, Role};
use crate::scenario::{Scenario, Team};
use crate::scene::SceneWriter;
use setpiece_render::Scene;
use std::sync::Arc;

/// What to play.
#[derive(Clone, Debug)]
pub struct FilmOptions {
    /// The seed.
    pub seed: u64,
    /// The episode's index under the seed.
    pub episode: u64,
    /// The agent that plays every slot.
    pub agent: ChosenAgent,
    /// Parameters and physics.
    pub environment: EnvironmentOptions,
    /// Stop after this many steps, whether or not the episode ends.
    pub until_step: Option<u32>,
}

/// A played episode.
#[derive(Clone, Debug)]
pub struct Film {
    /// The scenario's name.
    pub name: String,
    /// The first line of its documentation.
    pub title: String,
    /// The seed, the episode's index, the agent, and the parameters that differ from their
    /// defaults.
    pub origin: String,
    /// The start and the result of every step. A step in which play was stopped has two scenes: the
    /// stop, and the restart.
    pub scenes: Vec<Scene>,
    /// The events, each with the scene that shows it best.
    pub events: Vec<(usize, Event)>,
    /// Everybody's label, by [`PlayerId::index`]: their name, else their role.
    pub names: [String; PLAYERS_MAX],
    /// Whether each player keeps goal, by [`PlayerId::index`].
    pub keepers: [bool; PLAYERS_MAX],
    /// How the episode ended, if it did.
    pub outcome: Option<Outcome>,
    writer: SceneWriter,
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

    /// The index of the scene that a step led to. If play was stopped in it, that is the stop.
    pub fn moment_of(&self, step: u32) -> Option<usize> {
        self.scenes.iter().position(|scene| scene.step == step)
    }
}

/// Plays an episode and keeps every moment.
///
/// # Errors
/// [`Error::Environment`] if the options don't fit the scenario; [`Error::Policy`] if the agent
/// doesn't; [`Error::Episode`] if it has no start, a script fails, or nothing ends it.
pub fn film(scenario: &Arc<Scenario>, options: &FilmOptions) -> Result<Film, Error> {
    let environment = Environment::new(scenario.clone(), options.environment.clone())
        .map_err(Error::Environment)?;
    let mut policy = options.agent.fit(&environment)?.player();
    Ok(film_of(scenario, options, &mut policy, Some(options.agent.name()))?.0)
}

/// Like [`film`], with any policy instead of the agent of the options, and its name. Returns what
/// was played as a recording too, unless it is longer than one may be.
///
/// # Errors
/// Like [`film`].
pub fn film_of(
    scenario: &Arc<Scenario>,
    options: &FilmOptions,
    policy: &mut impl Policy,
    who: Option<&str>,
) -> Result<(Film, Option<Replay>), Error> {
    let fault = |why| Error::Episode(Box::new(why));
    if options.until_step.is_none()
        && scenario.endings.list.is_empty()
        && scenario.start.limit.is_none()
    {
        return Err(fault(EpisodeError::Endless(0)));
    }
    let mut environment = Environment::new(scenario.clone(), options.environment.clone())
        .map_err(Error::Environment)?;
    environment
        .reset(Some(options.seed), Some(options.episode))
        .map_err(|why| fault(EpisodeError::Draw(why)))?;
    policy.begin(&environment);
    let mut film = Film::begun(&environment, origin(&environment, who));
    let mut recorder = Recorder::default();
    recorder.begin(options.environment.from.as_deref());
    let mut scratch = Scratch::default();
    let mut actions = vec![Action::Idle; environment.n_agents()];
    while environment.is_running()
        && options.until_step.is_none_or(|step| environment.steps() < step)
    {
        for (agent, action) in actions.iter_mut().enumerate() {
            *action = policy.act(&environment, agent);
            recorder.note(*action, None);
        }
        environment.step(&actions, &mut scratch).map_err(|why| fault(EpisodeError::Step(why)))?;
        film.take(&environment);
        if environment.is_running() && environment.steps() >= STEPS_MAX {
            return Err(fault(EpisodeError::Endless(STEPS_MAX)));
        }
    }
    film.outcome = environment.outcome().cloned();
    // An episode that is longer than a replay may be isn't kept.
    let replay = Replay::of(&environment, &recorder).ok();
    Ok((film, replay))
}

/// Plays a recorded episode again and keeps every moment.
///
/// # Errors
/// [`Error::Replay`] if it can't be played here, or diverges from the recording.
pub fn replayed(replay: &Replay) -> Result<Film, Error> {
    let mut film: Option<Film> = None;
    let environment = replay.play(|environment, _| match &mut film {
        None => film = Some(Film::begun(environment, origin(environment, None))),
        Some(film) => film.take(environment),
    })?;
    let mut film = film.unwrap_or_else(|| Film::begun(&environment, origin(&environment, None)));
    film.outcome = environment.outcome().cloned();
    Ok(film)
}

impl Film {
    /// The first moment of an episode.
    pub(crate) fn begun(environment: &Environment, origin: String) -> Film {
        let scenario = environment.scenario();
        let writer = SceneWriter::default();
        let mut first = Scene::default();
        writer.write(environment, &mut first);
        first.placed = true;
        Film {
            writer,
            name: scenario.name.clone(),
            title: scenario.title().to_owned(),
            origin,
            scenes: vec![first],
            events: Vec::new(),
            names: names(scenario),
            keepers: keepers(scenario),
            outcome: None,
        }
    }

    /// Keeps the result of a step.
    pub(crate) fn take(&mut self, environment: &Environment) {
        let (judged, now) = (environment.judged_state(), environment.state());
        let stop = self.scenes.len();
        let stopped = !std::ptr::eq::<Match>(judged, now);
        self.writer.note(environment);
        let mut scene = Scene::default();
        self.writer.write_judged(environment, &mut scene);
        self.scenes.push(scene);
        // A restart after the end isn't part of the episode.
        let goes_on = stopped && environment.is_running();
        if goes_on {
            let mut scene = Scene::default();
            self.writer.write(environment, &mut scene);
            scene.placed = true;
            self.scenes.push(scene);
        }
        for event in environment.events() {
            let of_restart = goes_on && event.qualifier.is_none() && is_award(event.kind);
            self.events.push((stop + usize::from(of_restart), *event));
        }
    }
}

/// Whether the event is best shown by everyone's places at the restart.
fn is_award(kind: EventKind) -> bool {
    use EventKind::{Corner, FreeKick, GoalKick, Kickoff, Penalty, ThrowIn};
    matches!(kind, Kickoff | ThrowIn | Corner | GoalKick | FreeKick | Penalty)
}

/// The seed, the episode's index, the agent that played every slot, if one did, and the parameters
/// that differ from their defaults.
fn origin(environment: &Environment, who: Option<&str>) -> String {
    let mut origin = format!("seed {}", environment.seed());
    if environment.index() > 0 {
        origin += &format!(" · episode {}", environment.index());
    }
    if let Some(name) = who {
        origin += &format!(" · agent {name}");
    }
    for (param, &value) in environment.scenario().params.iter().zip(&environment.bindings().0) {
        if value != param.default {
            origin += &format!(" · {} {}", param.name, param.show(value));
        }
    }
    origin
}

/// Everybody's label, by [`PlayerId::index`]: their name, else their role.
pub fn names(scenario: &Scenario) -> [String; PLAYERS_MAX] {
    let mut names: [String; PLAYERS_MAX] =
        std::array::from_fn(|index| PlayerId(index as u8).in_team().to_string());
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::control::agents::Agent;
    use setpiece_render::scene::Mode;

    fn played(text: &str, until_step: Option<u32>) -> Result<Film, Error> {
        let options = FilmOptions {
            seed: 1,
            episode: 2,
            agent: Agent::Idle.into(),
            environment: EnvironmentOptions::default(),
            until_step,
        };
        film(&crate::compile_text(text, "test.pitch").unwrap().scenario, &options)
    }

    const ROLLS_OUT: &str = "scenario rolls_out {
        ball at (0, 0.4) { velocity: (0m/s, 8m/s) }
        team left { anna: CM at (-0.5, 0) }
        team right { GK at (0.9, 0) }
        END
    }";

    #[test]
    fn a_stop_is_kept_and_so_is_the_restart() {
        let film = played(&ROLLS_OUT.replace("END", "end limit 2s"), None).unwrap();
        let (out, _) =
            film.events.iter().find(|(_, event)| event.kind == EventKind::OutOfPlay).unwrap();
        let (award, _) =
            film.events.iter().find(|(_, event)| event.kind == EventKind::ThrowIn).unwrap();
        let (stop, restart) = (&film.scenes[*out], &film.scenes[*award]);
        assert!(stop.ball.pos[1] > 36.0 && !stop.placed, "{stop:?}");
        assert!(
            restart.ball.pos[1] <= 36.0 && restart.placed && restart.mode == Mode::ThrowIn,
            "{restart:?}"
        );
        assert_eq!((stop.step, *award), (restart.step, out + 1));
        assert_eq!((film.moment_of(stop.step), film.length()), (Some(*out), 20));
        assert_eq!(film.moment_of(21), None);
    }

    #[test]
    fn the_stop_that_ends_an_episode_is_its_last_moment() {
        let film =
            played(&ROLLS_OUT.replace("END", "end failure out when out_of_play"), None).unwrap();
        let last = film.scenes.last().unwrap();
        assert!(last.ball.pos[1] > 36.0 && !last.placed, "{last:?}");
        assert_eq!(&*film.outcome.unwrap().label, "out");
    }

    #[test]
    fn players_are_labelled_as_the_author_names_them() {
        let film = played(ROLLS_OUT.replace("END", "").as_str(), Some(3)).unwrap();
        assert_eq!((film.names[0].as_str(), film.names[11].as_str()), ("anna", "GK"));
        assert!(film.is_keeper(PlayerId(11)) && !film.is_keeper(PlayerId(0)));
        assert_eq!((film.length(), film.origin.as_str()), (3, "seed 1 · episode 2 · agent idle"));
    }

    #[test]
    fn an_episode_without_an_end_is_no_film_but_has_moments() {
        let endless = ROLLS_OUT.replace("END", "");
        assert!(matches!(played(&endless, None), Err(Error::Episode(_))));
        assert_eq!(played(&endless, Some(5)).unwrap().scenes.last().unwrap().step, 5);
    }
}
