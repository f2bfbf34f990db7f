//! Ready-made agents.

/// The names of the ready-made agents.
pub const AGENTS: [&str; 4] = ["random", "idle", "run_and_shoot", "bot"];
