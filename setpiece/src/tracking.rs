//! Tracking and event data of a recorded episode, for the tools of football analysis.
//!
//! Lengths are metres and speeds m/s. The origin is the centre spot, +x points at the right team's
//! goal, +y at the top of the picture, z up. The left team attacks towards +x all the time.
//! There are ten frames per second: frame 0 is the start, frame n the state after step n, as agents
//! observe it. A restart takes no step, so the frame of a step that stopped play shows the restart.

mod cdf;
mod csv;
mod events;
mod words;

use crate::engine::environment::Environment;
use crate::engine::state::PlayerId;
use crate::error::{Error, FileFault};
use crate::files::write;
use crate::replay::Replay;
use crate::scene::number;
use events::EventLog;
use glam::Vec2;
use setpiece_scenario::pitch::{PLAYERS_MAX, STEPS_PER_S};
use setpiece_scenario::{GameMode, PitchSize, Team};
use std::path::{Path, PathBuf};

/// Frames per second.
pub const FRAME_RATE: u32 = STEPS_PER_S as u32;
/// Milliseconds of a frame.
const FRAME_MS: u32 = 1000 / FRAME_RATE;

/// The form of the files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrackingForm {
    /// Common Data Format: `meta.json`, `tracking.jsonl`, `event.jsonl`; and `pitch.json`, for
    /// which the format has no place.
    Cdf,
    /// Tables: `tracking.csv`, `events.csv`, and the same `meta.json` and `pitch.json`.
    Csv,
}

/// What a recorded episode looks like from the stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracking {
    /// The scenario's name, the seed and the index: `corner_7_0`.
    pub id: String,
    /// How large the pitch is, with its goals and boxes.
    pub pitch: PitchSize,
    /// Everyone who is on the pitch at some time, the left team first.
    pub players: Vec<TrackedPlayer>,
    /// The frames.
    pub moments: Vec<TrackedMoment>,
    /// What happened, in the order in which it began.
    pub events: Vec<TrackedEvent>,
}

/// A player.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackedPlayer {
    /// Their name, else their team, role and number in that role.
    pub id: String,
    /// Their slot.
    pub slot: PlayerId,
    /// The number on their shirt.
    pub number: u8,
    /// Whether they are on the pitch in the first frame.
    pub starts: bool,
}

/// A frame.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackedMoment {
    /// Whether it is in the second half.
    pub second_half: bool,
    /// Whether the ball is in play; it isn't while a set piece waits to be taken.
    pub in_play: bool,
    /// The team that has the ball at its feet or in its hands.
    pub possession: Option<Team>,
    /// Where the ball is: x, y, z.
    pub ball: [f32; 3],
    /// The ball's velocity.
    pub ball_mps: [f32; 3],
    /// The players on the pitch, in the order of [`Tracking::players`].
    pub players: Vec<TrackedPlace>,
}

/// Where a player is in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackedPlace {
    /// Who.
    pub slot: PlayerId,
    /// x, y.
    pub at: [f32; 2],
    /// The velocity.
    pub mps: [f32; 2],
}

/// An event, in the words of the Common Data Format.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackedEvent {
    /// `pass`, `shot`, `goalkeeping`, `defending`, `misc` or `referee`.
    pub kind: &'static str,
    /// What exactly.
    pub sub_kind: Option<&'static str>,
    /// How it ended.
    pub outcome: &'static str,
    /// Whether it was a success.
    pub success: bool,
    /// When, milliseconds after the start.
    pub time_ms: u32,
    /// The frame at the end of the step in which it happened.
    pub frame: u32,
    /// Whether it is in the second half.
    pub second_half: bool,
    /// Who did it; None for the referee.
    pub by: Option<PlayerId>,
    /// Where: x, y.
    pub at: [f32; 2],
    /// Where the ball went, of a pass or shot, and the frame in which it arrived.
    pub end: Option<([f32; 2], u32)>,
    /// Who received a pass, and when, milliseconds.
    pub received: Option<(PlayerId, u32)>,
    /// What it was done with, of a pass or shot.
    pub body: Option<&'static str>,
    /// The events that belong to it, by their places in the list.
    pub related: Vec<usize>,
}

impl Tracking {
    /// Plays a replay and watches it.
    ///
    /// # Errors
    /// [`Error::Replay`] if it can't be played here, or diverges from the recording.
    pub fn of(replay: &Replay) -> Result<Tracking, Error> {
        let (mut moments, mut log) = (Vec::new(), EventLog::default());
        let mut seen = [None; PLAYERS_MAX];
        let environment = replay.play(|environment, _| {
            for (id, player) in slots().map(|id| (id, environment.state().player(id))) {
                if player.active && seen[id.index()].is_none() {
                    seen[id.index()] = Some(moments.is_empty());
                }
            }
            log.step(environment);
            moments.push(moment(environment));
        })?;
        let player = |slot: PlayerId| {
            let starts = seen[slot.index()]?;
            let id = environment.player_name(slot)?;
            Some(TrackedPlayer { id, slot, number: number(slot), starts })
        };
        Ok(Tracking {
            id: format!("{}_{}_{}", environment.scenario().name, replay.seed, replay.index),
            pitch: environment.state().pitch,
            players: slots().filter_map(player).collect(),
            moments,
            events: log.finish(),
        })
    }

    /// Writes the files into a folder, which is made if it isn't there. Returns their paths.
    ///
    /// # Errors
    /// [`Error::File`] if the folder or a file can't be written.
    pub fn save(&self, folder: &Path, form: TrackingForm) -> Result<Vec<PathBuf>, Error> {
        std::fs::create_dir_all(folder).map_err(|why| {
            let why = FileFault::Write(why.to_string());
            Error::File { path: folder.to_owned(), why }
        })?;
        let files = match form {
            TrackingForm::Cdf => vec![
                ("meta.json", cdf::meta(self)),
                ("tracking.jsonl", cdf::tracking(self)),
                ("event.jsonl", cdf::events(self)),
                ("pitch.json", cdf::pitch(&self.pitch)),
            ],
            TrackingForm::Csv => vec![
                ("meta.json", cdf::meta(self)),
                ("tracking.csv", csv::tracking(self)),
                ("events.csv", csv::events(self)),
                ("pitch.json", cdf::pitch(&self.pitch)),
            ],
        };
        let mut paths = Vec::new();
        for (name, text) in files {
            let path = folder.join(name);
            write(&path, text)?;
            paths.push(path);
        }
        Ok(paths)
    }

    /// A player's id.
    fn name(&self, slot: PlayerId) -> &str {
        self.players.iter().find(|player| player.slot == slot).map_or("", |player| &player.id)
    }
}

/// Every slot of both teams.
fn slots() -> impl Iterator<Item = PlayerId> {
    (0..PLAYERS_MAX as u8).map(PlayerId)
}

/// A frame of the current state.
fn moment(environment: &Environment) -> TrackedMoment {
    let game = environment.state();
    let place = |slot: PlayerId| {
        let player = game.player(slot);
        let place = TrackedPlace { slot, at: flat(player.pos), mps: flat(player.vel) };
        player.active.then_some(place)
    };
    let space = |it: glam::Vec3| [it.x, 0.0 - it.y, it.z];
    TrackedMoment {
        second_half: game.play.second_half,
        in_play: game.mode == GameMode::Normal && !game.dead,
        possession: game.owner.map(PlayerId::team),
        ball: space(game.ball.pos),
        ball_mps: space(game.ball.vel),
        players: slots().filter_map(place).collect(),
    }
}

/// A point or vector of the world, whose +y points at the bottom of the picture, as data.
fn flat(it: Vec2) -> [f32; 2] {
    // Not `-y`, which turns 0 into -0.
    [it.x, 0.0 - it.y]
}
