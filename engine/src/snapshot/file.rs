//! What stands around a snapshot: a mark, version, checksum and length.

use super::error::{SNAPSHOT_VERSION, SnapshotError};

/// What a snapshot begins with: no text does.
const MAGIC: &[u8; 8] = b"\x8bpitchs\n";
/// Mark, version, checksum, length.
const HEAD: usize = 8 + 4 + 8 + 8;

/// Puts a head before the content.
pub(super) fn wrap(body: &[u8]) -> Vec<u8> {
    let mut file = Vec::with_capacity(HEAD + body.len());
    file.extend_from_slice(MAGIC);
    file.extend_from_slice(&SNAPSHOT_VERSION.to_le_bytes());
    file.extend_from_slice(&checksum(body).to_le_bytes());
    file.extend_from_slice(&(body.len() as u64).to_le_bytes());
    file.extend_from_slice(body);
    file
}

/// The content behind a head that fits it.
pub(super) fn unwrap(file: &[u8]) -> Result<&[u8], SnapshotError> {
    let rest = file.strip_prefix(MAGIC).ok_or(SnapshotError::NotASnapshot)?;
    let (version, rest) = rest.split_first_chunk::<4>().ok_or(SnapshotError::Truncated)?;
    let version = u32::from_le_bytes(*version);
    if version != SNAPSHOT_VERSION {
        return Err(SnapshotError::Version(version));
    }
    let (sum, rest) = rest.split_first_chunk::<8>().ok_or(SnapshotError::Truncated)?;
    let (length, body) = rest.split_first_chunk::<8>().ok_or(SnapshotError::Truncated)?;
    match u64::from_le_bytes(*length) {
        wanted if wanted > body.len() as u64 => return Err(SnapshotError::Truncated),
        wanted if wanted < body.len() as u64 => return Err(SnapshotError::Checksum),
        _ => {}
    }
    if checksum(body) != u64::from_le_bytes(*sum) {
        return Err(SnapshotError::Checksum);
    }
    Ok(body)
}

/// The sum in a snapshot's head over what follows: over words of eight bytes, in the manner of FNV-1a. One changed word
/// always shows.
pub fn checksum(body: &[u8]) -> u64 {
    let step = |hash: u64, word: u64| (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(29);
    let (words, rest) = body.as_chunks::<8>();
    let hash = words.iter().fold(0xcbf2_9ce4_8422_2325, |hash, word| step(hash, u64::from_le_bytes(*word)));
    rest.iter().fold(hash, |hash, byte| step(hash, u64::from(*byte)))
}
