//! Who plays the agents: an agent of the command, a behaviour of the text, or a policy of the
//! program that has started the studio.

use crate::agent::{ActingAgent, ChosenAgent};
use crate::engine::batch::Policy;
use crate::engine::environment::Environment;
use crate::scenario::Action;

/// A policy of the program that has started the studio.
pub trait Guest: Policy {
    /// Why it failed since it was last asked; none if it didn't.
    fn fault(&mut self) -> Option<String>;
}

/// The policies of the program that has started the studio.
pub trait Guests: Send {
    /// Their names.
    fn names(&self) -> Vec<String>;

    /// A policy by its name, to play episodes.
    fn policy(&self, name: &str) -> Option<Box<dyn Guest + Send>>;
}

/// Who can play the agents.
#[derive(Clone, Debug)]
pub(super) enum Performer {
    /// An agent that the command knows.
    Agent(ChosenAgent),
    /// A behaviour of the text, by its name.
    Behavior(String),
    /// A policy from outside, by its name.
    Guest(String),
}

impl Performer {
    /// How pages call it.
    pub(super) fn name(&self) -> &str {
        match self {
            Performer::Agent(agent) => agent.name(),
            Performer::Behavior(name) | Performer::Guest(name) => name,
        }
    }
}

/// What chooses the agents' actions.
pub(super) enum ActingPolicy {
    /// An agent that the command knows.
    Agent(ActingAgent),
    /// A policy from outside.
    Guest(Box<dyn Guest + Send>),
}

impl ActingPolicy {
    /// Why a policy from outside failed.
    pub(super) fn fault(&mut self) -> Option<String> {
        match self {
            ActingPolicy::Agent(_) => None,
            ActingPolicy::Guest(guest) => guest.fault(),
        }
    }
}

impl Policy for ActingPolicy {
    fn begin(&mut self, environment: &Environment) {
        match self {
            ActingPolicy::Agent(agent) => agent.begin(environment),
            ActingPolicy::Guest(guest) => guest.begin(environment),
        }
    }

    fn act(&mut self, environment: &Environment, agent: usize) -> Action {
        match self {
            ActingPolicy::Agent(acting) => acting.act(environment, agent),
            ActingPolicy::Guest(guest) => guest.act(environment, agent),
        }
    }
}
