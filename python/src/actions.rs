//! Actions: what Python may give for one.

use crate::errors;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PySet, PyString};
use setpiece::scenario::Action;

/// Longest part of a value that an error shows, characters.
const SHOWN_MAX: usize = 60;

/// A set of Google Research Football's actions: the numbers below its size.
#[derive(Clone, Copy)]
pub(crate) struct ActionSet {
    /// How many actions it has.
    pub(crate) size: usize,
}

impl ActionSet {
    /// The sets by name.
    pub(crate) const NAMED: [(&'static str, ActionSet); 2] =
        [("default", ActionSet { size: Action::DEFAULT_SET }), ("v2", ActionSet { size: Action::V2_SET })];

    /// The set of a name in `setpiece.make`.
    pub(crate) fn from_name(name: &str) -> Option<ActionSet> {
        Self::NAMED.iter().find(|(known, _)| *known == name).map(|&(_, set)| set)
    }
}

/// Reads one action per agent: an integer (or a sequence of one) for one agent, a sequence of n for n.
///
/// Raises `ActionError` for anything else; `actions` may then be partly overwritten.
pub(crate) fn read(given: &Bound<'_, PyAny>, set: ActionSet, actions: &mut [Action]) -> PyResult<()> {
    if let [single] = actions
        && let Some(action) = one(given, set)
    {
        *single = action;
        return Ok(());
    }
    if several(given, set, actions) { Ok(()) } else { Err(wrong(given, set, actions.len())) }
}

/// An action by its number: any integer of Python's or `NumPy`'s, but no truth value.
fn one(given: &Bound<'_, PyAny>, set: ActionSet) -> Option<Action> {
    if given.is_instance_of::<PyBool>() {
        return None;
    }
    let number: usize = given.extract().ok()?;
    Action::from_index(number).filter(|_| number < set.size)
}

fn several(given: &Bound<'_, PyAny>, set: ActionSet, actions: &mut [Action]) -> bool {
    // What has keys has no order; a text's letters are no actions.
    let unordered =
        given.is_instance_of::<PyString>() || given.is_instance_of::<PyDict>() || given.is_instance_of::<PySet>();
    if unordered || given.len().ok() != Some(actions.len()) {
        return false;
    }
    let Ok(items) = given.try_iter() else { return false };
    let mut slots = actions.iter_mut();
    for item in items {
        match (item.ok().and_then(|item| one(&item, set)), slots.next()) {
            (Some(action), Some(slot)) => *slot = action,
            _ => return false,
        }
    }
    slots.next().is_none()
}

fn wrong(given: &Bound<'_, PyAny>, set: ActionSet, n_agents: usize) -> PyErr {
    let py = given.py();
    let mut shown: String = given.repr().map_or_else(|_| "?".to_owned(), |text| text.to_string_lossy().into_owned());
    if shown.chars().count() > SHOWN_MAX {
        shown = shown.chars().take(SHOWN_MAX).chain("…".chars()).collect();
    }
    let last = set.size - 1;
    let message = match n_agents {
        1 => format!("expected an action, an integer in 0..{last}, found `{shown}`"),
        0 => format!("nobody acts in this scenario: expected no actions (`[]`), found `{shown}`"),
        n => format!("expected {n} actions, integers in 0..{last}, found `{shown}`"),
    };
    if set.size < Action::V2_SET && wants_bot(given) {
        let help = "19 is `builtin_ai`, which `make(..., action_set=\"v2\")` has";
        return errors::raise_with_help(py, "ActionError", &message, help);
    }
    errors::raise_plain(py, "ActionError", &message)
}

/// Whether an action that the `default` set lacks and `v2` has is among what was given.
fn wants_bot(given: &Bound<'_, PyAny>) -> bool {
    let is_bot = |item: &Bound<'_, PyAny>| item.extract::<usize>().ok() == Some(Action::BuiltinAi.index());
    is_bot(given) || given.try_iter().is_ok_and(|mut items| items.any(|item| item.is_ok_and(|item| is_bot(&item))))
}
