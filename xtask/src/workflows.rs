//! The workflows of `.github`, read by actionlint.

use crate::shell::run;
use std::process::Command;

/// Whether actionlint is there.
pub(crate) fn is_there() -> bool {
    Command::new("actionlint").arg("-version").output().is_ok_and(|out| out.status.success())
}

/// Checks every workflow, and its scripts where shellcheck is installed too.
pub(crate) fn workflows() -> Result<(), String> {
    if !is_there() {
        let bring = "`go install github.com/rhysd/actionlint/cmd/actionlint@latest` brings it";
        return Err(format!("actionlint is not installed: {bring}"));
    }
    run(Command::new("actionlint").arg("-no-color"))
}
