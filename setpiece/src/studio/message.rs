//! What pages and the session say to each other, as JSON.

use crate::dsl::report::Diagnostic;
use crate::render::Scene;
use crate::render::scene::{Id, Side};
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
    },
    /// Write the text to the file.
    Save,
    /// Play an episode.
    Play {
        /// The seed.
        seed: u64,
        /// The episode's index under it.
        episode: u64,
        /// Who plays the agents: a name of the command line.
        agent: String,
    },
    /// Play the episode by hand, at the pace of the match.
    Begin {
        /// `left` or `right`: whose first agent the person plays. The others play as before.
        side: Side,
    },
    /// What the person holds down now.
    Hold {
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
        /// The moments that it led to: where play was stopped, if it was, and the present.
        scenes: Vec<Scene>,
    },
    /// Many starts.
    Cloud {
        /// The ball and everyone, metres: `[x, y]` each, the ball first.
        starts: Vec<Vec<[f32; 2]>>,
    },
    /// Many episodes.
    Summary(SummaryReply),
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
    /// Whether the text can be saved.
    pub is_file: bool,
    /// The text.
    pub text: String,
    /// Who can play the agents.
    pub agents: Vec<&'static str>,
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
    pub agent: &'static str,
    /// The moments, in order.
    pub scenes: Vec<Scene>,
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
    /// The mean of every record that has a value.
    pub records: Vec<(String, f64)>,
}
