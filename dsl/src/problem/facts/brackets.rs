//! Brackets, strings and comments that are not closed, or not opened.

use super::facts;
use crate::problem::Code;
use crate::problem::said::say;
use crate::source::Span;

facts! {
    /// Facts about brackets.
    pub(crate) Brackets {
        /// A bracket that closes another kind of bracket.
        WrongCloser {
            closer: char,
            opener: char,
            wanted: char,
            opened: Span,
        } = Code::UnclosedBracket =>
            say(format!("`{closer}` can't close this `{opener}`"), "another bracket")
                .at(opened, "opened here")
                .help(format!("close it with `{wanted}`")),
        /// A bracket that is not closed; `closer`: the next one, which belongs to another bracket.
        Unclosed {
            opener: char,
            wanted: char,
            closer: Option<(char, Span)>,
        } = Code::UnclosedBracket => {
            let said = say(format!("this `{opener}` is not closed"), "opened here")
                .help(format!("close it with `{wanted}`"));
            match closer {
                Some((closer, at)) => said.at(at, format!("this `{closer}` belongs to another bracket")),
                None => said,
            }
        },
        /// A bracket that closes nothing; `point`: the coordinates before it, if it ends a point.
        Unopened { closer: char, point: Option<(String, String)> } = Code::Syntax =>
            say(format!("nothing is open that this `{closer}` closes"), "no opening bracket").help(match point {
                Some((x, y)) => format!("a point stands in brackets: `at ({x}, {y})`"),
                None => format!("take the `{closer}` away"),
            }),
        /// A line that begins a body, without its brace.
        NoBrace { head: String, closer: Span } = Code::Syntax =>
            say(format!("`{head}` has no `{{`"), "its body is not opened")
                .at(closer, "so nothing is open here")
                .help(format!("write `{head} {{`")),
        /// A comment without an end.
        UnclosedComment = Code::UnclosedBracket =>
            say("this comment is not closed", "opened here").help("close it with `*/`"),
        /// A script without an end.
        UnclosedScript = Code::UnclosedString =>
            say("this script is not closed", "opened here").help("close it with `\"\"\"`"),
        /// A string without an end.
        UnclosedString = Code::UnclosedString =>
            say("this string is not closed", "opened here").help("close it with `\"` on its line"),
    }
}
