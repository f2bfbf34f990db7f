//! Snapshots: a whole match as bytes, at any moment, and back.
//!
//! A snapshot holds the match with its streams of random numbers, and what its judge and its
//! scripted players remember: everything a later step depends on. It begins with a
//! [head](setpiece_scenario::container), says what it is of (the scenario's digest, the rewards),
//! then holds the match, which any scenario of the same roster can begin an episode from, and last
//! the episode around it, which only the same scenario can go on with.
//!
//! - [`archive`]: writing and reading, in one; [`walk`](mod@walk): no number read may be
//!   impossible; [`floats`](crate::floats): many numbers at once; [`bounded`](mod@bounded): no list
//!   may be endless.
//!
//! [`Environment`](crate::environment::Environment) offers what can be done with a snapshot.

mod archive;
mod bounded;
mod error;
mod walk;

pub use error::{SNAPSHOT_VERSION, SnapshotError};

pub(crate) use archive::Archive;
pub(crate) use bounded::bounded;

use crate::state::Match;
use serde::{Deserialize, Serialize};
use setpiece_scenario::container::Container;

/// Snapshots as files.
pub const CONTAINER: Container = Container { mark: b"\x8bpitchs\n", version: SNAPSHOT_VERSION };

/// Room for a match of eleven a side: bytes that outgrow their place are copied.
const USUAL_BYTES: usize = 12 * 1024;

/// What a snapshot belongs to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct About {
    /// The digest of its scenario.
    pub(crate) digest: u64,
    /// The name of its scenario.
    pub(crate) scenario: String,
    /// The rewards that are paid.
    pub(crate) rewards: Vec<String>,
    /// Whether the snapshot has an episode around the match.
    pub(crate) started: bool,
    /// Whether an episode was requested, and the key of the last one.
    pub(crate) begun: bool,
    pub(crate) seed: u64,
    pub(crate) index: u64,
    /// The parameters of the next episodes.
    pub(crate) bindings: Vec<f64>,
}

/// Writes a snapshot; `pass` hands over the episode around the match, if there is one.
pub(crate) fn write(
    about: &About,
    game: &Match,
    episode: impl FnOnce(&mut Archive<'_>) -> Result<(), SnapshotError>,
) -> Result<Vec<u8>, SnapshotError> {
    let mut archive = Archive::writing(Container::begin(USUAL_BYTES));
    archive.put("about", about)?;
    archive.put("match", game)?;
    if about.started {
        episode(&mut archive)?;
    }
    Ok(CONTAINER.seal(archive.into_bytes()))
}

/// A snapshot that has been read up to and including its match.
pub(crate) struct Opened<'a> {
    /// What it belongs to.
    pub(crate) about: About,
    /// The match.
    pub(crate) game: Match,
    archive: Archive<'a>,
}

impl<'a> Opened<'a> {
    /// Reads a snapshot up to and including its match.
    pub(crate) fn of(bytes: &'a [u8]) -> Result<Opened<'a>, SnapshotError> {
        let mut archive = Archive::reading(CONTAINER.open(bytes)?);
        let (about, game) = (archive.read("about")?, archive.read("match")?);
        Ok(Opened { about, game, archive })
    }

    /// Reads the episode around the match, to the end of the bytes.
    pub(crate) fn read_episode(
        mut self,
        episode: impl FnOnce(&mut Archive<'_>) -> Result<(), SnapshotError>,
    ) -> Result<(), SnapshotError> {
        if self.about.started {
            episode(&mut self.archive)?;
        }
        match self.archive.rest().len() {
            0 => Ok(()),
            n => Err(SnapshotError::damaged("end", format!("is followed by {n} more bytes"))),
        }
    }
}

/// Encodes a match alone, as in a snapshot.
///
/// # Errors
/// None for a match in play.
pub fn match_bytes(game: &Match) -> Result<Vec<u8>, SnapshotError> {
    let mut archive = Archive::writing(Vec::new());
    archive.put("match", game)?;
    Ok(archive.into_bytes())
}

#[cfg(test)]
mod tests;
