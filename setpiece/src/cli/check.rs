//! `setpiece check`: every problem of some files.

use super::{FAULT, FINE, MessageFormat, out::Out};
use crate::dsl::problem::Severity;
use crate::dsl::report::{Format, render};
use crate::{Error, load_file};
use std::path::{Path, PathBuf};

/// Compiles each file and prints what was found.
pub(crate) fn check(files: &[PathBuf], format: MessageFormat, out: &Out) -> u8 {
    let mut failed = false;
    let mut array = Vec::new();
    for file in files {
        let (problems, sources) = match load_file(file) {
            Ok(loaded) => (crate::probe::probe(&loaded), loaded.sources),
            Err(Error::Compile(failure)) => (failure.problems, failure.sources),
            Err(error) => {
                failed = true;
                match format {
                    MessageFormat::Human => out.error(&error),
                    MessageFormat::Json => array.push(bare(&error, file)),
                }
                continue;
            }
        };
        let errors = problems.iter().filter(|problem| problem.severity() == Severity::Error).count();
        failed |= errors > 0;
        match format {
            MessageFormat::Human if problems.is_empty() => out.line(&format!("{}: no problems", file.display())),
            MessageFormat::Human => {
                out.problems(&problems, &sources);
                let warnings = problems.len() - errors;
                out.line(&format!("{}: {} and {}", file.display(), count(errors, "error"), count(warnings, "warning")));
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
        out.line(&serde_json::Value::Array(array).to_string());
    }
    if failed { FAULT } else { FINE }
}

/// A fault that has no place in a text, in the shape of the others.
fn bare(error: &Error, file: &Path) -> serde_json::Value {
    serde_json::json!({
        "code": error.code().to_string(), "severity": "error", "message": error.to_string(), "help": error.help(),
        "labels": [], "file": file.display().to_string(),
    })
}

fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}
