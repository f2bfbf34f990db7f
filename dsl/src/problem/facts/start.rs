//! The start of an episode: its kind, the ball and the pitch.

use super::facts;
use crate::problem::Code;
use crate::problem::said::say;
use crate::source::Span;
use setpiece_scenario::pitch::to_normalised;
use setpiece_scenario::vocabulary::{StartKind, Team};

facts! {
    /// Facts about the start.
    pub(crate) Starts {
        /// A place for a start that has its own.
        NoPlaceOfItsOwn { kind: StartKind } = Code::WrongScope =>
            say(format!("`{kind}` has no place of its own"), "").help(if *kind == StartKind::Open {
                "the ball's place is the start's: `ball at …`"
            } else {
                "the laws say where the ball lies: leave `at …` out"
            }),
        /// A set piece without a team; `spoken`: its name in words.
        WhoseIsIt { kind: StartKind } = Code::WrongArguments =>
            say(format!("whose {} is it?", spoken(*kind)), "").help(format!("write `start {kind} for left`")),
        /// A set piece for no team.
        BelongsToATeam { kind: StartKind } = Code::OutOfRange =>
            say(format!("a {} belongs to a team", spoken(*kind)), "").help(format!("write `start {kind} for left`")),
        /// `start open for left`.
        OpenForATeam { kind: Span } = Code::WrongScope =>
            say("an open start belongs to no team", "")
                .at(kind, "play is on at once")
                .help("leave `for …` out; who has the ball says `ball … { owner: NAME }`"),
        /// A set piece of a team without players.
        NobodyTakesIt { team: Team, kind: StartKind } = Code::OutOfRange =>
            say(format!("the {team} team has nobody to take the {}", spoken(*kind)), "")
                .help(format!("give it a player: `team {team} {{ CM at own (-0.1, 0) }}`")),
        /// `ball` where the set piece has its place.
        LaysBallItself { kind: StartKind, start: Span } = Code::DuplicateOption =>
            say(format!("a {} lays the ball down itself", spoken(*kind)), "").at(start, START_HERE).help(LEAVE_BALL_OUT),
        /// `ball` and `at` of one set piece.
        PlaceTwice { kind: StartKind, start: Span } = Code::DuplicateOption =>
            say(format!("the {}'s place is given twice", spoken(*kind)), "")
                .at(start, START_HERE)
                .help("leave one of `ball at …` and `at …` out"),
        /// `ball` of a kick-off.
        KickOffLaysBall { start: Span } = Code::DuplicateOption =>
            say("a kick-off lays the ball on the centre spot", "")
                .at(start, "the start is a kick-off")
                .help(LEAVE_BALL_OUT),
        /// The ball of a set piece moves.
        BallLiesStill { kind: StartKind } = Code::WrongScope =>
            say(format!("the ball of a {} lies still, at the taker's feet", spoken(*kind)), "").help("leave it out"),
        /// No ball.
        NoBall { scenario: String, kind: StartKind } = Code::NoBall =>
            say(format!("`{scenario}` has no ball"), "").help(match kind {
                StartKind::Open => "write, for example, `ball at (0.6, 0)`".to_owned(),
                StartKind::ThrowIn => "say where: `start throw_in for left at (0.5, 0.42)`".to_owned(),
                kind => format!("say where: `start {kind} for left at (0.5, 0.2)`"),
            }),
        /// A corner from another place than a corner.
        NoCorner { end: &'static str } = Code::OutOfRange =>
            say("a corner is taken from a corner of the other end", "lies elsewhere")
                .help(format!("write `at {end}.corner.top` or `at {end}.corner.bottom`")),
        /// A throw-in from another place than a side line.
        NoSideLine = Code::OutOfRange =>
            say("a throw-in is taken from a side line", "lies elsewhere").help(SIDE_LINES),
        /// A place off the pitch; `at`: metres.
        OffPitch {
            what: String,
            text: String,
            at: (f64, f64),
            size: (f64, f64),
        } = Code::OffPitch => {
            let ((x, y), (length, width)) = (at, size);
            let said = say(format!("{what} is off the pitch: `{text}` is ({x:.1}m, {y:.1}m)"), "");
            let (x, y) = to_normalised(0.5 * length, 0.5 * width);
            said.help(in_metres(text, *size).map_or_else(
                || format!("the pitch is {length}m by {width}m, or normalised from (-{x:.2}, -{y:.2}) to ({x:.2}, {y:.2})"),
                |place| format!("are metres meant? Then write `{place}`"),
            ))
        },
        /// The ball is far from its owner.
        OwnerFarAway { name: String, apart_m: f64 } = Code::OutOfRange =>
            say(format!("`{name}` stands {apart_m:.1} m from the ball"), "")
                .help(format!("lay it at the player's feet: `ball ahead of {name} by 1m`")),
        /// `score` with another number of parts.
        ScoreOfTwo = Code::WrongArguments => say("a score has two numbers", "").help("write `score: [1, 0]`"),
    }
}

/// From here on a coordinate was meant in metres.
const LEAST_METRES: f64 = 2.0;

/// A place with metres as its unit, if two numbers without one are a place on the pitch in metres.
fn in_metres(text: &str, (length, width): (f64, f64)) -> Option<String> {
    let (x, y) = text.strip_prefix("at (")?.strip_suffix(')')?.split_once(',')?;
    let (x, y): (f64, f64) = (x.trim().parse().ok()?, y.trim().parse().ok()?);
    let is_on = x.abs() <= length / 2.0 && y.abs() <= width / 2.0;
    // Less than this is a slip of another kind.
    (is_on && x.abs().max(y.abs()) >= LEAST_METRES).then(|| format!("at ({x}m, {y}m)"))
}

/// Where the side lines are.
pub(super) const SIDE_LINES: &str = "write, for example, `at left.corner.top + (20m, 0m)`";
const START_HERE: &str = "the start is given here";
const LEAVE_BALL_OUT: &str = "leave `ball …` out; an inherited one goes by `remove ball`";

/// The name of a start in words.
fn spoken(kind: StartKind) -> String {
    match kind {
        StartKind::ThrowIn => "throw-in".to_owned(),
        StartKind::Kickoff => "kick-off".to_owned(),
        kind => kind.name().replace('_', " "),
    }
}
