//! Suites, checks and curricula.

use super::facts;
use crate::problem::said::say;
use crate::problem::{Code, Guess};
use crate::source::Span;

facts! {
    /// Facts about suites, checks and curricula.
    pub(crate) Plans {
        /// No scenario has the name of what is played; `other`: what else has it.
        NoScenario {
            name: String,
            other: Option<&'static str>,
            guess: Guess,
        } = Code::UnknownName => {
            let said = say(format!("no scenario is called `{name}`"), "played here");
            match other {
                Some(noun) => said.help(format!("`{name}` is {noun}")),
                None => said.guess(guess, ""),
            }
        },
        /// What is played is abstract.
        Abstract { name: String } = Code::NoScenario =>
            say(format!("`{name}` is abstract: it can't be played"), "")
                .help(format!("play a scenario that extends it: `scenario mine extends {name} {{ … }}`")),
        /// A value of a plan reads what is known later.
        NotConstant { text: String } = Code::NotConstant =>
            say(format!("`{text}` is not known before anything is played"), "")
                .help("write a number, a `const`, or the name of the `each` around"),
        /// A number of episodes, or a seed, that is out of range.
        Count { what: &'static str, text: String, least: u64, most: u64 } = Code::OutOfRange =>
            say(format!("{what} is `{text}`, outside {least}..{most}"), "")
                .help(format!("write a whole number in {least}..{most}")),
        /// Two or more lines say what is played.
        PlayTwice { first: Span } = Code::DuplicateOption =>
            say("a check plays one scenario", "played again here")
                .at(first, "first played here")
                .help("write a check of its own"),
        /// A check without `play`.
        NothingPlayed { name: String } = Code::WrongArguments =>
            say(format!("the check `{name}` plays nothing"), "")
                .help("write `play SCENARIO with bot for 50 episodes`"),
        /// A check without `expect`.
        NothingExpected { name: String } = Code::WrongArguments =>
            say(format!("the check `{name}` expects nothing"), "").help("write `expect success_rate > 50%`"),
        /// A suite without entries.
        EmptySuite { name: String } = Code::WrongArguments =>
            say(format!("suite `{name}` has no entry"), "").help("write `SCENARIO for 100 episodes`"),
        /// A curriculum without stages.
        NoStage { name: String } = Code::WrongArguments =>
            say(format!("curriculum `{name}` has no stage"), "").help("write `stage first = SCENARIO`"),
        /// A stage that is never reached.
        NeverReached { name: String, before: String } = Code::WrongArguments =>
            say(format!("stage `{name}` is never reached"), "")
                .help(format!("say what ends `{before}`: `until success_rate(last: 200) > 80%`")),
        /// No agent has the name of who plays.
        NoAgent { name: String, guess: Guess } = Code::UnknownName =>
            say(format!("no agent is called `{name}`"), "plays every slot").guess(guess, "it can be"),
        /// Nothing that is measured has this name.
        NoMeasure { name: String, guess: Guess } = Code::UnknownName =>
            say(format!("nothing that is measured is called `{name}`"), "not known").guess(guess, "it can be"),
        /// The median is a quantile.
        Median = Code::UnknownName =>
            say("nothing that is measured is called `median`", "not known")
                .help("write `quantile(…, 50%)`"),
        /// No number of an episode has this name.
        NoQuantity { text: String, guess: Guess } = Code::UnknownName =>
            say(format!("no number of an episode is called `{text}`"), "not known").guess(guess, "it can be"),
        /// A record stands without its kind; `form`: the whole measure, with it.
        IsRecord { name: String, form: String } = Code::UnknownName =>
            say(format!("no number of an episode is called `{name}`"), "a record")
                .help(format!("write `{form}`")),
        /// A share of episodes that is never beyond a bound, or always within it.
        ShareBound { text: String, always: bool } = Code::OutOfRange =>
            say(format!("`{text}` {} holds", if *always { "always" } else { "never" }), "")
                .help("a share lies in 0%..100%"),
        /// A number that is counted meets a bound by chance.
        CountBound { text: String, counted: String } = Code::OutOfRange =>
            say(format!("`{text}` may never hold"), "")
                .help(format!("more than one is counted at once: write `{counted} >= …`")),
        /// An outcome stands where something is measured; `form`: how often it is met.
        IsOutcome { name: String, form: String } = Code::UnknownName =>
            say(format!("nothing that is measured is called `{name}`"), "an outcome")
                .help(format!("write `{form}`")),
        /// A scenario has no such record, term or outcome; `what`: which of these.
        NoSuch {
            scenario: String,
            what: &'static str,
            name: String,
            guess: Guess,
        } = Code::UnknownName =>
            say(format!("`{scenario}` has no {what} `{name}`"), "not known").guess(guess, "it has"),
        /// A scenario has no such outcome, but its match has something of this name.
        ///
        /// - `known`: its outcomes;
        /// - `seen`: how a record notes it.
        NoOutcome {
            scenario: String,
            name: String,
            known: Vec<String>,
            seen: String,
        } = Code::UnknownName => {
            let known = known.join("`, `");
            say(format!("`{scenario}` has no outcome `{name}`"), "no ending is called so")
                .help(format!(
                    "it has `{known}`; for what happens on the way write `record seen = {seen}` in the scenario, and here `expect max(record seen) == 0`"
                ))
        },
        /// The brackets of a measure hold something else.
        MeasureForm { name: String, form: &'static str } = Code::WrongArguments =>
            say(format!("`{name}` is not measured like this"), "").help(format!("write `{form}`")),
        /// A measure of a check looks at the latest episodes, or counts steps.
        OnlyInCurricula { text: String } = Code::WrongScope =>
            say(format!("`{text}` belongs to curricula"), "a check measures all of its episodes")
                .help("leave it out"),
        /// A share outside of 0 to 1.
        Share { what: &'static str, text: String } = Code::OutOfRange => {
            let said = say(format!("{what} is `{text}`, outside 0%..100%"), "");
            match text.parse::<f64>() {
                Ok(number) if (1.0..=100.0).contains(&number) => said.help(format!("write `{text}%`")),
                _ => said.help("write a share in 0%..100%"),
            }
        },
        /// A band whose lower bound isn't below the upper one.
        EmptyBand { low: String, high: String } = Code::OutOfRange =>
            say(format!("nothing is kept in {low}..{high}"), "")
                .help("write the lower bound first, as in `50%..70%`"),
        /// A parameter that adapts from a value to the same.
        AdaptsNowhere { text: String } = Code::OutOfRange =>
            say(format!("it begins and ends at `{text}`"), "adapts nothing")
                .help("write two different values: the easiest, and the hardest behind `to`"),
        /// An `each` of a suite without values.
        EmptySweep { name: String } = Code::WrongArguments =>
            say(format!("`each {name}` has no values"), "").help(format!("write some: `each {name} in [0.3, 0.6]`")),
        /// A record that isn't one number; `what`: what it is.
        NoNumber { name: String, what: &'static str } = Code::WrongType =>
            say(format!("the record `{name}` is {what}, not a number"), "")
                .help("measure a record that holds a number, such as `max of …` or `count of …`"),
        /// The shares of a mix don't add up.
        Mix { sum: f64 } = Code::OutOfRange =>
            say(format!("the shares of `mix` add up to {}%", (sum * 100.0 * 1e6).round() / 1e6), "")
                .help("write shares that add up to 100%, such as `mix current: 80%, earlier: 20%`"),
        /// A curriculum mixes twice.
        MixTwice { first: Span } = Code::DuplicateOption =>
            say("`mix` is given twice", "given again here").at(first, "first given here").help("leave one of them out"),
        /// A stage has other agents than the first one; `known`: those of the first, and where it
        /// stands.
        OtherAgents {
            stage: String,
            found: [usize; 2],
            known: (Span, [usize; 2]),
        } = Code::OtherAgents => {
            let crew = |[left, right]: &[usize; 2]| match right {
                0 => format!("{left} on the left"),
                _ => format!("{left} on the left and {right} on the right"),
            };
            let (first, known) = known;
            say(format!("stage `{stage}` has other agents than the first stage"), crew(found))
                .at(first, crew(known))
                .help(
                    "a vector plays one number of agents: write the same `agents { … }` in a scenario that \
                     extends this one, or set `left` and `right` of `make_vec`",
                )
        },
        /// The adapted name is no argument of the stage.
        AdaptsNothing { name: String, scenario: String } = Code::WrongArguments =>
            say(format!("`{name}` adapts nothing"), "")
                .help(format!("hand it in: `{scenario}(difficulty: {name})`")),
        /// The adapted name is a part of an argument.
        AdaptsPart { name: String } = Code::WrongArguments =>
            say(format!("`{name}` must be the whole argument"), "computed with it")
                .help(format!("write `PARAMETER: {name}`, and the range that it needs behind `from`")),
        /// The entries of a file are too many.
        TooMany { most: usize } = Code::TooMuch =>
            say(format!("suites of one file have more than {most} entries"), "too much")
                .help("use fewer values in `each`, or put suites into files of their own"),
    }
}
