//! The Common Data Format 0.3.2 (Anzer and others, 2025): metadata, tracking and events.
//!
//! Its times are moments of a calendar. An episode has none, so it begins with 1970.

use super::words::{period, team};
use super::{FRAME_MS, FRAME_RATE, TrackedEvent, TrackedMoment, TrackedPlayer, Tracking};
use serde::Serialize;
use serde_json::{Value, json};
use setpiece_scenario::vocabulary::PitchMeasure;
use setpiece_scenario::{PitchSize, Team};

/// The version of the format.
const VERSION: &str = "0.3.2";
/// The id of whoever blows the whistle.
pub(super) const REFEREE: &str = "referee";
/// Milliseconds of a day.
const DAY_MS: u32 = 24 * 60 * 60 * 1000;

/// The sheet about the match.
pub(super) fn meta(tracking: &Tracking) -> String {
    let halves: Vec<CdfHalf> =
        [false, true].into_iter().filter_map(|second| CdfHalf::of(tracking, second)).collect();
    let side = |side: Team| {
        let of = |player: &&TrackedPlayer| player.slot.team() == side;
        let players = tracking.players.iter().filter(of).map(|player| {
            json!({
                "id": player.id,
                "team_id": team(side),
                "jersey_number": player.number,
                "is_starter": player.starts,
            })
        });
        json!({"id": team(side), "name": team(side), "players": players.collect::<Vec<_>>()})
    };
    let source = json!({"version": env!("CARGO_PKG_VERSION"), "name": "Setpiece"});
    let live = |extra: Value| {
        let mut source = source.clone();
        source["collection_timing"] = json!("live");
        if let (Some(source), Value::Object(extra)) = (source.as_object_mut(), extra) {
            source.extend(extra);
        }
        source
    };
    let sheet = json!({
        "competition": {"id": "setpiece"},
        "season": {"id": "setpiece"},
        "match": {
            "id": tracking.id,
            "kickoff_time": timestamp(0),
            "periods": halves.iter().map(CdfHalf::period).collect::<Vec<_>>(),
            "whistles": halves.iter().flat_map(CdfHalf::whistles).collect::<Vec<_>>(),
        },
        "teams": {"home": side(Team::Left), "away": side(Team::Right)},
        "venue": {
            "id": "setpiece",
            "pitch_length": 2.0 * tracking.pitch.half_length(),
            "pitch_width": 2.0 * tracking.pitch.half_width(),
        },
        "officials": [{"id": REFEREE, "type": "main_referee"}],
        "meta": {
            "video": null,
            "landmarks": null,
            "ball": null,
            "tracking": live(json!({"fps": FRAME_RATE})),
            "event": live(json!({})),
            "meta": source,
            "cdf": {"version": VERSION},
        },
    });
    format!("{sheet:#}\n")
}

/// The goals and boxes of the pitch, metres. The strict validator of the format accepts no further
/// keys in `meta.json`, so they have a file of their own, which `setpiece.kloppy` reads.
pub(super) fn pitch(pitch: &PitchSize) -> String {
    let twice = |measure| 2.0 * pitch.measure(measure);
    let sheet = json!({
        "goal_width": twice(PitchMeasure::GoalHalfWidth),
        "goal_height": pitch.measure(PitchMeasure::GoalHeight),
        "penalty_area_length": pitch.measure(PitchMeasure::BoxDepth),
        "penalty_area_width": twice(PitchMeasure::BoxHalfWidth),
        "six_yard_length": pitch.measure(PitchMeasure::SixYardDepth),
        "six_yard_width": twice(PitchMeasure::SixYardHalfWidth),
        "penalty_spot_distance": pitch.measure(PitchMeasure::PenaltySpot),
        "circle_radius": pitch.measure(PitchMeasure::Circle),
    });
    format!("{sheet:#}\n")
}

/// A half, and its first and last frame.
struct CdfHalf {
    second: bool,
    first: u32,
    last: u32,
}

impl CdfHalf {
    /// A half of the match, if there are frames of it.
    fn of(tracking: &Tracking, second: bool) -> Option<CdfHalf> {
        let is_its = |moment: &TrackedMoment| moment.second_half == second;
        let first = tracking.moments.iter().position(is_its)?;
        let last = tracking.moments.iter().rposition(is_its)?;
        Some(CdfHalf { second, first: first as u32, last: last as u32 })
    }

    fn period(&self) -> Value {
        json!({
            "period": period(self.second),
            "play_direction": "left_right",
            "start_time": timestamp(self.first * FRAME_MS),
            "end_time": timestamp(self.last * FRAME_MS),
            "frame_id_start": self.first,
            "frame_id_end": self.last,
            "left_team_id": team(Team::Left),
            "right_team_id": team(Team::Right),
        })
    }

    fn whistles(&self) -> [Value; 2] {
        [("start", self.first), ("end", self.last)].map(|(what, frame)| {
            let time = timestamp(frame * FRAME_MS);
            json!({"type": period(self.second), "sub_type": what, "time": time})
        })
    }
}

/// A line of `tracking.jsonl`.
#[derive(Serialize)]
struct CdfFrame<'a> {
    frame_id: u32,
    timestamp: String,
    period: &'static str,
    r#match: CdfId<'a>,
    teams: CdfTeams<'a>,
    ball: CdfBall,
}

#[derive(Serialize)]
struct CdfId<'a> {
    id: &'a str,
}

#[derive(Serialize)]
struct CdfTeams<'a> {
    home: CdfTeam<'a>,
    away: CdfTeam<'a>,
}

#[derive(Serialize)]
struct CdfTeam<'a> {
    id: &'static str,
    players: Vec<CdfPlayer<'a>>,
}

#[derive(Serialize)]
struct CdfPlayer<'a> {
    id: &'a str,
    x: f32,
    y: f32,
    vel: f32,
}

#[derive(Serialize)]
struct CdfBall {
    x: f32,
    y: f32,
    z: f32,
    status: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    poss_team_id: Option<&'static str>,
}

/// One line per frame.
pub(super) fn tracking(tracking: &Tracking) -> String {
    let frame = |(at, moment): (usize, &TrackedMoment)| {
        let side = |side: Team| {
            let players = moment.players.iter().filter(|it| it.slot.team() == side);
            let player = |it: &super::TrackedPlace| {
                let [x, y] = it.at;
                let [x_mps, y_mps] = it.mps;
                let vel = (x_mps * x_mps + y_mps * y_mps).sqrt();
                CdfPlayer { id: tracking.name(it.slot), x, y, vel }
            };
            CdfTeam { id: team(side), players: players.map(player).collect() }
        };
        let [x, y, z] = moment.ball;
        line(&CdfFrame {
            frame_id: at as u32,
            timestamp: timestamp(at as u32 * FRAME_MS),
            period: period(moment.second_half),
            r#match: CdfId { id: &tracking.id },
            teams: CdfTeams { home: side(Team::Left), away: side(Team::Right) },
            ball: CdfBall {
                x,
                y,
                z,
                status: moment.in_play,
                poss_team_id: moment.possession.map(team),
            },
        })
    };
    tracking.moments.iter().enumerate().map(frame).collect()
}

/// A line of `event.jsonl`.
#[derive(Serialize)]
struct CdfLine<'a> {
    r#match: CdfId<'a>,
    meta: CdfSync,
    event: CdfEvent<'a>,
    tracking: CdfFrames,
}

#[derive(Serialize)]
struct CdfSync {
    is_synced: bool,
}

#[derive(Serialize)]
struct CdfFrames {
    frame_id: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    frame_id_end: Option<u32>,
}

#[derive(Serialize)]
struct CdfEvent<'a> {
    id: String,
    time: String,
    period: &'static str,
    r#type: &'static str,
    sub_type: Option<&'static str>,
    is_successful: bool,
    outcome_type: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    player_id: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    team_id: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    official_id: Option<&'static str>,
    receiver_id: Option<&'a str>,
    receiver_time: Option<String>,
    receiver_team_id: Option<&'static str>,
    x: f32,
    y: f32,
    x_end: Option<f32>,
    y_end: Option<f32>,
    body_part: Option<&'static str>,
    related_event_ids: Option<Vec<String>>,
}

/// One line per event.
pub(super) fn events(tracking: &Tracking) -> String {
    let event = |(at, event): (usize, &TrackedEvent)| {
        let end = event.end;
        line(&CdfLine {
            r#match: CdfId { id: &tracking.id },
            meta: CdfSync { is_synced: true },
            event: CdfEvent {
                id: event_id(at),
                time: timestamp(event.time_ms),
                period: period(event.second_half),
                r#type: event.kind,
                sub_type: event.sub_kind,
                is_successful: event.success,
                outcome_type: event.outcome,
                player_id: event.by.map(|by| tracking.name(by)),
                team_id: event.by.map(|by| team(by.team())),
                official_id: event.by.is_none().then_some(REFEREE),
                receiver_id: event.received.map(|(to, _)| tracking.name(to)),
                receiver_time: event.received.map(|(_, time_ms)| timestamp(time_ms)),
                receiver_team_id: event.received.map(|(to, _)| team(to.team())),
                x: event.at[0],
                y: event.at[1],
                x_end: end.map(|([x, _], _)| x),
                y_end: end.map(|([_, y], _)| y),
                body_part: event.body,
                related_event_ids: (!event.related.is_empty())
                    .then(|| event.related.iter().map(|&at| event_id(at)).collect()),
            },
            tracking: CdfFrames {
                frame_id: event.frame,
                frame_id_end: end.map(|(_, frame)| frame),
            },
        })
    };
    tracking.events.iter().enumerate().map(event).collect()
}

/// The id of an event by its place in the list.
pub(super) fn event_id(at: usize) -> String {
    format!("event_{at}")
}

/// A JSON object and the end of its line.
fn line(value: &impl Serialize) -> String {
    // These structures have nothing that JSON can't hold.
    serde_json::to_string(value).map(|text| text + "\n").unwrap_or_default()
}

/// A time after the start, as a moment of 1970.
fn timestamp(time_ms: u32) -> String {
    let (day, ms) = (time_ms / DAY_MS + 1, time_ms % DAY_MS);
    let (hours, minutes, seconds) = (ms / 3_600_000, ms / 60_000 % 60, ms / 1000 % 60);
    format!("1970-01-{day:02}T{hours:02}:{minutes:02}:{seconds:02}.{:03}Z", ms % 1000)
}

#[cfg(test)]
mod tests {
    use super::timestamp;

    #[test]
    fn a_time_becomes_a_moment_of_1970() {
        assert_eq!(timestamp(0), "1970-01-01T00:00:00.000Z");
        assert_eq!(timestamp(3_723_040), "1970-01-01T01:02:03.040Z");
        assert_eq!(timestamp(86_400_100), "1970-01-02T00:00:00.100Z");
    }
}
