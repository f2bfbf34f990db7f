//! Agents in both games: creates a separate environment and runs `lab/transfer/transfer.py` in it.

use crate::ci::{install_wheel, pip, system_python, venv, wheel};
use crate::shell::{root, run};
use std::process::Command;

/// Checks the options, creates the environment and trains, plays and writes `docs/transfer.md`.
///
/// The environment is in `target/venv-transfer`. With `--recorded` the real game isn't installed.
pub(crate) fn transfer(args: &[String]) -> Result<(), String> {
    // A mistyped option is reported before anything is built.
    let options = Command::new(system_python())
        .arg(root().join("lab/transfer/options.py"))
        .args(args)
        .status()
        .map_err(|why| format!("`{}` can't be run: {why}", system_python()))?;
    if !options.success() {
        return Err("the options are wrong".to_owned());
    }
    if args.iter().any(|arg| arg == "--help" || arg == "-h") {
        return Ok(());
    }
    let wheel = wheel(&venv("venv", "python/requirements-dev.txt")?)?;
    let python = venv("venv-transfer", "lab/transfer/requirements.txt")?;
    if !args.iter().any(|arg| arg == "--recorded") {
        pip(&python, &["--requirement", "lab/transfer/requirements-there.txt"]).map_err(|why| {
            format!("{why}; EnvPool brings the real game, `--recorded` works without it")
        })?;
    }
    install_wheel(&python, &wheel)?;
    // The networks are small: more threads only wait for each other.
    run(Command::new(&python)
        .arg("lab/transfer/transfer.py")
        .args(args)
        .env("OMP_NUM_THREADS", "1"))
}
