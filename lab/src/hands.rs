//! Play under an agent's control: scenes with a key in every step, played as recorded of Google
//! Research Football.
//!
//! Every scene is in `lab/data` with its recorded figures: how players are placed, which keys are
//! pressed, what the columns mean. Here the same keys are pressed in our game, and the same columns
//! are measured.

mod again;
mod contact;
mod duels;
mod early_kicks;
mod first_time;
mod first_touch;
mod keepers;
mod keys;
mod kicks;
mod latency;
mod limits;
mod openings;
mod played;
mod recorded;
mod runs;
mod set_pieces;
mod shots;
mod stage;
mod standing;
mod starts;
mod switching;
mod trace;
mod turns;
mod winning;

pub(crate) use again::{RecordedArgs, recorded};
pub(crate) use played::{PlayArgs, play};

use crate::figure::Section;
use crate::pitch::LabError;

/// The topics in the common form, in the order of the report.
const TOPICS: [recorded::Topic; 15] = [
    kicks::TOPIC,
    latency::TOPIC,
    shots::TOPIC,
    duels::TOPIC,
    contact::TOPIC,
    set_pieces::TOPIC,
    switching::TOPIC,
    keepers::TOPIC,
    early_kicks::TOPIC,
    first_time::TOPIC,
    starts::TOPIC,
    first_touch::TOPIC,
    winning::TOPIC,
    turns::TOPIC,
    openings::TOPIC,
];

/// Measures everything of the section.
pub(crate) fn measure(count: Option<u64>) -> Result<Section, LabError> {
    let mut section = Section::new(
        6,
        "Under an agent's hands",
        "An agent presses a key in every step; every episode has its own start. Rows of several figures are inside where \
         all of them are. Limits: a tolerance, and what chance does to the two means (95 %, by the real game's own \
         scatter). Tolerances: ±1 step, ±8 % on speeds, ±25 % and at least 0.3 m on heights, ±3°; distances ±8 %, at \
         least 0.5 m; places ±0.03; shares of the episodes ±0.1, of an episode's steps ±0.05; goals ±0.25. \
         `lab/data/README.md` says how theirs were taken, and how many of these rows the real game misses itself.",
    );
    for topic in &TOPICS {
        recorded::measure(&mut section, topic, count)?;
    }
    Ok(section)
}

/// Adds shots of standing players to the section of the ball.
pub(crate) fn standing_shots(section: &mut Section, count: Option<u64>) -> Result<(), LabError> {
    recorded::measure(section, &standing::TOPIC, count)
}

/// Adds runs with the ball to the section of movement.
pub(crate) fn runs_with_the_ball(section: &mut Section) -> Result<(), LabError> {
    recorded::measure(section, &runs::TOPIC, None)
}

/// Every topic, in any section of the report.
fn topics() -> impl Iterator<Item = &'static recorded::Topic> {
    TOPICS.iter().chain([&standing::TOPIC, &runs::TOPIC])
}

/// The topic of a file of `lab/data`.
fn topic_of(file: &str) -> Result<&'static recorded::Topic, LabError> {
    topics().find(|topic| topic.file == file).ok_or_else(|| format!("no topic has `{file}`"))
}

#[cfg(test)]
mod tests {
    /// The most figures in a row of the report.
    const ROW_MAX: usize = 5;

    #[test]
    fn every_column_is_in_one_row_and_rows_are_short() {
        for topic in super::topics() {
            for (column, _) in topic.columns {
                let rows =
                    topic.groups.iter().filter(|(_, columns)| columns.contains(column)).count();
                assert_eq!(rows, 1, "{}: {column}", topic.name);
            }
            let named: usize = topic.groups.iter().map(|(_, columns)| columns.len()).sum();
            assert_eq!(named, topic.columns.len(), "{}", topic.name);
            assert!(
                topic.groups.iter().all(|(_, columns)| columns.len() <= ROW_MAX),
                "{}",
                topic.name
            );
        }
    }
}
