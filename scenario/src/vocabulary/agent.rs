//! Agents by name.

/// The names of the agents: the ready-made ones, and the policy that a scenario comes with.
pub const AGENTS: [&str; 5] = ["random", "idle", "run_and_shoot", "bot", "baseline"];
