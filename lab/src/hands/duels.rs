//! An agent runs at one defender.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, apart, yes};

const COLUMNS: [FigureColumn; 4] = [
    ("furthest_x", FigureKind::Place),
    ("steps_with_ball", FigureKind::Steps),
    ("nearest_m", FigureKind::Metres),
    ("lost", FigureKind::Share),
];

const GROUPS: [Group; 1] = [("how far", &["furthest_x", "steps_with_ball", "nearest_m", "lost"])];

/// The topic.
pub(super) const TOPIC: Topic =
    Topic { name: "duel", file: "grf_duels.json", columns: &COLUMNS, groups: &GROUPS, read };

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    let owned = || trace.iter().enumerate().filter(|(step, view)| *step > 0 && view.owner == 0);
    let furthest =
        owned().map(|(_, view)| view.ball[0] / 54.4).fold(trace[0].ball[0] / 54.4, f64::max);
    let nearest = trace.iter().skip(1).map(|view| apart(view.player(0, 0), view.teams[1][1]));
    vec![
        Some(furthest),
        Some(owned().next_back().map_or(0.0, |(step, _)| step as f64)),
        Some(nearest.fold(f64::INFINITY, f64::min)),
        Some(yes(trace[trace.len() - 1].owner == 1)),
    ]
}
