//! The names that scripts can read, by the subject they belong to.

use setpiece_scenario::vocabulary::{Owner, PROPERTIES, Type};

/// What a name belongs to, and the kind of value it gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// `ctx`.
    Ctx,
    /// `now` and `prev`.
    State,
    /// The ball.
    Ball,
    /// A player.
    Player,
    /// `us`, `them`.
    Team,
    /// The score.
    Score,
    /// An event.
    Event,
    /// A place.
    Point,
    /// A velocity, or a place in metres.
    Vector,
    /// An array of players.
    Players,
    /// An array of events.
    Events,
    /// The scenario's parameters, by name.
    Params,
    /// A script's memory, with the script's own names.
    Memory,
    /// What has a name in the scenario or the file.
    Named,
    /// A region.
    Region,
    /// A table of numbers.
    Table,
    /// A number, word or truth value.
    Plain,
}

impl Subject {
    /// The subject in words.
    pub const fn words(self) -> &'static str {
        match self {
            Subject::Ctx => "the context",
            Subject::State => "the state of the match",
            Subject::Ball => "the ball",
            Subject::Player => "a player",
            Subject::Team => "a team",
            Subject::Score => "the score",
            Subject::Event => "an event",
            Subject::Point => "a point",
            Subject::Vector => "a vector",
            Subject::Players => "an array of players",
            Subject::Events => "an array of events",
            Subject::Params => "the parameters",
            Subject::Memory => "the script's memory",
            Subject::Named => "what has a name",
            Subject::Region => "a region",
            Subject::Table => "a table",
            Subject::Plain => "a plain value",
        }
    }
}

/// A name that scripts can read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Member {
    /// What it belongs to.
    pub of: Subject,
    /// The name after the dot.
    pub name: &'static str,
    /// The kind of its value.
    pub gives: Subject,
    /// One line of documentation.
    pub doc: &'static str,
}

const fn row(of: Subject, name: &'static str, gives: Subject, doc: &'static str) -> Member {
    Member { of, name, gives, doc }
}

/// Names for scripts, in addition to the language's properties.
const EXTRA: &[Member] = &[
    row(Subject::Ctx, "params", Subject::Params, "the scenario's parameters, SI units"),
    row(Subject::Ctx, "named", Subject::Named, "what the scenario and the file name"),
    row(Subject::State, "named", Subject::Named, "the same, as it is in this state"),
    row(Subject::Ctx, "side", Subject::Plain, "the judged side: left or right"),
    row(Subject::Ctx, "agent", Subject::Plain, "the agent's index, from 0"),
    row(Subject::Ctx, "index", Subject::Plain, "the episode's index"),
    row(Subject::Ctx, "step", Subject::Plain, "steps since the episode's start"),
    row(Subject::State, "ball", Subject::Ball, "the ball"),
    row(Subject::State, "us", Subject::Team, "the judged side"),
    row(Subject::State, "them", Subject::Team, "its opponents"),
    row(Subject::State, "me", Subject::Player, "the agent's player, or () while off the pitch"),
    row(Subject::State, "players", Subject::Players, "the players on the pitch of both teams"),
    row(Subject::State, "score", Subject::Score, "the goals"),
    row(Subject::Score, "us", Subject::Plain, "our goals"),
    row(Subject::Score, "them", Subject::Plain, "their goals"),
    row(Subject::Ball, "at", Subject::Point, "the ball's place"),
    row(Subject::Player, "at", Subject::Point, "the player's place"),
    row(Subject::Player, "has_ball", Subject::Plain, "the player has the ball now"),
    row(Subject::Team, "players", Subject::Players, "the team's players on the pitch"),
    row(Subject::Team, "goal", Subject::Point, "the middle of the team's own goal"),
    row(Subject::Team, "score", Subject::Plain, "the team's goals"),
    row(Subject::Team, "has_ball", Subject::Plain, "a player of the team has the ball now"),
    row(
        Subject::Team,
        "offside_line",
        Subject::Plain,
        "normalised x of the line beyond which its players are offside",
    ),
    row(Subject::Event, "kind", Subject::Plain, "the event's name"),
    row(Subject::Event, "qualifier", Subject::Plain, "completed, taken, …; empty without one"),
    row(Subject::Event, "team", Subject::Plain, "the event's team: us, them or none"),
    row(Subject::Event, "by", Subject::Player, "the player who did it, or ()"),
    row(Subject::Event, "to", Subject::Player, "the player it reached or hurt, or ()"),
    row(Subject::Event, "at", Subject::Point, "the event's place"),
    row(Subject::Event, "length", Subject::Plain, "how far the ball travelled, metres"),
    row(Subject::Event, "speed", Subject::Plain, "the ball's speed, m/s"),
    row(Subject::Point, "x", Subject::Plain, "normalised x"),
    row(Subject::Point, "y", Subject::Plain, "normalised y"),
    row(Subject::Point, "metres", Subject::Vector, "the place in metres from the centre spot"),
    row(Subject::Vector, "x", Subject::Plain, "m/s or metres forward"),
    row(Subject::Vector, "y", Subject::Plain, "m/s or metres to the right of an attacker"),
];

/// Every name that scripts can read.
pub fn members() -> impl Iterator<Item = Member> {
    let properties = PROPERTIES.iter().map(|property| Member {
        of: match property.owner {
            Owner::Ball => Subject::Ball,
            Owner::Player => Subject::Player,
            Owner::Team => Subject::Team,
            Owner::Match => Subject::State,
        },
        name: property.name,
        gives: match property.ty {
            Type::Vector => Subject::Vector,
            Type::Player => Subject::Player,
            Type::Point => Subject::Point,
            _ => Subject::Plain,
        },
        doc: property.doc,
    });
    properties.chain(EXTRA.iter().copied())
}

/// Words that authors try on a subject, and what is written instead.
const ELSEWHERE: &[(Subject, &[&str], &str)] = &[
    (
        Subject::State,
        &["left", "right", "home", "away", "team", "teams", "side"],
        "the teams are `us` and `them`, and `ctx.side` is the side of `us`",
    ),
    (
        Subject::State,
        &["opponents", "opponent", "enemies", "they", "defenders"],
        "write `them`, and `them.players` for its players",
    ),
    (Subject::State, &["mates", "teammates", "we"], "write `us`, and `us.players` for its players"),
    (
        Subject::State,
        &["step", "steps", "tick", "ticks", "frame"],
        "write `ctx.step`, or `elapsed` in seconds",
    ),
    (
        Subject::State,
        &["time", "clock", "seconds", "t"],
        "write `elapsed`, or `remaining` until the limit",
    ),
    (Subject::State, &["steps_left", "time_left"], "write `remaining`, in seconds"),
    (Subject::State, &["goals"], "write `score.us` or `score.them`"),
    (Subject::State, &["goal"], "a goal has a team: write `us.goal` or `them.goal`"),
    (Subject::State, &["events"], "they are an argument of the hook: write `events`"),
    (Subject::State, &["params"], "write `ctx.params`"),
    (Subject::Score, &["left", "right", "home", "away"], "write `us` or `them`"),
    (Subject::Ctx, &["time", "elapsed", "now"], "read `elapsed` of the state, `now.elapsed`"),
    (Subject::Ctx, &["team"], "write `side`"),
    (Subject::Ball, &["position", "pos", "place"], "write `at`, or `x` and `y`"),
    (Subject::Player, &["position", "pos", "place"], "write `at`, or `x` and `y`"),
    (Subject::Ball, &["z"], "write `height`"),
    (Subject::Ball, &["player", "holder", "carrier"], "write `owner`"),
    (Subject::Event, &["player", "who"], "write `by`"),
    (Subject::Event, &["type", "name"], "write `kind`"),
];

/// What to write for a name that a subject doesn't have but something else has.
///
/// `me`: whether the state of the match has the agent's player.
pub(in crate::judge::script) fn elsewhere(of: Subject, name: &str, me: bool) -> Option<String> {
    let mut known = ELSEWHERE.iter();
    if let Some((.., written)) = known.find(|row| row.0 == of && row.1.contains(&name)) {
        return Some((*written).to_owned());
    }
    let holds = |holder: Subject| members().any(|row| row.of == holder && row.name == name);
    match of {
        Subject::State if holds(Subject::Ctx) => return Some(format!("write `ctx.{name}`")),
        Subject::Ctx if holds(Subject::State) => return Some(format!("write `now.{name}`")),
        _ => {}
    }
    let holder = members().find(|part| {
        part.of == of && (me || part.name != "me") && part.gives != of && holds(part.gives)
    });
    let players = members().find(|part| part.of == of && part.gives == Subject::Players);
    holder.map(|part| format!("write `{}.{name}`", part.name)).or_else(|| {
        let players = players.filter(|_| holds(Subject::Player))?.name;
        Some(format!(
            "a player has it: write `{players}[0].{name}`, or `{players}.filter(|it| it.{name} …)`"
        ))
    })
}
