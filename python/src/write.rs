//! Writing files, completely or not at all.

use crate::errors;
use pyo3::prelude::*;
use setpiece::files;
use std::path::PathBuf;

/// Writes a file completely or not at all, replacing an existing one.
#[pyfunction]
pub(crate) fn write(py: Python<'_>, path: PathBuf, content: &[u8]) -> PyResult<()> {
    py.detach(|| files::write(&path, content)).map_err(|error| errors::from_facade(py, &error))
}

/// Writes a file completely or not at all, if its name is free. Returns whether it did.
#[pyfunction]
pub(crate) fn write_new(py: Python<'_>, path: PathBuf, content: &[u8]) -> PyResult<bool> {
    py.detach(|| files::write_new(&path, content)).map_err(|error| errors::from_facade(py, &error))
}
