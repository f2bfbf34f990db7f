//! The first steps of matches: the speed of the ball and its owner.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, yes};
use crate::pitch::mean;

/// Faster than any kick: the ball was placed, m/s.
const PLACED_MPS: f64 = 60.0;

const COLUMNS: [FigureColumn; 10] = [
    ("slow", FigureKind::Part),
    ("middling", FigureKind::Part),
    ("fast", FigureKind::Part),
    ("fastest", FigureKind::Part),
    ("owned_left", FigureKind::Part),
    ("owned_right", FigureKind::Part),
    ("stopped", FigureKind::Part),
    ("high", FigureKind::Part),
    ("goals_left", FigureKind::Count),
    ("goals_right", FigureKind::Count),
];

const GROUPS: [Group; 4] = [
    ("how fast the ball is", &["slow", "middling", "fast", "fastest"]),
    ("who has it", &["owned_left", "owned_right"]),
    ("how play goes", &["stopped", "high"]),
    ("goals", &["goals_left", "goals_right"]),
];

/// The topic.
pub(super) const TOPIC: Topic =
    Topic { name: "match", file: "grf_matches.json", columns: &COLUMNS, groups: &GROUPS, read };

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    let plays = |pair: &&[TraceMoment]| {
        pair[0].mode == 0 && pair[1].mode == 0 && pair[0].score == pair[1].score
    };
    let speeds =
        trace.windows(2).filter(plays).map(|pair| pair[1].speed).filter(|mps| *mps < PLACED_MPS);
    let speeds: Vec<f64> = speeds.collect();
    let between = |low: f64, high: f64| {
        Some(mean(&speeds.iter().map(|mps| yes((low..high).contains(mps))).collect::<Vec<_>>()))
    };
    let share = |holds: &dyn Fn(&TraceMoment) -> bool| {
        Some(mean(&trace.iter().skip(1).map(|view| yes(holds(view))).collect::<Vec<_>>()))
    };
    let score = trace[trace.len() - 1].score;
    vec![
        between(0.0, 5.0),
        between(5.0, 15.0),
        between(15.0, 25.0),
        between(25.0, PLACED_MPS),
        share(&|view| view.owner == 0),
        share(&|view| view.owner == 1),
        share(&|view| view.mode != 0),
        share(&|view| view.ball[2] > 1.0),
        Some(f64::from(score[0])),
        Some(f64::from(score[1])),
    ]
}
