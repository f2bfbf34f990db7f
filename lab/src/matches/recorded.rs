//! Matches of Google Research Football's bots, as counted by `lab/record/matches.py`.

use crate::figure::{FigurePart, short};
use crate::pitch::{LabError, deviation, mean};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// A match: its difficulties and all counts, by name.
type MatchCounts = BTreeMap<String, f64>;

/// Reads the matches between these difficulties.
pub(super) fn matches(left: f64, right: f64) -> Result<Vec<MatchCounts>, LabError> {
    const FILE: &str = "grf_bot_matches.jsonl";
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("data").join(FILE);
    let text = std::fs::read_to_string(path).map_err(|why| format!("lab/data/{FILE}: {why}"))?;
    let all = text
        .lines()
        .map(|line| serde_json::from_str(line).map_err(|why| format!("lab/data/{FILE}: {why}")));
    let mut of = all.collect::<Result<Vec<MatchCounts>, LabError>>()?;
    of.retain(|one| one.get("left") == Some(&left) && one.get("right") == Some(&right));
    Ok(of)
}

/// The tolerance in addition to the random error of the two means.
#[derive(Clone, Copy)]
pub(super) enum Give {
    /// A number of events in a match: ±25 %, at least 0.25.
    Count,
    /// A share: ±0.05.
    Share,
    /// Any other measured value: ±15 %.
    Measure,
}

/// Compares a count of ours, the mean over this many matches, with theirs.
pub(super) fn part(
    theirs: &[MatchCounts],
    name: &str,
    give: Give,
    ours: f64,
    matches: usize,
) -> FigurePart {
    let of: Vec<f64> = theirs.iter().filter_map(|one| one.get(name).copied()).collect();
    let (middle, n) = (mean(&of), of.len() as f64);
    // Events that a few matches happen not to show aren't impossible: adds one to their total.
    let least = if let Give::Count = give { ((middle * n + 1.0) / n).sqrt() } else { 0.0 };
    let chance = 1.96 * deviation(&of).max(least) * (1.0 / n + 1.0 / matches as f64).sqrt();
    let tolerance = match give {
        Give::Count => (0.25 * middle).max(0.25),
        Give::Share => 0.05,
        Give::Measure => 0.15 * middle,
    };
    let mut part = FigurePart::around(name, middle, tolerance + chance, ours);
    part.range[0] = part.range[0].max(0.0);
    part.theirs = format!("{} ± {}", short(middle), short(deviation(&of) / n.sqrt()));
    part
}
