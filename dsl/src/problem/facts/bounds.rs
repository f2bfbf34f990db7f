//! Values outside of their range, and words that an option never has.

use super::facts;
use crate::problem::Code;
use crate::problem::said::say;
use setpiece_scenario::vocabulary::PitchFigure;

facts! {
    /// Facts about ranges.
    pub(crate) Bounds {
        /// A value outside of its range; `shown`: the range, in backticks where it is written so.
        Outside { what: String, text: String, shown: String } = Code::OutOfRange =>
            say(format!("{what} is `{text}`, outside {shown}"), "").help(match text.parse::<f64>() {
                Ok(share) if shown == "`0%..100%`" && (1.0..=100.0).contains(&share) => {
                    format!("a share has its sign: `{text}%`")
                }
                _ => format!("write a value in {shown}"),
            }),
        /// A penalty box that doesn't fit the pitch.
        BoxTooLarge { figure: PitchFigure, text: String } = Code::OutOfRange => match figure {
            PitchFigure::Box => say(format!("`box` is `{text}`, more than half the pitch"), "")
                .help("write at most half of `length`, or leave it out: it is in proportion then"),
            _ => say(format!("`{figure}` is `{text}`, more than the pitch is wide"), "")
                .help("write at most `width`, or leave it out: it is in proportion then"),
        },
        /// A velocity above the greatest one; `what`: whose.
        TooFast { what: String, most_mps: f64 } = Code::OutOfRange =>
            say(format!("{what} is never faster than {most_mps} m/s"), "").help("write a smaller velocity"),
        /// A time that is no whole number of steps.
        NotWholeSteps { what: String, text: String, steps: f64 } = Code::OutOfRange => {
            let message = if text.ends_with("steps") {
                format!("{what} is `{text}`")
            } else {
                format!("{what} is `{text}`: {steps:.3} steps")
            };
            let written = match steps.round() {
                steps if steps > 1.0 => format!("{steps} steps"),
                _ => "1 step".to_owned(),
            };
            say(message, "not a whole number of steps")
                .help(format!("write `{written}`; a step is 0.1 s"))
                .writing(None, written)
        },
        /// A word that an option never has.
        NeverWord { option: String, word: String, known: Vec<&'static str> } = Code::OutOfRange =>
            say(format!("`{option}` is never `{word}`"), "").help(format!("write `{}`", known.join("` or `"))),
        /// `mirror` of another word.
        Mirror { word: String } = Code::OutOfRange =>
            say(format!("`mirror` is never `{word}`"), "")
                .help("write `mirror: flanks`, `mirror: ends` or `mirror: none`"),
        /// `physics` of another word.
        Physics { text: String } = Code::OutOfRange =>
            say(format!("`physics` is never `{text}`"), "").help("write `physics: gated` or `physics: full`"),
        /// `overlap` of another word.
        Overlap = Code::OutOfRange => say("`overlap` can only be `allowed`", "").help("write `overlap: allowed`"),
        /// A parameter's range without a value.
        EmptyRange { text: String } = Code::OutOfRange =>
            say(format!("the range `{text}` is empty"), "its end lies before its begin")
                .help("write the lower end first"),
        /// A value of a parameter outside of its domain.
        OutsideDomain {
            text: String,
            allowed: String,
            parameter: String,
            is_argument: bool,
        } = Code::OutOfRange => {
            let label = if *is_argument {
                format!("given to `{parameter}`")
            } else {
                format!("the default of `{parameter}`")
            };
            say(format!("`{text}` is outside `{allowed}`"), label).help(format!("write a value in `{allowed}`"))
        },
        /// A parameter that no caller and no default gives a value.
        NoValue { parameter: String } = Code::WrongArguments =>
            say(format!("parameter `{parameter}` has no value"), "").help("give it a default: `= 0.5`"),
    }
}
