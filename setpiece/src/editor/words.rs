//! The words of the language with what they mean, from the tables that the compiler checks against.

use crate::scenario::vocabulary::{
    Action, AgentsOption, BallOption, EventKind, Function, GameMode, Landmark, MeasureWord,
    PROPERTIES, PitchFigure, PitchRegion, PlayerOption, Primitive, Qualifier, QuantityWord,
    RegionName, Role, Rule, StartKind, StartOption, Stat, SubstituteOption, TeamOption, Type, Unit,
    ValueWord, WorldFigure,
};

/// What kind of word it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WordKind {
    /// A football role.
    Role,
    /// An event of the match.
    Event,
    /// What an event may be: `completed`.
    Qualifier,
    /// A function.
    Function,
    /// A property of a player, the ball or the match.
    Property,
    /// A place or an area of the pitch.
    Place,
    /// A team, a player or another value that the language names.
    Value,
    /// A key of the block that begins with this word.
    Option(&'static str),
    /// What checks and curricula measure.
    Measure,
    /// What a player of a behaviour does.
    Act,
    /// An action of an agent.
    Action,
    /// A kind of start, or a mode of the game.
    Mode,
    /// A type of a parameter.
    Type,
    /// What `… of` gathers over the steps of an episode.
    OverTime,
    /// A unit of numbers.
    Unit,
}

/// What `… of` gathers over the steps of an episode.
const OVER_TIME: [(&str, &str); 8] = [
    ("count", "how many events, or at how many steps it holds"),
    ("sum", "the sum over the steps"),
    ("mean", "the mean over the steps"),
    ("max", "the greatest value of any step"),
    ("min", "the least value of any step"),
    ("first", "the value at the first step"),
    ("last", "the value now"),
    ("series", "the value of every step"),
];

/// What `wind` of `world { … }` means.
const WIND: &str = "the wind's speed from 2 m above the ground on, a vector: `(4m/s, 0m/s)`";

/// The layouts of `kickoff { … }`.
const LAYOUTS: [(&str, &str); 2] = [
    ("kicking", "the formation of the team that kicks off"),
    ("receiving", "the formation of the other team"),
];

/// A word of the language.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word {
    /// The word.
    pub(super) name: &'static str,
    /// What it means, in a line.
    pub(super) doc: &'static str,
    /// What it is.
    pub(super) kind: WordKind,
    /// The page of the reference, under `docs/language/`.
    pub(super) page: &'static str,
}

/// Every word, by kind. A word may be of several kinds.
pub(super) fn all() -> impl Iterator<Item = Word> {
    macro_rules! table {
        ($name:ident, $kind:ident $(($block:literal))?, $page:literal) => {
            $name::ALL.iter().map(|word| Word {
                name: word.name(),
                doc: word.doc(),
                kind: WordKind::$kind $(($block))?,
                page: $page,
            })
        };
    }
    let properties = PROPERTIES.iter().map(|property| Word {
        name: property.name,
        doc: property.doc,
        kind: WordKind::Property,
        page: "expression.md",
    });
    let over_time = OVER_TIME.iter().map(|&(name, doc)| Word {
        name,
        doc,
        kind: WordKind::OverTime,
        page: "record.md",
    });
    // The wind is written as one vector.
    let figures = WorldFigure::ALL.iter().filter(|it| **it != WorldFigure::WindY);
    let world = figures.map(|figure| Word {
        name: if *figure == WorldFigure::WindX { "wind" } else { figure.name() },
        doc: if *figure == WorldFigure::WindX { WIND } else { figure.doc() },
        kind: WordKind::Option("world"),
        page: "world.md",
    });
    let kickoff = LAYOUTS.iter().map(|&(name, doc)| Word {
        name,
        doc,
        kind: WordKind::Option("kickoff"),
        page: "start.md",
    });
    table!(Role, Role, "team.md")
        .chain(table!(EventKind, Event, "event.md"))
        .chain(table!(Qualifier, Qualifier, "event.md"))
        .chain(table!(Function, Function, "expression.md"))
        .chain(properties)
        .chain(table!(ValueWord, Value, "expression.md"))
        .chain(table!(Landmark, Place, "place.md"))
        .chain(table!(RegionName, Place, "region.md"))
        .chain(table!(PitchRegion, Place, "region.md"))
        .chain(table!(Rule, Option("rules"), "start.md"))
        .chain(world)
        .chain(kickoff)
        .chain(table!(PitchFigure, Option("pitch"), "pitch.md"))
        .chain(table!(AgentsOption, Option("agents"), "scenario.md"))
        .chain(table!(TeamOption, Option("team"), "team.md"))
        .chain(table!(PlayerOption, Option("player"), "team.md"))
        .chain(table!(SubstituteOption, Option("substitute"), "start.md"))
        .chain(table!(BallOption, Option("ball"), "place.md"))
        .chain(table!(StartOption, Option("start"), "start.md"))
        .chain(table!(Stat, Option("stats"), "team.md"))
        .chain(table!(MeasureWord, Measure, "level.md"))
        .chain(table!(QuantityWord, Measure, "level.md"))
        .chain(table!(Primitive, Act, "behavior.md"))
        .chain(table!(Action, Action, "expression.md"))
        .chain(table!(GameMode, Mode, "expression.md"))
        .chain(table!(StartKind, Mode, "start.md"))
        .chain(table!(Type, Type, "param.md"))
        .chain(over_time)
        .chain(table!(Unit, Unit, "expression.md"))
}

/// Whether a word is of a kind.
pub(super) fn is(word: &str, kind: WordKind) -> bool {
    all().any(|known| known.name == word && known.kind == kind)
}
