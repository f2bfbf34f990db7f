//! Shots of a standing player without a held direction, with and without a keeper.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, apart, first, yes};
use setpiece::scenario::vocabulary::Action;

/// A free ball faster than this has been shot, m/s.
const SHOT_MPS: f64 = 15.0;
/// Steps over which the largest speed is taken.
const SPEED_STEPS: usize = 4;

const COLUMNS: [FigureColumn; 6] = [
    ("goal", FigureKind::Share),
    ("wide", FigureKind::Share),
    ("held", FigureKind::Share),
    ("leaves", FigureKind::Steps),
    ("speed", FigureKind::Speed),
    ("keeper_m", FigureKind::Metres),
];

const GROUPS: [Group; 2] = [
    ("what comes of it", &["goal", "wide", "held"]),
    ("the shot", &["leaves", "speed", "keeper_m"]),
];

/// The topic.
pub(super) const TOPIC: Topic = Topic {
    name: "standing shot",
    file: "grf_standing_shots.json",
    columns: &COLUMNS,
    groups: &GROUPS,
    read,
};

fn read(trace: &[TraceMoment], row: &RecordedRow) -> Vec<Option<f64>> {
    let end = &trace[trace.len() - 1];
    let Some(key) = first(trace, 1, |view| view.pressed[0] == Action::Shot) else {
        return vec![None; COLUMNS.len()];
    };
    let plays = |view: &TraceMoment| view.mode == 0 && view.score == trace[0].score;
    let struck =
        first(trace, key, |view| view.owner == -1 && view.velocity() > SHOT_MPS && plays(view));
    let speed = |from: usize| {
        let after =
            trace[from..trace.len().min(from + SPEED_STEPS)].iter().filter(|view| plays(view));
        after.map(|view| view.speed).fold(0.0, f64::max)
    };
    let guarded = !row.scene.ends_with("no keeper");
    vec![
        Some(yes(end.score[0] > 0)),
        Some(yes(end.mode == 2)),
        Some(yes(trace[key..].iter().any(|view| view.owned_by(1, 0)))).filter(|_| guarded),
        struck.map(|step| (step - key + 1) as f64),
        struck.filter(|step| step + 1 < trace.len()).map(speed),
        struck.map(|step| apart(trace[step].teams[1][0], [54.4, 0.0])).filter(|_| guarded),
    ]
}
