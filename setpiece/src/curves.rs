//! What an episode pays over time: the mean return of every reward term up to each step.

use crate::Error;
use crate::engine::batch::{EpisodeError, Policy, STEPS_MAX};
use crate::engine::environment::{Environment, Scratch};
use crate::run::RunOptions;
use crate::scenario::{Action, Scenario};
use std::sync::Arc;

/// Mean returns over the episodes, by step.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    /// How many episodes they are of.
    pub episodes: usize,
    /// The terms, in order: their name, and what they have paid up to each step, 0 for the start.
    /// An episode that has ended keeps its return.
    pub terms: Vec<(String, Vec<f64>)>,
}

impl Curves {
    /// The sum of all terms up to each step.
    pub fn total(&self) -> Vec<f64> {
        let steps = self.terms.first().map_or(0, |(_, curve)| curve.len());
        (0..steps).map(|step| self.terms.iter().map(|(_, curve)| curve[step]).sum()).collect()
    }
}

/// Plays the episodes one after the other and adds up what each term pays, as a mean over agents.
///
/// # Errors
/// [`Error::Environment`] if the options don't fit the scenario, [`Error::Policy`] if the agent
/// doesn't, [`Error::Episode`] if an episode has no start, a script fails, or nothing ends it.
pub fn curves(scenario: &Arc<Scenario>, options: &RunOptions) -> Result<Curves, Error> {
    let fault = |why| Error::Episode(Box::new(why));
    let mut environment = Environment::new(scenario.clone(), options.environment.clone())
        .map_err(Error::Environment)?;
    let names = environment.term_names().to_vec();
    let mut policy = options.agent.fit(&environment)?.player();
    let mut scratch = Scratch::default();
    let mut actions = vec![Action::Idle; environment.n_agents()];
    // Per term and step the sum over episodes of what was paid in that step.
    let mut paid: Vec<Vec<f64>> = vec![vec![0.0]; names.len()];
    for episode in options.episodes.clone() {
        environment
            .reset(Some(options.seed), Some(episode))
            .map_err(|why| fault(EpisodeError::Draw(why)))?;
        policy.begin(&environment);
        while environment.is_running() {
            for (agent, action) in actions.iter_mut().enumerate() {
                *action = policy.act(&environment, agent);
            }
            environment
                .step(&actions, &mut scratch)
                .map_err(|why| fault(EpisodeError::Step(why)))?;
            let (step, agents) = (environment.steps() as usize, actions.len().max(1) as f64);
            for (term, sums) in paid.iter_mut().enumerate() {
                sums.resize(sums.len().max(step + 1), 0.0);
                let all: f64 = (0..actions.len()).map(|agent| environment.terms(agent)[term]).sum();
                sums[step] += all / agents;
            }
            if environment.is_running() && environment.steps() >= STEPS_MAX {
                return Err(fault(EpisodeError::Endless(STEPS_MAX)));
            }
        }
    }
    let episodes = options.episodes.clone().count();
    let terms = names.into_iter().zip(paid).map(|(name, sums)| {
        let mut sum = 0.0;
        let up_to = |paid: f64| {
            sum += paid / episodes.max(1) as f64;
            sum
        };
        (name, sums.into_iter().map(up_to).collect())
    });
    Ok(Curves { episodes, terms: terms.collect() })
}
