//! A keeper against long, diagonal and close shots of a sprinting agent.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, apart, first, yes};
use setpiece::scenario::vocabulary::Action;

/// A free ball faster than this has been shot, m/s.
const SHOT_MPS: f64 = 15.0;

const COLUMNS: [FigureColumn; 9] = [
    ("shot", FigureKind::Share),
    ("goal", FigureKind::Share),
    ("held", FigureKind::Share),
    ("wide", FigureKind::Share),
    ("corner", FigureKind::Share),
    ("leaves", FigureKind::Steps),
    ("degrees", FigureKind::Degrees),
    ("speed", FigureKind::Speed),
    ("keeper_m", FigureKind::Metres),
];

const GROUPS: [Group; 3] = [
    ("what comes of it", &["shot", "goal", "held", "wide", "corner"]),
    ("the shot", &["leaves", "degrees", "speed"]),
    ("where the keeper is", &["keeper_m"]),
];

/// The topic.
pub(super) const TOPIC: Topic =
    Topic { name: "keeper", file: "grf_keepers.json", columns: &COLUMNS, groups: &GROUPS, read };

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    let Some(key) = first(trace, 1, |view| view.pressed[0] == Action::Shot) else {
        let mut none = vec![None; COLUMNS.len()];
        none[0] = Some(0.0);
        return none;
    };
    let end = &trace[trace.len() - 1];
    let on = |view: &TraceMoment| view.mode == 0 && view.score == trace[0].score;
    let leaves =
        first(trace, key, |view| view.owner == -1 && view.velocity() > SHOT_MPS && on(view));
    let speed = |from: usize| {
        let after = trace[from..trace.len().min(from + 4)].iter().filter(|view| on(view));
        after.map(|view| view.speed).fold(0.0, f64::max)
    };
    vec![
        Some(1.0),
        Some(yes(end.score[0] > 0)),
        Some(yes(trace[key..].iter().any(|view| view.owned_by(1, 0)))),
        Some(yes(end.mode == 2)),
        Some(yes(end.mode == 4)),
        leaves.map(|step| (step - key + 1) as f64),
        leaves.map(|step| trace[step].degrees().abs()),
        leaves.filter(|step| step + 1 < trace.len()).map(speed),
        leaves.map(|step| apart(trace[step].teams[1][0], [54.4, 0.0])),
    ]
}
