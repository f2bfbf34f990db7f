//! Errors of an environment.

use crate::draw::{DrawError, RosterError};
use crate::judge::ScriptError;
use crate::judge::script::ScriptLoadError;
use crate::snapshot::SnapshotError;
use setpiece_scenario::ParamError;

/// Why an environment can't be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EnvironmentError {
    /// A requested reward isn't in scope.
    #[error("no reward `{name}`; there is `{}`", known.join("`, `"))]
    Reward {
        /// The name.
        name: String,
        /// The rewards in scope.
        known: Vec<String>,
    },
    /// A reward was requested twice.
    #[error("reward `{0}` is requested twice")]
    RewardTwice(String),
    /// A parameter's value isn't allowed.
    #[error(transparent)]
    Param(#[from] ParamError),
    /// The values don't belong to this scenario.
    #[error("expected {expected} parameter values, found {found}")]
    Bindings {
        /// How many were given.
        found: usize,
        /// How many the scenario has.
        expected: usize,
    },
    /// The requested agents don't exist.
    #[error(transparent)]
    Agents(#[from] RosterError),
    /// A script isn't valid Rhai.
    #[error(transparent)]
    Script(#[from] ScriptLoadError),
    /// No episode can begin from the snapshot.
    #[error(transparent)]
    Snapshot(#[from] SnapshotError),
    /// New parameters would change who takes part.
    #[error("these parameters change the players or the agents: make a new environment")]
    Roster,
}

/// Why no episode begins in the state of a snapshot.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ResetError {
    /// No episode can begin from the snapshot; nothing has changed.
    #[error(transparent)]
    Snapshot(#[from] SnapshotError),
    /// The scenario's requirements can't be met.
    #[error(transparent)]
    Draw(#[from] DrawError),
}

/// Why a step was not completed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StepError {
    /// No episode is running.
    #[error("{}: reset the environment first", if *begun { "the episode has ended" } else { "no episode has begun" })]
    NotRunning {
        /// Whether there was an episode at all.
        begun: bool,
    },
    /// There is not one action per agent.
    #[error("expected {expected} actions, found {found}")]
    Actions {
        /// How many were given.
        found: usize,
        /// How many agents there are.
        expected: usize,
    },
    /// A further round has no start; the episode has ended.
    #[error(transparent)]
    Draw(Box<DrawError>),
    /// A script failed; the episode has ended.
    #[error(transparent)]
    Script(Box<ScriptError>),
}
