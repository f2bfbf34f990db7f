//! Agents that play episodes.

use super::policy::NetworkPolicy;
use super::sight::{PolicyEye, PolicySight, Seen};
use setpiece_engine::batch::{Policy, ReadyMade};
use setpiece_engine::environment::Environment;
use setpiece_engine::observe::action_mask;
use setpiece_scenario::Action;
use std::sync::Arc;

/// An agent that fits a scenario; it makes the agents of many threads.
#[derive(Clone, Debug)]
pub enum FittedAgent {
    /// A ready-made agent.
    ReadyMade(ReadyMade),
    /// A policy and what it sees.
    Policy(Arc<NetworkPolicy>, PolicySight),
}

impl FittedAgent {
    /// One that plays, an episode at a time.
    pub fn player(&self) -> ActingAgent {
        match self {
            FittedAgent::ReadyMade(agent) => ActingAgent::ReadyMade(agent.clone()),
            FittedAgent::Policy(policy, sight) => {
                let (policy, sight) = (policy.clone(), sight.clone());
                let (eye, slots) = (PolicyEye::default(), Vec::new());
                ActingAgent::Policy(Box::new(PlayingPolicy { policy, sight, eye, slots }))
            }
        }
    }
}

/// An agent that plays an episode.
#[derive(Debug)]
pub enum ActingAgent {
    /// A ready-made agent.
    ReadyMade(ReadyMade),
    /// A policy.
    Policy(Box<PlayingPolicy>),
}

impl Policy for ActingAgent {
    fn begin(&mut self, environment: &Environment) {
        match self {
            ActingAgent::ReadyMade(agent) => agent.begin(environment),
            ActingAgent::Policy(policy) => policy.begin(environment),
        }
    }

    fn act(&mut self, environment: &Environment, agent: usize) -> Action {
        match self {
            ActingAgent::ReadyMade(ready_made) => ready_made.act(environment, agent),
            ActingAgent::Policy(policy) => policy.act(environment, agent),
        }
    }
}

/// A policy in an episode.
#[derive(Debug)]
pub struct PlayingPolicy {
    policy: Arc<NetworkPolicy>,
    sight: PolicySight,
    eye: PolicyEye,
    /// By agent.
    slots: Vec<PolicySlot>,
}

/// What a policy keeps of an agent.
#[derive(Debug, Default)]
struct PolicySlot {
    seen: Seen,
    /// The action that is pressed until the next decision; none before the first.
    pressed: Option<Action>,
}

impl Policy for PlayingPolicy {
    fn begin(&mut self, environment: &Environment) {
        self.eye.begin();
        self.slots.clear();
        self.slots.resize_with(environment.n_agents(), PolicySlot::default);
    }

    /// Decides in the first step, and then after every `repeat` steps of the episode.
    fn act(&mut self, environment: &Environment, agent: usize) -> Action {
        let Some(slot) = self.slots.get_mut(agent) else { return Action::Idle };
        let is_due = environment.steps().is_multiple_of(self.policy.repeat());
        let held = slot.pressed.filter(|_| !is_due);
        if let (Some(held), false) = (held, self.sight.is_stacked()) {
            return held;
        }
        let first = slot.pressed.is_none();
        let seen = (&mut slot.seen, first);
        // Every agent of the environment can be seen, and the sight has the sizes.
        if self.eye.look(&self.sight, environment, agent, seen).is_err() {
            return Action::Idle;
        }
        if let Some(held) = held {
            return held;
        }
        let mask = if self.policy.sees_masks() {
            action_mask(environment.state(), agent).unwrap_or([true; Action::FULL_SET])
        } else {
            [true; Action::FULL_SET]
        };
        let action = self.policy.decide(slot.seen.tensor(&self.sight), &mask);
        slot.pressed = Some(action);
        action
    }
}
