//! The words of the language by page and group, with what is known of each.

use setpiece::scenario::vocabulary::{
    Action, AgentsOption, BallOption, EventField, EventKind, Function, GameMode, Landmark,
    MeasureWord, Owner, PROPERTIES, PitchFigure, PitchRegion, PlayerOption, Primitive, Qualifier,
    QuantityWord, RegionName, Role, Rule, StartKind, StartOption, Stat, SubstituteOption,
    TeamOption, Type, Unit, ValueWord, WorldFigure,
};

/// A page of words.
pub(crate) struct Page {
    pub(crate) file: &'static str,
    pub(crate) title: &'static str,
    pub(crate) about: &'static str,
    pub(crate) groups: fn() -> Vec<Group>,
}

/// Words of one kind.
pub(crate) struct Group {
    pub(crate) title: &'static str,
    /// What a word of it is, and the beginning of its anchor.
    pub(crate) kind: &'static str,
    pub(crate) about: &'static str,
    /// Where it is explained: title and place under `docs/`.
    pub(crate) pages: &'static [(&'static str, &'static str)],
    pub(crate) head: &'static [&'static str],
    /// Each word with the other cells of its row.
    pub(crate) rows: Vec<(&'static str, Vec<String>)>,
}

impl Group {
    /// The anchor of a word: `event-own_goal`.
    pub(crate) fn anchor(&self, word: &str) -> String {
        let word = word.replace('/', "-per-").replace('%', "percent").replace('.', "-");
        format!("{}-{word}", self.kind.replace(' ', "-"))
    }
}

/// A heading's anchor, as GitHub makes it.
pub(crate) fn slug(title: &str) -> String {
    let kept = |c: char| match c {
        ' ' => Some('-'),
        c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c.to_ascii_lowercase()),
        _ => None,
    };
    title.trim().chars().filter_map(kept).collect()
}

pub(crate) const PAGES: &[Page] = &[
    Page {
        file: "football.md",
        title: "Football",
        about: "Players, places of the pitch, actions, and how an episode starts.",
        groups: football,
    },
    Page {
        file: "events.md",
        title: "Events",
        about: "What happens in a match, step by step, and what can be asked of it.",
        groups: events,
    },
    Page {
        file: "values.md",
        title: "Values",
        about: "Properties, functions, types and units: what expressions are made of.",
        groups: values,
    },
    Page {
        file: "options.md",
        title: "Options",
        about: "The keys of every pair of braces.",
        groups: options,
    },
    Page {
        file: "behaviours.md",
        title: "Behaviours and measures",
        about: "What scripted players do, and what checks and curricula measure.",
        groups: behaviours,
    },
];

/// The rows of a table of the vocabulary.
macro_rules! rows {
    ($name:ident) => {
        rows!($name, |_| vec![])
    };
    ($name:ident, $more:expr) => {
        $name::ALL
            .iter()
            .map(|word| {
                let more: fn($name) -> Vec<String> = $more;
                let mut cells = more(*word);
                cells.push(word.doc().to_owned());
                (word.name(), cells)
            })
            .collect()
    };
}

/// The rows of a table whose documentation begins with a signature.
macro_rules! signed {
    ($name:ident) => {
        $name::ALL
            .iter()
            .map(|word| {
                let (signature, meaning) = signature(word.doc());
                let forms: Vec<String> = signature
                    .replace(", or ", " or ")
                    .split(" or ")
                    .map(|form| format!("`{form}`"))
                    .collect();
                (word.name(), vec![forms.join(" or "), meaning.to_owned()])
            })
            .collect()
    };
}

/// A text divided at its first colon outside of brackets.
fn signature(doc: &'static str) -> (&'static str, &'static str) {
    let mut depth = 0;
    for (at, c) in doc.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            ':' if depth == 0 => return (&doc[..at], doc[at + 1..].trim_start()),
            _ => {}
        }
    }
    (doc, "")
}

const PLAIN: &[&str] = &["word", "meaning"];
const SIGNED: &[&str] = &["word", "written", "meaning"];
const VALUED: &[&str] = &["word", "default", "least and greatest", "meaning"];

fn football() -> Vec<Group> {
    vec![
        Group {
            title: "Roles",
            kind: "role",
            about: "Every player has one.",
            pages: &[("teams", "language/team.md#teams")],
            head: PLAIN,
            rows: rows!(Role),
        },
        Group {
            title: "Statistics",
            kind: "statistic",
            about: "The keys of `stats`, from 0 to 1.",
            pages: &[("options of a player", "language/team.md#options-of-a-player")],
            head: PLAIN,
            rows: rows!(Stat),
        },
        Group {
            title: "Points of an end",
            kind: "point",
            about: "After a team: `left.goal`, `them.penalty_spot`.",
            pages: &[("points", "language/place.md#points")],
            head: PLAIN,
            rows: rows!(Landmark),
        },
        Group {
            title: "Regions of an end",
            kind: "region of an end",
            about: "After a team: `left.box`, `them.third`.",
            pages: &[("named regions", "language/region.md#named-regions")],
            head: PLAIN,
            rows: rows!(RegionName),
        },
        Group {
            title: "Regions of the pitch",
            kind: "region",
            about: "They belong to no team.",
            pages: &[("named regions", "language/region.md#named-regions")],
            head: PLAIN,
            rows: rows!(PitchRegion),
        },
        Group {
            title: "Actions",
            kind: "action",
            about: "What an agent can do in a step, by their numbers in Google Research Football.",
            pages: &[
                ("properties", "language/expression.md#properties"),
                ("actions and masks", "python.md#actions-and-masks"),
            ],
            head: &["word", "number", "meaning"],
            rows: rows!(Action, |word| vec![word.index().to_string()]),
        },
        Group {
            title: "Game modes",
            kind: "game mode",
            about: "The values of `game_mode`.",
            pages: &[("properties", "language/expression.md#properties")],
            head: PLAIN,
            rows: rows!(GameMode),
        },
        Group {
            title: "Starts",
            kind: "start",
            about: "After `start`.",
            pages: &[("starts", "language/start.md#start")],
            head: PLAIN,
            rows: rows!(StartKind),
        },
    ]
}

fn events() -> Vec<Group> {
    vec![
        Group {
            title: "Events",
            kind: "event",
            about: "After `on` and `count of`, and in conditions.",
            pages: &[("events", "language/event.md")],
            head: &["word", "qualifiers", "meaning"],
            rows: rows!(EventKind, |word| {
                let names: Vec<String> =
                    word.qualifiers().iter().map(|it| format!("`{it}`")).collect();
                vec![names.join(" ")]
            }),
        },
        Group {
            title: "Qualifiers",
            kind: "qualifier",
            about: "After an event: `pass completed`.",
            pages: &[("events", "language/event.md")],
            head: PLAIN,
            rows: rows!(Qualifier),
        },
        Group {
            title: "Properties of an event",
            kind: "property of an event",
            about: "After `event.`, in an `on` block and in a `give … on`.",
            pages: &[("events", "language/event.md#event")],
            head: &["word", "type"],
            rows: EventField::NAMED
                .iter()
                .map(|(name, ty)| (*name, vec![format!("`{ty}`")]))
                .collect(),
        },
    ]
}

fn properties(owner: Owner, title: &'static str, kind: &'static str, about: &'static str) -> Group {
    Group {
        title,
        kind,
        about,
        pages: &[("properties", "language/expression.md#properties")],
        head: &["word", "type", "meaning"],
        rows: PROPERTIES
            .iter()
            .filter(|it| it.owner == owner)
            .map(|it| (it.name, vec![format!("`{}`", it.ty), it.doc.to_owned()]))
            .collect(),
    }
}

fn values() -> Vec<Group> {
    vec![
        properties(Owner::Ball, "Properties of the ball", "property of the ball", "After `ball.`."),
        properties(
            Owner::Player,
            "Properties of a player",
            "property of a player",
            "After a player: `me.fatigue`.",
        ),
        properties(
            Owner::Match,
            "Properties of the match",
            "property of the match",
            "They stand alone: `elapsed`.",
        ),
        Group {
            title: "Values with a name",
            kind: "value",
            about: "They are no properties of the match.",
            pages: &[("names", "language/expression.md")],
            head: PLAIN,
            rows: rows!(ValueWord),
        },
        Group {
            title: "Functions",
            kind: "function",
            about: "Of numbers, places, sets, time and chance.",
            pages: &[
                ("functions", "language/expression.md#functions"),
                ("time", "language/time.md"),
                ("draws", "language/draw.md"),
                ("regions", "language/region.md#constructors"),
            ],
            head: SIGNED,
            rows: signed!(Function),
        },
        Group {
            title: "Types",
            kind: "type",
            about: "Of parameters, and of every value.",
            pages: &[("types", "language/param.md#types")],
            head: PLAIN,
            rows: rows!(Type),
        },
        Group {
            title: "Units",
            kind: "unit",
            about: "Behind a number.",
            pages: &[("units", "language/param.md#units")],
            head: &["word", "type", "meaning"],
            rows: rows!(Unit, |word| vec![format!("`{}`", word.ty())]),
        },
    ]
}

fn options() -> Vec<Group> {
    vec![
        Group {
            title: "Rules",
            kind: "rule",
            about: "The keys of `rules { … }`.",
            pages: &[("rules", "language/start.md#rules")],
            head: &["word", "default", "meaning"],
            rows: rows!(Rule, |word| {
                let default = match (word, word.default_value()) {
                    (Rule::Physics, _) => "`gated`",
                    (Rule::HalfTime, _) => "`0 steps`",
                    (_, 0.0) => "`off`",
                    _ => "`on`",
                };
                vec![default.to_owned()]
            }),
        },
        Group {
            title: "The world",
            kind: "option of the world",
            about: "Of `world { … }`; `wind` is written as one vector.",
            pages: &[("the world", "language/world.md")],
            head: VALUED,
            rows: rows!(WorldFigure, |word| range(word.usual(), word.range())),
        },
        Group {
            title: "The pitch",
            kind: "option of the pitch",
            about: "The keys of `pitch { … }`, in metres.",
            pages: &[("the pitch", "language/pitch.md")],
            head: VALUED,
            rows: rows!(PitchFigure, |word| range(word.usual(), word.range())),
        },
        Group {
            title: "Agents",
            kind: "option of agents",
            about: "The keys of `agents { … }`.",
            pages: &[("agents", "language/team.md#agents")],
            head: PLAIN,
            rows: rows!(AgentsOption),
        },
        Group {
            title: "A team",
            kind: "option of a team",
            about: "The keys of `team left { … }`.",
            pages: &[("teams", "language/team.md#teams")],
            head: PLAIN,
            rows: rows!(TeamOption),
        },
        Group {
            title: "A player",
            kind: "option of a player",
            about: "The keys of a player's braces, and of `each`.",
            pages: &[("options of a player", "language/team.md#options-of-a-player")],
            head: PLAIN,
            rows: rows!(PlayerOption),
        },
        Group {
            title: "A substitution",
            kind: "option of a substitution",
            about: "The keys of `substitute NAME when … { … }`.",
            pages: &[("substitutions", "language/team.md#substitutions")],
            head: PLAIN,
            rows: rows!(SubstituteOption),
        },
        Group {
            title: "The ball",
            kind: "option of the ball",
            about: "The keys of the ball's braces.",
            pages: &[("the ball", "language/team.md#the-ball")],
            head: PLAIN,
            rows: rows!(BallOption),
        },
        Group {
            title: "A start",
            kind: "option of a start",
            about: "The keys of `start … { … }`.",
            pages: &[("starts", "language/start.md#start")],
            head: PLAIN,
            rows: rows!(StartOption),
        },
    ]
}

/// The cells of a figure with its range.
fn range(usual: f64, (least, greatest): (f64, f64)) -> Vec<String> {
    vec![usual.to_string(), format!("{least} … {greatest}")]
}

fn behaviours() -> Vec<Group> {
    vec![
        Group {
            title: "Acts",
            kind: "act",
            about: "After `do`, and as `ai` of a player.",
            pages: &[("behaviours", "language/behavior.md#do")],
            head: SIGNED,
            rows: signed!(Primitive),
        },
        Group {
            title: "Measures",
            kind: "measure",
            about: "In the checks of a file, and in what ends a stage of a curriculum.",
            pages: &[
                ("checks", "language/level.md#checks"),
                ("curricula", "language/level.md#curricula"),
            ],
            head: SIGNED,
            rows: signed!(MeasureWord),
        },
        Group {
            title: "Numbers of an episode",
            kind: "number of an episode",
            about: "The `Q` of a measure.",
            pages: &[("checks", "language/level.md#checks")],
            head: PLAIN,
            rows: rows!(QuantityWord),
        },
    ]
}
