//! Who plays the agents: a ready-made agent, the policy that a scenario comes with, or one from an
//! ONNX file.

mod acting;
mod policy;
mod sight;

pub use acting::{ActingAgent, FittedAgent};
pub use policy::{NetworkPolicy, POLICY_MAX_BYTES};

use crate::baseline::{BASELINE, baseline};
use crate::error::Error;
use setpiece_engine::batch::ReadyMade;
use setpiece_engine::control::agents::Agent;
use setpiece_engine::environment::Environment;
use sight::PolicySight;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Who plays the agents, before it is known what.
#[derive(Clone, Debug)]
pub enum ChosenAgent {
    /// A ready-made agent.
    ReadyMade(Agent),
    /// The policy that the scenario comes with.
    Baseline,
    /// A policy from a file, which is read when it is needed.
    File {
        /// The file.
        path: PathBuf,
        /// The path as text.
        name: String,
    },
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

    /// The policy of a file.
    pub fn of_file(path: &Path) -> ChosenAgent {
        ChosenAgent::File { path: path.to_owned(), name: path.display().to_string() }
    }

    /// Reads the file of a policy, to report what is wrong with it before anything is played.
    ///
    /// # Errors
    /// [`Error::File`] if it can't be read, [`Error::Policy`] if it is no policy.
    pub fn check(&self) -> Result<(), Error> {
        match self {
            ChosenAgent::File { path, .. } => NetworkPolicy::from_file(path).map(|_| ()),
            ChosenAgent::ReadyMade(_) | ChosenAgent::Baseline => Ok(()),
        }
    }

    /// Finds an agent by its name: a ready-made one, or `baseline`.
    pub fn from_name(name: &str) -> Option<ChosenAgent> {
        let ready_made = || Agent::from_name(name).map(ChosenAgent::from);
        if name == BASELINE { Some(ChosenAgent::Baseline) } else { ready_made() }
    }

    /// How it is called: its name, else the path of its file.
    pub fn name(&self) -> &str {
        match self {
            ChosenAgent::ReadyMade(agent) => agent.name(),
            ChosenAgent::Baseline => BASELINE,
            ChosenAgent::File { name, .. } => name,
        }
    }

    /// Prepares it for a scenario.
    ///
    /// # Errors
    /// [`Error::File`] or [`Error::Policy`] for a policy that can't be read, or that sees or
    /// presses something else, [`Error::NoBaseline`] for a scenario without a policy.
    pub fn fit(&self, environment: &Environment) -> Result<FittedAgent, Error> {
        let policy = match self {
            ChosenAgent::ReadyMade(agent) => {
                return Ok(FittedAgent::ReadyMade(ReadyMade::new(*agent)));
            }
            ChosenAgent::Baseline => baseline(environment.scenario())?,
            ChosenAgent::File { path, .. } => Arc::new(NetworkPolicy::from_file(path)?),
        };
        let sight = PolicySight::of(&policy, environment)?;
        policy.try_out(&sight)?;
        Ok(FittedAgent::Policy(policy, sight))
    }
}
