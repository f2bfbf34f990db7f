//! A kick and the keys that follow it.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, first, yes};
use setpiece::scenario::vocabulary::Action;

/// A ball faster than this has been kicked, m/s.
const KICKED_MPS: f64 = 11.5;
/// Steps after the kick's key in which the ball leaves or doesn't.
const STEPS: usize = 18;
/// Steps over which the largest speed is taken.
const SPEED_STEPS: usize = 4;

const COLUMNS: [FigureColumn; 5] = [
    ("kicked", FigureKind::Share),
    ("when", FigureKind::Steps),
    ("speed", FigureKind::Speed),
    ("degrees", FigureKind::Way),
    ("peak", FigureKind::Height),
];

const GROUPS: [Group; 1] = [("the kick", &["kicked", "when", "speed", "degrees", "peak"])];

/// The topic.
pub(super) const TOPIC: Topic =
    Topic { name: "kick", file: "grf_kick_inputs.json", columns: &COLUMNS, groups: &GROUPS, read };

/// Whether an action is a kick.
pub(super) fn is_kick(action: Action) -> bool {
    [Action::Shot, Action::ShortPass, Action::LongPass, Action::HighPass].contains(&action)
}

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    figures(trace, STEPS)
}

/// Whether and when the first requested kick leaves within this many steps, its speed, direction
/// and height.
pub(super) fn figures(trace: &[TraceMoment], steps: usize) -> Vec<Option<f64>> {
    let key = first(trace, 1, |view| is_kick(view.pressed[0]));
    let until = trace.len().min(key.unwrap_or_default() + steps + 1);
    let kick = key.and_then(|key| {
        first(&trace[..until], key, |view| view.owner == -1 && view.velocity() > KICKED_MPS)
    });
    let moved = |from: usize| {
        let after = trace[(from + 1)..trace.len().min(from + SPEED_STEPS)]
            .iter()
            .filter(|view| view.mode == 0);
        after.map(|view| view.speed).fold(trace[from].velocity(), f64::max)
    };
    vec![
        Some(yes(kick.is_some())),
        kick.zip(key).map(|(step, key)| (step - key + 1) as f64),
        kick.map(moved),
        kick.map(|step| trace[step].degrees()),
        kick.map(|step| trace[step..until].iter().map(|view| view.ball[2]).fold(0.0, f64::max)),
    ]
}
