//! Running with the ball: the first steps of a sprint, turns, stops.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, apart, first, pace};
use crate::pitch::mean;
use setpiece::scenario::vocabulary::Action;

/// A turn is done within this angle of the new direction, degrees.
const TURNED_DEG: f64 = 12.0;
/// From this share of the old speed on, the speed counts as full again.
const FAST: f64 = 0.9;
/// A slower player stands, m/s.
const STANDS_MPS: f64 = 0.1;
/// How many steps after the key are checked.
const STEPS: usize = 60;

const COLUMNS: [FigureColumn; 12] = [
    ("mps_2", FigureKind::Speed),
    ("mps_3", FigureKind::Speed),
    ("mps_4", FigureKind::Speed),
    ("mps_5", FigureKind::Speed),
    ("mps_6", FigureKind::Speed),
    ("mps_8", FigureKind::Speed),
    ("mps_11", FigureKind::Speed),
    ("mps_16", FigureKind::Speed),
    ("turned", FigureKind::Steps),
    ("fast", FigureKind::Steps),
    ("stopped", FigureKind::Steps),
    ("way_m", FigureKind::Metres),
];

const GROUPS: [Group; 4] = [
    ("the first steps", &["mps_2", "mps_3", "mps_4", "mps_5"]),
    ("the next steps", &["mps_6", "mps_8", "mps_11", "mps_16"]),
    ("steps", &["turned", "fast"]),
    ("steps and metres", &["stopped", "way_m"]),
];

/// The topic.
pub(super) const TOPIC: Topic = Topic {
    name: "with the ball",
    file: "grf_runs.json",
    columns: &COLUMNS,
    groups: &GROUPS,
    read,
};

fn read(trace: &[TraceMoment], row: &RecordedRow) -> Vec<Option<f64>> {
    let mut figures = vec![None; COLUMNS.len()];
    let me = trace[0].active[0];
    let (key, way) = match row.plan.rsplit(' ').next() {
        Some("45") => (Action::BottomRight, -45.0),
        Some("90") => (Action::Bottom, -90.0),
        Some("stop") => (Action::ReleaseDirection, 0.0),
        _ => (Action::Right, 0.0),
    };
    let Some(begins) = first(trace, 1, |view| view.pressed[0] == key) else { return figures };
    let speed = |step: usize| pace(trace, step, me);
    let steps = begins..trace.len().min(begins + STEPS);
    match key {
        Action::Right => {
            for (figure, step) in figures.iter_mut().zip([2, 3, 4, 5, 6, 8, 11, 16]) {
                *figure = speed(begins + step - 1);
            }
        }
        Action::ReleaseDirection => {
            let stands =
                steps.into_iter().find(|step| speed(*step).is_some_and(|mps| mps < STANDS_MPS));
            figures[10] = stands.map(|step| (step - begins) as f64);
            figures[11] = stands
                .map(|step| apart(trace[step - 1].teams[0][me], trace[begins - 1].teams[0][me]));
        }
        _ => {
            let before: Vec<f64> = (begins - 5..begins).filter_map(speed).collect();
            let old = mean(&before);
            let straight = |step: &usize| {
                let (now, then) = (trace[*step].teams[0][me], trace[*step - 1].teams[0][me]);
                let off = (then[1] - now[1]).atan2(now[0] - then[0]).to_degrees() - way;
                off.abs() < TURNED_DEG && apart(now, then) > 0.0
            };
            let fast =
                |step: &usize| straight(step) && speed(*step).is_some_and(|mps| mps >= FAST * old);
            figures[8] = steps.clone().find(straight).map(|step| (step - begins + 1) as f64);
            figures[9] = steps.clone().find(fast).map(|step| (step - begins + 1) as f64);
        }
    }
    figures
}
