//! Which player the agent controls, and when it switches.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, first, yes};
use crate::pitch::mean;
use setpiece::scenario::vocabulary::Action;

const COLUMNS: [FigureColumn; 11] = [
    ("happened", FigureKind::Share),
    ("switch", FigureKind::Share),
    ("switch_step", FigureKind::Steps),
    ("to_nearest", FigureKind::Share),
    ("to_owner", FigureKind::Share),
    ("new_m", FigureKind::Metres),
    ("changes", FigureKind::Steps),
    ("nearest", FigureKind::Share),
    ("keeper", FigureKind::Share),
    ("owner_step", FigureKind::Steps),
    ("leave_step", FigureKind::Steps),
];

const GROUPS: [Group; 4] = [
    ("when", &["happened", "switch", "switch_step", "changes"]),
    ("to which player", &["to_nearest", "to_owner", "new_m"]),
    ("which player the agent has", &["nearest", "keeper"]),
    ("the ball meanwhile", &["leave_step", "owner_step"]),
];

/// The topic.
pub(super) const TOPIC: Topic = Topic {
    name: "switching",
    file: "grf_switching.json",
    columns: &COLUMNS,
    groups: &GROUPS,
    read,
};

fn read(trace: &[TraceMoment], row: &RecordedRow) -> Vec<Option<f64>> {
    let event = match row.event.as_str() {
        "kick" => first(trace, 2, |view| {
            [Action::ShortPass, Action::LongPass, Action::HighPass].contains(&view.pressed[0])
        }),
        "lost" => first(trace, 2, |view| view.owner == 1),
        "score" => first(trace, 2, |view| view.score != trace[0].score),
        _ => Some(2),
    };
    let Some(event) = event.filter(|event| *event < trace.len()) else {
        let mut none = vec![None; COLUMNS.len()];
        none[0] = Some(0.0);
        return none;
    };
    let nearest =
        |view: &TraceMoment| view.nearest(0, [view.ball[0], view.ball[1]], |player| player > 0);
    let before = trace[event - 1].active[0];
    let other = row.event == "kick";
    let owner = first(trace, event, |view| view.owner == 0 && !(other && view.who == before));
    let switch = first(trace, event, |view| view.active[0] != before);
    let new = switch.map(|step| (&trace[step], trace[step].active[0]));
    let rest = &trace[event..];
    let share = |holds: &dyn Fn(&TraceMoment) -> bool| {
        Some(mean(&rest.iter().map(|v| yes(holds(v))).collect::<Vec<_>>()))
    };
    let changes =
        trace[event - 1..].windows(2).filter(|pair| pair[0].active[0] != pair[1].active[0]).count();
    let steps = |step: Option<usize>| step.map(|step| (step - event) as f64);
    vec![
        Some(1.0),
        Some(yes(switch.is_some())),
        steps(switch),
        new.map(|(view, player)| yes(player == nearest(view))),
        new.zip(owner).map(|((_, player), owner)| yes(player == trace[owner].who)),
        new.map(|(view, player)| view.ball_from(view.teams[0][player])),
        Some(changes as f64),
        share(&|view| view.active[0] == nearest(view)),
        share(&|view| view.active[0] == 0),
        steps(owner),
        steps(first(trace, event, |view| view.owner == -1 && view.speed > 9.0)).filter(|_| other),
    ]
}
