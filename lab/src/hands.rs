//! Under an agent's hands: scenes with a key in every step, played as they were recorded of Google Research Football.
//!
//! Every scene stands in `lab/data` beside the figures taken of it: how players are placed, which keys are pressed, what
//! the columns mean. Here the same keys are pressed in our game and the same columns measured.

mod contact;
mod duels;
mod early_kicks;
mod first_touch;
mod keepers;
mod keys;
mod kicks;
mod openings;
mod recorded;
mod set_pieces;
mod shots;
mod stage;
mod switching;
mod trace;
mod turns;
mod winning;

use crate::figure::Section;
use crate::pitch::Failure;
use serde::de::DeserializeOwned;
use setpiece::scenario::vocabulary::Action;

/// The topics in the common form, in the order of the report.
const TOPICS: [recorded::Topic; 9] = [
    contact::TOPIC,
    set_pieces::TOPIC,
    switching::TOPIC,
    keepers::TOPIC,
    early_kicks::TOPIC,
    first_touch::TOPIC,
    winning::TOPIC,
    turns::TOPIC,
    openings::TOPIC,
];

/// Measures everything of the section.
pub(crate) fn measure(count: Option<u64>) -> Result<Section, Failure> {
    let mut section = Section::new(
        6,
        "Under an agent's hands",
        "An agent presses a key in every step. Rows of several figures are inside where all of them are. Limits: ±1 step \
         on times (and their spread), ±8 % on speeds (and their spread), ±25 % on heights, 3° and their spread on \
         directions; shares as far as two samples of those sizes may differ. From the contact rows on every episode has \
         its own start: there the spread is what chance does to the two means (95 %). Distances: ±8 %, at least 0.5 m; \
         places ±0.03; shares of an episode's steps ±0.05; goals ±0.25, each with that spread.",
    );
    kicks::measure(&mut section, count)?;
    shots::measure(&mut section, count)?;
    duels::measure(&mut section, count)?;
    for topic in &TOPICS {
        recorded::measure(&mut section, topic, count)?;
    }
    Ok(section)
}

/// The rows of a recorded file.
fn rows<Row: DeserializeOwned>(file: &str, text: &str) -> Result<Vec<Row>, Failure> {
    #[derive(serde::Deserialize)]
    struct Recorded<Row> {
        rows: Vec<Row>,
    }
    let recorded: Recorded<Row> = serde_json::from_str(text).map_err(|why| format!("lab/data/{file}: {why}"))?;
    Ok(recorded.rows)
}

/// The action of a direction's name in the recorded files; none for a released one.
fn direction(name: &str) -> Option<Action> {
    Some(match name {
        "right" => Action::Right,
        "left" => Action::Left,
        "top" => Action::Top,
        "bottom" => Action::Bottom,
        "top_right" => Action::TopRight,
        "bottom_right" => Action::BottomRight,
        "top_left" => Action::TopLeft,
        "bottom_left" => Action::BottomLeft,
        _ => return None,
    })
}

/// How far two shares may be apart: what chance does to samples of `theirs` and `ours` in nineteen cases of twenty, and a
/// tenth more.
fn share_give(share: f64, theirs: u64, ours: u64) -> f64 {
    // Agresti and Coull's two successes and two failures keep shares of 0 and 1 from looking certain.
    let n = theirs as f64;
    let p = (share * n + 2.0) / (n + 4.0);
    1.96 * (p * (1.0 - p) * (1.0 / (n + 4.0) + 1.0 / ours as f64)).sqrt() + 0.1
}

#[cfg(test)]
mod tests {
    use super::TOPICS;

    /// The most figures a row of the report holds.
    const ROW_MAX: usize = 5;

    #[test]
    fn every_column_is_in_one_row_and_rows_are_short() {
        for topic in &TOPICS {
            for (column, _) in topic.columns {
                let rows = topic.groups.iter().filter(|(_, columns)| columns.contains(column)).count();
                assert_eq!(rows, 1, "{}: {column}", topic.name);
            }
            let named: usize = topic.groups.iter().map(|(_, columns)| columns.len()).sum();
            assert_eq!(named, topic.columns.len(), "{}", topic.name);
            assert!(topic.groups.iter().all(|(_, columns)| columns.len() <= ROW_MAX), "{}", topic.name);
        }
    }
}
