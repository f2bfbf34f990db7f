//! What pages and the session say to each other, as JSON.

use super::moment::{MomentReply, RosterReply};
use crate::dsl::Outline;
use crate::dsl::report::Diagnostic;
use crate::render::scene::{Id, Pitch};
use crate::studio::hands::HeldKeys;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The most bytes of a request: a text of the largest size, quoted.
pub const REQUEST_MAX_BYTES: usize = 3 << 20;
/// The most starts of a cloud.
pub const DRAWS_MAX: u32 = 500;
/// The most episodes of a summary.
pub const EPISODES_MAX: u32 = 1_000;

/// What a page asks for.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Request {
    /// Use this text instead of the last one.
    Text {
        /// The whole file.
        text: String,
        /// The page that it comes from, as it calls itself.
        from: Option<String>,
    },
    /// Write the text to the file.
    Save,
    /// Play an episode.
    Play {
        /// The seed.
        seed: u64,
        /// The episode's index under it.
        episode: u64,
        /// Who plays the agents: one of [`CheckReply::players`].
        agent: String,
        /// Who plays the same episode beside it, if anybody does.
        beside: Option<String>,
    },
    /// Play the episode by hand, at the pace of the match.
    Begin {
        /// The agents that people play, by their ids. The others play as before.
        seats: Vec<String>,
    },
    /// What a person holds down now.
    Hold {
        /// Which of the seats.
        seat: usize,
        /// The keys.
        keys: HeldKeys,
    },
    /// Stop playing by hand.
    Stop,
    /// Bind parameters, SI units, and play again.
    Bind {
        /// Values by name; others have their defaults.
        params: BTreeMap<String, f64>,
    },
    /// Put a player, or the ball, elsewhere at the start: the numbers in the text change.
    Move {
        /// The player, by team and place in the team's list; none for the ball.
        player: Option<Id>,
        /// Metres from the centre spot.
        to: [f64; 2],
    },
    /// Draw many starts.
    Cloud {
        /// How many.
        count: u32,
    },
    /// Play many episodes.
    Summary {
        /// How many.
        episodes: u32,
    },
    /// Hand the episode over as a file.
    Record,
}

/// What the session says to every page.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Reply {
    /// A scenario is open.
    Opened(OpenReply),
    /// The text has been checked.
    Checked(CheckReply),
    /// An episode has been played.
    Episode(Box<Episode>),
    /// A step that a person has played.
    Step {
        /// The pitch.
        pitch: Pitch,
        /// Everyone.
        roster: Vec<RosterReply>,
        /// The moments that it led to: where play was stopped, if it was, and the present.
        scenes: Vec<MomentReply>,
    },
    /// Many starts.
    Cloud {
        /// The ball and everyone, metres: `[x, y]` each, the ball first.
        starts: Vec<Vec<[f32; 2]>>,
    },
    /// Many episodes.
    Summary(SummaryReply),
    /// What stands around the start.
    Sketch(SketchReply),
    /// The episode as a file.
    Recording {
        /// The name of the file.
        name: String,
        /// Its bytes, two hexadecimal digits each.
        hex: String,
    },
    /// The file was written.
    Saved,
    /// A request could not be met.
    Refused {
        /// Why.
        message: String,
    },
}

/// An open scenario.
#[derive(Clone, Debug, Serialize)]
pub struct OpenReply {
    /// The name or path that was asked for.
    pub source: String,
    /// The address of the text for the language server.
    pub uri: String,
    /// Whether the text can be saved.
    pub is_file: bool,
    /// Whether the file has this text.
    pub is_saved: bool,
    /// The text.
    pub text: String,
    /// The page that it comes from.
    pub from: Option<String>,
}

/// The result of a check.
#[derive(Clone, Debug, Serialize)]
pub struct CheckReply {
    /// Errors and warnings.
    pub problems: Vec<Diagnostic>,
    /// What is wrong besides, such as a file that can't be read.
    pub fault: Option<String>,
    /// The scenario that plays now: the last good one.
    pub name: String,
    /// The first line of its documentation.
    pub title: String,
    /// Its parameters.
    pub params: Vec<ParamControl>,
    /// Its agents.
    pub agents: Vec<SeatReply>,
    /// Who can play them: ready-made agents, behaviours, policies of the program that has started
    /// the studio.
    pub players: Vec<String>,
}

/// An agent that a person can play.
#[derive(Clone, Debug, Serialize)]
pub struct SeatReply {
    /// Its id: a player's name, `left_CM_1`, or `left_0` for one that changes players.
    pub id: String,
    /// `left` or `right`.
    pub team: &'static str,
}

/// What stands around a start.
#[derive(Clone, Debug, Serialize)]
pub struct SketchReply {
    /// The pitch of this start.
    pub pitch: Pitch,
    /// The regions: the named ones, then those that something is drawn in.
    pub regions: Vec<RegionReply>,
    /// The requirements on a drawn start.
    pub requires: Vec<RequireReply>,
}

/// A region.
#[derive(Clone, Debug, Serialize)]
pub struct RegionReply {
    /// Its name or its text.
    pub name: String,
    /// Its shape in this start.
    pub shape: Outline<f64>,
}

/// A requirement.
#[derive(Clone, Debug, Serialize)]
pub struct RequireReply {
    /// Its text.
    pub label: String,
    /// Whether it follows from another part of the text.
    pub implied: bool,
    /// Its line, if it has one.
    pub line: Option<u32>,
    /// The share of single attempts at a start that it is the first to refuse, 0..1.
    pub refused: f64,
    /// Whether this episode has no start, and no other refused more attempts at it.
    pub fails: bool,
}

/// A parameter.
#[derive(Clone, Debug, Serialize)]
pub struct ParamControl {
    /// Its name.
    pub name: String,
    /// Its documentation.
    pub doc: String,
    /// The value, SI units.
    pub value: f64,
    /// The value as the language writes it.
    pub shown: String,
    /// Least and greatest value.
    pub range: Option<(f64, f64)>,
    /// The words of a value that is one.
    pub choices: Vec<String>,
    /// The numbers it can be, if it is one of a list.
    pub values: Vec<f64>,
    /// Whether it is on or off, or a whole number.
    pub kind: &'static str,
}

/// A played episode.
#[derive(Clone, Debug, Serialize)]
pub struct Episode {
    /// The seed and the index.
    pub seed: u64,
    /// The index under the seed.
    pub episode: u64,
    /// Who played.
    pub agent: String,
    /// Whether it stands beside another one, to be compared.
    pub beside: bool,
    /// Whether another program has played it.
    pub watched: bool,
    /// The scenario's name.
    pub name: String,
    /// The pitch.
    pub pitch: Pitch,
    /// Everyone, in the order of each moment's players.
    pub roster: Vec<RosterReply>,
    /// The moments, in order.
    pub scenes: Vec<MomentReply>,
    /// Everybody's label, by team and place.
    pub names: Vec<String>,
    /// What happened: the moment, and the words for it.
    pub events: Vec<Happened>,
    /// How it ended.
    pub outcome: Option<String>,
    /// Whether that is a success; none if it is neither success nor failure.
    pub success: Option<bool>,
}

/// An event.
#[derive(Clone, Debug, Serialize)]
pub struct Happened {
    /// The index of the moment that shows it.
    pub at: usize,
    /// Its name, such as `pass completed`.
    pub name: String,
    /// The player's label.
    pub by: Option<String>,
    /// `left` or `right`.
    pub team: Option<&'static str>,
    /// Where, metres.
    pub place: [f32; 2],
}

/// The results of many episodes.
#[derive(Clone, Debug, Serialize)]
pub struct SummaryReply {
    /// How many.
    pub episodes: u32,
    /// How often each ending came, the most frequent first.
    pub outcomes: Vec<(String, u32)>,
    /// The mean return of the first side's agents.
    pub mean_return: f64,
    /// Mean goals, left and right.
    pub score: [f64; 2],
    /// The mean return of every term.
    pub terms: Vec<(String, f64)>,
    /// The mean of every record that has a value, and its unit.
    pub records: Vec<(String, f64, String)>,
}
