//! The docs site: `site/build.py` gathers the pages, has Zensical build them, and checks what came
//! out.

use crate::ci::{install_wheel, venv, wheel};
use crate::shell::run;
use std::path::Path;
use std::process::Command;

/// Builds the wheel, whose lexer colours the scenarios, and the site.
pub(crate) fn docs() -> Result<(), String> {
    build(&wheel(&venv("venv", "python/requirements-dev.txt")?)?)
}

/// Builds the site with a wheel, in an environment of its own.
pub(crate) fn build(wheel: &Path) -> Result<(), String> {
    let python = venv("venv-docs", "site/requirements.txt")?;
    install_wheel(&python, wheel)?;
    run(Command::new(&python).arg("site/build.py"))
}
