//! Levels: which episode of which scenario.

use crate::{errors, given};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use setpiece::Level;
use setpiece::engine::environment::Environment as Engine;
use setpiece::scenario::Bindings;

/// The level of an engine's episode as text. It names every parameter: a scenario in Python may
/// have other defaults than its file.
pub(crate) fn of_episode(engine: &Engine, bindings: &Bindings) -> String {
    let values = engine.scenario().params.iter().zip(&bindings.0);
    let level = Level {
        scenario: engine.scenario().name.clone(),
        digest: None,
        params: values.map(|(param, value)| (param.name.clone(), param.write(*value))).collect(),
        seed: engine.seed(),
        episode: engine.index(),
    };
    level.to_string()
}

/// The text of a level's JSON.
#[pyfunction]
pub(crate) fn level_text(text: &Bound<'_, PyAny>) -> PyResult<String> {
    Ok(read(text)?.to_string())
}

fn read(text: &Bound<'_, PyAny>) -> PyResult<Level> {
    let (py, text) = (text.py(), given::text("level", text)?);
    Level::read(&text)
        .map_err(|why| errors::parameter(py, "level", &format!("`{text}` is no level: {why}")))
}

/// A level's text or JSON as a dict with the keys of the JSON.
#[pyfunction]
pub(crate) fn level<'py>(
    py: Python<'py>,
    text: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyDict>> {
    let level = read(text)?;
    let dict = PyDict::new(py);
    dict.set_item("scenario", level.scenario)?;
    dict.set_item("digest", level.digest)?;
    dict.set_item("params", level.params)?;
    dict.set_item("seed", level.seed)?;
    dict.set_item("episode", level.episode)?;
    Ok(dict)
}
