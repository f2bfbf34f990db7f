//! Tables of tracking and events, with a header line; an empty field means that there is no value.

use super::cdf::{REFEREE, event_id};
use super::words::{period, team};
use super::{FRAME_MS, Tracking};
use std::fmt::Write as _;

/// One row per frame for the ball, and one for each player on the pitch.
pub(super) fn tracking(tracking: &Tracking) -> String {
    let mut table =
        String::from("frame_id,time_s,period,in_play,possession,id,team_id,x,y,z,vx,vy,vz\n");
    for (at, moment) in tracking.moments.iter().enumerate() {
        let shared = format!(
            "{at},{},{},{},{}",
            seconds(at as u32 * FRAME_MS),
            period(moment.second_half),
            moment.in_play,
            moment.possession.map_or("", team),
        );
        let ([x, y, z], [vx, vy, vz]) = (moment.ball.map(number), moment.ball_mps.map(number));
        let _ = writeln!(table, "{shared},ball,,{x},{y},{z},{vx},{vy},{vz}");
        for it in &moment.players {
            let ([x, y], [vx, vy]) = (it.at.map(number), it.mps.map(number));
            let (id, team) = (quoted(tracking.name(it.slot)), team(it.slot.team()));
            let _ = writeln!(table, "{shared},{id},{team},{x},{y},,{vx},{vy},");
        }
    }
    table
}

/// One row per event.
pub(super) fn events(tracking: &Tracking) -> String {
    let mut table = String::from(
        "id,time_s,frame_id,frame_id_end,period,type,sub_type,is_successful,outcome_type,player_id,\
         team_id,official_id,receiver_id,receiver_time_s,receiver_team_id,x,y,x_end,y_end,\
         body_part,related_event_ids\n",
    );
    for (at, event) in tracking.events.iter().enumerate() {
        let name = |slot| quoted(tracking.name(slot));
        let (to, received) = (event.received.map(|it| it.0), event.received.map(|it| it.1));
        let related: Vec<String> = event.related.iter().map(|&at| event_id(at)).collect();
        let fields = [
            event_id(at),
            seconds(event.time_ms),
            event.frame.to_string(),
            event.end.map(|(_, frame)| frame.to_string()).unwrap_or_default(),
            period(event.second_half).to_owned(),
            event.kind.to_owned(),
            event.sub_kind.unwrap_or_default().to_owned(),
            event.success.to_string(),
            event.outcome.to_owned(),
            event.by.map(name).unwrap_or_default(),
            event.by.map(|by| team(by.team())).unwrap_or_default().to_owned(),
            if event.by.is_none() { REFEREE } else { "" }.to_owned(),
            to.map(name).unwrap_or_default(),
            received.map(seconds).unwrap_or_default(),
            to.map(|to| team(to.team())).unwrap_or_default().to_owned(),
            number(event.at[0]),
            number(event.at[1]),
            event.end.map(|([x, _], _)| number(x)).unwrap_or_default(),
            event.end.map(|([_, y], _)| number(y)).unwrap_or_default(),
            event.body.unwrap_or_default().to_owned(),
            related.join(";"),
        ];
        let _ = writeln!(table, "{}", fields.join(","));
    }
    table
}

/// A number with the digits that it has in the other form; a table's reader gets the same one.
fn number(value: f32) -> String {
    serde_json::to_string(&value).unwrap_or_default()
}

fn seconds(time_ms: u32) -> String {
    format!("{}.{:02}", time_ms / 1000, time_ms % 1000 / 10)
}

/// A field that may hold what separates fields.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}
