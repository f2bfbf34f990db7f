//! Scenarios: loading, compiling, binding, saving.

use crate::params::{Param, bind};
use crate::patience::interruptible;
use crate::{diagnostics, errors, given};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyMappingProxy};
use setpiece::scenario::{self as compiled, Bindings, Team};
use setpiece::{Cast, CastTarget, LoadOptions, Loaded};
use std::sync::Arc;

/// A compiled scenario, as returned by `setpiece.load` and `setpiece.compile`. It is immutable.
#[pyclass(frozen, module = "setpiece")]
pub(crate) struct Scenario {
    /// The defaults of its parameters are their bound values.
    inner: Arc<compiled::Scenario>,
    /// The same with the defaults of its text.
    unbound: Arc<compiled::Scenario>,
    /// The compiler's warnings.
    warnings: Py<PyList>,
}

impl Scenario {
    pub(crate) fn inner(&self) -> &Arc<compiled::Scenario> {
        &self.inner
    }

    /// A scenario without warnings.
    pub(crate) fn of(py: Python<'_>, inner: impl Into<Arc<compiled::Scenario>>) -> Scenario {
        let inner = inner.into();
        Scenario { unbound: inner.clone(), inner, warnings: PyList::empty(py).unbind() }
    }

    pub(crate) fn from_loaded(py: Python<'_>, loaded: Loaded) -> PyResult<Scenario> {
        let warnings = diagnostics::to_python(py, &loaded.warnings, &loaded.sources)?;
        let (inner, unbound) = (loaded.scenario.clone(), loaded.scenario);
        Ok(Scenario { inner, unbound, warnings: warnings.unbind() })
    }

    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        compiled::file::to_json(&self.inner)
            .map_err(|why| errors::raise_plain(py, "FormatError", &why.to_string()))
    }
}

fn digest_of(py: Python<'_>, scenario: &compiled::Scenario) -> PyResult<String> {
    let digest = compiled::file::digest(scenario)
        .map_err(|why| errors::raise_plain(py, "FormatError", &why.to_string()))?;
    Ok(format!("{digest:016x}"))
}

#[pymethods]
impl Scenario {
    /// The name in the file.
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// The first line of the documentation.
    #[getter]
    fn title(&self) -> &str {
        self.inner.title()
    }

    /// The documentation written above it.
    #[getter]
    fn doc(&self) -> &str {
        &self.inner.doc
    }

    /// 16 hexadecimal digits that change with any part of it, including the bound values.
    #[getter]
    fn digest(&self, py: Python<'_>) -> PyResult<String> {
        digest_of(py, &self.inner)
    }

    /// Whether this is its digest, with the bound values or with the defaults of its text.
    fn _has_digest(&self, py: Python<'_>, digest: &str) -> PyResult<bool> {
        Ok(digest == self.digest(py)? || digest == digest_of(py, &self.unbound)?)
    }

    /// The parameters by name, in the file's order; the mapping is immutable.
    #[getter]
    fn params<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyMappingProxy>> {
        let params = PyDict::new(py);
        for param in &self.inner.params {
            params.set_item(&param.name, Param::new(param.clone()).into_pyobject(py)?)?;
        }
        Ok(PyMappingProxy::new(py, params.as_mapping()))
    }

    /// The space of the parameters that have a range or a list of values: a `ParameterSpace`.
    #[getter]
    fn parameter_space<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("setpiece._parameter_space")?.getattr("ParameterSpace")?.call1((slf,))
    }

    /// The names of the rewards it pays, in the file's order.
    #[getter]
    fn rewards(&self) -> Vec<&str> {
        self.inner.rewards.iter().map(|reward| reward.name.as_str()).collect()
    }

    /// The records with their units, in the file's order; an empty unit is that of a plain number.
    #[getter]
    fn records<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyMappingProxy>> {
        let records = PyDict::new(py);
        for record in &self.inner.records {
            records.set_item(&record.name, record.unit.to_string())?;
        }
        Ok(PyMappingProxy::new(py, records.as_mapping()))
    }

    /// The compiler's warnings: a list of `Diagnostic`.
    #[getter]
    fn warnings<'py>(&self, py: Python<'py>) -> Bound<'py, PyList> {
        // A copy, because the scenario is immutable.
        self.warnings.bind(py).get_slice(0, usize::MAX)
    }

    /// Returns the scenario with parameters bound: SI units, or strings as the language writes them
    /// (`"12m"`, `"60%"`).
    ///
    /// Raises `ParameterError` for a name, a type or a value that the scenario doesn't allow.
    #[pyo3(signature = (**params))]
    fn with_params(
        &self,
        py: Python<'_>,
        params: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Scenario> {
        let mut inner = compiled::Scenario::clone(&self.inner);
        if let Some(params) = params {
            let Bindings(values) = bind(py, &inner.params, params)?;
            for (param, value) in inner.params.iter_mut().zip(values) {
                param.default = value;
            }
        }
        let (unbound, warnings) = (self.unbound.clone(), self.warnings.clone_ref(py));
        Ok(Scenario { inner: Arc::new(inner), unbound, warnings })
    }

    /// Writes the compiled scenario to a file (`.pitchc`): self-contained, parameters can still be
    /// bound.
    ///
    /// Raises `FileError` if it can't be written, `ParameterError` if `path` isn't a path.
    fn save(&self, path: &Bound<'_, PyAny>) -> PyResult<()> {
        let py = path.py();
        let path = given::path("path", path)?;
        let text = self.to_json(py)?;
        setpiece::files::refuse_overwriting(&path, &[])
            .map_err(|error| errors::from_facade(py, &error))?;
        setpiece::files::write(&path, &text).map_err(|error| errors::from_facade(py, &error))
    }

    fn __repr__(&self) -> String {
        let bound: Vec<String> = self
            .inner
            .params
            .iter()
            .map(|param| format!("{}={}", param.name, param.default))
            .collect();
        format!(
            "Scenario({}{}{})",
            self.inner.name,
            if bound.is_empty() { "" } else { ": " },
            bound.join(", ")
        )
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((py.import("setpiece._native")?.getattr("restore")?, (self.to_json(py)?,)))
    }
}

/// Loads a scenario by its name in the library, or from a `.pitch` or compiled `.pitchc` file.
///
/// `wanted` is the scenario's name among several of a file, whose last it is otherwise. With
/// `allow_outside` imports and scripts may lie outside the file's folder. Raises
/// `UnknownScenarioError`, `FileError`, `CompileError` or `FormatError`.
#[pyfunction]
#[pyo3(signature = (name_or_path, wanted = None, *, allow_outside = false))]
pub(crate) fn load(
    py: Python<'_>,
    name_or_path: &Bound<'_, PyAny>,
    wanted: Option<String>,
    allow_outside: bool,
) -> PyResult<Scenario> {
    let name_or_path = given::path("scenario", name_or_path)?;
    let loaded = interruptible(py, move || {
        let scenario = wanted.as_deref();
        let options = LoadOptions { scenario, allow_outside, ..LoadOptions::default() };
        setpiece::load_with(&name_or_path, &options)
    })?;
    Scenario::from_loaded(py, loaded.map_err(|error| errors::from_facade(py, &error))?)
}

/// Compiles a text in the language; `name` is its name in reports, `scenario` the scenario that is
/// wanted of several, without it the last.
///
/// With `allow_outside` imports and scripts may lie outside the folder of `name`, which is the
/// working directory for a name without one. Raises `CompileError`, whose `diagnostics` lists every
/// problem, `FileError` above 1 MiB, or `ParameterError` for anything but a text.
#[pyfunction]
#[pyo3(
    signature = (text, name = None, *, scenario = None, allow_outside = false),
    text_signature = "(text, name='<text>', *, scenario=None, allow_outside=False)"
)]
pub(crate) fn compile(
    text: &Bound<'_, PyAny>,
    name: Option<&Bound<'_, PyAny>>,
    scenario: Option<&Bound<'_, PyAny>>,
    allow_outside: bool,
) -> PyResult<Scenario> {
    let py = text.py();
    let (text, name) = (given::text("text", text)?, text_name(name)?);
    let wanted = scenario.map(|wanted| given::text("scenario", wanted)).transpose()?;
    let loaded = interruptible(py, move || {
        let scenario = wanted.as_deref();
        let options = LoadOptions { scenario, allow_outside, ..LoadOptions::default() };
        setpiece::compile_text_with(&text, &name, &options)
    })?;
    Scenario::from_loaded(py, loaded.map_err(|error| errors::from_facade(py, &error))?)
}

/// The name of a text in reports.
fn text_name(name: Option<&Bound<'_, PyAny>>) -> PyResult<String> {
    name.map_or_else(|| Ok("<text>".to_owned()), |name| given::text("name", name))
}

/// What plays some players, as the package passes it: its `CastingArgument`.
#[derive(FromPyObject)]
pub(crate) struct CastingArgument<'py> {
    /// 0 left, 1 right.
    team: usize,
    /// The index of one player; none for the whole team.
    place: Option<usize>,
    /// The text after `ai:`.
    ai: Bound<'py, PyAny>,
}

fn cast_of(casting: Vec<CastingArgument<'_>>) -> PyResult<Vec<Cast>> {
    let cast = |CastingArgument { team, place, ai }: CastingArgument<'_>| {
        let team = if team == 0 { Team::Left } else { Team::Right };
        let target = place.map_or(CastTarget::Team(team), |place| CastTarget::Player(team, place));
        Ok(Cast { target, ai: given::text("opponents", &ai)? })
    };
    casting.into_iter().map(cast).collect()
}

/// Loads a scenario like `load`, with a cast that plays players.
#[pyfunction]
#[pyo3(signature = (name_or_path, wanted, casting, *, allow_outside = false))]
pub(crate) fn load_cast(
    py: Python<'_>,
    name_or_path: &Bound<'_, PyAny>,
    wanted: Option<String>,
    casting: Vec<CastingArgument<'_>>,
    allow_outside: bool,
) -> PyResult<Scenario> {
    let (name_or_path, cast) = (given::path("scenario", name_or_path)?, cast_of(casting)?);
    let loaded = interruptible(py, move || {
        let scenario = wanted.as_deref();
        let options =
            LoadOptions { scenario, cast: &cast, allow_outside, ..LoadOptions::default() };
        setpiece::load_with(&name_or_path, &options)
    })?;
    Scenario::from_loaded(py, loaded.map_err(|error| errors::from_facade(py, &error))?)
}

/// Compiles a text like `compile`, with a cast that plays players.
#[pyfunction]
#[pyo3(signature = (text, name, wanted, casting, *, allow_outside = false))]
pub(crate) fn compile_cast(
    text: &Bound<'_, PyAny>,
    name: &Bound<'_, PyAny>,
    wanted: Option<String>,
    casting: Vec<CastingArgument<'_>>,
    allow_outside: bool,
) -> PyResult<Scenario> {
    let py = text.py();
    let (text, name, cast) =
        (given::text("text", text)?, given::text("name", name)?, cast_of(casting)?);
    let loaded = interruptible(py, move || {
        let scenario = wanted.as_deref();
        let options =
            LoadOptions { scenario, cast: &cast, allow_outside, ..LoadOptions::default() };
        setpiece::compile_text_with(&text, &name, &options)
    })?;
    Scenario::from_loaded(py, loaded.map_err(|error| errors::from_facade(py, &error))?)
}

/// A scenario of the library.
#[pyclass(frozen, get_all, module = "setpiece._native")]
pub(crate) struct LibraryEntry {
    /// Its name.
    name: String,
    /// The first line of its documentation.
    title: String,
    /// Players of the left and the right team.
    players: (usize, usize),
}

/// Every scenario of the library, by name.
#[pyfunction]
pub(crate) fn library(py: Python<'_>) -> Vec<LibraryEntry> {
    let entry = |entry: setpiece::Entry| {
        let setpiece::Entry { name, title, players, .. } = entry;
        LibraryEntry { name, title, players: players.into() }
    };
    py.detach(setpiece::list).into_iter().map(entry).collect()
}

/// The scenario of a compiled file's text, for unpickling.
#[pyfunction]
pub(crate) fn restore(py: Python<'_>, text: &str) -> PyResult<Scenario> {
    let inner = compiled::file::from_json(text)
        .map_err(|why| errors::raise_plain(py, "FormatError", &why.to_string()))?;
    Ok(Scenario::of(py, inner))
}
