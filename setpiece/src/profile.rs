//! What an agent does: touches, passes, shots, actions, ends and rewards of some episodes.

mod figures;
mod page;

pub use figures::figures;
pub use page::{page, suite_page};

use crate::agent::{ChosenAgent, FittedAgent};
use crate::error::Error;
use crate::evaluate::refuse_endless;
use crate::measure::{Estimate, measure};
use crate::replay::{Recorder, Replay};
use crate::scene::of_match;
use crate::tracking::Tracking;
use setpiece_engine::batch::{EpisodeError, EpisodeSummary, Policy, STEPS_MAX};
use setpiece_engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece_engine::state::{Match, PlayerId};
use setpiece_engine::step::hand_over;
use setpiece_render::Scene;
use setpiece_render::scene::Pitch;
use setpiece_scenario::Scenario;
use setpiece_scenario::plan::{Measure, Quantity};
use setpiece_scenario::vocabulary::{Action, EventKind, Team, Verdict};
use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;

/// What to look at.
#[derive(Clone, Debug)]
pub struct ProfileOptions {
    /// The agent that plays every slot.
    pub agent: ChosenAgent,
    /// The indices of the episodes under the seed.
    pub episodes: Range<u64>,
    /// The seed.
    pub seed: u64,
    /// Threads; the results don't depend on them.
    pub threads: usize,
    /// Parameters, physics, the snapshot to begin from.
    pub environment: EnvironmentOptions,
}

/// What an agent did. Places are metres, its team attacks towards +x, and +y is on its right.
#[derive(Clone, Debug)]
pub struct Profile {
    /// The scenario's name.
    pub scenario: String,
    /// The agent's name.
    pub agent: String,
    /// How many episodes were played.
    pub episodes: u64,
    /// Their seed.
    pub seed: u64,
    /// The mean of the left team's goals less the right one's.
    pub score: Option<Estimate>,
    /// The mean length, seconds.
    pub length: Option<Estimate>,
    /// Endings with their verdicts and counts, the most frequent first.
    pub ends: Vec<(String, Option<Verdict>, u32)>,
    /// The mean return of an agent by term.
    pub terms: Vec<(String, f64)>,
    /// How often each action was pressed, the most frequent first.
    pub actions: Vec<(Action, u64)>,
    /// Where the players that it controlled at the time touched the ball.
    pub touches: Vec<[f32; 2]>,
    /// Their passes.
    pub passes: Vec<ProfilePass>,
    /// Their shots.
    pub shots: Vec<ProfileShot>,
    /// The measures of the pitch, of the first episode.
    pub pitch: Pitch,
}

/// What an agent did in one episode.
#[derive(Debug)]
struct WatchedEpisode {
    summary: EpisodeSummary,
    counts: [u64; Action::FULL_SET],
    touches: Vec<[f32; 2]>,
    passes: Vec<ProfilePass>,
    shots: Vec<ProfileShot>,
    pitch: Pitch,
}

/// A pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePass {
    /// Where it was struck.
    pub from: [f32; 2],
    /// Where it ended.
    pub to: [f32; 2],
    /// Whether a teammate received it.
    pub completed: bool,
}

/// A shot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileShot {
    /// Where it was struck.
    pub at: [f32; 2],
    /// How it ended: `successful` for a goal, `saved`, `blocked`, `woodwork`, `wide`.
    pub outcome: &'static str,
}

/// Plays the episodes and looks at them. `after` is called after each, from any thread.
///
/// # Errors
/// [`Error::Environment`] if the options don't fit the scenario, [`Error::Policy`] or
/// [`Error::NoBaseline`] if the agent doesn't, [`Error::Episode`] if an episode has no start, a
/// script fails or nothing ends it, [`Error::Replay`] if one is too long to be recorded,
/// [`Error::Threads`] if threads can't be started.
pub fn profile(
    scenario: &Arc<Scenario>,
    options: &ProfileOptions,
    after: impl Fn() + Sync,
) -> Result<Profile, Error> {
    refuse_endless(scenario)?;
    let environment = Environment::new(scenario.clone(), options.environment.clone())
        .map_err(Error::Environment)?;
    let agent = options.agent.fit(&environment)?;
    let names = environment.term_names().to_vec();
    let is_left = environment.roster().agents.iter().any(|(team, _)| *team == Team::Left);
    let watched = watch_all(&environment, &agent, options, &after)?;
    let mut found = Profile {
        scenario: scenario.name.clone(),
        agent: options.agent.name().to_owned(),
        episodes: watched.len() as u64,
        seed: options.seed,
        score: None,
        length: None,
        ends: Vec::new(),
        terms: Vec::new(),
        actions: Vec::new(),
        touches: Vec::new(),
        passes: Vec::new(),
        shots: Vec::new(),
        pitch: watched.first().map_or_else(Pitch::default, |first| first.pitch),
    };
    let (mut summaries, mut counts) = (Vec::new(), [0; Action::FULL_SET]);
    for episode in watched {
        found.touches.extend(episode.touches);
        found.passes.extend(episode.passes);
        found.shots.extend(episode.shots);
        for (sum, count) in counts.iter_mut().zip(episode.counts) {
            *sum += count;
        }
        summaries.push(episode.summary);
    }
    let side = if is_left { 1.0 } else { -1.0 };
    summarise(&mut found, &summaries, &names, &counts, side);
    Ok(found)
}

/// Plays the episodes on some threads; returns them in order, or the first that failed.
fn watch_all(
    environment: &Environment,
    agent: &FittedAgent,
    options: &ProfileOptions,
    after: &(impl Fn() + Sync),
) -> Result<Vec<WatchedEpisode>, Error> {
    let Range { start, end } = options.episodes;
    // Indices are taken in order, so that all before one that fails are played.
    let (next, is_over) = (AtomicU64::new(start), AtomicBool::new(false));
    let work = || {
        let (mut environment, mut policy) = (environment.clone(), agent.player());
        let (mut scratch, mut watched) = (Scratch::default(), Vec::new());
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= end || is_over.load(Ordering::Relaxed) {
                return watched;
            }
            let key = (options.seed, index);
            let episode = watch(&mut environment, &mut policy, key, &mut scratch);
            if episode.is_err() {
                is_over.store(true, Ordering::Relaxed);
            }
            watched.push((index, episode));
            after();
        }
    };
    let wanted = usize::try_from(end.saturating_sub(start)).unwrap_or(usize::MAX);
    let threads = options.threads.clamp(1, wanted.max(1));
    let mut watched = thread::scope(|scope| {
        let spawn = |_| thread::Builder::new().spawn_scoped(scope, work);
        let others = (1..threads).map(spawn).collect::<Result<Vec<_>, _>>();
        let others = others.map_err(|why| {
            is_over.store(true, Ordering::Relaxed);
            Error::Threads(why.to_string())
        })?;
        let mut all = work();
        for other in others {
            all.extend(other.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
        Ok(all)
    })?;
    watched.sort_by_key(|(index, _)| *index);
    watched.into_iter().map(|(_, episode)| episode).collect()
}

/// Plays an episode and looks at it.
fn watch(
    environment: &mut Environment,
    policy: &mut impl Policy,
    key: (u64, u64),
    scratch: &mut Scratch,
) -> Result<WatchedEpisode, Error> {
    let (mut touches, mut passes, mut shots) = (Vec::new(), Vec::new(), Vec::new());
    let (mut controlled, mut counts) = (Vec::new(), [0; Action::FULL_SET]);
    let replay = play(environment, policy, key, scratch, |it, own| {
        look(it, own, &mut touches, &mut counts);
        controlled.push(own);
    })?;
    for event in &Tracking::of(&replay)?.events {
        // Frame n is the end of step n.
        let step = (event.frame as usize).checked_sub(1);
        let own = step.and_then(|step| controlled.get(step)).copied().unwrap_or_default();
        let Some(by) = event.by.filter(|by| own.contains(*by)) else { continue };
        let at = ahead(by, downwards(event.at));
        match (event.kind, event.end) {
            ("pass", Some((to, _))) => {
                let (to, completed) = (ahead(by, downwards(to)), event.success);
                passes.push(ProfilePass { from: at, to, completed });
            }
            ("shot", _) => shots.push(ProfileShot { at, outcome: event.outcome }),
            _ => {}
        }
    }
    let mut scene = Scene::default();
    of_match(environment.state(), &mut scene);
    let summary = EpisodeSummary::of(environment);
    Ok(WatchedEpisode { summary, counts, touches, passes, shots, pitch: scene.pitch })
}

/// A place of a tracked event, where +y is the top of the picture, as the match and a page have
/// it: +y is the bottom.
fn downwards([x, y]: [f32; 2]) -> [f32; 2] {
    // Not `-y`, which turns 0 into -0.
    [x, 0.0 - y]
}

/// The place of a player's deed, as their team sees it: attacking towards +x.
fn ahead(by: PlayerId, [x, y]: [f32; 2]) -> [f32; 2] {
    let side = by.team().side() as f32;
    [side * x, side * y]
}

/// The players that agents control in a step, one bit each.
#[derive(Clone, Copy, Debug, Default)]
struct ControlledPlayers(u32);

impl ControlledPlayers {
    /// Those of the step that comes next.
    fn next(environment: &Environment) -> ControlledPlayers {
        let of = |game: &Match| {
            let players = game.agents.iter().filter_map(|slot| slot.player);
            ControlledPlayers(players.fold(0, |bits, id| bits | 1 << id.0))
        };
        if environment.steps() > 0 {
            return of(environment.state());
        }
        // An episode's first step hands the ball's player over to an agent.
        let mut game = environment.state().clone();
        hand_over(&mut game);
        of(&game)
    }

    fn contains(self, id: PlayerId) -> bool {
        self.0 & (1 << id.0) != 0
    }
}

/// Plays an episode and records it; `look` is called after each step, before the next begins, with
/// the players that agents controlled in it.
fn play(
    environment: &mut Environment,
    policy: &mut impl Policy,
    (seed, index): (u64, u64),
    scratch: &mut Scratch,
    mut look: impl FnMut((&Environment, &[Action]), ControlledPlayers),
) -> Result<Replay, Error> {
    let fault = |why| Error::Episode(Box::new(why));
    environment.reset(Some(seed), Some(index)).map_err(|why| fault(EpisodeError::Draw(why)))?;
    policy.begin(environment);
    let mut recorder = Recorder::default();
    recorder.begin(environment.options().from.clone().as_deref());
    let mut actions = vec![Action::Idle; environment.n_agents()];
    while environment.is_running() {
        for (agent, action) in actions.iter_mut().enumerate() {
            *action = policy.act(environment, agent);
            recorder.note(*action, None);
        }
        let own = ControlledPlayers::next(environment);
        environment.step(&actions, scratch).map_err(|why| fault(EpisodeError::Step(why)))?;
        look((environment, &actions), own);
        if environment.is_running() && environment.steps() >= STEPS_MAX {
            return Err(fault(EpisodeError::Endless(STEPS_MAX)));
        }
    }
    Replay::of(environment, &recorder)
}

/// Counts the actions and touches of a step.
fn look(
    (environment, actions): (&Environment, &[Action]),
    own: ControlledPlayers,
    touches: &mut Vec<[f32; 2]>,
    counts: &mut [u64; Action::FULL_SET],
) {
    for action in actions {
        if let Some(count) = counts.get_mut(action.index()) {
            *count += 1;
        }
    }
    for event in environment.events().iter().filter(|event| event.kind == EventKind::Touch) {
        if let Some(by) = event.by.filter(|by| own.contains(*by)) {
            touches.push(ahead(by, [event.at.x, event.at.y]));
        }
    }
}

/// Fills in what is a sum or a mean over all episodes.
fn summarise(
    found: &mut Profile,
    summaries: &[EpisodeSummary],
    names: &[String],
    counts: &[u64; Action::FULL_SET],
    side: f64,
) {
    let episodes: Vec<&EpisodeSummary> = summaries.iter().collect();
    found.score = measure(&Measure::Mean(Quantity::Score), &episodes, names).map(|score| {
        let (low, high) = (side * score.low, side * score.high);
        Estimate { value: side * score.value, low: low.min(high), high: low.max(high), ..score }
    });
    found.length = measure(&Measure::Mean(Quantity::Length), &episodes, names);
    for episode in summaries {
        let known = found.ends.iter_mut().find(|(name, ..)| *name == episode.outcome);
        match known {
            Some((.., count)) => *count += 1,
            None => found.ends.push((episode.outcome.clone(), episode.verdict, 1)),
        }
    }
    found.ends.sort_by(|a, b| b.2.cmp(&a.2).then_with(|| a.0.cmp(&b.0)));
    let rows = summaries.iter().map(|episode| episode.terms.len()).sum::<usize>().max(1) as f64;
    let term = |at: usize| {
        let paid = summaries.iter().flat_map(|episode| &episode.terms);
        paid.filter_map(|terms| terms.get(at)).sum::<f64>() / rows + 0.0
    };
    found.terms = names.iter().enumerate().map(|(at, name)| (name.clone(), term(at))).collect();
    let pressed = Action::ALL.iter().map(|action| (*action, counts[action.index()]));
    found.actions = pressed.filter(|(_, count)| *count > 0).collect();
    // Stable: of equal counts the first action stays first.
    found.actions.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
}
