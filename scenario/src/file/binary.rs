//! The compact form: a magic number, version, checksum and length, then the scenario as CBOR (RFC
//! 8949).

use super::{FORMAT_VERSION, FormatError, check_size, fnv1a, to_json};
use crate::scenario::Scenario;
use crate::verify::verify;

/// The first bytes of a compact file; no text starts with them.
pub const MAGIC: &[u8; 8] = b"\x8bpitchc\n";
/// Length of the header: magic number, version, checksum, length.
const HEAD: usize = 8 + 4 + 8 + 8;

/// Writes a scenario in the compact form.
///
/// # Errors
/// [`FormatError::Write`] if a constant isn't finite.
pub fn to_bytes(scenario: &Scenario) -> Result<Vec<u8>, FormatError> {
    // What one form can't hold, the other mustn't either.
    to_json(scenario)?;
    let mut body = Vec::new();
    ciborium::into_writer(scenario, &mut body).map_err(|error| FormatError::Write(error.to_string()))?;
    let mut file = Vec::with_capacity(HEAD + body.len());
    file.extend_from_slice(MAGIC);
    file.extend_from_slice(&FORMAT_VERSION.to_le_bytes());
    file.extend_from_slice(&fnv1a(&body).to_le_bytes());
    file.extend_from_slice(&(body.len() as u64).to_le_bytes());
    file.extend_from_slice(&body);
    Ok(file)
}

/// Reads a scenario in the compact form. The result is safe to run.
///
/// # Errors
/// [`FormatError`] for anything but an unchanged file of this version.
pub fn from_bytes(file: &[u8]) -> Result<Scenario, FormatError> {
    check_size(file.len(), FormatError::NotAScenario)?;
    let Some(rest) = file.strip_prefix(MAGIC) else {
        return Err(FormatError::NotAScenario("it doesn't begin as `setpiece build --format bin` writes".to_owned()));
    };
    let (version, rest) = rest.split_first_chunk::<4>().ok_or(FormatError::Truncated)?;
    let version = u32::from_le_bytes(*version);
    if version != FORMAT_VERSION {
        return Err(FormatError::Version(version));
    }
    let (checksum, rest) = rest.split_first_chunk::<8>().ok_or(FormatError::Truncated)?;
    let (length, body) = rest.split_first_chunk::<8>().ok_or(FormatError::Truncated)?;
    match u64::from_le_bytes(*length) {
        wanted if wanted > body.len() as u64 => return Err(FormatError::Truncated),
        wanted if wanted < body.len() as u64 => return Err(FormatError::Checksum),
        _ => {}
    }
    if fnv1a(body) != u64::from_le_bytes(*checksum) {
        return Err(FormatError::Checksum);
    }
    let scenario: Scenario = ciborium::from_reader(body).map_err(|error| FormatError::Corrupt(error.to_string()))?;
    verify(&scenario).map_err(FormatError::Corrupt)?;
    Ok(scenario)
}
