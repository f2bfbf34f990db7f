//! Who plays the agents: a ready-made agent, or a policy from an ONNX file.

mod acting;
mod policy;
mod sight;

pub use acting::{ActingAgent, FittedAgent};
pub use policy::{NetworkPolicy, POLICY_MAX_BYTES};

use crate::error::Error;
use setpiece_engine::batch::ReadyMade;
use setpiece_engine::control::agents::Agent;
use setpiece_engine::environment::Environment;
use sight::Sight;
use std::path::Path;
use std::sync::Arc;

/// Who plays the agents, before it is known what.
#[derive(Clone, Debug)]
pub enum ChosenAgent {
    /// A ready-made agent.
    ReadyMade(Agent),
    /// A policy from a file.
    Policy(Arc<NetworkPolicy>),
}

impl From<Agent> for ChosenAgent {
    fn from(agent: Agent) -> ChosenAgent {
        ChosenAgent::ReadyMade(agent)
    }
}

impl ChosenAgent {
    /// Whether a text is the path of a policy, not a name.
    pub fn is_path(text: &str) -> bool {
        Path::new(text).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("onnx"))
    }

    /// Reads the policy of a file.
    ///
    /// # Errors
    /// [`Error::File`] if it can't be read, [`Error::Policy`] if it is no policy.
    pub fn from_file(path: &Path) -> Result<ChosenAgent, Error> {
        Ok(ChosenAgent::Policy(Arc::new(NetworkPolicy::from_file(path)?)))
    }

    /// How it is called: its name, else the path of its file.
    pub fn name(&self) -> &str {
        match self {
            ChosenAgent::ReadyMade(agent) => agent.name(),
            ChosenAgent::Policy(policy) => policy.name(),
        }
    }

    /// Prepares it for a scenario.
    ///
    /// # Errors
    /// [`Error::Policy`] for a policy that sees or presses something else.
    pub fn fit(&self, environment: &Environment) -> Result<FittedAgent, Error> {
        Ok(match self {
            ChosenAgent::ReadyMade(agent) => FittedAgent::ReadyMade(ReadyMade::new(*agent)),
            ChosenAgent::Policy(policy) => {
                let sight = Sight::of(policy, environment)?;
                policy.try_out(&sight)?;
                FittedAgent::Policy(policy.clone(), sight)
            }
        })
    }
}
