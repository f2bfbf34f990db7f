//! The header of a snapshot: a magic number, version, checksum and length.

use super::error::{SNAPSHOT_VERSION, SnapshotError};

/// The first bytes of a snapshot; no text starts with them.
pub const MAGIC: &[u8; 8] = b"\x8bpitchs\n";
/// Length of the header: magic number, version, checksum, length.
const HEAD: usize = 8 + 4 + 8 + 8;

/// Initial capacity, enough for a match of eleven a side: growing means copying.
const USUAL_BYTES: usize = 12 * 1024;

/// Reserves space for a header; the content follows it.
pub(super) fn begun() -> Vec<u8> {
    let mut file = Vec::with_capacity(USUAL_BYTES);
    file.resize(HEAD, 0);
    file
}

/// Fills in the header of a file from [`begun`].
pub(super) fn sealed(mut file: Vec<u8>) -> Vec<u8> {
    let (head, body) = file.split_at_mut(HEAD);
    let (version, sum, length) =
        (SNAPSHOT_VERSION.to_le_bytes(), checksum(body).to_le_bytes(), (body.len() as u64).to_le_bytes());
    let parts = MAGIC.iter().chain(&version).chain(&sum).chain(&length);
    head.iter_mut().zip(parts).for_each(|(byte, part)| *byte = *part);
    file
}

/// Checks the header and returns the content.
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

/// Computes the checksum of the content, similar to FNV-1a: over words of eight bytes, in four
/// lanes that a processor computes in parallel, then over the remaining bytes. A single changed
/// word always changes it.
pub fn checksum(body: &[u8]) -> u64 {
    let step = |hash: u64, word: u64| (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(29);
    let mut lanes = [0xcbf2_9ce4_8422_2325, 1, 2, 3];
    let (rows, rest) = body.as_chunks::<32>();
    for row in rows {
        for (lane, word) in lanes.iter_mut().zip(row.as_chunks().0) {
            *lane = step(*lane, u64::from_le_bytes(*word));
        }
    }
    let hash = lanes.into_iter().reduce(step).unwrap_or_default();
    rest.iter().fold(hash, |hash, byte| step(hash, u64::from(*byte)))
}
