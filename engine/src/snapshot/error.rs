//! Errors of snapshots.

use setpiece_scenario::container::HeadError;

/// The version of snapshots that this build takes and restores.
pub const SNAPSHOT_VERSION: u32 = 26;

/// Why a snapshot can't be taken, restored or begun from.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SnapshotError {
    /// It has another format.
    #[error("not a snapshot: its header isn't recognised")]
    NotASnapshot,
    /// It was taken by another version.
    #[error(
        "the snapshot has version {0}; this build reads version {SNAPSHOT_VERSION}: take it again"
    )]
    Version(u32),
    /// It is truncated.
    #[error("the snapshot is truncated: its end is missing")]
    Truncated,
    /// Its content isn't what was written.
    #[error("the snapshot was changed after it was taken: its checksum differs")]
    Checksum,
    /// It is well-formed but holds an impossible value.
    #[error("the snapshot is damaged: `{place}` {why}")]
    Damaged {
        /// Where: `match.players[3].pos[0]`.
        place: String,
        /// What is wrong there.
        why: String,
    },
    /// It belongs to another scenario.
    #[error("{}", other_scenario(found, expected))]
    Scenario {
        /// The name of its scenario.
        found: String,
        /// The name of this one.
        expected: String,
    },
    /// Its environment paid other rewards.
    #[error("the snapshot's rewards are {}, this environment's {}", list(found), list(expected))]
    Rewards {
        /// Its rewards.
        found: Vec<String>,
        /// This environment's.
        expected: Vec<String>,
    },
    /// The players or agents differ.
    #[error("the {what} differ: the snapshot has {found}, this environment {expected}")]
    Roster {
        /// What differs: `left players`, `agents`.
        what: String,
        /// What the snapshot has.
        found: String,
        /// What this environment has.
        expected: String,
    },
    /// It was taken before an episode began.
    #[error("the snapshot was taken before an episode had begun")]
    NotBegun,
    /// A script's memory holds a value that can't be encoded.
    #[error(
        "a script keeps {what} in `{place}`: a snapshot holds numbers, words, lists, maps and what a hook is shown"
    )]
    Unkept {
        /// Where: `this.last[2]`.
        place: String,
        /// What the value is.
        what: String,
    },
}

impl SnapshotError {
    /// An error about damage at a place.
    pub(crate) fn damaged(place: impl Into<String>, why: impl Into<String>) -> SnapshotError {
        SnapshotError::Damaged { place: place.into(), why: why.into() }
    }
}

impl From<HeadError> for SnapshotError {
    fn from(error: HeadError) -> SnapshotError {
        match error {
            HeadError::Mark => SnapshotError::NotASnapshot,
            HeadError::Truncated => SnapshotError::Truncated,
            HeadError::Version(found) => SnapshotError::Version(found),
            HeadError::Checksum => SnapshotError::Checksum,
        }
    }
}

fn other_scenario(found: &str, expected: &str) -> String {
    if found == expected {
        format!(
            "the snapshot is of another version of `{expected}`: the scenario has changed since"
        )
    } else {
        format!("the snapshot is of scenario `{found}`, this environment's is `{expected}`")
    }
}

fn list(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { format!("`{}`", names.join("`, `")) }
}
