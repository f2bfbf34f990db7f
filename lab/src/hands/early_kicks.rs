//! Kicks requested by a receiver before the pass arrives.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, first, leaves, yes};
use setpiece::scenario::vocabulary::Action;

/// A ball this near to the receiver has arrived, metres.
const ARRIVED_M: f64 = 1.2;
/// A free ball faster than this may have been kicked, m/s.
const KICKED_MPS: f64 = 11.5;
/// A kick turns the ball by at least this angle, degrees.
const TURN_DEG: f64 = 25.0;
/// Or makes it faster by this, m/s.
const FASTER_MPS: f64 = 3.0;
/// Steps over which the largest height is taken.
const PEAK_STEPS: usize = 12;

const COLUMNS: [FigureColumn; 9] = [
    ("pressed", FigureKind::Share),
    ("owned", FigureKind::Share),
    ("kicked", FigureKind::Share),
    ("kick_step", FigureKind::Steps),
    ("after_arrival", FigureKind::Steps),
    ("speed", FigureKind::Speed),
    ("degrees", FigureKind::Degrees),
    ("peak", FigureKind::Height),
    ("goal", FigureKind::Share),
];

const GROUPS: [Group; 3] = [
    ("whether", &["pressed", "owned", "kicked", "goal"]),
    ("when", &["kick_step", "after_arrival"]),
    ("where to and how fast", &["speed", "degrees", "peak"]),
];

/// The topic.
pub(super) const TOPIC: Topic = Topic {
    name: "early kick",
    file: "grf_early_kicks.json",
    columns: &COLUMNS,
    groups: &GROUPS,
    read,
};

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    let pressed = |view: &TraceMoment| {
        [Action::Shot, Action::ShortPass, Action::HighPass].contains(&view.pressed[1])
    };
    let (Some(left), Some(key)) = (leaves(trace), first(trace, 1, pressed)) else {
        let mut none = vec![None; COLUMNS.len()];
        none[0] = Some(0.0);
        return none;
    };
    let me = trace[0].active[1];
    let (arrives, kick) = struck(trace, left, me);
    vec![
        Some(1.0),
        Some(yes(trace[left..].iter().any(|view| view.owned_by(0, me)))),
        Some(yes(kick.is_some())),
        kick.map(|step| step as f64 - key as f64 + 1.0),
        kick.zip(arrives).map(|(step, arrives)| (step - arrives) as f64),
        kick.map(|step| trace[step].velocity()),
        kick.map(|step| trace[step].degrees().abs()),
        kick.map(|step| peak(trace, step)),
        Some(yes(trace[trace.len() - 1].score[0] > 0)),
    ]
}

/// The steps in which a pass that left in a step arrives at the receiver, and is kicked on.
pub(super) fn struck(
    trace: &[TraceMoment],
    left: usize,
    receiver: usize,
) -> (Option<usize>, Option<usize>) {
    let arrives = first(trace, left, |view| view.ball_from(view.teams[0][receiver]) < ARRIVED_M);
    let kick = arrives.and_then(|arrives| {
        let before = &trace[left.max(arrives - 1)];
        let kicked = first(trace, arrives, |view| {
            let turn = (view.degrees() - before.degrees() + 180.0).rem_euclid(360.0) - 180.0;
            let other = turn.abs() > TURN_DEG || view.velocity() > before.velocity() + FASTER_MPS;
            let over = view.score != trace[0].score || view.mode != 0;
            over || (view.owner == -1 && view.velocity() > KICKED_MPS && other)
        });
        kicked.filter(|step| trace[*step].score == trace[0].score && trace[*step].mode == 0)
    });
    (arrives, kick)
}

/// The largest height of a kicked ball.
pub(super) fn peak(trace: &[TraceMoment], step: usize) -> f64 {
    trace[step..trace.len().min(step + PEAK_STEPS)]
        .iter()
        .map(|view| view.ball[2])
        .fold(0.0, f64::max)
}
