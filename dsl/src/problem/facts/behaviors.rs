//! What scripted players do.

use super::facts;
use crate::problem::Code;
use crate::problem::said::say;

facts! {
    /// Facts about behaviors.
    pub(crate) Behaviors {
        /// More statements or calls than a behavior may have.
        TooLarge { name: String } = Code::Impossible =>
            say(format!("`{name}` makes the behavior too large"), "").help("call fewer behaviors"),
        /// `do wait`, or `do wait(1s)`; `given`: what stands in the brackets.
        WaitHowLong { given: Option<String> } = Code::WrongArguments => {
            let time = given.as_deref().unwrap_or("1s");
            say("`wait` doesn't say for how long", "").help(format!(
                "write `do wait for {time}`; `do hold` stands until something else happens"
            ))
        },
        /// `sprinting` of what doesn't run; `what`: in backticks, or with its article.
        NoSprint { what: String, runs: Vec<&'static str> } = Code::WrongArguments =>
            say(format!("{what} is not done `sprinting`"), "not here")
                .help(format!("what can be: `{}`", runs.join("`, `"))),
        /// A primitive without its argument; `head`: what stands before it.
        NoTarget {
            head: &'static str,
            primitive: &'static str,
            is_player: bool,
            signature: &'static str,
        } = Code::WrongArguments => {
            let what = if *is_player { "who" } else { "where" };
            let form = signature.replace("(player)", "(NAME)");
            say(format!("`{primitive}` doesn't say {what}"), "").help(format!("write `{head} {form}`"))
        },
        /// `choose { }`.
        NoChoices = Code::WrongArguments =>
            say("`choose` has nothing to choose from", "")
                .help("write, for example, `choose { 2: do shoot 1: do hold for 1s }`"),
    }
}
