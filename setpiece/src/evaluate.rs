//! Plays what plans say: the entries of suites, and checks.

use crate::agent::ChosenAgent;
use crate::error::Error;
use crate::measure::{Estimate, measure, worst};
use crate::replay::{Recorder, Replay};
use setpiece_engine::batch::{EpisodeError, EpisodeSummary, Policy, run_episodes};
use setpiece_engine::draw::draw_params;
use setpiece_engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece_scenario::plan::{Check, Expectation, PlannedEpisodes, Played};
use setpiece_scenario::{Action, Bindings, Scenario};

/// The results of some episodes.
#[derive(Clone, Debug)]
pub struct Results {
    /// The episodes, in order.
    pub episodes: Vec<EpisodeSummary>,
    /// The names of the terms, in the order of the summaries.
    pub terms: Vec<String>,
}

/// What became of an expectation.
#[derive(Clone, Debug)]
pub struct JudgedExpectation<'a> {
    /// What was expected.
    pub expectation: &'a Expectation,
    /// What was measured; `None` if no episode has the number.
    pub measured: Option<Estimate>,
    /// Whether it holds.
    pub holds: bool,
    /// The episode that speaks most against it, by its index.
    pub worst: Option<u64>,
}

/// Plays some episodes.
///
/// - `options`: rewards, physics, agents; the parameters are those of what is played.
/// - `over_params`: every episode draws the parameters.
/// - `after`: called with every episode as it ends, from any thread.
///
/// # Errors
/// [`Error::Environment`] if the bindings don't fit, [`Error::Policy`] if the agent doesn't,
/// [`Error::Episode`] for the first episode that failed, [`Error::Threads`] if threads can't be
/// started.
pub fn play(
    what: &PlannedEpisodes,
    options: &EnvironmentOptions,
    agent: &ChosenAgent,
    over_params: bool,
    threads: usize,
    after: impl Fn() + Sync,
) -> Result<Results, Error> {
    let fault = |why| Error::Episode(Box::new(why));
    refuse_endless(&what.played.scenario)?;
    let environment = environment_of(&what.played, options, what.played.bindings.clone())?;
    let agent = agent.fit(&environment)?;
    let episodes = run_episodes(
        &environment,
        what.seed,
        0..what.count,
        threads.min(what.count.try_into().unwrap_or(usize::MAX)).max(1),
        |index| over_params.then(|| bindings(what, true, index)),
        || agent.player(),
        |_| after(),
    )
    .map_err(|why| Error::Threads(why.to_string()))?;
    let episodes = episodes.into_iter().collect::<Result<Vec<_>, _>>().map_err(fault)?;
    Ok(Results { episodes, terms: environment.term_names().to_vec() })
}

/// Refuses a scenario whose episodes nothing ends.
///
/// # Errors
/// [`Error::Episode`].
pub fn refuse_endless(scenario: &Scenario) -> Result<(), Error> {
    let has_end = !scenario.endings.list.is_empty() || scenario.start.limit.is_some();
    if has_end { Ok(()) } else { Err(Error::Episode(Box::new(EpisodeError::Endless(0)))) }
}

/// The values of the parameters in an episode.
pub fn bindings(what: &PlannedEpisodes, over_params: bool, index: u64) -> Bindings {
    let Played { scenario, bindings } = &what.played;
    if over_params {
        draw_params(&scenario.params, bindings, what.seed, index)
    } else {
        bindings.clone()
    }
}

/// Compares the results of a check with what it expects.
pub fn judge<'a>(check: &'a Check, results: &Results) -> Vec<JudgedExpectation<'a>> {
    let episodes: Vec<&EpisodeSummary> = results.episodes.iter().collect();
    let judged = check.expectations.iter().map(|expectation| {
        let goal = &expectation.goal;
        let measured = measure(&goal.measure, &episodes, &results.terms);
        let holds =
            measured.is_some_and(|measured| goal.comparison.holds(measured.value, goal.bound));
        let worst = worst(goal, &episodes, &results.terms).and_then(|at| episodes.get(at));
        JudgedExpectation {
            expectation,
            measured,
            holds,
            worst: worst.map(|episode| episode.index),
        }
    });
    judged.collect()
}

/// Plays an episode again and records it.
///
/// # Errors
/// Like [`play`].
pub fn record(
    what: &PlannedEpisodes,
    options: &EnvironmentOptions,
    agent: &ChosenAgent,
    over_params: bool,
    index: u64,
) -> Result<Replay, Error> {
    let fault = |why| Error::Episode(Box::new(why));
    let mut environment =
        environment_of(&what.played, options, bindings(what, over_params, index))?;
    environment
        .reset(Some(what.seed), Some(index))
        .map_err(|why| fault(EpisodeError::Draw(why)))?;
    let mut policy = agent.fit(&environment)?.player();
    policy.begin(&environment);
    let (mut recorder, mut scratch) = (Recorder::default(), Scratch::default());
    recorder.begin(None);
    let mut actions = vec![Action::Idle; environment.n_agents()];
    while environment.is_running() {
        for (agent, action) in actions.iter_mut().enumerate() {
            *action = policy.act(&environment, agent);
            recorder.note(*action, None);
        }
        environment.step(&actions, &mut scratch).map_err(|why| fault(EpisodeError::Step(why)))?;
    }
    Replay::of(&environment, &recorder)
}

/// An environment of what is played.
///
/// # Errors
/// [`Error::Environment`] if the options don't fit.
pub(crate) fn environment_of(
    played: &Played,
    options: &EnvironmentOptions,
    bindings: Bindings,
) -> Result<Environment, Error> {
    let options = EnvironmentOptions { bindings: Some(bindings), ..options.clone() };
    Environment::new(played.scenario.clone(), options).map_err(Error::Environment)
}
