//! Converts errors of the facade to exceptions of `setpiece._errors`.

use crate::diagnostics;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use setpiece::Error;
use setpiece::dsl::problem::{Code, nearest};
use setpiece::engine::batch::EpisodeError;
use setpiece::engine::draw::RosterError;
use setpiece::engine::environment::{EnvironmentError, StepError};
use setpiece::engine::judge::ScriptError;
use setpiece::scenario::{Param, ParamError};

/// An exception of the package's own tree; `fields` become keyword arguments of its class.
pub(crate) fn raise(
    py: Python<'_>,
    class: &str,
    message: &str,
    fields: &Bound<'_, PyDict>,
) -> PyErr {
    let made = py
        .import("setpiece._errors")
        .and_then(|module| module.getattr(class))
        .and_then(|class| class.call((message,), Some(fields)));
    match made {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}

/// An exception without further fields.
pub(crate) fn raise_plain(py: Python<'_>, class: &str, message: &str) -> PyErr {
    raise(py, class, message, &PyDict::new(py))
}

/// An exception with a help line.
pub(crate) fn raise_with_help(py: Python<'_>, class: &str, message: &str, help: &str) -> PyErr {
    let fields = PyDict::new(py);
    match fields.set_item("help", help) {
        Ok(()) => raise(py, class, message, &fields),
        Err(error) => error,
    }
}

/// The exception for an error of the facade.
pub(crate) fn from_facade(py: Python<'_>, error: &Error) -> PyErr {
    facade_fields(py, error).map_or_else(
        |failed| failed,
        |(class, message, fields)| raise(py, class, &message, &fields),
    )
}

type ErrorParts<'py> = (&'static str, String, Bound<'py, PyDict>);

fn facade_fields<'py>(py: Python<'py>, error: &Error) -> PyResult<ErrorParts<'py>> {
    let fields = PyDict::new(py);
    fields.set_item("code", error.code().to_string())?;
    if let Error::Compile(failure) = error {
        fields.set_item(
            "diagnostics",
            diagnostics::to_python(py, &failure.problems, &failure.sources)?,
        )?;
        return Ok((
            "CompileError",
            diagnostics::report(&failure.problems, &failure.sources),
            fields,
        ));
    }
    fields.set_item("help", error.help())?;
    let class = match error {
        Error::Unknown { name, .. } => {
            fields.set_item("name", name)?;
            "UnknownScenarioError"
        }
        Error::File { path, .. } => {
            fields.set_item("path", path.to_string_lossy())?;
            "FileError"
        }
        Error::Param { why, .. } => {
            fields.set_item("name", param_name(why))?;
            "ParameterError"
        }
        Error::Snapshot(_) => "SnapshotError",
        Error::Replay(_) => "ReplayError",
        Error::NoBaseline { .. } | Error::NoBaselines { .. } => {
            fields.set_item("name", "policy")?;
            "ParameterError"
        }
        Error::Environment(why) => {
            if let EnvironmentError::Param(why) = why {
                fields.set_item("name", param_name(why))?;
            }
            if let EnvironmentError::Agents(
                RosterError::TooMany { team, .. } | RosterError::Player { team, .. },
            ) = why
            {
                fields.set_item("name", team.name())?;
            }
            if let EnvironmentError::Agents(RosterError::Player { name, known, .. }) = why
                && let Some(similar) = nearest(name, known.iter().map(String::as_str))
            {
                fields.set_item("help", format!("did you mean `{similar}`?"))?;
            }
            environment_class(why)
        }
        Error::Episode(why) => match &**why {
            EpisodeError::Draw(_) | EpisodeError::Step(StepError::Draw(_)) => "DrawError",
            EpisodeError::Step(StepError::Script(why)) => {
                script_fields(&fields, why)?;
                "ScriptError"
            }
            EpisodeError::Environment(_) | EpisodeError::Step(_) | EpisodeError::Endless(_) => {
                "SetpieceError"
            }
        },
        Error::Cast { .. } => {
            fields.set_item("name", "opponents")?;
            "ParameterError"
        }
        Error::NoPlan { what, .. } => {
            fields.set_item("name", if *what == "suite" { "suite" } else { "levels" })?;
            "ParameterError"
        }
        Error::Level { .. } => "LevelError",
        Error::Threads(_) | Error::NoStep { .. } => "SetpieceError",
        Error::Format { .. } | Error::Policy { .. } | Error::Compile(_) => "FormatError",
    };
    Ok((class, error.to_string(), fields))
}

fn environment_class(why: &EnvironmentError) -> &'static str {
    match why {
        EnvironmentError::Reward { .. } | EnvironmentError::RewardTwice(_) => "RewardError",
        EnvironmentError::Param(_)
        | EnvironmentError::Bindings { .. }
        | EnvironmentError::Agents(_)
        | EnvironmentError::Roster => "ParameterError",
        EnvironmentError::Snapshot(_) => "SnapshotError",
        EnvironmentError::Script(_) => "SetpieceError",
    }
}

fn script_fields(fields: &Bound<'_, PyDict>, why: &ScriptError) -> PyResult<()> {
    fields.set_item("script", &why.script)?;
    fields.set_item("line", why.line)?;
    fields.set_item("column", why.column)?;
    fields.set_item("hook", &why.hook)?;
    fields.set_item("seed", why.seed)?;
    fields.set_item("episode", why.index)?;
    fields.set_item("step", why.step)
}

/// The exception for a parameter that can't be bound.
pub(crate) fn from_param(py: Python<'_>, why: ParamError, params: &[Param]) -> PyErr {
    let similar = match &why {
        ParamError::Unknown { name, .. } => {
            nearest(name, params.iter().map(|param| param.name.as_str()))
        }
        _ => None,
    };
    from_facade(py, &Error::Param { similar: similar.map(str::to_owned), why })
}

/// A `ParameterError` about something that the facade doesn't know.
pub(crate) fn parameter(py: Python<'_>, name: &str, message: &str) -> PyErr {
    let fields = PyDict::new(py);
    match fields
        .set_item("name", name)
        .and_then(|()| fields.set_item("code", Code::BadParameter.to_string()))
    {
        Ok(()) => raise(py, "ParameterError", message, &fields),
        Err(error) => error,
    }
}

/// A `LevelError` for a level that doesn't fit its vector.
pub(crate) fn level(py: Python<'_>, message: &str, help: &str) -> PyErr {
    let fields = PyDict::new(py);
    let made = fields
        .set_item("help", help)
        .and_then(|()| fields.set_item("code", Code::OtherSpaces.to_string()));
    match made {
        Ok(()) => raise(py, "LevelError", message, &fields),
        Err(error) => error,
    }
}

fn param_name(why: &ParamError) -> &str {
    match why {
        ParamError::Unknown { name, .. }
        | ParamError::Type { name, .. }
        | ParamError::Range { name, .. } => name,
    }
}
