//! Reads scripts without running them: straight lines, and what they do by the episode's parity.
//!
//! 1. `lines` joins and splits the file as Python does, `tree` finds the blocks.
//! 2. `find` tells where the scripts of a text are.
//! 3. `run` follows the statements once per episode, with the values of `value`.
//!
//! What can't be read is left out, and so is what depends on it.

mod find;
mod lines;
mod run;
mod tree;
mod value;

pub use find::scripts;

use super::recorded::GrfScenario;
use super::translate::{TranslationError, to_pitch};
use crate::scenario::pitch::TEAM_MAX;
use run::PyRun;
use tree::PyNode;

/// The number of an even and of an odd episode, the first two.
const EPISODES: [i64; 2] = [2, 1];
/// Episodes that must equal the first ones.
const LATER: [i64; 4] = [3, 4, 5, 6];

/// Why a script has no text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GrfFault {
    /// No function of it is a script, or it sets nothing that can be read.
    #[error("nothing of it can be read")]
    Empty,
    /// Episodes take turns otherwise.
    #[error(
        "it tells more than even from odd episodes by `EpisodeNumber`; \
         a text can alternate between two"
    )]
    Turns,
    /// A team would get a keeper that the script doesn't give it.
    #[error("the players of a team can't be read")]
    LacksTeam,
    /// More players than a team may have.
    #[error("a team has more than {TEAM_MAX} players")]
    Crowd,
}

/// A script that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct GrfScript {
    /// What it sets in even episodes, so in the first one.
    pub even: GrfScenario,
    /// What it sets in odd episodes.
    pub odd: GrfScenario,
    /// What the comments and texts in quotes say at its head and at that of its function.
    pub comments: Vec<String>,
    /// The lines that can't be read, as they are written.
    pub left_out: Vec<String>,
}

impl GrfScript {
    /// Reads a script.
    ///
    /// # Errors
    /// It sets nothing, or what no text can have.
    pub fn read(text: &str) -> Result<GrfScript, GrfFault> {
        let lines = find::lines(text);
        let comments = find::comments(text, &lines);
        let nodes = PyNode::all(lines);
        let at = nodes.iter().position(|node| find::is_script(&node.line));
        let at = at.ok_or(GrfFault::Empty)?;
        let run = |episode: i64| PyRun::of(&nodes, at, episode);
        let [even, odd] = EPISODES.map(run);
        let takes_turns = LATER.into_iter().all(|episode| {
            let first = if episode % 2 == 0 { &even } else { &odd };
            run(episode).recorded == first.recorded
        });
        let is_too_large = |it: &PyRun<'_>| {
            it.recorded.left_team.len().max(it.recorded.right_team.len()) > TEAM_MAX
        };
        // A team without players would get a keeper.
        let is_lost = even.lacks_a_team() || odd.lacks_a_team();
        for (is_so, fault) in [
            (even.is_empty(), GrfFault::Empty),
            (!takes_turns, GrfFault::Turns),
            (is_lost, GrfFault::LacksTeam),
            (is_too_large(&even) || is_too_large(&odd), GrfFault::Crowd),
        ] {
            if is_so {
                return Err(fault);
            }
        }
        let mut ranges: Vec<_> = even.left_out().chain(odd.left_out()).collect();
        ranges.sort_by_key(|range| (range.start, std::cmp::Reverse(range.end)));
        let (mut left_out, mut behind) = (Vec::new(), 0);
        for range in ranges.iter().filter(|range| !range.is_empty()) {
            // A part of what is left out already, or left out in either episode.
            if range.end > behind {
                let written = text.get(range.start.max(behind)..range.end).unwrap_or_default();
                left_out.extend(written.lines().filter(|it| !it.trim().is_empty()).map(plain));
                behind = range.end;
            }
        }
        let done = |run: PyRun<'_>| run.finished();
        Ok(GrfScript { even: done(even), odd: done(odd), comments, left_out })
    }

    /// The text that says the same, in the layout of `setpiece fmt`. Comments above it have what
    /// the script says at its head, and what is left out.
    ///
    /// # Errors
    /// Episodes differ in what no text can alternate.
    pub fn to_pitch(&self, name: &str) -> Result<String, TranslationError> {
        let scenario = to_pitch(&self.even, &self.odd, name)?;
        let comment = |line: &String| format!("// {line}").trim_end().to_owned() + "\n";
        let mut text: String = self.comments.iter().map(comment).collect();
        if !self.left_out.is_empty() {
            if !text.is_empty() {
                text.push('\n');
            }
            text += "// These lines of the script are left out. `setpiece import grf` of the Python package\n\
                     // runs a script, and so translates them too.\n";
            text.extend(self.left_out.iter().map(comment));
        }
        if !text.is_empty() {
            text.push('\n');
        }
        Ok(text + scenario.as_str())
    }
}

/// A line of the script as a comment can have it.
fn plain(line: &str) -> String {
    line.trim_end().chars().map(|sign| if sign.is_control() { ' ' } else { sign }).collect()
}
