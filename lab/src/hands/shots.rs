//! Shots of a sprinting agent: place, held direction, presses, keeper.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, first, yes};
use setpiece::scenario::vocabulary::Action;

/// A free ball faster than this has been shot, m/s.
const SHOT_MPS: f64 = 15.0;
/// Steps over which the largest speed is taken.
const SPEED_STEPS: usize = 4;

const COLUMNS: [FigureColumn; 6] = [
    ("goal", FigureKind::Share),
    ("wide", FigureKind::Share),
    ("lost", FigureKind::Share),
    ("leaves", FigureKind::Steps),
    ("degrees", FigureKind::Degrees),
    ("speed", FigureKind::Speed),
];

const GROUPS: [Group; 2] = [
    ("what comes of it", &["goal", "wide", "lost"]),
    ("the shot", &["leaves", "degrees", "speed"]),
];

/// The topic.
pub(super) const TOPIC: Topic =
    Topic { name: "shot", file: "grf_shots_held.json", columns: &COLUMNS, groups: &GROUPS, read };

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    let end = &trace[trace.len() - 1];
    let key = first(trace, 1, |view| view.pressed[0] == Action::Shot);
    let plays = |view: &TraceMoment| view.mode == 0 && view.score == trace[0].score;
    let struck = key.and_then(|key| {
        first(trace, key, |view| view.owner == -1 && view.velocity() > SHOT_MPS && plays(view))
    });
    let speed = |from: usize| {
        let after =
            trace[from..trace.len().min(from + SPEED_STEPS)].iter().filter(|view| plays(view));
        after.map(|view| view.speed).fold(0.0, f64::max)
    };
    vec![
        Some(yes(end.score[0] > 0)),
        Some(yes(end.mode == 2)),
        Some(yes(key.is_none())),
        // Counted from the step before the first press, which sets the direction.
        key.zip(struck).map(|(key, step)| (step - key + 2) as f64),
        struck.map(|step| trace[step].degrees()),
        struck.filter(|step| step + 1 < trace.len()).map(speed),
    ]
}
