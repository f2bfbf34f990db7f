//! An agent wins the ball from a bot, and races a bot for a loose ball.

use super::recorded::{Column, Group, Kind, Row, Topic};
use super::trace::{View, apart, first, yes};

const COLUMNS: [Column; 8] = [
    ("first_ours", Kind::Share),
    ("first_step", Kind::Steps),
    ("won", Kind::Share),
    ("won_step", Kind::Steps),
    ("foul", Kind::Share),
    ("goal", Kind::Share),
    ("out", Kind::Share),
    ("nearest_m", Kind::Metres),
];

const GROUPS: [Group; 4] = [
    ("who has it", &["first_ours", "won"]),
    ("when", &["first_step", "won_step"]),
    ("what comes of it", &["foul", "goal", "out"]),
    ("how near", &["nearest_m"]),
];

/// The topic.
pub(super) const TOPIC: Topic =
    Topic { name: "winning the ball", file: "grf_winning.json", columns: &COLUMNS, groups: &GROUPS, read };

fn read(trace: &[View], _: &Row) -> Vec<Option<f64>> {
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
