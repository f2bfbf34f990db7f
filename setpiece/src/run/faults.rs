//! Which rewards and observed numbers of a run could not be computed, found by playing again.

use super::{RunOptions, Summary};
use crate::error::Error;
use setpiece_engine::batch::Policy;
use setpiece_engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece_scenario::vocabulary::Action;
use setpiece_scenario::{Instr, Scenario};
use std::sync::Arc;

/// In how many episodes a run looks for numbers that can't be observed.
const OBSERVED_EPISODES: usize = 5;

/// A part of a reward whose value wasn't finite.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FaultyTerm {
    /// The reward.
    pub reward: String,
    /// The label of the term; absent for a `state` of the reward.
    pub term: Option<String>,
    /// The episode, the run's first with faults.
    pub episode: u64,
    /// The first step of the episode with this fault, counted from 1.
    pub step: usize,
}

/// The parts of rewards whose values weren't finite, of the first episode with such faults.
///
/// The episode is played again with each reward and each term alone: what is paid doesn't change
/// what the agents do.
///
/// # Errors
/// Like [`run`](super::run).
pub fn faulty_terms(
    scenario: &Arc<Scenario>,
    options: &RunOptions,
    summary: &Summary,
) -> Result<Vec<FaultyTerm>, Error> {
    let Some(faulty) = summary.episodes.iter().flatten().find(|episode| episode.faults > 0) else {
        return Ok(Vec::new());
    };
    let counts = |scenario: &Arc<Scenario>, rewards: Vec<String>| {
        faults_by_step(scenario, options, faulty.index, rewards)
    };
    let own = || scenario.rewards.iter().map(|reward| reward.name.clone()).collect();
    let names: Vec<String> = options.environment.rewards.clone().unwrap_or_else(own);
    // Behaviours have faults, too, whatever is paid.
    let others = counts(scenario, Vec::new())?;
    let mut found = Vec::new();
    for name in names {
        let Some(at) = scenario.rewards.iter().position(|reward| reward.name == name) else {
            continue;
        };
        if first_above(&counts(scenario, vec![name.clone()])?, &others).is_none() {
            continue;
        }
        let alone =
            |term: Option<u32>| counts(&paying_only(scenario, at, term), vec![name.clone()]);
        let states = alone(None)?;
        let mut add = |term: Option<String>, step: Option<usize>| {
            let fault =
                |step| FaultyTerm { reward: name.clone(), term, episode: faulty.index, step };
            found.extend(step.map(fault));
        };
        add(None, first_above(&states, &others));
        for (term, label) in (0..).zip(&scenario.rewards[at].body.terms) {
            add(Some(label.clone()), first_above(&alone(Some(term))?, &states));
        }
    }
    Ok(found)
}

/// The scenario with a reward that pays into one term only, or into none.
fn paying_only(scenario: &Arc<Scenario>, reward: usize, kept: Option<u32>) -> Arc<Scenario> {
    let mut changed = Scenario::clone(scenario);
    for instr in &mut changed.rewards[reward].body.step.code {
        if matches!(instr, Instr::Give { term, .. } if Some(*term) != kept) {
            *instr = Instr::Const(0.0);
        }
    }
    Arc::new(changed)
}

/// The faults of an episode so far, after each of its steps.
fn faults_by_step(
    scenario: &Arc<Scenario>,
    options: &RunOptions,
    index: u64,
    rewards: Vec<String>,
) -> Result<Vec<u32>, Error> {
    let chosen = EnvironmentOptions { rewards: Some(rewards), ..options.environment.clone() };
    let mut environment = Environment::new(scenario.clone(), chosen).map_err(Error::Environment)?;
    let mut counts = Vec::new();
    play(&mut environment, options, index, |environment| counts.push(environment.faults()));
    // The first is of the start.
    Ok(counts.split_off(1.min(counts.len())))
}

/// The first step, counted from 1, until which there were more faults than in `others`.
fn first_above(counts: &[u32], others: &[u32]) -> Option<usize> {
    counts.iter().zip(others).position(|(count, other)| count > other).map(|at| at + 1)
}

/// Plays an episode with the run's agent; `look` is called with its start and after each step. An
/// episode that fails has been reported by the run.
fn play(
    environment: &mut Environment,
    options: &RunOptions,
    index: u64,
    mut look: impl FnMut(&mut Environment),
) {
    // The run has fitted the same agent.
    let Ok(agent) = options.agent.fit(environment) else { return };
    let (mut scratch, mut policy) = (Scratch::default(), agent.player());
    if environment.reset(Some(options.seed), Some(index)).is_err() {
        return;
    }
    policy.begin(environment);
    look(environment);
    while environment.is_running() {
        let actions: Vec<Action> =
            (0..environment.n_agents()).map(|agent| policy.act(environment, agent)).collect();
        if environment.step(&actions, &mut scratch).is_err() {
            return;
        }
        look(environment);
    }
}

/// The numbers of the scenario's own observation that could not be computed in the first episodes,
/// and how often. They are played again, and every agent looks in every step.
///
/// # Errors
/// Like [`run`](super::run).
pub fn faulty_numbers(
    scenario: &Arc<Scenario>,
    options: &RunOptions,
) -> Result<Vec<(String, u64)>, Error> {
    let Some(observation) = &scenario.observation else { return Ok(Vec::new()) };
    let mut environment = Environment::new(scenario.clone(), options.environment.clone())
        .map_err(Error::Environment)?;
    let mut out = vec![0.0; observation.values.len()];
    let mut found: Vec<(String, u64)> = Vec::new();
    for index in options.episodes.clone().take(OBSERVED_EPISODES) {
        play(&mut environment, options, index, |environment| {
            for agent in 0..environment.n_agents() {
                // The buffer is of the right size.
                let _ = environment.observe_vector(agent, &mut out);
            }
        });
        for (name, times) in environment.observed_faults() {
            match found.iter_mut().find(|(known, _)| known == name) {
                Some((_, sum)) => *sum += u64::from(times),
                None => found.push((name.to_owned(), times.into())),
            }
        }
    }
    Ok(found)
}
