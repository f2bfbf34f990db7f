//! npm, for the folders that it builds and tests.

use crate::shell::{self, run};
use std::path::Path;
use std::process::Command;

/// Whether npm is there.
pub(crate) fn is_there() -> bool {
    shell::is_there(&mut npm())
}

/// Installs the packages that a folder's lock file names.
pub(crate) fn install(folder: &Path) -> Result<(), String> {
    let quiet = ["--no-audit", "--no-fund", "--loglevel=error"];
    run(npm().arg("ci").args(quiet).current_dir(folder))
}

/// A call of npm.
pub(crate) fn npm() -> Command {
    Command::new(if cfg!(windows) { "npm.cmd" } else { "npm" })
}
