//! What Rhai's errors say, in plain words, and where they are.

use super::limits::{
    BYTES_PER_OPERATION, CALL_LEVELS_MAX, DISABLED, OPERATIONS_MAX, Overspent, PREFIX, Why,
};
use rhai::{EvalAltResult, ParseError, ParseErrorType, Position};

/// Line and column of a position, if it has any.
pub(super) fn line_column(position: Position) -> Option<(usize, usize)> {
    position.line().map(|line| (line, position.position().unwrap_or(1)))
}

/// Where and why a call failed.
pub(super) fn explain(error: Box<EvalAltResult>) -> (Option<(usize, usize)>, String) {
    let mut error = error;
    let mut place = None;
    // The innermost place is the line that failed.
    loop {
        let here = line_column(error.position());
        match *error {
            EvalAltResult::ErrorInFunctionCall(_, _, inner, _) => {
                place = here.or(place);
                error = inner;
            }
            other => {
                let known = match &other {
                    EvalAltResult::ErrorTerminated(token, _) => {
                        token.read_lock::<Overspent>().and_then(|over| over.place)
                    }
                    _ => None,
                };
                let place = known.or(here).or(place);
                return (place, runtime_message(other));
            }
        }
    }
}

/// Two of a script's functions use one variable at once.
const RACE: &str =
    "a closure reads the variable that its chain begins with: put one of both into a `let` before";

/// Rhai reports what is too large; this adds which limit it is.
fn words_of_size(words: &str) -> String {
    if words.starts_with("a value") { words.to_owned() } else { format!("{words} too large") }
}

fn runtime_message(error: EvalAltResult) -> String {
    match error {
        EvalAltResult::ErrorTerminated(token, _) if token.is::<Overspent>() => {
            match token.cast::<Overspent>().why {
                Why::Size => format!(
                    "more than {OPERATIONS_MAX} operations in one call: work on values counts by their size, \
                 {BYTES_PER_OPERATION} bytes to an operation"
                ),
                Why::Changing => RACE.to_owned(),
            }
        }
        EvalAltResult::ErrorTerminated(..) => {
            format!("more than {OPERATIONS_MAX} operations in one call: a loop doesn't end")
        }
        EvalAltResult::ErrorStackOverflow(_) => format!("calls nest deeper than {CALL_LEVELS_MAX}"),
        EvalAltResult::ErrorDataRace(..) => RACE.to_owned(),
        EvalAltResult::ErrorDataTooLarge(words, _) => lower_first(&words_of_size(&words)),
        EvalAltResult::ErrorDotExpr(message, _) if !message.is_empty() => lower_first(&message),
        EvalAltResult::ErrorRuntime(value, _) => format!("the script threw `{value}`"),
        EvalAltResult::ErrorPropertyNotFound(name, _) => format!("unknown property `{name}`"),
        EvalAltResult::ErrorVariableNotFound(name, _) => format!("unknown variable `{name}`"),
        EvalAltResult::ErrorFunctionNotFound(signature, _) => {
            format!("no function `{}`", tidy(&signature))
        }
        mut other => {
            let _ = other.take_position();
            lower_first(&other.to_string())
        }
    }
}

/// What is wrong with a script's text, in one clause.
pub(super) fn parse_message(error: &ParseError) -> String {
    match error.err_type() {
        ParseErrorType::VariableUndefined(name) => format!("unknown variable `{name}`"),
        ParseErrorType::Reserved(word)
            if DISABLED.contains(&word.as_str()) || word.starts_with(PREFIX) =>
        {
            format!("`{word}` is not available in a script")
        }
        ParseErrorType::ModuleUndefined(name) => format!("no module is imported as `{name}`"),
        other => lower_first(&other.to_string()),
    }
}

/// Drops the paths of Rust types from Rhai's words.
pub(super) fn tidy(words: &str) -> String {
    let short = words.replace("rhai::types::immutable_string::", "").replace("alloc::vec::", "");
    short
        .split_inclusive([' ', ',', '('])
        .map(|part| part.rsplit("::").next().unwrap_or(part))
        .collect()
}

pub(super) fn lower_first(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
}
