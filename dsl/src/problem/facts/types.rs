//! Values of the wrong type or unit, and operands that don't agree.

use super::facts;
use crate::check::types::Ty;
use crate::problem::Code;
use crate::problem::said::{Said, say};
use crate::source::Span;
use setpiece_scenario::vocabulary::Landmark;

/// A longer text is not repeated in a message, letters.
const TEXT_MAX: usize = 40;

facts! {
    /// Facts about types and units.
    pub(crate) Types {
        /// A value of another type than its place wants.
        Mismatch {
            wanted: Ty,
            found: Ty,
            text: String,
            instead: Instead,
        } = code(*wanted, *found) =>
            mismatch(*wanted, *found, text, instead),
        /// The two values of a choice have no type in common.
        ChoiceMismatch {
            wanted: Ty,
            found: Ty,
            text: String,
            other: Span,
        } = code(*wanted, *found) =>
            mismatch(*wanted, *found, text, &Instead::Usual).at(other, wanted.noun()),
        /// An event's `by` or `to` is neither a team nor a player.
        NeitherTeamNorPlayer { found: Ty, text: String } = Code::WrongType =>
            expected("a team or a player", *found, text).help("write, for example, `by left` or `by me`"),
        /// What is paid goes to no team, player or role.
        NoReceiver { found: Ty, text: String } = Code::WrongType =>
            expected("a team, players or a role", *found, text)
                .help("write, for example, `for left`, `for striker`, `to event.by` or `to assist`"),
        /// A rule is neither on nor off.
        NeitherOnNorOff { rule: &'static str, found: Ty, text: String } = Code::WrongType =>
            expected("`on` or `off`", *found, text).help(format!("write `{rule}: on` or `{rule}: off`")),
        /// The operands of an operator don't agree.
        Disagree { verb: Verb, left: Operand, right: Operand } = code(left.ty, right.ty) =>
            agree(
                say(disagreement(*verb, left, right), right.ty.noun())
                    .at(&left.span, left.ty.noun()),
                *verb,
                left,
                right,
            ),
        /// `a + b` of two points; `offset`: the name of the second one, if it is a point that could
        /// be an offset.
        PointsAdded { offset: Option<String> } = Code::WrongType => {
            let said = say("two points can't be added", "");
            match offset {
                Some(name) => {
                    said.help(format!("an offset is a vector: declare it as one, `let {name}: vector = (2m, 0m)`"))
                }
                None => said.help("add an offset in brackets: `ball + (2m, 0m)`; or write `between a and b`"),
            }
        },
        /// A point whose coordinates have different units.
        MixedPoint { first: Operand, other: Operand, is_height: bool } = Code::MixedUnits => {
            let operand = [first, other].into_iter().find(|it| it.metres.is_some());
            let normalised = operand.and_then(|it| Some((it.span, it.metres.as_ref()?)));
            let help = if let Some((_, metres)) = normalised {
                format!("a coordinate is normalised; in metres write `{metres}`")
            } else if *is_height {
                "a place on the pitch has two coordinates; a third is a height, `1m`".to_owned()
            } else {
                "write both coordinates normalised, `(0.5, 0.1)`, or both in metres, `(27m, 8m)`"
                    .to_owned()
            };
            let (first_noun, noun) = (first.ty.noun(), other.ty.noun());
            let (text, other_text) = (&first.text, &other.text);
            say(format!("`{text}` is {first_noun}, `{other_text}` {noun}: a point has one unit"), noun)
                .at(&first.span, first_noun)
                .help(help)
                .writing_if(normalised)
        },
        /// `nobody` stands where a place is wanted.
        NobodyHasNoPlace = Code::Impossible => say("`nobody` has no place", "nobody is there").help(NAME_A_PLAYER),
        /// A property of `nobody`.
        NobodyHasNoProperty { property: String } = Code::Impossible =>
            say(format!("`nobody` has no `{property}`"), "nobody is there").help(NAME_A_PLAYER),
        /// A choice between values that no register holds.
        NoChoiceOf { ty: Ty, values: [String; 2] } = Code::NotYet => {
            let said = say(format!("a choice between values that are each {} is not supported yet", ty.noun()), "");
            match ty {
                Ty::Formation => {
                    said.help(format!("choose where it is used: `formation: choice({})`", values.join(", ")))
                }
                Ty::String => {
                    said.help("choose between numbers: `let kind = choice(1, 2)`, and `when kind == 1`")
                }
                _ => said.help("choose between conditions instead: `c and … or not c and …`"),
            }
        },
        /// A division by 0; `text`: the divisor, if it doesn't say so itself.
        DividedByZero { text: Option<String> } = Code::Impossible => {
            let what = text.as_ref().map_or(String::new(), |text| format!("`{text}` is 0, and "));
            say(format!("{what}nothing can be divided by 0"), "").help("divide by something else")
        },
        /// A divisor that a parameter can make 0.
        MayDivideByZero { text: String, low: f64, high: f64 } = Code::Impossible =>
            say(format!("`{text}` can become 0, and nothing can be divided by 0"), format!("between {low} and {high}"))
                .help("narrow the parameter's range"),
        /// A root or logarithm of what is too small; `text`: the operand, if it is not a constant.
        OutsideDomain { what: String, least: Option<(String, f64)> } = Code::Impossible => {
            let low = least.as_ref().map_or(String::new(), |(text, low)| format!(", and `{text}` can be {low}"));
            say(format!("{what} can't be computed{low}"), "")
        },
        /// A number that is not finite in SI units.
        NumberTooLarge = Code::Impossible => say("the number is too large", "").help(PITCH_SIZE),
        /// Digits of a number that no float holds.
        TooManyDigits { digits: usize } = Code::OutOfRange =>
            say(format!("a number of {digits} digits is too large"), "above 1e308").help(PITCH_SIZE),
        /// `event` without a property.
        EventIsNoValue { parts: String } = Code::WrongType =>
            say("`event` is no value by itself", "").help(format!("it has `{parts}`")),
        /// `A or B` of regions; `joined`: how it is written.
        RegionsJoined { word: &'static str, joined: String } = Code::WrongType =>
            say(format!("`{word}` joins conditions, and these are regions"), "two regions")
                .write(joined),
        /// A name of a file that stands for no value; `cure`: how it is used instead.
        NotAValue { name: String, noun: &'static str, cure: Option<Use> } = Code::WrongType => {
            let said = say(format!("`{name}` is {noun}, not a value"), "");
            match cure {
                Some(Use::Called) => said.help(format!("call it: `{name}(…)`")),
                Some(Use::Given) => said.help(format!("give it to a player: `ai: {name}`")),
                None => said,
            }
        },
        /// A reward where a value is wanted.
        ///
        /// - `states`: how those that it keeps are read here, `None` where none can be.
        RewardIsNoValue { name: String, states: Option<Vec<String>> } = Code::WrongType => {
            let said = say(format!("`{name}` is a reward, not a value"), "");
            match states.as_deref() {
                None => said.help("a record or an ending of its scenario reads a reward's states"),
                Some([]) => said.help(format!(
                    "it keeps nothing to read: give it a state, `state n = 0`, and read `{name}.n`"
                )),
                Some([state]) => said.help(format!("read its state: `{state}`")),
                Some(all) => said.help(format!("read one of its states: `{}`", all.join("`, `"))),
            }
        },
        /// A series where a value is wanted.
        SeriesIsNoValue { name: String } = Code::WrongType =>
            say(format!("`{name}` is a series, a value for every step"), "one value is needed")
                .help("write another record of the same, for example with `last of`"),
        /// A state of a type that is not kept from step to step.
        NoState { ty: Ty } = Code::WrongType =>
            say(format!("a state can't be {}", ty.noun()), "").help("keep numbers, players and points in states"),
        /// A parameter of a type that no caller can set.
        NoParameter { ty: Ty } = Code::WrongType =>
            say(format!("a parameter can't be {}", ty.noun()), "")
                .help("a parameter is a number, a quantity, a condition, a team or a word; use `let` for others"),
        /// A parameter of a script that no script reads.
        NoScriptParameter { ty: Ty } = Code::WrongType =>
            say(format!("a script's parameter can't be {}", ty.noun()), "")
                .help("it can be a number of any unit, a truth value, a player, a team or a point"),
        /// A child declares another type for a parameter.
        OtherTypeInParent { name: String, parent: Span } = Code::WrongType =>
            say(format!("`{name}` has another type in the parent"), "a child can change the default, not the type")
                .at(parent, "declared here")
                .help("leave the type out, or choose another name"),
        /// A range of words.
        WordsHaveNoRange = Code::WrongType =>
            say("words have no range", "").help("list them: `in [\"wing\", \"centre\"]`"),
        /// An option that is a group or a script, and should be one value.
        OneValue { option: String } = Code::WrongType =>
            say(format!("`{option}` is one value"), "").help(format!("write `{option}: …`")),
        /// `stats: 0.9`.
        StatsIsAGroup = Code::WrongType => say("`stats` is a group", "").help("write `stats: { speed: 0.9 }`"),
        /// A velocity of a player with a third part.
        PlayersDontFly = Code::WrongType =>
            say("a player runs along the ground", "").help("write two coordinates: `(5m/s, 0m/s)`"),
        /// A wind with a third part.
        WindIsLevel = Code::WrongType =>
            say("the wind blows along the ground", "").help("write two coordinates: `(4m/s, 0m/s)`"),
        /// `ai` is no name.
        NoAi = Code::WrongType =>
            say("expected who plays the player", "")
                .help("write `ai: bot`, `ai: hold`, `ai: lazy`, an act such as `ai: press`, a behavior or `ai: script \"file.rhai\"`"),
        /// `score` is no list.
        NoScore = Code::WrongType => say("expected the goals of both teams", "").help("write `score: [1, 0]`"),
        /// `spin` is no triple.
        NoSpin = Code::WrongType =>
            say("expected the spin about three axes", "")
                .help("write, for example, `spin: (0, 0, 30)`: radians per second about x, y and z"),
        /// `formation` is none.
        NoFormation = Code::WrongType => say("expected a formation", "").help("write the name of a `formation`"),
    }
}

const NAME_A_PLAYER: &str = "name a player, or write `nearest(us, to: ball)`";
const PITCH_SIZE: &str = "the pitch is 110m by 72m: write less";

/// How something that is no value is used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Use {
    /// A function.
    Called,
    /// A behavior.
    Given,
}

/// What an operator does with its operands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verb {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `<`, `==` and their like.
    Compare,
}

/// An operand, as the author wrote it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Operand {
    /// Its type.
    pub(crate) ty: Ty,
    /// Its text, on one line.
    pub(crate) text: String,
    /// Its place.
    pub(crate) span: Span,
    /// Whether it is a text in quotes.
    pub(crate) is_quoted: bool,
    /// How it is written with its normalised coordinates in metres, if it has any.
    pub(crate) metres: Option<String>,
}

/// What to write instead of a value of the wrong type.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Instead {
    /// What the two types suggest.
    Usual,
    /// A condition of what was found.
    Condition,
    /// An event where players are counted.
    CountedEvent,
    /// A condition that repeats what both sides of `and` or `or` share; in the place of what.
    Repeated { condition: String, whole: Option<Span> },
    /// A region stands behind `at`; `place`: both.
    In { text: String, place: Span },
    /// A place stands behind `in`; `place`: both.
    At { text: String, place: Span },
    /// A number stands behind `at`.
    PointInBrackets,
    /// A coordinate of a point.
    Coordinate,
    /// A normalised coordinate where a length is wanted.
    Metres { text: String },
    /// A number that may be a fraction where a whole one is wanted: because of a name without a
    /// type, or as it is written.
    Whole { undeclared: Option<Undeclared>, is_literal: bool },
    /// A number stands behind `facing`.
    Facing { text: String },
    /// A number is the first value of `polar`.
    Distance { text: String },
    /// A value that a record holds.
    Recorded,
    /// What `count of` counts.
    Counted,
    /// What `max of` and its like look at.
    Measured { kind: String },
    /// A value that an observation holds.
    Observed,
    /// `gravity`.
    Gravity,
    /// `half_time`.
    HalfTime,
    /// Who is controlled.
    Agents,
}

/// A name whose declaration has a whole value and no type.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Undeclared {
    pub(crate) name: String,
    pub(crate) value: String,
    /// The name where it is declared.
    pub(crate) at: Span,
}

/// Two numbers disagree in their units, everything else in its type.
fn code(one: Ty, other: Ty) -> Code {
    if one.dim().is_some() && other.dim().is_some() { Code::WrongUnit } else { Code::WrongType }
}

/// "expected a length, found `3s` (a duration)"
fn expected(wanted: &str, found: Ty, text: &str) -> Said {
    let noun = found.noun();
    let what = if text.is_empty() || text.chars().count() > TEXT_MAX {
        noun
    } else {
        format!("`{text}` ({noun})")
    };
    say(format!("expected {wanted}, found {what}"), found.noun())
}

fn mismatch(wanted: Ty, found: Ty, text: &str, instead: &Instead) -> Said {
    let said = expected(&wanted.noun(), found, text);
    match instead {
        Instead::Usual => match usual(wanted, found, text) {
            Some(help) => said.help(help),
            None => said,
        },
        Instead::Condition => said.help(condition(found, text)),
        Instead::CountedEvent => said.help(format!("events are counted by `count of {text}`")),
        Instead::Repeated { condition, whole } => {
            said.help(format!("write `{condition}`"))
                .writing_if(whole.map(|whole| (whole, condition)))
        }
        Instead::In { text, place } => {
            said.help(format!("write `in {text}`")).writing(Some(*place), format!("in {text}"))
        }
        Instead::At { text, place } => {
            said.help(format!("write `at {text}`")).writing(Some(*place), format!("at {text}"))
        }
        Instead::PointInBrackets => said.help("a point stands in brackets: `at (0.5, 0.1)`"),
        Instead::Coordinate => {
            said.help("a point is written `(0.5, 0.1)` or `(27m, 8m)`, a velocity `(5m/s, 0m/s)`")
        }
        Instead::Metres { text } => said.help(metres(text)),
        Instead::Whole { undeclared: Some(Undeclared { name, value, at }), .. } => said
            .at(at, "may hold fractions")
            .help(format!("declare whole numbers, `{name}: int = {value}`, or write `round(…)`"))
            .writing(Some(*at), format!("{name}: int")),
        Instead::Whole { is_literal: true, .. } => said.help("write a whole number"),
        Instead::Whole { .. } if text.chars().count() > TEXT_MAX => {
            said.help("round it: `round(…)`, `floor(…)` or `ceil(…)`")
        }
        Instead::Whole { .. } => {
            said.help(format!("write `round({text})`, `floor({text})` or `ceil({text})`"))
        }
        Instead::Facing { text } => said.help(format!("write an angle, `{text}deg`, or a point")),
        Instead::Distance { text } => {
            said.help(format!("write `{text}m` for an offset, `{text}m/s` for a velocity"))
        }
        Instead::Recorded => {
            said.help("a record holds a number, a length, a duration, a place or a condition")
        }
        Instead::Counted => said.help(
            "what is counted is an event, or a condition in brackets, for example `count of (ball in \
             right.box)`",
        ),
        Instead::Measured { kind } => {
            said.help(format!("`{kind} of` takes a number, a length, a duration, …"))
        }
        Instead::Observed => {
            said.help("an observation holds numbers, quantities, conditions, places and vectors")
        }
        Instead::Gravity => said.help("write m/s² as a number: `gravity: 9.81`"),
        Instead::HalfTime => said.help("write `half_time: off` or `half_time: 1500 steps`"),
        Instead::Agents => {
            said.help("write a number, `all`, or a list of names: `[striker, winger]`")
        }
    }
}

/// The condition that a value is a part of.
fn condition(found: Ty, text: &str) -> String {
    let is_literal = text.starts_with(|c: char| c.is_ascii_digit());
    match found {
        Ty::Team | Ty::Player => "compare it, as in `possession == left`, or write `… has ball`",
        Ty::DURATION if is_literal => {
            return format!(
                "write `elapsed > {text}`; an episode ends after `end limit {text}`, and an act of a \
                 behaviour after `for {text}`"
            );
        }
        ty if ty.dim().is_some() => {
            let example = ty.example().and_then(|all| all.split('`').next()).unwrap_or("0");
            let what = if is_literal || text.chars().count() > TEXT_MAX { "…" } else { text };
            return format!("compare it with something: `{what} > {example}`");
        }
        ty if ty.is_place() || ty == Ty::Region => "ask where something is: `ball in right.box`",
        _ => "write a condition, for example `us has ball`",
    }
    .to_owned()
}

/// What the two types suggest.
fn usual(wanted: Ty, found: Ty, text: &str) -> Option<String> {
    let both_numbers = found.dim().is_some() && wanted.dim().is_some();
    match (found, wanted) {
        (Ty::Role, Ty::Point | Ty::Player) => {
            Some(format!("give the player a name, as in `anchor: {text} …`, and write the name"))
        }
        (Ty::Bool, Ty::Point) if Landmark::from_name(text).is_some() => {
            Some(format!("a place belongs to a team: `right.{text}`, or `them.{text}` in a reward"))
        }
        (Ty::LENGTH, Ty::Number) => Some(
            "divide by a length, as in `/ 1m`, or use `grf_distance` for normalised units"
                .to_owned(),
        ),
        (Ty::Number, Ty::Int) => Some("write a whole number".to_owned()),
        (_, Ty::Number) if both_numbers => {
            Some("divide by a value of the same unit to get a plain number".to_owned())
        }
        (_, wanted) if found.is_plain() && both_numbers => {
            let own = with_unit(text, wanted).or_else(|| wanted.example().map(str::to_owned));
            own.map(|written| format!("write the unit: `{written}`"))
        }
        (_, wanted) => wanted.example().map(|example| format!("write, for example, `{example}`")),
    }
}

/// A number as it was written, with the unit that is wanted.
fn with_unit(text: &str, wanted: Ty) -> Option<String> {
    text.replace('_', "").parse::<f64>().ok()?;
    Some(match wanted {
        Ty::LENGTH => format!("{text}m"),
        Ty::DURATION if text.contains('.') => format!("{text}s"),
        Ty::DURATION => format!("{text}s` or `{text} steps"),
        Ty::SPEED => format!("{text}m/s"),
        Ty::ANGLE => format!("{text}deg"),
        _ => return None,
    })
}

/// How a coordinate is written in metres.
fn metres(text: &str) -> String {
    format!("coordinates are normalised, from about -1 to 1; in metres write `{text}`")
}

fn disagreement(verb: Verb, left: &Operand, right: &Operand) -> String {
    let done = match verb {
        Verb::Compare => "compared",
        Verb::Add => "added",
        Verb::Subtract => "subtracted",
    };
    format!(
        "`{}` is {}, `{}` {}: they can't be {done}",
        left.text,
        left.ty.noun(),
        right.text,
        right.ty.noun()
    )
}

/// Adds how two operands can be made to agree.
fn agree(said: Said, verb: Verb, left: &Operand, right: &Operand) -> Said {
    let (x, y) = (left.ty, right.ty);
    let (text_a, text_b) = (&left.text, &right.text);
    let is_compared = verb == Verb::Compare;
    let whole = left.span.to(right.span);
    let both =
        |said: Said, text: String| said.help(format!("write `{text}`")).writing(Some(whole), text);
    if (x == Ty::LENGTH && y.is_plain()) || (y == Ty::LENGTH && x.is_plain()) {
        let number = if y == Ty::LENGTH { left } else { right };
        if let Some(text) = &number.metres {
            return said.help(metres(text)).writing(Some(number.span), text);
        }
        let said = said.help(
            "write the number with its unit, `2m`; `/ 1m` makes a length a number, and \
             `grf_distance` is one",
        );
        let is_literal = number.text.parse::<f64>().is_ok();
        let text = format!("{}m", number.text);
        return if is_literal { said.writing(Some(number.span), text) } else { said };
    }
    let (of_x, of_y) = (x.dim().is_some(), y.dim().is_some());
    let unquoted = text_b.trim_matches('"');
    match (x, y, x.example()) {
        (_, ty, Some(example)) if of_x && ty.is_plain() => {
            said.help(format!("write the number with its unit, for example `{example}`"))
        }
        (_, _, Some(example)) if of_x && of_y => {
            let verb = if is_compared { "compare it with" } else { "both must be" };
            said.help(format!("{verb} {}, for example `{example}`", x.noun()))
        }
        (Ty::Role | Ty::Mode | Ty::Action, _, _) if right.is_quoted => said
            .help(format!("write it without quotes: `{unquoted}`"))
            .writing(Some(right.span), unquoted),
        (Ty::Player | Ty::Team | Ty::Set, _, _) if right.is_quoted => said
            .help(format!("a name stands without quotes: `{unquoted}`"))
            .writing(Some(right.span), unquoted),
        (Ty::Player, Ty::Team | Ty::Set, _) if is_compared => {
            both(said, format!("{text_a} in {text_b}"))
        }
        (ty, Ty::Point | Ty::Player | Ty::Ball, _) if ty.is_place() && is_compared => {
            both(said, format!("distance({text_a}, {text_b}) < 1m"))
        }
        (ty, Ty::Region, _) if ty.is_place() && is_compared => {
            both(said, format!("{text_a} in {text_b}"))
        }
        _ if is_compared => said.help("both sides must be of one kind"),
        _ => said
            .help("numbers, vectors and regions can be added and subtracted, each with its like"),
    }
}
