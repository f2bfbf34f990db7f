//! The pictures of `docs/examples.md`: `lab/pictures/pictures.py` draws them with the wheel.

use crate::ci::{install_wheel, venv, wheel};
use crate::shell::run;
use std::process::Command;

/// Builds the wheel and draws every picture into `docs/examples`.
pub(crate) fn pictures() -> Result<(), String> {
    let python = venv("venv", "python/requirements-dev.txt")?;
    install_wheel(&python, &wheel(&python)?)?;
    run(Command::new(&python).arg("lab/pictures/pictures.py"))
}
