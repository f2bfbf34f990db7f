//! The first touch of an episode's ball.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, apart, first, yes};

/// A ball that has gone further than this was touched, metres.
const TOUCHED_M: f64 = 0.04;
/// The step in which the ball's distance is measured.
const LATER_STEP: usize = 10;

const COLUMNS: [FigureColumn; 8] = [
    ("touched", FigureKind::Share),
    ("touch_step", FigureKind::Steps),
    ("own_step", FigureKind::Steps),
    ("me_m", FigureKind::Metres),
    ("ball_m", FigureKind::Metres),
    ("mps", FigureKind::Speed),
    ("degrees", FigureKind::Way),
    ("ball_10", FigureKind::Metres),
];

const GROUPS: [Group; 2] = [
    ("when", &["touched", "touch_step", "own_step", "me_m"]),
    ("where the ball is", &["ball_m", "mps", "degrees", "ball_10"]),
];

/// The topic.
pub(super) const TOPIC: Topic =
    Topic { name: "start", file: "grf_starts.json", columns: &COLUMNS, groups: &GROUPS, read };

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    let level = |view: &TraceMoment| [view.ball[0], view.ball[1]];
    let from = level(&trace[0]);
    let touch = first(trace, 1, |view| apart(level(view), from) > TOUCHED_M);
    let after = touch.and_then(|step| trace.get(step + 1));
    vec![
        Some(yes(touch.is_some())),
        touch.map(|step| step as f64),
        first(trace, 1, |view| view.owner == 0).map(|step| step as f64),
        touch.map(|step| apart(trace[step - 1].player(0, 0), from)),
        touch.map(|step| apart(level(&trace[step]), from)),
        after.map(TraceMoment::velocity),
        after.map(TraceMoment::degrees),
        trace.get(LATER_STEP).map(|view| apart(level(view), from)),
    ]
}
