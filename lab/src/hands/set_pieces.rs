//! Set pieces: who takes them, when play resumes, and what an agent sees meanwhile.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, apart, first, yes};
use crate::pitch::mean;
use setpiece::scenario::vocabulary::Role;

/// Steps after the ball has moved in which the last owner counts.
const KEPT_STEPS: usize = 15;
/// Steps over which the largest speed is taken.
const SPEED_STEPS: usize = 5;
/// Faster than any kick: the ball was placed, m/s.
const PLACED_MPS: f64 = 60.0;

const COLUMNS: [FigureColumn; 16] = [
    ("awarded", FigureKind::Share),
    ("in_mode", FigureKind::Share),
    ("resumed", FigureKind::Steps),
    ("moved", FigureKind::Steps),
    ("ownerless", FigureKind::Share),
    ("agent_takes", FigureKind::Share),
    ("taker_keeper", FigureKind::Share),
    ("taker_defender", FigureKind::Share),
    ("taker_midfielder", FigureKind::Share),
    ("taker_forward", FigureKind::Share),
    ("taker_m", FigureKind::Metres),
    ("waiter_m", FigureKind::Metres),
    ("ball_speed", FigureKind::Speed),
    ("kept", FigureKind::Share),
    ("first_right", FigureKind::Share),
    ("first_own", FigureKind::Steps),
];

const GROUPS: [Group; 5] = [
    ("when", &["awarded", "resumed", "moved"]),
    ("what is seen meanwhile", &["in_mode", "ownerless"]),
    (
        "who takes it",
        &["agent_takes", "taker_keeper", "taker_defender", "taker_midfielder", "taker_forward"],
    ),
    ("where they stand", &["taker_m", "waiter_m"]),
    ("what comes of it", &["ball_speed", "kept", "first_right", "first_own"]),
];

/// The topic.
pub(super) const TOPIC: Topic = Topic {
    name: "set piece",
    file: "grf_set_pieces.json",
    columns: &COLUMNS,
    groups: &GROUPS,
    read,
};

/// The `game_mode` of a scene; a kick-off shows none.
fn mode_of(scene: &str) -> usize {
    match scene {
        "goal kick" => 2,
        "free kick" | "foul" => 3,
        "corner" => 4,
        "throw-in" => 5,
        "penalty" => 6,
        _ => 0,
    }
}

fn read(trace: &[TraceMoment], row: &RecordedRow) -> Vec<Option<f64>> {
    let mode = mode_of(&row.scene);
    let begins =
        first(
            trace,
            1,
            |view| if mode == 0 { view.score != trace[0].score } else { view.mode != 0 },
        );
    let Some(begins) = begins.filter(|step| trace[*step].mode == mode) else {
        let mut none = vec![None; COLUMNS.len()];
        none[0] = Some(0.0);
        return none;
    };
    let spot = [trace[begins].ball[0], trace[begins].ball[1]];
    let resumed = if mode == 0 { None } else { first(trace, begins, |view| view.mode == 0) };
    let moved = first(trace, begins + 1, |view| apart([view.ball[0], view.ball[1]], spot) > 1.0);
    let share = |from: usize, to: usize, holds: &dyn Fn(&TraceMoment) -> bool| {
        let of: Vec<f64> = trace[from..to.max(from)].iter().map(|view| yes(holds(view))).collect();
        (!of.is_empty()).then(|| mean(&of))
    };
    // The last step in which the taker still waits.
    let before = resumed.or(moved).map_or(trace.len() - 1, |step| step - 1);
    let taker = trace[before].nearest(1, spot, |_| true);
    let role = |of: &[Role]| Some(yes(of.contains(&trace[before].roles[1][taker])));
    let start = &trace[begins];
    let steps = |step: Option<usize>| step.map(|step| (step - begins) as f64);
    let last = trace.len() - 1;
    let owned = first(trace, begins + 1, |view| view.owner >= 0 && (mode == 0 || view.mode == 0));
    vec![
        Some(1.0),
        moved.and_then(|moved| share(begins, moved, &|view| view.mode == mode)),
        steps(resumed),
        steps(moved),
        share(begins, resumed.or(moved).unwrap_or(trace.len()), &|view| view.owner == -1),
        Some(yes(trace[before].active[1] == taker)),
        role(&[Role::GK]),
        role(&[Role::CB, Role::LB, Role::RB]),
        role(&[Role::DM, Role::CM, Role::LM, Role::RM, Role::AM]),
        role(&[Role::CF]),
        Some(apart(start.teams[1][start.nearest(1, spot, |_| true)], spot)),
        Some(apart(start.player(0, 0), spot)),
        moved.map(|from| {
            let after = trace[from..trace.len().min(from + SPEED_STEPS)].iter();
            let plays =
                after.filter(|view| [0, mode].contains(&view.mode) && view.score == start.score);
            plays.map(|view| view.speed).filter(|mps| *mps < PLACED_MPS).fold(0.0, f64::max)
        }),
        moved.map(|from| {
            let after = &trace[from..=last.min(from + KEPT_STEPS)];
            yes(after.iter().rev().find(|view| view.owner >= 0).is_some_and(|view| view.owner == 1))
        }),
        owned.map(|step| yes(trace[step].owner == 1)),
        steps(owned),
    ]
}
