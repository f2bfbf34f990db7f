//! Names that nothing has, that are declared twice, hide one another or lead in a circle.

use super::facts;
use crate::problem::said::{Elsewhere, Said, say};
use crate::problem::{Code, Guess};
use crate::source::Span;

facts! {
    /// Facts about names.
    pub(crate) Names {
        /// Nothing of a kind has this name.
        Unknown {
            kind: Kind,
            name: String,
            guess: Guess,
        } = kind.code() => unknown(*kind, name, guess),
        /// No value in sight has this name.
        ///
        /// - `late`: whether it is read in a scenario, where a child may declare it;
        /// - `records`: whether it is compared where records are read.
        NoValue {
            name: String,
            guess: Guess,
            late: bool,
            records: bool,
        } = Code::UnknownName => {
            let said = say(format!("nothing here is called `{name}`"), "not known").guess(guess, "");
            if said.help.is_some() || !records {
                said
            } else {
                said.help(format!(
                    "declare it in the scenario: what is counted by `record {name} = count of …`, what is drawn by `let {name} = …`"
                ))
            }
        },
        /// A player of a parent is read that a child's own players replace; `by`: the first of
        /// these.
        ReplacedPlayer {
            name: String,
            child: String,
            by: Span,
        } = Code::UnknownName =>
            say(format!("`{child}` has no player `{name}`"), "read here")
                .at(by, format!("its own players replace those that `{child}` inherits"))
                .help(format!("move a player and keep the others by `place {name} …`, or name one of its own `{name}`")),
        /// A value of the scenario is used outside of it.
        ///
        /// - `noun`: what uses it, with its article;
        /// - `form`: how that would be declared and used with the value as a parameter, if it can.
        OfTheScenario {
            name: String,
            noun: &'static str,
            form: Option<(String, String)>,
        } = Code::UnknownName => {
            let said = say(format!("nothing here is called `{name}`"), "not known");
            said.help(match form {
                Some((declared, used)) => {
                    format!("{noun} doesn't see the scenario's names: hand it in, `{declared}` and `{used}`")
                }
                None => {
                    format!("`{name}` is the scenario's, which nothing outside of it sees: declare it outside, too")
                }
            })
        },
        /// A file that was imported under a name has no such item.
        NotInFile { file: String, name: String, guess: Guess } = Code::UnknownName =>
            say(format!("`{file}` has no `{name}`"), "not known").guess(guess, "it has"),
        /// A function that nothing has; `other`: what else has the name.
        NoFunction { name: String, other: NotAFunction } = Code::UnknownFunction => {
            let said = say(format!("no function is called `{name}`"), "not known");
            match other {
                NotAFunction::Value { call } => said
                    .help(format!("`{name}` is a value: write it without brackets"))
                    .writing(Some(*call), name),
                NotAFunction::Item(noun) => said.help(format!("`{name}` is {noun}")),
                NotAFunction::Foreign(ours) => said.help(format!("did you mean `{ours}`?")),
                NotAFunction::Clause(written) => {
                    said.help(format!("it stands behind what is observed: `ball {written}`"))
                }
                NotAFunction::Unknown(guess) => said.guess(guess, ""),
            }
        },
        /// A parent that nothing has; `other`: what else has the name.
        NoParent {
            kind: &'static str,
            name: String,
            other: Option<&'static str>,
            guess: Guess,
        } = Code::UnknownParent => {
            let said = say(format!("no {kind} is called `{name}`"), "extends this");
            match other {
                Some(noun) => said.help(format!("`{name}` is {noun}")),
                None => said.guess(guess, ""),
            }
        },
        /// An argument for a parameter that the parent doesn't have.
        NoParentParameter { parent: String, name: String, guess: Guess } = Code::UnknownName =>
            say(format!("`{parent}` has no parameter `{name}`"), "").guess(guess, ""),
        /// A property that a value doesn't have.
        NoProperty {
            text: String,
            noun: String,
            name: String,
            like: Like,
        } = Code::UnknownMember => {
            let said = say(format!("`{text}` ({noun}) has no property `{name}`"), "not known");
            match like {
                Like::HasBall { whole } => {
                    let written = format!("{text} has ball");
                    said.help(format!("write `{written}`")).writing(Some(*whole), written)
                }
                Like::Velocity => said.help(format!("write `{text}.velocity`, or `{text}.speed`")),
                Like::Place => said.help(format!("write `{text}` for its place, or `{text}.x` and `{text}.y`")),
                Like::Other(guess) => said.guess(guess, "it has"),
            }
        },
        /// A landmark or region that a team doesn't have.
        NoLandmark { team: String, name: String, guess: Guess } = Code::UnknownMember =>
            say(format!("`{team}` has no landmark or region `{name}`"), "not known").guess(guess, "a team has"),
        /// A player of a team by their role.
        PlayerByRole { team: String, role: String } = Code::UnknownMember =>
            say(format!("`{team}` has no landmark or region `{role}`"), "a role")
                .help(format!("a player is called by a name of their own: write `anchor: {role} at …` in the team, and here `anchor`")),
        /// An option that something doesn't have; `whose`: with its article or in backticks.
        NoOption { whose: String, option: String, guess: Guess } = Code::UnknownOption =>
            say(format!("{whose} has no option `{option}`"), "not known").guess(guess, "it has"),
        /// An option of players that stands beside them.
        OfPlayers { option: String } = Code::UnknownOption =>
            say(format!("a team has no option `{option}`"), "an option of players")
                .help(format!("write it behind a player, or for all of them: `each {{ {option}: … }}`")),
        /// An option of another block, of something else. `whose`: with its article or in
        /// backticks.
        OfBlock { whose: String, option: String, block: &'static str } = Code::UnknownOption =>
            say(format!("{whose} has no option `{option}`"), format!("an option of `{block}`"))
                .help(format!("write `{block} {{ {option}: … }}`"))
                .elsewhere(Elsewhere::Moved(block)),
        /// The ball has no mass of its own; `option`: what it was called.
        NoMass { whose: String, option: String } = Code::UnknownOption =>
            say(format!("{whose} has no option `{option}`"), "a ball's mass shows only in the air")
                .help("write what the air does to it: `world { drag: 0.8, swerve: 0.8 }` is a ball that is heavier by a quarter"),
        /// An option of `rules` that is no rule.
        NoRule { option: String, guess: Guess } = Code::UnknownOption =>
            say(format!("`rules` has no option `{option}`"), "not known").guess(guess, "it can be"),
        /// An option among the players of a formation.
        NoFormationOption { option: String } = Code::UnknownOption =>
            say(format!("a formation has no option `{option}`"), "").help("options of a team stand in `team left { … }`"),
        /// A word that is none of those a parameter can be.
        NoneOfItsWords {
            word: String,
            parameter: Option<String>,
            guess: Guess,
        } = Code::OutOfRange => {
            let message = match parameter {
                Some(name) => format!("`{word}` is none of the words `{name}` may be"),
                None => format!("`{word}` is none of the words it may be"),
            };
            say(message, "").guess(guess, "")
        },
        /// A label of an ending that looks like a verdict.
        LikeAVerdict { label: String, meant: &'static str } = Code::LikelyTypo =>
            say(format!("`{label}` is a label, no verdict"), "neither success nor failure")
                .help(format!("did you mean `{meant}`?")),
        /// A name that means one thing was declared again; `what`: the name in backticks, with its
        /// kind before it.
        DeclaredTwice { what: String, first: Option<Span> } = Code::DuplicateName => {
            let said = say(format!("{what} is declared twice"), "declared again here").help(OTHER_NAME);
            match first {
                Some(first) => said.at(first, "first declared here"),
                None => said,
            }
        },
        /// Two things of the scenario of different kinds have one name.
        ///
        /// - `kinds`: with their article.
        Shared {
            name: String,
            kinds: (&'static str, &'static str),
            first: Span,
        } = Code::DuplicateName =>
            say(format!("`{name}` is declared twice"), "declared again here")
                .at(first, "first declared here")
                .help(format!("{} and {} can't share a name: {OTHER_NAME}", kinds.0, kinds.1)),
        /// A record is called as a word that means something wherever a value stands; `whose`: what
        /// the word belongs to.
        UnreadableRecord { name: String, whose: &'static str } = Code::HidingName =>
            say(
                format!("`{name}` means the language's `{name}` wherever it is read, never this record"),
                format!("belongs to {whose}"),
            )
            .help(format!("choose another name, for example `my_{name}`")),
        /// Two players have one name.
        TwoPlayers { name: String, first: Span } = Code::DuplicateName =>
            say(format!("two players are called `{name}`"), "called so again here")
                .at(first, "first called so here")
                .help(OTHER_NAME),
        /// Several players are written under one name.
        OneNameForMany { name: String, count: u32 } = Code::DuplicateName =>
            say(format!("`{name}` would name {count} players"), "")
                .help("leave the name out, or write one line per player"),
        /// Something that may stand once was given again; `what`: in backticks, or with its
        /// article.
        GivenTwice { what: String, first: Span } = Code::DuplicateOption =>
            say(format!("{what} is given twice"), "given again here").at(first, "first given here").help(LEAVE_ONE_OUT),
        /// A clause of a `do` stands twice.
        ClauseTwice = Code::DuplicateOption =>
            say("a `do` has each of its clauses once", "given again here").help("join the conditions: `until a or b`"),
        /// Two rewards of a scenario have one name.
        RewardTwice { name: String, what: String, first: Span } = Code::DuplicateName =>
            say(format!("reward `{name}` is given twice"), "given again here")
                .at(first, "first given here")
                .help(format!("give one of them another label: `reward {what} as \"{name}_2\"`")),
        /// Two endings of a scenario have one label.
        EndingTwice { name: String, first: Span } = Code::DuplicateName =>
            say(format!("ending `{name}` is given twice"), "given again here")
                .at(first, "first given here")
                .help("give each ending its own label, or join the conditions with `or`"),
        /// Two values of an observation have one label.
        ObservedTwice { label: String } = Code::DuplicateName =>
            say(format!("`{label}` is observed twice"), "named again here")
                .help("choose another label: `… as \"label\"`"),
        /// Two imported files declare one name.
        Ambiguous { name: String, files: (String, String) } = Code::AmbiguousName =>
            say(format!("`{name}` is declared in `{}` and in `{}`", files.0, files.1), "which one is meant?")
                .help("import one of the files `as` a name and write `name.` before it"),
        /// A role that several players have stands for one.
        AmbiguousPlayer { role: String, count: usize } = Code::AmbiguousName =>
            say(format!("the team has {count} players `{role}`"), "which one is meant?")
                .help("give the player a name, `anna: CM at …`, and place `anna`"),
        /// A definition uses itself; `declared`: where it stands, if that is another place.
        Recursion { name: String, declared: Option<Span>, is_behavior: bool } = Code::Recursion => {
            let said = say(format!("`{name}` uses itself"), "closes the circle");
            let said = said.help(if *is_behavior { "what is done again and again stands in a `repeat`" } else { NO_CIRCLE });
            match declared {
                Some(declared) => said.at(declared, "declared here"),
                None => said,
            }
        },
        /// Parents lead in a circle.
        ExtendsItself { name: String } = Code::ExtendsCycle =>
            say(format!("`{name}` extends itself"), "closes the circle").help("take one `extends` of the circle away"),
        /// More parents than are followed.
        TooManyParents { kind: &'static str, most: usize } = Code::TooMuch =>
            say(format!("a {kind} has more than {most} parents"), "too many")
                .help("join some of them: a child may change everything that it inherits"),
        /// `remove` of what is not inherited.
        NothingToRemove {
            what: String,
            name: Option<String>,
            guess: Guess,
        } = Code::NothingToRemove => {
            let message = match name {
                Some(name) => format!("no {what} `{name}` is inherited"),
                None => format!("no `{what}` is inherited"),
            };
            say(message, "nothing to remove").guess(guess, "")
        },
        /// A local name hides another one; `what`: with its article.
        Hides { name: String, what: &'static str, hidden: Option<Span> } = Code::HidingName => {
            let said = say(format!("`{name}` hides {what} of this name"), "hides it from here")
                .help(format!("choose another name, for example `my_{name}`"));
            match hidden {
                Some(hidden) => said.at(hidden, "hidden here"),
                None => said,
            }
        },
        /// A word of the language as a name; `whose`: what the word belongs to.
        Reserved { name: String, whose: String } = Code::ReservedName =>
            say(format!("`{name}` is a word of the language and can't be a name"), format!("belongs to {whose}"))
                .help(format!("choose another name, for example `my_{}`", name.to_lowercase())),
        /// A behavior has the name of a primitive.
        HidesPrimitive { name: String } = Code::ReservedName =>
            say(format!("`{name}` is something that every behavior can do"), "can't be declared again")
                .help(format!("choose another name, for example `my_{name}`")),
        /// An assignment to something that is no state.
        NotAState { name: String, is: Assigned, guess: Guess } = Code::UnknownName => {
            let message = match is {
                Assigned::ValueOfReward => format!("`{name}` is no `state`, and only a `state` is assigned"),
                Assigned::Value | Assigned::Nothing => format!("no `state` is called `{name}`"),
            };
            let said = say(message, "can't be assigned").guess(guess, "");
            match is {
                _ if said.help.is_some() => said,
                Assigned::Value => said.help("only a `state` is assigned"),
                _ => {
                    let statement = format!("state {name} = 0");
                    said.help(format!("declare it at the top: `{statement}`"))
                        .elsewhere(Elsewhere::OfBody(statement))
                }
            }
        },
        /// A record reads a state that a reward doesn't have.
        NoStateOfReward { reward: String, name: String, guess: Guess } = Code::UnknownMember => {
            let said = say(format!("reward `{reward}` has no state `{name}`"), "not known").guess(guess, "it has");
            if said.help.is_none() { said.help("a record reads what a reward keeps in `state`s") } else { said }
        },
        /// A record reads the memory of a script.
        ScriptHasNoStates { reward: String } = Code::UnknownMember =>
            say(format!("reward `{reward}` is a script, whose memory is its own"), "can't be read"),
        /// `each` of no role.
        EachOfNothing { name: String, guess: Guess } = Code::UnknownRole =>
            say(format!("`each` knows no `{name}`"), "").guess(guess, ""),
        /// `each` of a role that the team doesn't have.
        NobodyOfRole { team: &'static str, name: String } = Code::UnknownRole =>
            say(format!("the {team} team has no `{name}`"), "").help("leave it out, or write `each outfield`"),
        /// A cast asks for a player that the team doesn't have.
        NoSuchPlace { team: &'static str, place: usize } = Code::UnknownName =>
            say(format!("the {team} team has no player {place}"), ""),
    }
}

const OTHER_NAME: &str = "choose another name for one of them";
const LEAVE_ONE_OUT: &str = "leave one of them out";
const NO_CIRCLE: &str = "give one of the circle a value of its own";
const WHO_PLAYS: &str = "it can be `bot`, `hold`, `lazy`, an act such as `press`, a `behavior` or `script \"file.rhai\"`";

/// The kinds of names that have a list of their own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    /// Who plays a player.
    Ai,
    /// An `ending` of a file.
    Ending,
    /// A `formation` of a file.
    Formation,
    /// An event of the match.
    Event,
    /// What is compared with a player's `action`.
    Action,
    /// What is compared with `game_mode`.
    Mode,
    /// A player of a team.
    Player,
    /// A player of the scenario by their name.
    NamedPlayer,
    /// A region of the pitch.
    Region,
    /// A reward in sight.
    Reward,
    /// What a player does.
    Act,
    /// What stands behind `start`.
    Start,
    /// A statistic of a player.
    Statistic,
    /// `left` or `right`.
    Team,
    /// The type of a parameter.
    Type,
}

impl Names {
    /// Whether a child of the scenario may bring what is missing.
    pub(super) fn child_may_bring(&self) -> bool {
        match self {
            Names::NoValue { late, .. } => *late,
            Names::ReplacedPlayer { .. } => true,
            Names::Unknown { kind, .. } => {
                matches!(kind, Kind::Formation | Kind::Player | Kind::NamedPlayer | Kind::Reward)
            }
            _ => false,
        }
    }
}

impl Kind {
    fn code(self) -> Code {
        match self {
            Kind::Event => Code::UnknownEvent,
            Kind::Region => Code::UnknownMember,
            Kind::Statistic => Code::UnknownOption,
            _ => Code::UnknownName,
        }
    }

    fn noun(self) -> &'static str {
        match self {
            Kind::Ai => "no player's `ai`",
            Kind::Ending => "no `ending`",
            Kind::Event => "no event",
            Kind::Action => "no action",
            Kind::Mode => "no game mode",
            Kind::Player => "no player of this team",
            Kind::NamedPlayer => "no player",
            Kind::Region => "no region",
            Kind::Reward => "no reward",
            Kind::Formation => "no formation",
            Kind::Act => "nothing that a player does",
            Kind::Start => "no start",
            Kind::Statistic => "no statistic",
            Kind::Team => "no team",
            Kind::Type => "no type",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Kind::Action
            | Kind::Ending
            | Kind::Mode
            | Kind::Player
            | Kind::NamedPlayer
            | Kind::Start
            | Kind::Team
            | Kind::Type => "",
            _ => "not known",
        }
    }
}

fn unknown(kind: Kind, name: &str, guess: &Guess) -> Said {
    let listed = match kind {
        Kind::Action => "the actions are",
        Kind::Mode => "the modes are",
        Kind::Region => "there is",
        Kind::Reward => &format!("declare it, `reward {name} {{ give … }}`, or use one of"),
        Kind::Event => "the events are",
        Kind::Formation => "the formations are",
        Kind::NamedPlayer => "the players with a name are",
        Kind::Statistic => "it can be",
        Kind::Type => "the types are",
        _ => "",
    };
    let said = say(format!("{} is called `{name}`", kind.noun()), kind.label());
    match kind {
        // What there is, and what the author may add to it.
        Kind::Act if !guess.known.is_empty() => said.help(format!(
            "a player can `{}`, or what a `behavior` says",
            guess.known.join("`, `")
        )),
        Kind::Ai if guess.meant.is_none() => said.help(WHO_PLAYS),
        Kind::Ending if name.starts_with(|first: char| first.is_ascii_digit()) => {
            said.help(format!("write `end limit {name}`"))
        }
        Kind::Ending if guess.meant.is_none() => {
            said.help(format!("say when it ends: `end {name} when …`"))
        }
        Kind::NamedPlayer if *guess == Guess::default() => said.help(format!(
            "a player has the name that stands before their role: `{name}: CM at …`"
        )),
        Kind::Team => said.help("write `team left` or `team right`"),
        _ => said.guess(guess, listed),
    }
}

/// What has the name of a function that there is not.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum NotAFunction {
    /// A value; `call`: with its brackets.
    Value { call: Span },
    /// Another item, with its article.
    Item(&'static str),
    /// A function of another language, which is called so here.
    Foreign(&'static str),
    /// A word that stands behind a value that is observed, and with what.
    Clause(&'static str),
    /// Nothing.
    Unknown(Guess),
}

/// What a property that there is not may stand for.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Like {
    /// A question for possession; `whole`: with what it is asked of.
    HasBall { whole: Span },
    /// The velocity by its parts.
    Velocity,
    /// The place.
    Place,
    /// A property of another name.
    Other(Guess),
}

/// What an assignment finds in place of a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Assigned {
    /// Another value of a behavior.
    Value,
    /// Another value of a reward.
    ValueOfReward,
    /// No value.
    Nothing,
}
