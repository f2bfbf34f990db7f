//! The number of steps until a kick leaves the foot, by the step in which it was requested.

use super::kicks;
use super::recorded::{Column, Group, Kind, Row, Topic};
use super::trace::View;

/// Steps from the kick's key in which the ball leaves or doesn't.
const STEPS: usize = 25;

const COLUMNS: [Column; 5] = [
    ("kicked", Kind::Share),
    ("when", Kind::Steps),
    ("speed", Kind::Speed),
    ("degrees", Kind::Way),
    ("peak", Kind::Height),
];

const GROUPS: [Group; 2] =
    [("when it leaves", &["kicked", "when"]), ("where to and how fast", &["speed", "degrees", "peak"])];

/// The topic.
pub(super) const TOPIC: Topic =
    Topic { name: "kick asked for", file: "grf_kick_latency.json", columns: &COLUMNS, groups: &GROUPS, read };

fn read(trace: &[View], _: &Row) -> Vec<Option<f64>> {
    kicks::figures(trace, STEPS)
}
