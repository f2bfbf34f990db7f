//! The judge: what an episode is worth, and when it ends.
//!
//! Decides rewards and endings from what happened in a step; never touches the match. Each step it is shown a
//! [`View`] of the state before any restart, the view that the step before left behind (after its restart), and the
//! step's events. Endings are judged first, in their order; the one that holds adds the event `end`, which the rewards
//! of that last step see.
//!
//! - [`view`]: the part of a match that programs and scripts may read.
//! - [`machine`]: runs register programs.
//! - [`rewards`], [`endings`]: what the scenario pays, and how it ends.
//! - [`records`], [`observation`]: what it measures, and what it shows its agents.
//! - [`script`]: the same by Rhai hooks.

pub mod endings;
pub mod machine;
pub mod observation;
pub mod records;
pub mod rewards;
pub mod script;
pub mod view;

pub use endings::{EndingJudge, Outcome};
pub use machine::Machine;
pub use records::{RecordJudge, Recorded};
pub use rewards::RewardJudge;
pub use script::{ScriptError, ScriptFault, ScriptFaultKind, check_script};
pub use view::View;

use crate::event::Events;
use crate::random::{Purpose, Stream};
use crate::start::Drawn;
use crate::state::Match;
use machine::Input;
use observation::ObservationJudge;
use script::{Params, Scene, Scripts};
use setpiece_scenario::{Endings, Reward, Scenario};
use std::sync::Arc;

/// The judge of one environment.
#[derive(Clone, Debug)]
pub struct Judge {
    endings: EndingJudge,
    rewards: RewardJudge,
    records: RecordJudge,
    observation: Option<ObservationJudge>,
    scripts: Scripts,
    /// Whether a reward or an ending asks a script.
    scripted: bool,
    random: Stream,
    params: Vec<f64>,
    /// The same as scripts see them.
    shown: Params,
    lets: Vec<f64>,
    seed: u64,
    index: u64,
    prev: View,
    /// What `prev` was in the step just judged: what an observation compares with.
    before: View,
}

impl Judge {
    /// Prepares a judge that pays `rewards` to so many agents.
    pub fn new(scenario: &Scenario, rewards: Arc<[Reward]>, scripts: Scripts, n_agents: usize) -> Judge {
        let endings: Arc<Endings> = Arc::new(scenario.endings.clone());
        let script_reward = |reward: &Reward| matches!(reward.body, setpiece_scenario::RewardBody::Script { .. });
        Judge {
            scripted: rewards.iter().any(script_reward) || endings.list.iter().any(|ending| ending.script.is_some()),
            endings: EndingJudge::new(endings),
            rewards: RewardJudge::new(rewards, &scripts, n_agents),
            records: RecordJudge::new(&scenario.records, n_agents),
            observation: scenario.observation.as_ref().map(ObservationJudge::new),
            scripts,
            random: Stream::new(0, 0, Purpose::Script),
            params: Vec::new(),
            shown: Params::default(),
            lets: Vec::new(),
            seed: 0,
            index: 0,
            prev: View::EMPTY,
            before: View::EMPTY,
        }
    }

    /// What has been measured.
    pub fn records(&self) -> &RecordJudge {
        &self.records
    }

    /// The names of the declared observation's numbers; none without one.
    pub fn observed_names(&self) -> Vec<String> {
        self.observation.iter().flat_map(ObservationJudge::names).map(str::to_owned).collect()
    }

    /// Writes the declared observation of an agent; `false` where there is none of that length.
    pub fn observe(&mut self, game: &Match, agent: usize, out: &mut [f32]) -> bool {
        let Some(observation) = &mut self.observation else { return false };
        if out.len() != observation.names().len() || agent >= game.agents.len() {
            return false;
        }
        let input = Input {
            now: &self.prev,
            prev: &self.before,
            events: &[],
            params: &self.params,
            lets: &self.lets,
            index: self.index,
            us: endings::judged_side(game),
            me: None,
            silent: false,
        };
        observation.write(game, agent, &input, out);
        true
    }

    /// What has been paid.
    pub fn rewards(&self) -> &RewardJudge {
        &self.rewards
    }

    /// The endings.
    pub fn endings(&self) -> &EndingJudge {
        &self.endings
    }

    /// Begins an episode: the match stands at its start.
    pub fn reset(&mut self, game: &Match, drawn: &Drawn, params: &[f64]) {
        self.params.clear();
        self.params.extend_from_slice(params);
        if self.scripted {
            self.shown = self.scripts.params(params);
        }
        self.lets.clear();
        self.lets.extend_from_slice(&drawn.lets);
        (self.seed, self.index) = (drawn.seed, drawn.index);
        self.random = Stream::new(drawn.seed, drawn.index, Purpose::Script);
        self.prev = View::of(game);
        self.before = self.prev;
        let start = self.prev;
        let input = Input {
            now: &start,
            prev: &start,
            events: &[],
            params: &self.params,
            lets: &self.lets,
            index: self.index,
            us: endings::judged_side(game),
            me: None,
            silent: false,
        };
        self.endings.reset(&input);
        self.rewards.reset(game, &input);
        self.records.reset(game, &input);
    }

    /// Judges a step: `game` stands before any restart. Where the episode ends, the event `end` is added.
    ///
    /// # Errors
    /// A hook that failed; the episode can't go on.
    pub fn step(&mut self, game: &Match, events: &mut Events) -> Result<Option<Outcome>, ScriptError> {
        let now = View::of(game);
        let us = endings::judged_side(game);
        let mut scene = self.scripted.then(|| self.scene(&now, events));
        let shared = Input {
            now: &now,
            prev: &self.prev,
            events: &[],
            params: &self.params,
            lets: &self.lets,
            index: self.index,
            us,
            me: None,
            silent: false,
        };
        let shown = scene.as_ref().map(|scene| (&self.scripts, scene));
        let outcome = self.endings.step(game, &Input { events: events.as_slice(), ..shared }, shown)?;
        if let Some(outcome) = &outcome {
            endings::announce(outcome, game, events);
            scene = scene.map(|scene| Arc::new(scene.with_events(events.as_slice())));
        }
        let shown = scene.as_ref().map(|scene| (&self.scripts, scene));
        self.rewards.step(game, &Input { events: events.as_slice(), ..shared }, shown)?;
        self.records.step(game, &Input { events: events.as_slice(), ..shared });
        if let Some(scene) = scene {
            self.random = scene.random();
        }
        Ok(outcome)
    }

    /// Remembers the state that the step leaves behind, after its restart: what the next step's `prev` reads.
    pub fn settle(&mut self, game: &Match) {
        if self.observation.is_some() {
            self.before = self.prev;
        }
        self.prev = View::of(game);
    }

    fn scene(&self, now: &View, events: &Events) -> Arc<Scene> {
        Arc::new(Scene::new(
            *now,
            self.prev,
            events.as_slice(),
            self.shown.clone(),
            self.random.clone(),
            (self.seed, self.index),
        ))
    }
}

#[cfg(test)]
mod tests;
