//! The number of steps until a kick leaves the foot, by the step in which it was requested.

use super::kicks;
use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::TraceMoment;

/// Steps from the kick's key in which the ball leaves or doesn't.
const STEPS: usize = 25;

const COLUMNS: [FigureColumn; 5] = [
    ("kicked", FigureKind::Share),
    ("when", FigureKind::Steps),
    ("speed", FigureKind::Speed),
    ("degrees", FigureKind::Way),
    ("peak", FigureKind::Height),
];

const GROUPS: [Group; 2] = [
    ("when it leaves", &["kicked", "when"]),
    ("where to and how fast", &["speed", "degrees", "peak"]),
];

/// The topic.
pub(super) const TOPIC: Topic = Topic {
    name: "kick asked for",
    file: "grf_kick_latency.json",
    columns: &COLUMNS,
    groups: &GROUPS,
    read,
};

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    kicks::figures(trace, STEPS)
}
