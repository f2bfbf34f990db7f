//! What is drawn by lot, and what must be known before.

use super::{Fact, facts};
use crate::problem::Code;
use crate::problem::said::{Elsewhere, say};
use crate::source::Span;
use setpiece_scenario::vocabulary::PitchFigure;

const USE_LET: &str = "use `let` for what is drawn or computed";

facts! {
    /// Facts about draws and constants.
    pub(crate) Chance {
        /// A value that must be known before the start is drawn.
        Drawn { what: String } = Code::NotConstant =>
            say(format!("{what} can't be drawn"), "differs between episodes")
                .help("compute it from parameters and constants"),
        /// A child hands in something drawn, and the parent needs it before the start.
        ArgumentDrawn { name: String, because: Box<Fact>, used: Span } = because.code() =>
            say(format!("`{name}` can't be drawn: {}", consequence(because)), "differs between episodes")
                .at(used, "used here")
                .help("hand in a number or a parameter"),
        /// A `const` reads what is known later.
        NoConstant { name: String } = Code::NotConstant =>
            say(format!("`{name}` is no constant"), "not known before the start").help(USE_LET),
        /// A constant reads a `let` of the scenario.
        ComputedAtReset { name: String } = Code::NotConstant =>
            say(format!("`{name}` is computed at reset"), "a constant is known before").help(USE_LET),
        /// A constant reads the size of a pitch that is drawn or depends on parameters.
        SizeInConstant { figure: PitchFigure } = Code::NotConstant =>
            say(format!("a constant reads `{figure}` of the pitch, which is computed at reset"), "no constant").help(USE_LET),
        /// The default of a parameter reads what is known later.
        DefaultNotConstant { text: String } = Code::NotConstant =>
            say(format!("`{text}` is not known before the start"), "a default must be a constant").help(USE_LET),
        /// `alternate` in a constant.
        AlternateInConstant = Code::NotConstant =>
            say("`alternate` changes with the episode", "a constant never changes"),
        /// `min_gap` of players that depend on a draw.
        WhoseGap = Code::NotConstant =>
            say("whose gap is meant must be known", "")
                .help("write `min_gap(players)`, `min_gap(left)` or `min_gap(right)`"),
        /// A script's parameter differs from step to step.
        ScriptParameterChanges { name: String } = Code::NotConstant =>
            say(format!("`{name}` changes within an episode"), "")
                .help("a script's parameter is fixed for an episode; what changes it reads from `now`"),
        /// `controllable` depends on a parameter or a draw.
        ControllableUnknown = Code::NotConstant =>
            say("`controllable` must be `on` or `off`", "")
                .help("the number of agents can't change with a parameter's value here"),
        /// A draw where nothing is drawn.
        NoDrawHere { function: &'static str, is_constant: bool } =
            if *is_constant { Code::NotConstant } else { Code::WrongScope } =>
            say(format!("`{function}` draws at reset, not here"), "")
                .help("draw it with a `let` of the scenario and use the name")
                .elsewhere(Elsewhere::Named),
        /// A draw of a behavior that belongs to no statement: it would happen in every step.
        NoDrawNow { function: &'static str } = Code::WrongScope =>
            say(format!("`{function}` draws when a statement is reached, not here"), "looked at again and again")
                .help("draw it before with a `let` and use the name"),
        /// A draw of an observation for each element of a loop, or a step ago.
        DrawnOnce { function: &'static str } = Code::WrongScope =>
            say(format!("`{function}` draws once in a step here"), "drawn again for each player or step")
                .help("put the noise behind the value: `ball.x noise normal(0, 0.01)`"),
        /// Noise that is always the same.
        NoiseNotDrawn { text: String } = Code::WrongArguments =>
            say(format!("`{text}` is not drawn, so it is no noise"), "always the same")
                .help(format!("write, for example, `noise normal(0, {text})`")),
        /// `uniform(…)` and its like without a range or a region.
        NoEnds { function: &'static str, signature: String } = Code::WrongArguments =>
            say(format!("`{function}` needs two ends or a region"), "").help(format!("`{signature}`")),
        /// The ends of a range are swapped.
        EndsSwapped = Code::OutOfRange =>
            say("the upper end lies below the lower one", "").help("write the lower end first"),
        /// No choice can be drawn.
        NoWeight = Code::OutOfRange =>
            say("every choice has the weight 0", "").help("give one of them a weight above 0"),
        /// `choice()`.
        NoChoices = Code::WrongArguments =>
            say("`choice` has nothing to choose from", "").help("write, for example, `choice(-0.2, 0.2)`"),
        /// Some choices have weights, one has not.
        WeightMissing = Code::WrongArguments =>
            say("one of the choices has no weight", "").help("write `value: weight` for each, or for none"),
        /// `shuffle` where one value is wanted.
        ShuffleAsValue = Code::WrongScope =>
            say("`shuffle` gives several values", "one is wanted here")
                .help("give each a name: `let (a, b) = shuffle(x, y)`"),
        /// Several names get one value.
        OnlyShuffleGivesSeveral = Code::WrongType =>
            say("only `shuffle` gives several values", "").help(SHUFFLE),
        /// Another number of names than of values.
        ShuffleCount { names: usize, values: usize } = Code::WrongArguments =>
            say(format!("{names} names share {values} values"), "").help(SHUFFLE),
        /// Several names get the value of another function.
        OneValueForNames { function: String, names: usize } = Code::WrongArguments =>
            say(format!("`{function}` gives one value, and {names} names wait for one each"), "").help(SHUFFLE),
        /// More values than `shuffle` takes.
        ShuffleTooMuch { most: usize } = Code::TooMuch =>
            say(format!("`shuffle` mixes more than {most} values"), "one too many").help("mix them in several groups"),
        /// A requirement that no start meets.
        NeverMet { label: String } = Code::ImpossibleToDraw =>
            say(format!("`{label}` is never met"), "always false").help("move the players, or drop the requirement"),
        /// An intersection of regions without a place.
        EmptyRegion { text: String } = Code::Impossible =>
            say(format!("nothing can be drawn in `{text}`"), "its parts don't meet")
                .help("`&` is what both regions hold, `|` what either does"),
        /// A polygon without area, or one whose edges cross.
        EmptyPolygon { is_flat: bool } = Code::Impossible => {
            let (why, help) = if *is_flat {
                ("its corners lie on one line", "move one of its corners off the line")
            } else {
                ("its edges cross", "list its corners in order, along its edge")
            };
            say("nothing can be drawn in this polygon", why).help(help)
        },
    }
}

const SHUFFLE: &str = "write `let (a, b) = shuffle(x, y)`";

/// What follows where an argument is drawn.
fn consequence(because: &Fact) -> String {
    match because {
        Fact::Chance(Chance::Drawn { what }) => format!("{what} depends on it"),
        other => other.words().message,
    }
}
