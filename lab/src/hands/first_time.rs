//! Kicks requested before a pass arrives, with one agent that switches to the receiver: first time
//! or after a trap.

use super::early_kicks::{peak, struck};
use super::kicks::is_kick;
use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, first, leaves, yes};

/// A ball kicked within this many steps of its arrival was not trapped.
const AT_ONCE_STEPS: usize = 3;
/// The receiver's index in the team.
const RECEIVER: usize = 2;

const COLUMNS: [FigureColumn; 10] = [
    ("passed", FigureKind::Share),
    ("arrived", FigureKind::Share),
    ("arrive_step", FigureKind::Steps),
    ("struck", FigureKind::Share),
    ("first_time", FigureKind::Share),
    ("after", FigureKind::Steps),
    ("speed", FigureKind::Speed),
    ("degrees", FigureKind::Way),
    ("peak", FigureKind::Height),
    ("goal", FigureKind::Share),
];

const GROUPS: [Group; 3] = [
    ("the pass", &["passed", "arrived", "arrive_step"]),
    ("whether and when it is struck", &["struck", "first_time", "after"]),
    ("where to and how fast", &["speed", "degrees", "peak", "goal"]),
];

/// The topic.
pub(super) const TOPIC: Topic = Topic {
    name: "first time",
    file: "grf_first_time.json",
    columns: &COLUMNS,
    groups: &GROUPS,
    read,
};

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    let key = first(trace, 1, |view| is_kick(view.pressed[0]));
    let left = key.and_then(|key| leaves(&trace[key - 1..]).map(|left| left + key - 1));
    let (arrives, kick) = left.map_or((None, None), |left| struck(trace, left, RECEIVER));
    let taken = arrives.zip(kick).map(|(arrives, kick)| kick - arrives);
    let mut figures = vec![
        Some(yes(left.is_some())),
        left.map(|_| yes(arrives.is_some())),
        arrives.zip(key).map(|(arrives, key)| (arrives - key + 1) as f64),
        arrives.map(|_| yes(kick.is_some())),
        arrives.map(|_| yes(taken.is_some_and(|taken| taken <= AT_ONCE_STEPS))),
        taken.map(|taken| taken as f64),
    ];
    figures.extend([
        kick.map(|step| trace[step].velocity()),
        kick.map(|step| trace[step].degrees()),
        kick.map(|step| peak(trace, step)),
        Some(yes(trace[trace.len() - 1].score[0] > 0)),
    ]);
    figures
}
