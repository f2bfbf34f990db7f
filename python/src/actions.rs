//! Actions: what Python may give for one.

use crate::errors;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PySet, PyString};
use setpiece::scenario::Action;

/// Longest part of a value that an error shows, characters.
const SHOWN_MAX: usize = 60;

/// Reads one action per agent: an integer (or a sequence of one) for one agent, a sequence of n for n.
///
/// Raises `ActionError` for anything else; `actions` may then be partly overwritten.
pub(crate) fn read(given: &Bound<'_, PyAny>, actions: &mut [Action]) -> PyResult<()> {
    if let [single] = actions
        && let Some(action) = one(given)
    {
        *single = action;
        return Ok(());
    }
    if several(given, actions) { Ok(()) } else { Err(wrong(given, actions.len())) }
}

/// An action by its number: any integer of Python's or `NumPy`'s, but no truth value.
fn one(given: &Bound<'_, PyAny>) -> Option<Action> {
    if given.is_instance_of::<PyBool>() {
        return None;
    }
    let number: usize = given.extract().ok()?;
    Action::from_index(number).filter(|_| number < Action::DEFAULT_SET)
}

fn several(given: &Bound<'_, PyAny>, actions: &mut [Action]) -> bool {
    // What has keys has no order; a text's letters are no actions.
    let unordered =
        given.is_instance_of::<PyString>() || given.is_instance_of::<PyDict>() || given.is_instance_of::<PySet>();
    if unordered || given.len().ok() != Some(actions.len()) {
        return false;
    }
    let Ok(items) = given.try_iter() else { return false };
    let mut slots = actions.iter_mut();
    for item in items {
        match (item.ok().as_ref().and_then(one), slots.next()) {
            (Some(action), Some(slot)) => *slot = action,
            _ => return false,
        }
    }
    slots.next().is_none()
}

fn wrong(given: &Bound<'_, PyAny>, n_agents: usize) -> PyErr {
    let py = given.py();
    let mut shown: String = given.repr().map_or_else(|_| "?".to_owned(), |text| text.to_string_lossy().into_owned());
    if shown.chars().count() > SHOWN_MAX {
        shown = shown.chars().take(SHOWN_MAX).chain("…".chars()).collect();
    }
    let last = Action::DEFAULT_SET - 1;
    let message = match n_agents {
        1 => format!("expected an action, an integer in 0..{last}, found `{shown}`"),
        n => format!("expected {n} actions, integers in 0..{last}, found `{shown}`"),
    };
    errors::raise_plain(py, "ActionError", &message)
}
