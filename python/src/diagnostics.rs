//! Diagnostics: problems of the compiler as `setpiece.Diagnostic`.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use setpiece::dsl::problem::Problem;
use setpiece::dsl::report::{Diagnostic, DiagnosticLabel, Format, diagnostics, render};
use setpiece::dsl::source::Sources;

/// Columns at which a rendered report wraps.
const WIDTH: usize = 100;

/// The rendered report, without colour: what `str()` of a `CompileError` shows.
pub(crate) fn report(problems: &[Problem], sources: &Sources) -> String {
    render(problems, sources, Format::Human { color: false, width: WIDTH }).trim_end().to_owned()
}

/// A list of `Diagnostic`, by file and place.
pub(crate) fn to_python<'py>(
    py: Python<'py>,
    problems: &[Problem],
    sources: &Sources,
) -> PyResult<Bound<'py, PyList>> {
    let module = py.import("setpiece._errors")?;
    let (class, label_class) = (module.getattr("Diagnostic")?, module.getattr("Label")?);
    let list = PyList::empty(py);
    for diagnostic in diagnostics(problems, sources) {
        list.append(one(&class, &label_class, &diagnostic)?)?;
    }
    Ok(list)
}

fn one<'py>(
    class: &Bound<'py, PyAny>,
    label_class: &Bound<'py, PyAny>,
    diagnostic: &Diagnostic,
) -> PyResult<Bound<'py, PyAny>> {
    let py = class.py();
    let labels: PyResult<Vec<_>> =
        diagnostic.labels.iter().map(|one| label(label_class, one)).collect();
    let fields = PyDict::new(py);
    fields.set_item("code", &diagnostic.code)?;
    fields.set_item("severity", &diagnostic.severity)?;
    fields.set_item("message", &diagnostic.message)?;
    fields.set_item("help", &diagnostic.help)?;
    fields.set_item("labels", PyTuple::new(py, labels?)?)?;
    class.call((), Some(&fields))
}

fn label<'py>(class: &Bound<'py, PyAny>, label: &DiagnosticLabel) -> PyResult<Bound<'py, PyAny>> {
    let fields = PyDict::new(class.py());
    fields.set_item("file", &label.file)?;
    fields.set_item("line", label.line)?;
    fields.set_item("column", label.column)?;
    fields.set_item("end_line", label.end_line)?;
    fields.set_item("end_column", label.end_column)?;
    fields.set_item("text", &label.text)?;
    class.call((), Some(&fields))
}
