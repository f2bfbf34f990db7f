//! `setpiece check`: every problem of some files.

use super::{FAULT, FINE, MessageFormat, out::Out};
use crate::Error;
use crate::dsl::problem::Severity;
use crate::dsl::report::{Format, render};

/// Compiles each file and prints what was found.
pub(crate) fn check(files: &[String], format: MessageFormat, out: &Out) -> u8 {
    let mut failed = false;
    let mut array = Vec::new();
    for file in files {
        let (problems, sources) = match crate::check(file) {
            Ok(found) => found,
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
            MessageFormat::Human if problems.is_empty() => out.line(&format!("{file}: no problems")),
            MessageFormat::Human => {
                out.problems(&problems, &sources);
                let warnings = problems.len() - errors;
                out.line(&format!("{}: {} and {}", file, count(errors, "error"), count(warnings, "warning")));
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
fn bare(error: &Error, file: &str) -> serde_json::Value {
    serde_json::json!({
        "code": error.code().to_string(), "severity": "error", "message": error.to_string(), "help": error.help(),
        "labels": [], "file": file,
    })
}

fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}
