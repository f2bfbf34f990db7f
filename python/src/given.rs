//! Checks texts and paths from Python.

use crate::errors;
use pyo3::prelude::*;
use pyo3::types::PyString;
use std::path::PathBuf;

/// A text; `ParameterError` for anything else, and for an invalid string (a lone surrogate).
pub(crate) fn text(name: &str, given: &Bound<'_, PyAny>) -> PyResult<String> {
    let py = given.py();
    let Ok(text) = given.cast::<PyString>() else {
        let found = given.get_type().name()?;
        return Err(errors::parameter(
            py,
            name,
            &format!("expected a string as `{name}`, found `{found}`"),
        ));
    };
    text.to_cow().map(std::borrow::Cow::into_owned).map_err(|_| {
        let message = format!("`{name}` is not Unicode text: it has a lone surrogate");
        errors::parameter(py, name, &message)
    })
}

/// A path; `ParameterError` for anything else: another type, a lone surrogate, a NUL.
pub(crate) fn path(name: &str, given: &Bound<'_, PyAny>) -> PyResult<PathBuf> {
    let py = given.py();
    let path = given.extract::<PathBuf>().map_err(|_| {
        let found =
            given.repr().map_or_else(|_| "something else".to_owned(), |repr| repr.to_string());
        errors::parameter(py, name, &format!("expected a path as `{name}`, found `{found}`"))
    })?;
    if path.as_os_str().as_encoded_bytes().contains(&0) {
        return Err(errors::parameter(
            py,
            name,
            &format!("expected a path as `{name}`, found one with a NUL"),
        ));
    }
    Ok(path)
}
