//! Parameters: between Python's values and a scenario's bindings.

use crate::errors;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString, PyTuple};
use setpiece::scenario::{self as compiled, Bindings, ParamError, Type};

/// A parameter of a scenario; lengths, times and speeds are metres, seconds and m/s, angles
/// radians.
#[pyclass(frozen, module = "setpiece")]
pub(crate) struct Param {
    inner: compiled::Param,
}

impl Param {
    pub(crate) fn new(inner: compiled::Param) -> Param {
        Param { inner }
    }
}

#[pymethods]
impl Param {
    /// The name.
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// The documentation above it.
    #[getter]
    fn doc(&self) -> &str {
        &self.inner.doc
    }

    /// The type in the language: `number`, `int`, `bool`, `percent`, `length`, `duration`, `speed`,
    /// `team`, `string`, …
    #[getter]
    fn r#type(&self) -> &str {
        self.inner.ty.name()
    }

    /// The value unless an episode binds another.
    #[getter]
    fn default<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.inner, self.inner.default)
    }

    /// Least and greatest value, both included, or None.
    #[getter]
    fn range(&self) -> Option<(f64, f64)> {
        self.inner.range
    }

    /// The allowed values, if it is a list of words or numbers; else empty.
    #[getter]
    fn choices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        if self.inner.choices.is_empty() {
            let values: PyResult<Vec<_>> =
                self.inner.values.iter().map(|&v| to_python(py, &self.inner, v)).collect();
            PyTuple::new(py, values?)
        } else {
            PyTuple::new(py, &self.inner.choices)
        }
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let default = self.default(py)?.repr()?;
        let allowed = self.inner.allowed();
        Ok(format!("Param({}: {} = {default}, {allowed})", self.inner.name, self.inner.ty))
    }
}

/// A parameter's value as Python shows it.
pub(crate) fn to_python<'py>(
    py: Python<'py>,
    param: &compiled::Param,
    value: f64,
) -> PyResult<Bound<'py, PyAny>> {
    Ok(match param.ty {
        Type::Bool => PyBool::new(py, value != 0.0).to_owned().into_any(),
        Type::Int => (value as i64).into_pyobject(py)?.into_any(),
        Type::Team => match value as i64 {
            0 => "left".into_pyobject(py)?.into_any(),
            1 => "right".into_pyobject(py)?.into_any(),
            _ => "none".into_pyobject(py)?.into_any(),
        },
        Type::String => {
            let word = param.choices.get(value as usize).map(String::as_str).unwrap_or_default();
            word.into_pyobject(py)?.into_any()
        }
        _ => value.into_pyobject(py)?.into_any(),
    })
}

/// A scenario's defaults with some parameters bound: numbers in SI units, or strings as the
/// language writes them.
pub(crate) fn bind(
    py: Python<'_>,
    params: &[compiled::Param],
    given: &Bound<'_, PyDict>,
) -> PyResult<Bindings> {
    let mut bindings = Bindings::defaults(params);
    for (name, value) in given {
        let Ok(name) = name.extract::<String>() else {
            let message = format!("expected a parameter's name, found `{}`", name.repr()?);
            return Err(errors::parameter(py, "params", &message));
        };
        bind_one(params, &mut bindings, &name, &value).map_err(|fault| match fault {
            ParamFault::Param(why) => errors::from_param(py, why, params),
            ParamFault::Python(error) => error,
        })?;
    }
    Ok(bindings)
}

enum ParamFault {
    Param(ParamError),
    Python(PyErr),
}

impl From<PyErr> for ParamFault {
    fn from(error: PyErr) -> ParamFault {
        ParamFault::Python(error)
    }
}

impl From<ParamError> for ParamFault {
    fn from(why: ParamError) -> ParamFault {
        ParamFault::Param(why)
    }
}

fn bind_one(
    params: &[compiled::Param],
    bindings: &mut Bindings,
    name: &str,
    value: &Bound<'_, PyAny>,
) -> Result<(), ParamFault> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(bindings.set_text(params, name, &text.to_string_lossy())?);
    }
    let ty = params.iter().find(|param| param.name == name).map(|param| param.ty);
    let wrong = || -> Result<(), ParamFault> {
        let found = value.repr()?.to_string();
        // An unknown name is reported as such, whatever the value.
        Err(match ty {
            Some(ty) => ParamError::Type { name: name.to_owned(), ty, found }.into(),
            None => ParamError::Unknown {
                name: name.to_owned(),
                known: params.iter().map(|p| p.name.clone()).collect(),
            }
            .into(),
        })
    };
    let is_bool = value.is_instance_of::<PyBool>();
    if ty.is_some_and(|ty| is_bool != (ty == Type::Bool))
        || ty == Some(Type::String)
        || ty == Some(Type::Team)
    {
        return wrong();
    }
    if value.is_instance_of::<PyFloat>() || value.is_instance_of::<PyInt>() || has_number(value) {
        return match value.extract::<f64>() {
            Ok(number) => Ok(bindings.set(params, name, number)?),
            Err(_) => wrong(),
        };
    }
    wrong()
}

/// Whether a value is a number of another library, such as numpy's scalars.
fn has_number(value: &Bound<'_, PyAny>) -> bool {
    value.hasattr("__float__").unwrap_or_default() && !value.hasattr("__len__").unwrap_or_default()
}
