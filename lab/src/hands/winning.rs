//! An agent wins the ball from a bot, and races a bot for a loose ball.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, apart, first, yes};

const COLUMNS: [FigureColumn; 8] = [
    ("first_ours", FigureKind::Share),
    ("first_step", FigureKind::Steps),
    ("won", FigureKind::Share),
    ("won_step", FigureKind::Steps),
    ("foul", FigureKind::Share),
    ("goal", FigureKind::Share),
    ("out", FigureKind::Share),
    ("nearest_m", FigureKind::Metres),
];

const GROUPS: [Group; 4] = [
    ("who has it", &["first_ours", "won"]),
    ("when", &["first_step", "won_step"]),
    ("what comes of it", &["foul", "goal", "out"]),
    ("how near", &["nearest_m"]),
];

/// The topic.
pub(super) const TOPIC: Topic = Topic {
    name: "winning the ball",
    file: "grf_winning.json",
    columns: &COLUMNS,
    groups: &GROUPS,
    read,
};

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    let owned = first(trace, 1, |view| view.owner >= 0);
    let theirs = first(trace, 1, |view| view.owner == 1);
    let won = theirs.and_then(|from| first(trace, from, |view| view.owner == 0));
    let end = &trace[trace.len() - 1];
    let nearest = trace.iter().skip(1).map(|view| apart(view.player(0, 0), view.teams[1][1]));
    vec![
        owned.map(|step| yes(trace[step].owner == 0)),
        owned.map(|step| step as f64),
        theirs.map(|_| yes(won.is_some())),
        won.map(|step| step as f64),
        Some(yes(trace.iter().any(|view| [3, 6].contains(&view.mode)))),
        Some(yes(end.score[1] > 0)),
        Some(yes([2, 4, 5].contains(&end.mode))),
        Some(nearest.fold(f64::INFINITY, f64::min)),
    ]
}
