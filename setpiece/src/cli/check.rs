//! `setpiece check`: reports every problem of some files.

use super::common::{FAULT, FINE, MessageFormat};
use super::out::{Out, StyledText};
use crate::Error;
use crate::dsl::problem::Severity;
use crate::dsl::report::{Format, diagnostics, render};
use crate::load::Checked;
use crate::watch::Watcher;
use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

/// How often the watcher checks.
const TICK: Duration = Duration::from_millis(200);

/// Checks files again whenever one of them, or one of their imports, has changed.
pub(crate) fn watch(files: &[OsString], format: MessageFormat, out: &Out) -> Result<u8, Error> {
    let mut inputs = Vec::new();
    check(files, format, out, &mut inputs);
    let mut watcher = Watcher::new(&inputs);
    loop {
        if format == MessageFormat::Human {
            out.line(StyledText::default().dim("waiting for a change; Ctrl-C ends"));
        }
        while !watcher.changed(TICK) {}
        inputs.clear();
        check(files, format, out, &mut inputs);
        watcher.watch(&inputs);
    }
}

/// Compiles each file and prints its problems; adds the files that were read to `inputs`.
pub(crate) fn check(
    files: &[OsString],
    format: MessageFormat,
    out: &Out,
    inputs: &mut Vec<PathBuf>,
) -> u8 {
    let mut failed = false;
    let mut array = Vec::new();
    for file in files {
        let name = file.to_string_lossy();
        let Checked { problems, sources, inputs: read } =
            match crate::check_with(file, &out.loading()) {
                Ok(found) => found,
                Err(error) => {
                    failed = true;
                    match format {
                        MessageFormat::Human => out.error(&error),
                        MessageFormat::Short => {
                            let (code, message) = (error.code().to_string(), error.to_string());
                            out.line(short(&format!("{name}:1:1"), "error", &code, &message));
                        }
                        MessageFormat::Json => array.push(bare(&error, &name)),
                    }
                    // A missing file may appear later.
                    inputs.push(PathBuf::from(file));
                    continue;
                }
            };
        inputs.extend(read);
        let errors =
            problems.iter().filter(|problem| problem.severity() == Severity::Error).count();
        failed |= errors > 0;
        match format {
            MessageFormat::Human if problems.is_empty() => out.line(format!("{name}: no problems")),
            MessageFormat::Human => {
                out.problems(&problems, &sources);
                let warnings = problems.len() - errors;
                out.line(format!(
                    "{name}: {} and {}",
                    count(errors, "error"),
                    count(warnings, "warning")
                ));
            }
            MessageFormat::Short => {
                for found in diagnostics(&problems, &sources) {
                    // The first label is where the problem is.
                    let place = found.labels.first().map_or_else(
                        || format!("{name}:1:1"),
                        |label| format!("{}:{}:{}", label.file, label.line, label.column),
                    );
                    out.line(short(&place, &found.severity, &found.code, &found.message));
                }
            }
            MessageFormat::Json => {
                let text = render(&problems, &sources, Format::Json);
                if let Ok(serde_json::Value::Array(items)) = serde_json::from_str(&text) {
                    array.extend(items);
                }
            }
        }
    }
    if format == MessageFormat::Json {
        out.line(serde_json::Value::Array(array).to_string());
    }
    if failed { FAULT } else { FINE }
}

/// An error without a place in a text, in the same shape as the others.
fn bare(error: &Error, file: &str) -> serde_json::Value {
    serde_json::json!({
        "code": error.code().to_string(), "severity": "error", "message": error.to_string(), "help": error.help(),
        "labels": [], "file": file,
    })
}

/// A problem in one line, for programs that read lines; a message has no line of its own.
fn short(place: &str, severity: &str, code: &str, message: &str) -> String {
    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
    format!("{place}: {severity}[{code}]: {message}")
}

fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}
