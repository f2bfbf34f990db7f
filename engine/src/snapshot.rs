//! Snapshots: a whole match as bytes, at any moment, and back.
//!
//! A snapshot holds everything that later steps depend on: the match with its random streams, and
//! the memory of its judge and of its scripted players. It has four parts. The header has a version
//! and a checksum. Then comes what it belongs to (the scenario's digest, the rewards). The match
//! follows; any scenario with the same roster can begin an episode from it. Last comes the episode
//! around it, which only the same scenario can continue.
//!
//! - [`archive`]: writing and reading in one function; [`walk`](mod@walk): rejects impossible
//!   numbers; [`floats`](crate::floats): many numbers at once; [`bounded`](mod@bounded): limits the
//!   length of lists.
//! - [`file`]: the header.
//!
//! [`Environment`](crate::environment::Environment) offers what can be done with a snapshot.

mod archive;
mod bounded;
mod error;
mod file;
mod walk;

pub use error::{SNAPSHOT_VERSION, SnapshotError};
pub use file::{MAGIC, checksum};

pub(crate) use archive::Archive;
pub(crate) use bounded::bounded;

use crate::state::Match;
use serde::{Deserialize, Serialize};

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

/// Writes a snapshot; `episode` writes the episode around the match.
pub(crate) fn write(
    about: &About,
    game: &Match,
    episode: impl FnOnce(&mut Archive<'_>) -> Result<(), SnapshotError>,
) -> Result<Vec<u8>, SnapshotError> {
    let mut archive = Archive::writing(file::begun());
    archive.put("about", about)?;
    archive.put("match", game)?;
    let scenes_at = archive.written();
    if about.started {
        episode(&mut archive)?;
    }
    // Values that scripts have kept refer to scenes, so these come first.
    let mut shelf = std::mem::take(&mut archive.shelf);
    let mut scenes = Archive::writing(Vec::new());
    shelf.archive_scenes(&mut scenes)?;
    let mut file = archive.into_bytes();
    file.splice(scenes_at..scenes_at, scenes.into_bytes());
    Ok(file::sealed(file))
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
        let mut archive = Archive::reading(file::unwrap(bytes)?);
        let (about, game) = (archive.read("about")?, archive.read("match")?);
        Ok(Opened { about, game, archive })
    }

    /// Reads the episode around the match, to the end of the bytes.
    pub(crate) fn read_episode(
        mut self,
        episode: impl FnOnce(&mut Archive<'_>) -> Result<(), SnapshotError>,
    ) -> Result<(), SnapshotError> {
        let mut shelf = std::mem::take(&mut self.archive.shelf);
        shelf.archive_scenes(&mut self.archive)?;
        self.archive.shelf = shelf;
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
