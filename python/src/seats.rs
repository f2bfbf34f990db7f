//! Agents requested instead of the scenario's.

use crate::errors;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyString};
use setpiece::engine::environment::{AgentsChoice, SideChoice};

/// The arguments of `make` about agents.
pub(crate) struct Seats<'a, 'py> {
    /// None, a number, `"all"` or players' names.
    pub(crate) left: Option<&'a Bound<'py, PyAny>>,
    /// The same for the right side.
    pub(crate) right: Option<&'a Bound<'py, PyAny>>,
    /// None, `"auto"` or `"fixed"`.
    pub(crate) switching: Option<&'a Bound<'py, PyAny>>,
}

/// Reads them; none if the scenario decides all of it.
pub(crate) fn read(py: Python<'_>, seats: &Seats<'_, '_>) -> PyResult<Option<AgentsChoice>> {
    if seats.left.is_none() && seats.right.is_none() && seats.switching.is_none() {
        return Ok(None);
    }
    let sides = [side(py, "left", seats.left)?, side(py, "right", seats.right)?];
    let fixed = match seats.switching.map(|word| (word, word.extract::<&str>())) {
        None => None,
        Some((_, Ok("auto"))) => Some(false),
        Some((_, Ok("fixed"))) => Some(true),
        Some((other, _)) => {
            let message = format!("`switching` is `{}`; it can be `auto` or `fixed`", shown(other));
            return Err(errors::parameter(py, "switching", &message));
        }
    };
    Ok(Some(AgentsChoice { sides, fixed }))
}

/// A value in a message; a string unchanged.
fn shown(given: &Bound<'_, PyAny>) -> String {
    given
        .cast::<PyString>()
        .map_or_else(|_| given.to_string(), |text| text.to_string_lossy().into_owned())
}

fn side(py: Python<'_>, name: &str, given: Option<&Bound<'_, PyAny>>) -> PyResult<SideChoice> {
    let Some(given) = given.filter(|given| !given.is_none()) else {
        return Ok(SideChoice::Scenario);
    };
    if let Ok(word) = given.cast::<PyString>() {
        if word.to_string_lossy() == "all" {
            return Ok(SideChoice::All);
        }
    } else if !given.is_instance_of::<PyBool>() {
        if let Ok(count) = given.extract::<u32>() {
            return Ok(SideChoice::Count(count));
        }
        if let Ok(players) = given.extract::<Vec<String>>() {
            return Ok(SideChoice::Players(players));
        }
    }
    let message = format!(
        "`{name}` is `{given}`; it can be a number of agents, \"all\" or a list of players' names"
    );
    Err(errors::parameter(py, name, &message))
}
