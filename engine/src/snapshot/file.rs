//! What stands around a snapshot: a mark, version, checksum and length, as in a compiled scenario's compact form.

use super::error::{SNAPSHOT_VERSION, SnapshotError};
use setpiece_scenario::file::fnv1a;

/// What a snapshot begins with: no text does.
const MAGIC: &[u8; 8] = b"\x8bpitchs\n";
/// Mark, version, checksum, length.
const HEAD: usize = 8 + 4 + 8 + 8;

/// Puts a head before the content.
pub(super) fn wrap(body: &[u8]) -> Vec<u8> {
    let mut file = Vec::with_capacity(HEAD + body.len());
    file.extend_from_slice(MAGIC);
    file.extend_from_slice(&SNAPSHOT_VERSION.to_le_bytes());
    file.extend_from_slice(&fnv1a(body).to_le_bytes());
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
    let (checksum, rest) = rest.split_first_chunk::<8>().ok_or(SnapshotError::Truncated)?;
    let (length, body) = rest.split_first_chunk::<8>().ok_or(SnapshotError::Truncated)?;
    match u64::from_le_bytes(*length) {
        wanted if wanted > body.len() as u64 => return Err(SnapshotError::Truncated),
        wanted if wanted < body.len() as u64 => return Err(SnapshotError::Checksum),
        _ => {}
    }
    if fnv1a(body) != u64::from_le_bytes(*checksum) {
        return Err(SnapshotError::Checksum);
    }
    Ok(body)
}
