//! The compiled scenario: the compiler writes it and the engine runs it.
//!
//! Plain data. A [`Scenario`] holds everything an episode needs: the roster, the start (a
//! [`Program`] that is run at every reset), rewards and endings (programs run at every step),
//! scripts, and the parameters, which stay symbolic until a match binds them. [`vocabulary`] is the
//! one home of every list that the language, the engine, the docs and Python share.
//! [`file`](mod@file) is the versioned `.pitchc` format, [`container`] the head of all binary
//! files.

pub mod behavior;
pub mod bounds;
pub mod container;
mod dimension;
pub mod file;
pub mod module;
mod named;
pub mod operators;
pub mod params;
pub mod pitch;
pub mod pitch_size;
pub mod plan;
pub mod program;
pub mod scenario;
#[cfg(feature = "schema")]
pub mod schema;
pub mod table;
pub mod verify;
pub mod vocabulary;

pub use behavior::{Act, Behavior, Do, Node, ScriptArg, Then, Watch};
pub use dimension::Dimension;
pub use file::{FORMAT_VERSION, FormatError};
pub use module::{MODULES_MAX, ScriptModule, module_name};
pub use named::{NamedKind, NamedValue};
pub use params::{Bindings, Param, ParamError};
pub use pitch_size::PitchSize;
pub use program::{
    BinaryOp, Distribution, Each, EventFilter, Fold, FoldKind, Instr, Over, Program, Reg, UnaryOp,
    When, Who,
};
pub use scenario::{
    Agents, Ai, BallStart, Ending, Endings, Kickoff, KickoffPlaces, LIMIT, Observation,
    ObservedValue, Others, PitchSetting, PlayerSlot, PlayerStart, ROUNDS, Record, Require, Reward,
    RewardBody, RewardHook, RuleSetting, Scenario, Script, SideAgents, Start, Substitution,
    Switching, WorldSetting,
};
pub use table::Table;
pub use vocabulary::{
    Action, EventField, EventKind, Field, GameMode, Qualifier, Role, Rule, StartKind, Stat, Team,
    Type, Verdict,
};
