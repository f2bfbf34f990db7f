//! The compact form: a [head](crate::container), then the scenario as CBOR (RFC 8949).

use super::{FORMAT_VERSION, FormatError, check_size, to_json};
use crate::container::Container;
use crate::scenario::Scenario;
use crate::verify::verify;

/// Compact files.
pub const CONTAINER: Container = Container { mark: b"\x8bpitchc\n", version: FORMAT_VERSION };

/// Writes a scenario in the compact form.
///
/// # Errors
/// [`FormatError::Write`] if a constant isn't finite.
pub fn to_bytes(scenario: &Scenario) -> Result<Vec<u8>, FormatError> {
    // What one form can't hold, the other mustn't either.
    to_json(scenario)?;
    let mut file = Container::begin(0);
    ciborium::into_writer(scenario, &mut file)
        .map_err(|error| FormatError::Write(error.to_string()))?;
    Ok(CONTAINER.seal(file))
}

/// Reads a scenario in the compact form. The result is safe to run.
///
/// # Errors
/// [`FormatError`] for anything but an unchanged file of this version.
pub fn from_bytes(file: &[u8]) -> Result<Scenario, FormatError> {
    check_size(file.len(), FormatError::NotAScenario)?;
    let body = CONTAINER.open(file)?;
    let scenario: Scenario =
        ciborium::from_reader(body).map_err(|error| FormatError::Corrupt(error.to_string()))?;
    verify(&scenario).map_err(FormatError::Corrupt)?;
    Ok(scenario)
}
