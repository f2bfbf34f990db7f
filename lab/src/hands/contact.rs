//! An agent dribbles at one or two defenders: what happens at contact and after it.

use super::recorded::{FigureColumn, FigureKind, Group, RecordedRow, Topic};
use super::trace::{TraceMoment, apart, pace, yes};

/// Within this distance of a defender they are in contact, metres.
const CONTACT_M: f64 = 1.0;
/// A defender nearer than this jockeys, metres.
const JOCKEY_M: f64 = 8.0;
/// Steps of jockeying for a mean.
const JOCKEY_STEPS: usize = 5;

const COLUMNS: [FigureColumn; 19] = [
    ("contact", FigureKind::Share),
    ("jockey_m", FigureKind::Metres),
    ("furthest_x", FigureKind::Place),
    ("lost", FigureKind::Share),
    ("lost_step", FigureKind::Steps),
    ("contact_step", FigureKind::Steps),
    ("contact_x", FigureKind::Place),
    ("ours_5", FigureKind::Share),
    ("theirs_5", FigureKind::Share),
    ("ours_10", FigureKind::Share),
    ("theirs_10", FigureKind::Share),
    ("ball_before", FigureKind::Speed),
    ("ball_at", FigureKind::Speed),
    ("ball_after", FigureKind::Speed),
    ("me_before", FigureKind::Speed),
    ("me_at", FigureKind::Speed),
    ("me_after", FigureKind::Speed),
    ("foul", FigureKind::Share),
    ("goal", FigureKind::Share),
];

const GROUPS: [Group; 5] = [
    ("how near", &["contact", "contact_step", "contact_x", "furthest_x", "jockey_m"]),
    ("who has it after contact", &["ours_5", "theirs_5", "ours_10", "theirs_10"]),
    ("how fast the ball is", &["ball_before", "ball_at", "ball_after"]),
    ("how fast the player is", &["me_before", "me_at", "me_after"]),
    ("what comes of it", &["lost", "lost_step", "foul", "goal"]),
];

/// The topic.
pub(super) const TOPIC: Topic =
    Topic { name: "contact", file: "grf_contact.json", columns: &COLUMNS, groups: &GROUPS, read };

fn read(trace: &[TraceMoment], _: &RecordedRow) -> Vec<Option<f64>> {
    let mut jockeyed = Vec::new();
    let mut contact = None;
    let mut lost = None;
    let mut furthest: Option<f64> = None;
    for (step, view) in trace.iter().enumerate().skip(1) {
        if view.owner == 1 && lost.is_none() {
            lost = Some(step);
        }
        if view.owner == 0 {
            furthest = Some(furthest.unwrap_or(-9.0).max(view.ball[0] / 54.4));
        }
        let me = view.player(0, 0);
        let nearest =
            view.teams[1].iter().skip(1).map(|foe| apart(*foe, me)).fold(f64::INFINITY, f64::min);
        if lost.is_some() || contact.is_some() {
            continue;
        }
        if nearest <= CONTACT_M {
            contact = Some(step);
        } else if nearest < JOCKEY_M && view.owner == 0 {
            jockeyed.push(nearest);
        }
    }
    let at = |step: usize| &trace[step.min(trace.len() - 1)];
    let owned = |team: i8, later: usize| contact.map(|step| yes(at(step + later).owner == team));
    let moment =
        |later: isize| contact.and_then(|step| step.checked_add_signed(later)).filter(|s| *s > 0);
    let ball = |later| moment(later).and_then(|step| trace.get(step)).map(|view| view.speed);
    let me = |later| pace(trace, moment(later)?, trace[contact?].active[0]);
    vec![
        Some(yes(contact.is_some())),
        (jockeyed.len() >= JOCKEY_STEPS).then(|| crate::pitch::mean(&jockeyed)),
        furthest,
        Some(yes(lost.is_some())),
        lost.map(|step| step as f64),
        contact.map(|step| step as f64),
        contact.map(|step| trace[step].ball[0] / 54.4),
        owned(0, 5),
        owned(1, 5),
        owned(0, 10),
        owned(1, 10),
        ball(-2),
        ball(0),
        ball(3),
        me(-2),
        me(0),
        me(3),
        Some(yes(trace.iter().any(|view| [3, 6].contains(&view.mode)))),
        Some(yes(trace[trace.len() - 1].score[0] > 0)),
    ]
}
