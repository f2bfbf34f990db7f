//! Rewards, endings and observations.

use super::facts;
use crate::problem::Code;
use crate::problem::said::{Elsewhere, Said, say};
use crate::source::Span;
use setpiece_scenario::PitchSize;
use setpiece_scenario::vocabulary::{EventKind, PitchMeasure, Rule, Team};

facts! {
    /// Facts about rewards, endings and observations.
    pub(crate) Rewards {
        /// A reward with the weight 0.
        WeightZero { reward: String } = Code::NeverPays =>
            say(format!("reward `{reward}` never pays"), "times 0").help("write another weight, or leave the reward out"),
        /// A payment that no match can earn.
        NeverPays {
            why: Never,
        } = Code::NeverPays => why.add(say("this `give` never pays", "")),
        /// A receiver that is relative to the agent who is judged.
        ReceiverOfView { name: String, word: &'static str } = Code::WrongType => {
            let said = say(format!("`{word} {name}` says nothing: every agent is judged for itself"), "");
            match name.as_str() {
                "us" | "me" | "players" | "all" | "everyone" | "everybody" | "anyone" => said.help(format!("leave it out, or name a team or a player: `{word} left`")),
                _ => said.help(format!(
                    "name a team or a player, `{word} left`, or write whose deeds pay: `give 1 on goal by them`"
                )),
            }
        },
        /// An empty list of receivers.
        NoReceiver { word: &'static str } = Code::WrongArguments =>
            say("nobody receives it", "").help(format!("name a team or players: `{word} left`, `{word} [striker, winger]`")),
        /// A reward for a team without agents.
        PaysNobody { team: Team } = Code::NeverPays =>
            say(format!("no agent plays for {team}"), "pays nobody")
                .help(format!("write `agents {{ {team}: 1 }}`, or name the other team")),
        /// A payment above the limit.
        MoreThanPayable { text: String } = Code::OutOfRange =>
            say(format!("`{text}` is more than can be paid"), "").help("rewards are small numbers: `give 1`"),
        /// A label without a letter.
        EmptyLabel = Code::OutOfRange =>
            say("a label has at least one letter", "")
                .help("say in a word what is paid, for example `give 1 on goal by us as \"goal\"`"),
        /// Several terms of what isn't a script.
        TermsOfNoScript = Code::WrongScope =>
            say("only a script has several terms", "")
                .help("write one `give` for each term: `give 1 on goal by us as \"goal\"`"),
        /// A scenario without an ending.
        NeverEnds { scenario: String } = Code::NoEnding =>
            say(format!("an episode of `{scenario}` never ends"), "").help("write, for example, `end limit 400 steps`"),
        /// An ending whose condition no match meets.
        NeverComes { label: String, why: Never } = Code::NeverEnds =>
            why.add(say(format!("the ending `{label}` never comes about"), "never holds")),
        /// An ending that holds only when an earlier one does, which names the outcome.
        Forestalled {
            label: String,
            earlier: String,
            at: Span,
            is_inherited: bool,
        } = Code::NeverEnds =>
{
            let said = say(
                format!("the ending `{label}` never comes about: `{earlier}` holds whenever it does"),
                "checked later",
            )
            .at(at, "checked first, and names the outcome");
            if *is_inherited {
                let out = format!("remove end {earlier}");
                said.help(format!("take the other one out, `{out}`, or call this one `{earlier}`, too"))
                    .elsewhere(Elsewhere::OfScenario(out))
            } else {
                said.help(format!("write it above `{earlier}`, or leave one of them out"))
            }
        },
        /// Of several earlier endings one holds whenever it does.
        ForestalledTogether {
            label: String,
            earlier: Vec<String>,
            is_inherited: bool,
        } = Code::NeverEnds => {
            let out = earlier.iter().map(|label| format!("`remove end {label}`"));
            let (out, them): (Vec<String>, _) = (out.collect(), earlier.join("` or `"));
            say(
                format!("the ending `{label}` never comes about: `{them}` holds whenever it does"),
                "checked later",
            )
            .help(if *is_inherited {
                format!("take the other ones out: {}", out.join(", "))
            } else {
                "write it above them, or leave one of them out".to_owned()
            })
        },
        /// Endings hold whenever a round would be over in one of its ways.
        NoNextRound { earlier: Vec<String> } = Code::NeverEnds => {
            let all = earlier.join("`, `");
            let out: Vec<String> = earlier.iter().map(|label| format!("`remove end {label}`")).collect();
            let (end, them) = if earlier.len() == 1 { ("ends", "it") } else { ("end", "them") };
            say(format!("`{all}` {end} the episode where a round would be over"), "checked later than the endings")
                .help(format!("take {them} out: {}", out.join(", ")))
        },
        /// An ending without a condition.
        EndsWhen = Code::Syntax =>
            say("the ending doesn't say when", "").help("write, for example, `end success when goal by left`"),
        /// Noise of what is no number.
        NoNoise { noun: String } = Code::WrongType =>
            say(format!("{noun} has no noise"), "not a number")
                .help("noise is added to numbers, quantities, places and vectors"),
        /// A delay without a known upper end.
        EndlessDelay { text: String } = Code::NotConstant =>
            say(format!("it isn't known how long `{text}` is at most"), "may be any duration")
                .help("write a duration, a parameter with a range, or `uniform(0.1s, 0.3s)`"),
        /// The length of a stack that is known only later.
        StackNotConstant { text: String } = Code::NotConstant =>
            say(format!("`{text}` is not known before the match"), "decides how many numbers there are")
                .help("write a number or a `const`: `stack 4`"),
        /// An observation without numbers, or with too many.
        Numbers { most: usize } = Code::WrongArguments =>
            say(format!("an observation has 1 to {most} numbers"), "")
                .help("write, for example, `observe vector { ball.x, ball.y, distance(me, ball) / 10m }`"),
    }
}

/// Why a payment is never earned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Never {
    /// It pays 0.
    Nothing,
    /// The scenario switches off the rule without which there is no such event.
    SwitchedOff(EventKind, Rule),
    /// A completed pass to an opponent.
    CompletedToOpponent,
    /// A pass that a team mate intercepts.
    InterceptedByMate,
    /// The condition is false whatever the match is like.
    Condition(Option<Because>),
    /// Several things together make the condition false.
    Several,
}

/// The one thing that a condition looks at, which is never as it asks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Because {
    /// Coordinates on the pitch.
    Places,
    /// Coordinates in metres; how far the pitch's goal lines and touchlines lie from the centre at
    /// most, if that is known.
    Metres(Option<[f64; 2]>),
    /// The ball's velocity.
    BallSpeed,
    /// A player's velocity.
    PlayerSpeed,
    /// A player's yellow cards.
    YellowCards,
    /// A player's fatigue.
    Fatigue,
    /// The ball's height; how high it rises at most, metres.
    BallHeight(f64),
    /// What begins at 0 and only grows.
    Count,
    /// The time: how many steps the episode has at most.
    Limit(f64),
    /// The time: how many steps a round has at most.
    Round(f64),
    /// Parts that don't hold in the same step.
    Excluded,
    /// A number of players.
    Players,
    /// The round: how many an episode has.
    Rounds(f64),
}

impl Never {
    fn add(self, said: Said) -> Said {
        let said = said.help(self.words());
        match self {
            Never::SwitchedOff(_, rule) => said.elsewhere(Elsewhere::Setting(
                "rules",
                rule.to_string(),
                Never::switched_on(rule).to_owned(),
            )),
            _ => said,
        }
    }

    /// What a rule is set to for its event to happen.
    fn switched_on(rule: Rule) -> &'static str {
        if rule == Rule::HalfTime { "1500 steps" } else { "on" }
    }

    fn words(self) -> String {
        match self {
            Never::Nothing => "it pays 0: write another value, or leave it out".to_owned(),
            Never::SwitchedOff(event, rule) => {
                let value = Never::switched_on(rule);
                format!("`{event}` never happens: write `rules {{ {rule}: {value} }}`")
            }
            Never::CompletedToOpponent => {
                "a pass is completed to a team mate: write `pass intercepted`, or name one"
                    .to_owned()
            }
            Never::InterceptedByMate => {
                "an opponent intercepts a pass: write `pass completed`, or name one".to_owned()
            }
            Never::Condition(Some(because)) => {
                format!("its condition can't hold: {}", because.words())
            }
            Never::Condition(None) => {
                "its condition is never true: write another one, or leave it out".to_owned()
            }
            Never::Several => "its condition can't hold: look at each of its values".to_owned(),
        }
    }
}

impl Because {
    fn words(self) -> String {
        match self {
            Because::Places => {
                "x lies between about -1 and 1, y between -0.42 and 0.42; metres are `ball.metres.x > 20m`"
            }
            Because::Metres(None) => {
                "on this pitch x lies between the goal lines, y between the touchlines"
            }
            Because::Metres(Some([x, y])) => {
                let usual = PitchSize::USUAL;
                let [length, width] = [PitchMeasure::HalfLength, PitchMeasure::HalfWidth];
                let is_usual = x == usual.measure(length) && y == usual.measure(width);
                let pitch = if is_usual { "the usual" } else { "this" };
                return format!(
                    "on {pitch} pitch x lies between about -{x:.0}m and {x:.0}m, y between -{y:.0}m and {y:.0}m"
                );
            }
            Because::BallSpeed => "no ball flies as fast",
            Because::PlayerSpeed => "nobody runs as fast",
            Because::YellowCards => "a player has 0, 1 or 2 yellow cards",
            Because::Fatigue => "fatigue lies between 0 and 1",
            Because::BallHeight(most) => {
                return format!("here the ball is at least 0m high, and never higher than {most:.0}m");
            }
            Because::Count => "a count never falls below what it begins with",
            Because::Limit(steps) => return format!("the episode is over after {steps:.0} steps"),
            Because::Rounds(n) => return format!("an episode has {n:.0} rounds"),
            Because::Round(steps) => return format!("a round is over after {steps:.0} steps"),
            Because::Excluded => "its parts exclude each other",
            Because::Players => "a team has 0 to 11 players",
        }
        .to_owned()
    }
}
