//! Actions: the forms in which Python may pass one.

use crate::errors;
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PySet, PyString};
use setpiece::engine::control::continuous;
use setpiece::engine::state::Steer;
use setpiece::scenario::Action;
use setpiece::scenario::vocabulary::StickyAction;

/// Longest value that an error shows, characters.
const SHOWN_MAX: usize = 60;

/// The actions available to an agent.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum ActionSet {
    /// A set of Google Research Football's actions: the numbers below a size.
    Keys(usize),
    /// Four numbers: see `setpiece::engine::control::continuous`.
    Continuous,
}

/// An agent's action in a step.
#[derive(Clone, Copy)]
pub(crate) struct GivenAction {
    /// The key it presses.
    pub(crate) action: Action,
    /// How it steers, with continuous actions.
    pub(crate) steer: Option<Steer>,
}

impl GivenAction {
    /// Presses nothing.
    pub(crate) const IDLE: GivenAction = GivenAction { action: Action::Idle, steer: None };
}

impl ActionSet {
    /// The action sets by name.
    pub(crate) const NAMED: [(&'static str, ActionSet); 4] = [
        ("default", ActionSet::Keys(Action::DEFAULT_SET)),
        ("v2", ActionSet::Keys(Action::V2_SET)),
        ("full", ActionSet::Keys(Action::FULL_SET)),
        ("continuous", ActionSet::Continuous),
    ];

    /// The set with a name of `setpiece.make`.
    pub(crate) fn from_name(name: &str) -> Option<ActionSet> {
        Self::NAMED.iter().find(|(known, _)| *known == name).map(|&(_, set)| set)
    }

    /// The keys that a mask of this set covers.
    pub(crate) fn masked(self) -> &'static [Action] {
        match self {
            ActionSet::Keys(size) => &Action::ALL[..size],
            ActionSet::Continuous => &continuous::KINDS,
        }
    }

    /// The number of held actions in its raw observations.
    pub(crate) fn held(self) -> usize {
        if self == ActionSet::Keys(Action::FULL_SET) {
            StickyAction::ALL.len()
        } else {
            StickyAction::DEFAULT_SET
        }
    }
}

/// Reads one action per agent: an integer (or a sequence of one) for one agent, a sequence of n for
/// n; with continuous actions four numbers, or n rows of four.
///
/// Raises `ActionError` for anything else; `acts` may then be partly overwritten.
pub(crate) fn read(
    given: &Bound<'_, PyAny>,
    set: ActionSet,
    acts: &mut [GivenAction],
) -> PyResult<()> {
    let size = match set {
        ActionSet::Keys(size) => size,
        ActionSet::Continuous => return read_numbers(given, acts),
    };
    if let [single] = acts
        && let Some(action) = one(given, size)
    {
        *single = GivenAction { action, steer: None };
        return Ok(());
    }
    if several(given, size, acts) { Ok(()) } else { Err(wrong(given, size, acts.len())) }
}

/// Reads an action by its number: any integer of Python or `NumPy`, but not a bool.
pub(crate) fn one(given: &Bound<'_, PyAny>, size: usize) -> Option<Action> {
    if given.is_instance_of::<PyBool>() {
        return None;
    }
    let number: usize = given.extract().ok()?;
    Action::from_index(number).filter(|_| number < size)
}

fn several(given: &Bound<'_, PyAny>, size: usize, acts: &mut [GivenAction]) -> bool {
    // A value with keys has no order, and the letters of a text aren't actions.
    let unordered = given.is_instance_of::<PyString>()
        || given.is_instance_of::<PyDict>()
        || given.is_instance_of::<PySet>();
    if unordered || given.len().ok() != Some(acts.len()) {
        return false;
    }
    let Ok(items) = given.try_iter() else { return false };
    let mut slots = acts.iter_mut();
    for item in items {
        match (item.ok().and_then(|item| one(&item, size)), slots.next()) {
            (Some(action), Some(slot)) => *slot = GivenAction { action, steer: None },
            _ => return false,
        }
    }
    slots.next().is_none()
}

/// Reads rows of four numbers.
fn read_numbers(given: &Bound<'_, PyAny>, acts: &mut [GivenAction]) -> PyResult<()> {
    let py = given.py();
    let n_agents = acts.len();
    let wrong = |why: &str| {
        let shape = if n_agents == 1 { "(4,)".to_owned() } else { format!("({n_agents}, 4)") };
        let message = format!("expected numbers of shape {shape}: x, y, kind, power; {why}");
        errors::raise_plain(py, "ActionError", &message)
    };
    let array = floats(given).ok_or_else(|| wrong(&format!("found `{}`", shown(given))))?;
    if array.shape() != [n_agents, 4] && (n_agents != 1 || array.shape() != [4]) {
        return Err(wrong(&format!("found the shape {:?}", array.shape())));
    }
    let values = array.readonly().as_array().iter().copied().collect::<Vec<f32>>();
    for (act, row) in acts.iter_mut().zip(values.chunks_exact(4)) {
        let (steer, action) = continuous::decode([row[0], row[1], row[2], row[3]])
            .ok_or_else(|| wrong(&format!("found {row:?}, which is not all numbers")))?;
        *act = GivenAction { action, steer: Some(steer) };
    }
    Ok(())
}

/// Converts to float32 whatever `NumPy` can.
pub(crate) fn floats<'py>(given: &Bound<'py, PyAny>) -> Option<Bound<'py, PyArrayDyn<f32>>> {
    if let Ok(array) = given.cast::<PyArrayDyn<f32>>() {
        return Some(array.clone());
    }
    if given.is_instance_of::<PyString>() {
        return None;
    }
    let numpy = given.py().import("numpy").ok()?;
    let array = numpy.call_method1("asarray", (given, "float32")).ok()?;
    array.cast_into::<PyArrayDyn<f32>>().ok()
}

/// The beginning of a value's text.
fn shown(given: &Bound<'_, PyAny>) -> String {
    let text =
        given.repr().map_or_else(|_| "?".to_owned(), |text| text.to_string_lossy().into_owned());
    if text.chars().count() <= SHOWN_MAX {
        return text;
    }
    text.chars().take(SHOWN_MAX).chain("…".chars()).collect()
}

fn wrong(given: &Bound<'_, PyAny>, size: usize, n_agents: usize) -> PyErr {
    let py = given.py();
    let (last, shown) = (size - 1, shown(given));
    let message = match n_agents {
        1 => format!("expected an action, an integer in 0..{last}, found `{shown}`"),
        0 => format!("nobody acts in this scenario: expected no actions (`[]`), found `{shown}`"),
        n => format!("expected {n} actions, integers in 0..{last}, found `{shown}`"),
    };
    let wider = ActionSet::NAMED.iter().find_map(|&(name, set)| match set {
        ActionSet::Keys(more) if more > size && holds(given, size..more) => Some(name),
        _ => None,
    });
    match wider {
        Some(name) => {
            let help = format!("`make(..., action_set=\"{name}\")` has it");
            errors::raise_with_help(py, "ActionError", &message, &help)
        }
        None => errors::raise_plain(py, "ActionError", &message),
    }
}

/// Whether the given value includes an action in a range.
fn holds(given: &Bound<'_, PyAny>, range: std::ops::Range<usize>) -> bool {
    let within = |item: &Bound<'_, PyAny>| {
        item.extract::<usize>().is_ok_and(|number| range.contains(&number))
    };
    within(given)
        || given
            .try_iter()
            .is_ok_and(|mut items| items.any(|item| item.is_ok_and(|item| within(&item))))
}
