//! Turns with the ball, an opponent near.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, apart, first, yes};
use setpiece::scenario::vocabulary::Action;

/// A slower player has no direction, m/s.
const MOVES_MPS: f64 = 1.5;
/// A turn is done within this angle of the new direction, degrees.
const TURNED_DEG: f64 = 25.0;

const COLUMNS: [FigureColumn; 7] = [
    ("had", FigureKind::Share),
    ("foe_m", FigureKind::Metres),
    ("lost", FigureKind::Share),
    ("kept_5", FigureKind::Share),
    ("kept_15", FigureKind::Share),
    ("turn_step", FigureKind::Steps),
    ("turn_owned", FigureKind::Share),
];

const GROUPS: [Group; 3] = [
    ("before it", &["had", "foe_m"]),
    ("who has it", &["lost", "kept_5", "kept_15"]),
    ("when", &["turn_step", "turn_owned"]),
];

/// The topic.
pub(super) const TOPIC: Topic =
    Topic { name: "turn", file: "grf_turns.json", columns: &COLUMNS, groups: &GROUPS, read };

/// The key of a turn and its direction.
fn turn(plan: &str) -> (Action, f64) {
    match plan.rsplit(' ').next() {
        Some("45") => (Action::TopRight, 45.0),
        Some("90") => (Action::Top, 90.0),
        Some("135") => (Action::TopLeft, 135.0),
        _ => (Action::Left, 180.0),
    }
}

fn read(trace: &[TraceMoment], row: &RecordedRow) -> Vec<Option<f64>> {
    let (key, way) = turn(&row.plan);
    let begins =
        first(trace, 1, |view| view.pressed[0] == key).filter(|step| trace[step - 1].owner == 0);
    let Some(begins) = begins else {
        let mut none = vec![None; COLUMNS.len()];
        none[0] = Some(0.0);
        return none;
    };
    let before = &trace[begins - 1];
    let me = before.active[0];
    let at = before.teams[0][me];
    let foe =
        before.teams[1].iter().skip(1).map(|foe| apart(*foe, at)).fold(f64::INFINITY, f64::min);
    let last = trace.len() - 1;
    let kept = |steps: usize| {
        let to = last.min(begins + steps);
        Some(yes(trace[begins..=to].iter().all(|view| view.owner != 1) && trace[to].mode == 0))
    };
    let turned = (begins..=last).find(|step| {
        let (now, before) = (trace[*step].teams[0][me], trace[step - 1].teams[0][me]);
        let off = (-(now[1] - before[1])).atan2(now[0] - before[0]).to_degrees() - way;
        apart(now, before) * 10.0 > MOVES_MPS
            && ((off + 180.0).rem_euclid(360.0) - 180.0).abs() < TURNED_DEG
    });
    vec![
        Some(1.0),
        foe.is_finite().then_some(foe),
        Some(yes(trace[begins..].iter().any(|view| view.owner == 1))),
        kept(5),
        kept(15),
        turned.map(|step| (step - begins + 1) as f64),
        turned.map(|step| yes(trace[step].owner == 0)),
    ]
}
