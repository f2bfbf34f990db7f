//! The first touch of a pass.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, first, leaves, pace, yes};

const COLUMNS: [FigureColumn; 9] = [
    ("left", FigureKind::Share),
    ("got", FigureKind::Share),
    ("own_step", FigureKind::Steps),
    ("arrives_mps", FigureKind::Speed),
    ("ball_1", FigureKind::Metres),
    ("ball_3", FigureKind::Metres),
    ("kept_5", FigureKind::Share),
    ("ball_mps_3", FigureKind::Speed),
    ("me_mps_3", FigureKind::Speed),
];

const GROUPS: [Group; 4] = [
    ("who has it", &["left", "got", "kept_5"]),
    ("when and how fast it arrives", &["own_step", "arrives_mps"]),
    ("how near the ball stays", &["ball_1", "ball_3"]),
    ("how fast after it", &["ball_mps_3", "me_mps_3"]),
];

/// The topic.
pub(super) const TOPIC: Topic = Topic {
    name: "first touch",
    file: "grf_first_touch.json",
    columns: &COLUMNS,
    groups: &GROUPS,
    read,
};

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    let mut figures = vec![None; COLUMNS.len()];
    let left = leaves(trace);
    figures[0] = Some(yes(left.is_some()));
    let Some(left) = left else { return figures };
    let me = trace[0].active[1];
    let owned = first(trace, left, |view| view.owned_by(0, me));
    figures[1] = Some(yes(owned.is_some()));
    let Some(owned) = owned else { return figures };
    let away =
        |later: usize| trace.get(owned + later).map(|view| view.ball_from(view.teams[0][me]));
    figures[2] = Some((owned - left) as f64);
    figures[3] = Some(trace[owned - 1].speed);
    figures[4] = away(1);
    figures[5] = away(3);
    figures[6] = trace.get(owned + 5).map(|view| yes(view.owner == 0));
    figures[7] = trace.get(owned + 3).map(|view| view.speed);
    figures[8] = pace(trace, owned + 3, me);
    figures
}
