//! What is known elsewhere, but not where it was used: before the match, outside a block, in an
//! observation.

use super::facts;
use crate::problem::Code;
use crate::problem::said::say;
use crate::source::Span;

facts! {
    /// Facts about what can't be used here.
    pub(crate) Scopes {
        /// `own` where no team is known.
        OwnWithoutTeam = Code::WrongScope =>
            say("`own` needs a team", "no team is known here")
                .help("use it in a `team`, a `formation` or a `reward`; elsewhere write world coordinates"),
        /// `us`, `me` and their like where nobody's view is taken.
        NoView { name: String, why: ViewOutside } = Code::WrongScope =>
            say(format!("`{name}` has no meaning here"), "whose view is it?").help(match why {
                ViewOutside::BothTeams => "both teams have agents, or none: write `left` or `right`",
                ViewOutside::BeforeFirstStep => BEFORE_THE_FIRST_STEP,
                ViewOutside::OutsideRewards => {
                    "write `left`, `right` or a player's name; `us`, `them` and `me` belong to rewards"
                }
            }),
        /// A value of the match before it begins.
        NotYetKnown { name: String, by: BeforeOutside } = Code::WrongScope => {
            let (what, help) = match by {
                BeforeOutside::Constant => ("a constant", IN_A_REWARD),
                BeforeOutside::State => ("a state's first value", BEFORE_THE_FIRST_STEP),
                BeforeOutside::Start => ("the start", IN_A_REWARD),
            };
            say(format!("`{name}` is known only while the match runs"), format!("{what} is computed before")).help(help)
        },
        /// A function over time outside of the match.
        NothingToLookBackAt { function: &'static str } = Code::WrongScope =>
            say(format!("`{function}` looks back at the match, which has not begun"), "").help(IN_A_REWARD),
        /// A function over time in an observation.
        ObservationRemembersNothing { function: &'static str } = Code::WrongScope =>
            say(format!("`{function}` remembers, and an observation does not"), "")
                .help("`prev` and `delta` look one step back; `delayed 0.3s` and `stack 4` show earlier steps"),
        /// A function over time inside of `prev`.
        NotAStepAgo { function: String } = Code::WrongScope =>
            say(format!("`{function}` has no value a step ago"), "inside a look at the step before")
                .help("`prev` reads the state of the match and of the reward only"),
        /// A record of a function over time inside of `prev`.
        RecordNotAStepAgo { name: String } = Code::WrongScope =>
            say(
                format!("the record `{name}` has no value a step ago"),
                "it is of `ever`, `held`, `since`, `prev` or the like",
            )
            .help(format!(
                "keep what it was in a reward: `state was = …` at the top, `was = {name}` at the end"
            )),
        /// `prev` outside of the match.
        NoEarlierStep = Code::WrongScope =>
            say("there is no earlier step here", "this is computed before the match begins")
                .help(JUDGES),
        /// `changes` of what is the same before and after every step.
        NeverChanges { text: String } = Code::WrongScope => {
            let said = say(format!("`{text}` is the same before and after every step"), "never holds");
            match text.as_str() {
                "round" => {
                    said.help("write `round_elapsed == 1 step`, which holds in the first step of every round")
                }
                _ => said.help("leave it out, or look at the match: `possession changes`"),
            }
        },
        /// `prev` inside of `prev`.
        OneStepRemembered = Code::WrongScope =>
            say("only one step is remembered", "inside a look at the step before")
                .help("keep what is older in a `state`"),
        /// A function over time of a value that differs within the step.
        ChangesWithinStep { name: String } = Code::WrongScope =>
            say(
                format!("`{name}` changes within the step, but this is computed once per step"),
                "belongs to a loop or an `on` block",
            )
            .help("`held`, `ever`, `since` and their like look at the whole match, not at one event or player"),
        /// An event outside of the match; `landmark`: it is also the name of a place.
        NothingHappened { event: String, is_landmark: bool } = Code::WrongScope =>
            say("nothing has happened yet", "this is computed before the match").help(if *is_landmark {
                format!("a place belongs to a team: `left.{event}`")
            } else {
                "events belong to rewards and endings".to_owned()
            }),
        /// An event in an observation.
        ObservationShowsState = Code::WrongScope =>
            say("an observation shows the state, not what happened", "")
                .help("use the event in a reward, an ending or a record"),
        /// An ending reads the event that it brings about, or what counts it.
        EndOfItself { event: Span } = Code::Recursion =>
            say("the event `end` is what endings bring about: none can wait for it", "closes the circle")
                .at(event, "happens once the episode has ended")
                .help("read what happens before: an event of the match, or a condition"),
        /// An event inside of `prev`.
        EventsForgotten = Code::WrongScope =>
            say("events of the step before are forgotten", "").help("`since(…)` tells how long ago an event was"),
        /// `event.by` outside of a block of an event.
        NoEvent = Code::WrongScope =>
            say("no event is known here", "").help("`event` stands inside an `on` block, or in a `give … on …`"),
        /// An `on` inside of an `on`.
        OnInsideOn = Code::WrongScope =>
            say("an `on` stands inside another one", "")
                .help("write the inner event as a condition: `when goal by us { … }`"),
        /// A `state` inside of a block; `of`: with its article.
        StateInBlock { of: &'static str } = Code::WrongScope =>
            say(format!("a `state` stands at the top of {of}"), "").help("move it above the block"),
        /// `min_gap` in the match.
        GapInMatch = Code::WrongScope =>
            say("`min_gap` is about the start", "the match is under way here")
                .help("in a match write `min(distance(p, q) for p in S)`"),
        /// A loop over players before the match.
        PlayersBeforeMatch { what: String } = Code::WrongScope =>
            say(format!("`{what}` goes through players, and the match has not begun"), "")
                .help("name the players: `distance(a, b)`"),
        /// `series of` inside of an expression.
        SeriesStandsAlone = Code::WrongScope =>
            say("`series of …` stands alone", "").help("write `record NAME = series of …`"),
        /// A record outside of the match, or where nobody judges it.
        MeasuredLater { name: String } = Code::WrongScope =>
            say(format!("`{name}` is a record, measured while the match runs"), "can't be read here")
                .help(JUDGES),
        /// An ending reads what each agent sees differently.
        KeptForEachAgent { name: String } = Code::WrongScope =>
            say(format!("`{name}` is kept for each agent, and the episode ends for all of them"), "whose is meant?")
                .help("name a player or a side instead of `me` and `us`"),
        /// `max of` and its like where nobody judges the match.
        OverEpisode { kind: String } = Code::WrongScope =>
            say(format!("`{kind} of …` looks at the whole episode"), "").help(JUDGES),
    }
}

const IN_A_REWARD: &str = "use it in a `reward` or an `end`";
const JUDGES: &str = "use it in a reward, an ending or a record";
const BEFORE_THE_FIRST_STEP: &str = "a state's first value is known before the first step: begin with a number, and assign the state further down";

/// Why nobody's view is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ViewOutside {
    /// Not one team alone has agents.
    BothTeams,
    /// States begin before anybody has acted.
    BeforeFirstStep,
    /// Only rewards and their like have a view.
    OutsideRewards,
}

/// What is computed before the match.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum BeforeOutside {
    /// A constant.
    Constant,
    /// The first value of a state.
    State,
    /// The start.
    Start,
}
