//! Scenarios that follow their files.

use crate::errors;
use crate::scenario::Scenario;
use pyo3::prelude::*;
use setpiece::Live as Facade;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// A scenario and a watcher on its file, imports and scripts.
#[pyclass(frozen, module = "setpiece._native")]
pub(crate) struct Live {
    /// Python may call from several threads.
    inner: Mutex<Facade>,
}

#[pymethods]
impl Live {
    #[new]
    #[pyo3(signature = (path, *, allow_outside = false))]
    fn new(py: Python<'_>, path: PathBuf, allow_outside: bool) -> PyResult<Live> {
        let opened = py.detach(|| Facade::open(&path, allow_outside));
        let inner = opened.map_err(|error| errors::from_facade(py, &error))?;
        if !inner.is_watching() {
            let message = format!("`{}` is no file: there is nothing to watch", path.display());
            return Err(errors::parameter(py, "watch", &message));
        }
        Ok(Live { inner: Mutex::new(inner) })
    }

    /// The last good scenario.
    #[getter]
    fn scenario(&self, py: Python<'_>) -> PyResult<Scenario> {
        let loaded = self.inner.lock().unwrap_or_else(PoisonError::into_inner).loaded().clone();
        Scenario::from_loaded(py, loaded)
    }

    /// A file that has been missing for a while: its last good state goes on.
    #[getter]
    fn missing(&self) -> Option<PathBuf> {
        let live = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        live.missing().map(Path::to_owned)
    }

    /// The new scenario if a file has changed since the last call, else None; waits for at most
    /// `timeout` seconds.
    #[pyo3(signature = (timeout = 0.0))]
    fn poll(&self, py: Python<'_>, timeout: f64) -> PyResult<Option<Scenario>> {
        let timeout = Duration::try_from_secs_f64(timeout).map_err(|_| {
            errors::parameter(py, "timeout", &format!("`{timeout}` is no number of seconds"))
        })?;
        let polled = py.detach(|| {
            let mut live = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
            live.poll(timeout).map(Result::<&setpiece::Loaded, _>::cloned)
        });
        match polled {
            None => Ok(None),
            Some(Ok(loaded)) => Scenario::from_loaded(py, loaded).map(Some),
            Some(Err(error)) => Err(errors::from_facade(py, &error)),
        }
    }
}
