//! The policies in the box: what `--agent baseline` plays, by the name of the scenario.

use crate::agent::NetworkPolicy;
use crate::error::Error;
use std::path::Path;
use std::sync::Arc;

/// How the agent is called.
pub const BASELINE: &str = "baseline";

/// The name and bytes of every policy, sorted by name.
const POLICIES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/policies.rs"));

/// The scenarios that have a policy, in order.
pub fn baselines() -> impl Iterator<Item = &'static str> {
    POLICIES.iter().filter_map(|(name, _)| name.strip_suffix(".onnx"))
}

/// The ONNX file of a scenario's policy.
pub fn baseline_file(scenario: &str) -> Option<&'static [u8]> {
    let found = POLICIES.iter().find(|(name, _)| name.strip_suffix(".onnx") == Some(scenario));
    found.map(|(_, bytes)| *bytes)
}

/// The policy of a scenario.
///
/// # Errors
/// [`Error::NoBaseline`] if it has none.
pub fn baseline(scenario: &str) -> Result<Arc<NetworkPolicy>, Error> {
    let Some(bytes) = baseline_file(scenario) else {
        return Err(Error::NoBaseline {
            scenario: scenario.to_owned(),
            known: baselines().map(str::to_owned).collect(),
        });
    };
    let path = format!("{BASELINE}/{scenario}.onnx");
    Ok(Arc::new(NetworkPolicy::from_bytes(Path::new(&path), bytes)?))
}
