//! The compiled scenario's file format, `.pitchc`: JSON with a version and a checksum, or the
//! [`binary`] form of it.

pub mod binary;

use crate::container::{HeadError, checksum};
use crate::scenario::Scenario;
use crate::verify::verify;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

/// The version this build reads and writes.
pub const FORMAT_VERSION: u32 = 3;
/// Largest file, bytes: more than the largest scenario needs, and little enough to be read whole.
pub const FILE_MAX_BYTES: u64 = 16 << 20;
/// The value of the field `format`.
pub(crate) const FORMAT_NAME: &str = "setpiece scenario";

/// Why a compiled scenario can't be read or written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FormatError {
    /// It isn't a compiled scenario.
    NotAScenario(String),
    /// It is truncated.
    Truncated,
    /// It was written by another version.
    Version(u32),
    /// Its content isn't what was written.
    Checksum,
    /// It is well-formed but holds an impossible value.
    Corrupt(String),
    /// It can't be written.
    Write(String),
}

impl std::fmt::Display for FormatError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            FormatError::NotAScenario(why) => write!(f, "not a compiled scenario: {why}"),
            FormatError::Truncated => f.write_str("the compiled scenario is truncated: its end is missing"),
            FormatError::Version(found) => write!(
                f,
                "the compiled scenario has format version {found}; this build reads version {FORMAT_VERSION}: build it again from its source"
            ),
            FormatError::Checksum => f.write_str(
                "the compiled scenario was changed after it was built: its checksum differs; build it again",
            ),
            FormatError::Corrupt(why) => write!(f, "the compiled scenario is corrupt: {why}"),
            FormatError::Write(why) => write!(f, "the scenario can't be written: {why}"),
        }
    }
}

impl std::error::Error for FormatError {}

impl From<HeadError> for FormatError {
    fn from(error: HeadError) -> FormatError {
        match error {
            HeadError::Mark => FormatError::NotAScenario(
                "it doesn't begin as `setpiece build --format bin` writes".into(),
            ),
            HeadError::Truncated => FormatError::Truncated,
            HeadError::Version(found) => FormatError::Version(found),
            HeadError::Checksum => FormatError::Checksum,
        }
    }
}

#[derive(Serialize)]
struct WrittenFile<'a> {
    format: &'a str,
    version: u32,
    checksum: String,
    scenario: &'a RawValue,
}

#[derive(Deserialize)]
struct ReadFile<'a> {
    #[serde(borrow)]
    format: Option<std::borrow::Cow<'a, str>>,
    version: Option<u32>,
    #[serde(borrow)]
    checksum: Option<std::borrow::Cow<'a, str>>,
    #[serde(borrow)]
    scenario: Option<&'a RawValue>,
}

/// Writes a scenario as text.
///
/// # Errors
/// [`FormatError::Write`] if a constant isn't finite.
pub fn to_json(scenario: &Scenario) -> Result<String, FormatError> {
    let write = |error: serde_json::Error| FormatError::Write(error.to_string());
    let body = serde_json::to_string(scenario).map_err(write)?;
    let checksum = written_checksum(&body);
    let raw = RawValue::from_string(body).map_err(write)?;
    let out =
        WrittenFile { format: FORMAT_NAME, version: FORMAT_VERSION, checksum, scenario: &raw };
    let file = serde_json::to_string(&out).map_err(write)?;
    check_size(file.len(), FormatError::Write)?;
    Ok(file)
}

/// Rejects content larger than a file may be.
fn check_size(bytes: usize, fault: impl Fn(String) -> FormatError) -> Result<(), FormatError> {
    if bytes as u64 <= FILE_MAX_BYTES {
        return Ok(());
    }
    Err(fault(format!("it is larger than {} MiB", FILE_MAX_BYTES >> 20)))
}

/// A number that changes with anything in the scenario: snapshots name the scenario that they are
/// of by it.
///
/// # Errors
/// [`FormatError::Write`] if a constant isn't finite.
pub fn digest(scenario: &Scenario) -> Result<u64, FormatError> {
    let body =
        serde_json::to_string(scenario).map_err(|error| FormatError::Write(error.to_string()))?;
    Ok(fnv1a(body.as_bytes()))
}

/// Reads a scenario from text. The result is safe to run.
///
/// # Errors
/// [`FormatError`] for anything but an unchanged file of this version.
pub fn from_json(text: &str) -> Result<Scenario, FormatError> {
    check_size(text.len(), FormatError::NotAScenario)?;
    if text.trim().is_empty() {
        return Err(FormatError::NotAScenario("it is empty".to_owned()));
    }
    let envelope: ReadFile<'_> = serde_json::from_str(text).map_err(|error| {
        if error.is_eof() && text.trim_start().starts_with('{') {
            FormatError::Truncated
        } else {
            let (line, column) = (error.line(), error.column());
            FormatError::NotAScenario(format!(
                "line {line}, column {column} is not what `setpiece build` writes"
            ))
        }
    })?;
    if envelope.format.as_deref() != Some(FORMAT_NAME) {
        return Err(FormatError::NotAScenario(format!(
            "the field `format` is not \"{FORMAT_NAME}\""
        )));
    }
    let version = envelope
        .version
        .ok_or_else(|| FormatError::NotAScenario("it has no `version`".to_owned()))?;
    if version != FORMAT_VERSION {
        return Err(FormatError::Version(version));
    }
    let body = envelope.scenario.ok_or(FormatError::Truncated)?.get();
    if envelope.checksum.as_deref() != Some(written_checksum(body).as_str()) {
        return Err(FormatError::Checksum);
    }
    let scenario: Scenario =
        serde_json::from_str(body).map_err(|error| FormatError::Corrupt(error.to_string()))?;
    verify(&scenario).map_err(FormatError::Corrupt)?;
    Ok(scenario)
}

/// The checksum of a scenario's JSON, as its file says it.
fn written_checksum(body: &str) -> String {
    format!("{:08x}", checksum(body.as_bytes()))
}

/// FNV-1a, 64 bit: the hash of digests. Files have a [`checksum`] instead.
pub fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}
