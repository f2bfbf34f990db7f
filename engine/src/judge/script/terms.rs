//! The terms of a `reward` hook: one number, or a map of numbers by their names.

use super::api::{to_number, type_words};
use super::check::suggest;
use rhai::{Dynamic, Map};

/// Reads what a hook returned into one number for each of its terms, or one without terms.
///
/// # Errors
/// What is wrong with the value, in one clause.
pub(super) fn read(value: &Dynamic, terms: &[String], into: &mut [f64]) -> Result<(), String> {
    let map = value.read_lock::<Map>();
    if terms.is_empty() {
        let number = to_number(value).map_err(|_| match &map {
            Some(_) => format!("{FOUND_MAP}; {}", list_them("\"goal\", \"tempo\"")),
            None => format!("expected a number, found {}", type_words(value.type_name())),
        })?;
        into.fill(number);
        return Ok(());
    }
    let Some(map) = map else {
        let names: Vec<&str> = terms.iter().map(String::as_str).collect();
        return Err(expected_map(&names, &type_words(value.type_name())));
    };
    for (term, into) in terms.iter().zip(into) {
        let number = map.get(term.as_str()).ok_or_else(|| no_term(term))?;
        *into = to_number(number).map_err(|_| {
            format!("term `{term}`: expected a number, found {}", type_words(number.type_name()))
        })?;
    }
    match map.keys().find(|key| terms.iter().all(|term| term != key.as_str())) {
        None => Ok(()),
        Some(key) => {
            let (message, help) = not_listed(key, terms.iter().map(String::as_str));
            Err(help.map_or(message.clone(), |help| format!("{message}; {help}")))
        }
    }
}

/// Why a map doesn't do where no terms are listed.
pub(super) const FOUND_MAP: &str = "expected a number, found a map";

/// What to write for a map with these terms, in quotes.
pub(super) fn list_them(terms: &str) -> String {
    format!("list its terms where the script is used: `as [{terms}]`")
}

/// What is wrong with a key, and what it may have meant.
pub(super) fn not_listed<'a>(
    key: &str,
    terms: impl Iterator<Item = &'a str>,
) -> (String, Option<String>) {
    (format!("no term is called `{key}`"), suggest(key, terms))
}

/// What is wrong with a map that lacks a term.
pub(super) fn no_term(term: &str) -> String {
    format!("the map has no term `{term}`")
}

/// What is wrong with a value that is no map.
pub(super) fn expected_map(terms: &[&str], found: &str) -> String {
    let listed = terms.iter().map(|term| format!("`{term}`")).collect::<Vec<_>>().join(", ");
    format!("expected a map of {listed}, found {found}")
}
