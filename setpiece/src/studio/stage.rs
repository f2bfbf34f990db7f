//! A scenario with its parameters and who plays it: what is shown of it.

use super::message::{Episode, Happened, RegionReply, RequireReply, SketchReply};
use super::moment::{MomentReply, pitch, roster};
use super::players::ActingPolicy;
use crate::drag::HeldThing;
use crate::engine::batch::EpisodeError;
use crate::engine::control::agents::Agent;
use crate::engine::draw::Drawer;
use crate::engine::environment::{Environment, EnvironmentOptions};
use crate::engine::state::PlayerId;
use crate::engine::state::event::Event;
use crate::film::{Film, FilmOptions, film_of};
use crate::render::Scene;
use crate::render::scene::Id;
use crate::replay::Replay;
use crate::scenario::{Scenario, Team, Verdict};
use crate::scene::{of_match, pitch_of};
use crate::{Error, Loaded};
use std::sync::Arc;

/// Longer episodes are shown up to here: a whole match.
pub(super) const STEPS_MAX: u32 = 3_000;
/// The attempts at a start that show how often each requirement refuses one.
const ATTEMPTS: u32 = 300;

/// A scenario, its parameters and its player.
pub(super) struct StudioStage {
    pub(super) scenario: Arc<Scenario>,
    pub(super) options: EnvironmentOptions,
    pub(super) player: ActingPolicy,
    /// How pages call the player.
    pub(super) who: String,
}

/// A failed episode in one sentence.
pub(super) fn fault(why: impl Into<EpisodeError>) -> String {
    Error::Episode(Box::new(why.into())).to_string()
}

impl StudioStage {
    /// Its environment, before an episode.
    ///
    /// # Errors
    /// A sentence, if the parameters don't fit.
    pub(super) fn environment(&self) -> Result<Environment, String> {
        Environment::new(self.scenario.clone(), self.options.clone())
            .map_err(|why| Error::Environment(why).to_string())
    }

    /// Plays an episode.
    ///
    /// # Errors
    /// A sentence, if it has no start, or a script or a policy fails.
    pub(super) fn film(
        &mut self,
        (seed, episode): (u64, u64),
    ) -> Result<(Film, Option<Replay>), String> {
        let options = FilmOptions {
            seed,
            episode,
            agent: Agent::Idle.into(),
            environment: self.options.clone(),
            until_step: Some(STEPS_MAX),
        };
        let played = film_of(&self.scenario, &options, &mut self.player, Some(&self.who))
            .map_err(|why| why.to_string())?;
        self.check()?;
        Ok(played)
    }

    /// Whether the player has failed.
    ///
    /// # Errors
    /// A sentence that says why.
    pub(super) fn check(&mut self) -> Result<(), String> {
        match self.player.fault() {
            Some(why) => Err(format!("`{}` failed: {why}", self.who)),
            None => Ok(()),
        }
    }

    /// Draws many starts: the ball and everyone, metres.
    ///
    /// # Errors
    /// A sentence, if one has no start.
    pub(super) fn cloud(&self, seed: u64, count: u32) -> Result<Vec<Vec<[f32; 2]>>, String> {
        let mut environment = self.environment()?;
        let (mut starts, mut scene) = (Vec::new(), Scene::default());
        for episode in 0..u64::from(count) {
            environment.reset(Some(seed), Some(episode)).map_err(fault)?;
            of_match(environment.state(), &mut scene);
            let [x, y, _] = scene.ball.pos;
            let players = scene.players.iter().map(|player| player.pos);
            starts.push(std::iter::once([x, y]).chain(players).collect());
        }
        Ok(starts)
    }

    /// A player of a start, or the ball, to be moved: also of a start that doesn't meet its
    /// requirements.
    ///
    /// # Errors
    /// A sentence, if the parameters don't fit, or there is no such player.
    pub(super) fn held(
        &self,
        (seed, episode): (u64, u64),
        player: Option<Id>,
    ) -> Result<HeldThing, String> {
        let environment = self.environment()?;
        let (roster, bindings) = (environment.roster(), environment.bindings());
        let mut drawer = Drawer::new(&self.scenario);
        // An attempt that is refused has drawn places, too.
        let _ = drawer.draw(&self.scenario, bindings, roster, seed, episode);
        HeldThing::of(&self.scenario, &drawer, player)
            .ok_or_else(|| "this place isn't written in this file".to_owned())
    }

    /// The regions of a start, and how often each requirement refuses one.
    ///
    /// `loaded`: where the scenario comes from.
    ///
    /// # Errors
    /// A sentence, if the parameters don't fit.
    pub(super) fn sketch(
        &self,
        loaded: &Loaded,
        (seed, episode): (u64, u64),
    ) -> Result<SketchReply, String> {
        let environment = self.environment()?;
        let (roster, bindings) = (environment.roster(), environment.bindings());
        let mut drawer = Drawer::new(&self.scenario);
        let drawn = drawer.draw(&self.scenario, bindings, roster, seed, episode);
        let pitch = pitch_of(&drawer.pitch(&self.scenario));
        let name =
            |span| loaded.sources.text(span).split_whitespace().collect::<Vec<_>>().join(" ");
        let origins = &loaded.origins;
        let mut regions: Vec<RegionReply> = Vec::new();
        for (span, shape) in loaded.regions(&drawer) {
            let name = name(span);
            // A named region in which something is drawn is one region.
            if !regions.iter().any(|known| known.name == name && known.shape == shape) {
                regions.push(RegionReply { name, shape });
            }
        }
        let found = drawer.acceptance(&self.scenario, bindings, roster, ATTEMPTS, u32::MAX);
        let unmet = drawn.err().map(|why| why.requirement);
        let requires = self.scenario.start.requires.iter().enumerate().map(|(at, require)| {
            let refused = found.refused.get(at).copied().unwrap_or_default();
            let origin = origins.requires.get(at);
            let span = origin.and_then(|origin| origin.span);
            let file = span.and_then(|span| loaded.sources.get(span.file));
            RequireReply {
                label: require.label.clone(),
                implied: origin.is_none_or(|origin| origin.help.is_some()),
                line: span.zip(file).map(|(span, file)| file.line_column(span.start).0),
                refused: f64::from(refused) / f64::from(found.attempts.max(1)),
                fails: unmet.as_ref() == Some(&require.label),
            }
        });
        Ok(SketchReply { pitch, regions, requires: requires.collect() })
    }
}

/// A film as pages get it.
pub(super) fn episode_of(film: Film, (seed, episode): (u64, u64), agent: &str) -> Episode {
    let events = film.events.iter().map(|(at, event)| happened(&film, *at, event)).collect();
    let verdict = film.outcome.as_ref().and_then(|outcome| outcome.verdict);
    Episode {
        seed,
        episode,
        agent: agent.to_owned(),
        beside: false,
        watched: false,
        name: film.name,
        names: film.names.to_vec(),
        events,
        outcome: film.outcome.as_ref().map(|outcome| outcome.label.to_string()),
        success: verdict.map(|verdict| verdict == Verdict::Success),
        pitch: pitch(&film.scenes),
        roster: roster(&film.scenes),
        scenes: film.scenes.iter().map(MomentReply::from).collect(),
    }
}

fn happened(film: &Film, at: usize, event: &Event) -> Happened {
    let name = match event.qualifier {
        Some(qualifier) => format!("{} {}", event.kind.name(), qualifier.name()),
        None => event.kind.name().to_owned(),
    };
    let label = |player: PlayerId| film.names.get(player.index()).cloned();
    Happened {
        at,
        name,
        by: event.by.and_then(label),
        team: event.team.or_else(|| event.by.map(PlayerId::team)).map(Team::name),
        place: [event.at.x, event.at.y],
    }
}
