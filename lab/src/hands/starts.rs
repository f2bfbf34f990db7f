//! The first touch of an episode's ball.

use super::recorded::{Column, Group, Kind, Row, Topic};
use super::trace::{View, apart, first, yes};

/// A ball that has gone further than this was touched, metres.
const TOUCHED_M: f64 = 0.04;
/// The step in which the ball's distance is measured.
const LATER_STEP: usize = 10;

const COLUMNS: [Column; 8] = [
    ("touched", Kind::Share),
    ("touch_step", Kind::Steps),
    ("own_step", Kind::Steps),
    ("me_m", Kind::Metres),
    ("ball_m", Kind::Metres),
    ("mps", Kind::Speed),
    ("degrees", Kind::Way),
    ("ball_10", Kind::Metres),
];

const GROUPS: [Group; 2] = [
    ("when", &["touched", "touch_step", "own_step", "me_m"]),
    ("where the ball is", &["ball_m", "mps", "degrees", "ball_10"]),
];

/// The topic.
pub(super) const TOPIC: Topic =
    Topic { name: "start", file: "grf_starts.json", columns: &COLUMNS, groups: &GROUPS, read };

fn read(trace: &[View], _: &Row) -> Vec<Option<f64>> {
    let level = |view: &View| [view.ball[0], view.ball[1]];
    let from = level(&trace[0]);
    let touch = first(trace, 1, |view| apart(level(view), from) > TOUCHED_M);
    let after = touch.and_then(|step| trace.get(step + 1));
    vec![
        Some(yes(touch.is_some())),
        touch.map(|step| step as f64),
        first(trace, 1, |view| view.owner == 0).map(|step| step as f64),
        touch.map(|step| apart(trace[step - 1].player(0, 0), from)),
        touch.map(|step| apart(level(&trace[step]), from)),
        after.map(View::velocity),
        after.map(View::degrees),
        trace.get(LATER_STEP).map(|view| apart(level(view), from)),
    ]
}
