//! Everything that must pass, fastest failures first.

use crate::shell::{command_of_tests, is_there, root, run};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Format, house rules, lints, dependencies, the studio, tests, docs, the editors, the wheel and
/// its tests, the site.
pub(crate) fn ci() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"])?;
    crate::tidy::tidy()?;
    cargo(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"])?;
    if has_deny() {
        deny()?;
    } else {
        println!(
            "deny: left out, cargo-deny is not installed: `cargo install cargo-deny --locked` brings it"
        );
    }
    if crate::grammar::is_there() {
        crate::grammar::grammar()?;
    } else {
        println!("grammar: left out, tree-sitter is not installed: see `cargo xtask grammar`");
    }
    if crate::workflows::is_there() {
        crate::workflows::workflows()?;
    } else {
        println!("workflows: left out, actionlint is not installed: see `cargo xtask workflows`");
    }
    crate::studio::check()?;
    rust_tests()?;
    let command = command_of_tests();
    run(Command::new("cargo")
        .args(["doc", "--workspace", "--no-deps", "--quiet"])
        .env("RUSTDOCFLAGS", "-D warnings"))?;
    crate::editors::drive_if_there(&command)?;
    crate::vscode::vscode_if_there(&command)?;
    let wheel = python()?;
    crate::docs::build(&wheel)?;
    // Last, because a policy of the wheel plays there too.
    crate::studio::drive_if_there(&command)
}

/// Checks the dependencies of both workspaces by `deny.toml`.
///
/// Advisories are left out, with a word, where their database can't be fetched.
pub(crate) fn deny() -> Result<(), String> {
    if !has_deny() {
        return Err(
            "cargo-deny is not installed: `cargo install cargo-deny --locked` brings it".to_owned()
        );
    }
    for manifest in ["Cargo.toml", "fuzz/Cargo.toml"] {
        cargo(&["deny", "--manifest-path", manifest, "check", "bans", "licenses", "sources"])?;
        let mut advisories = Command::new("cargo");
        advisories
            .args(["deny", "--manifest-path", manifest, "check", "advisories"])
            .current_dir(root());
        let output =
            advisories.output().map_err(|why| format!("cargo-deny can't be run: {why}"))?;
        let said = String::from_utf8_lossy(&output.stderr);
        if said.contains("failed to fetch advisory database") {
            println!("deny: advisories of {manifest} left out, their database can't be fetched");
        } else if !output.status.success() {
            return Err(format!("advisories of {manifest}:\n{said}"));
        }
    }
    Ok(())
}

fn has_deny() -> bool {
    is_there(Command::new("cargo").arg("deny"))
}

/// The Rust tests, by nextest where it is installed.
pub(crate) fn rust_tests() -> Result<(), String> {
    if is_there(Command::new("cargo").arg("nextest")) {
        cargo(&["nextest", "run", "--workspace", "--no-fail-fast"])?;
        cargo(&["test", "--workspace", "--doc", "--quiet"])
    } else {
        cargo(&["test", "--workspace", "--no-fail-fast"])
    }
}

/// Builds the wheel once, tests it in a separate environment, and returns it.
pub(crate) fn python() -> Result<PathBuf, String> {
    let python = venv("venv", "python/requirements-dev.txt")?;
    let wheel = wheel(&python)?;
    install_wheel(&python, &wheel)?;
    let run_in = |folder: &str, args: &[&str]| {
        run(Command::new(&python)
            .arg("-m")
            .args(args)
            .current_dir(root().join("python").join(folder)))
    };
    run_in("", &["ruff", "check"])?;
    run_in("", &["ruff", "format", "--check"])?;
    for folder in ["../baselines", "../benches", "../site"] {
        run_in(folder, &["ruff", "check", "--config", "../python/pyproject.toml"])?;
    }
    for folder in ["../lab/pictures", "../lab/record", "../lab/transfer"] {
        run_in(folder, &["ruff", "check", "--config", "../../python/pyproject.toml"])?;
    }
    run_in("tests", &["mypy", "--strict", "--config-file", "../pyproject.toml", "-p", "setpiece"])?;
    run_in("tests", &["mypy.stubtest", "setpiece._native"])?;
    pytest(&python)?;
    Ok(wheel)
}

/// Builds the wheel and runs the Python tests with the heavy packages, so that all of `tests/full`
/// runs but `PufferLib`'s part: its distribution downloads what it builds with (`docs/tools.md`).
pub(crate) fn python_full() -> Result<(), String> {
    // The heavy packages need another version of Gymnasium than the environment that builds the
    // wheel.
    let wheel = wheel(&venv("venv", "python/requirements-dev.txt")?)?;
    let python = venv("venv-full", "python/requirements-full.txt")?;
    install_wheel(&python, &wheel)?;
    pytest(&python)
}

/// The Python that creates environments.
pub(crate) fn system_python() -> &'static str {
    if cfg!(windows) { "python" } else { "python3" }
}

/// Creates an environment in `target/` from a requirements file; returns its Python.
pub(crate) fn venv(name: &str, requirements: &str) -> Result<PathBuf, String> {
    let venv = root().join("target").join(name);
    let python = venv.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if !python.exists() {
        run(Command::new(system_python()).args(["-m", "venv"]).arg(&venv))?;
    }
    pip(&python, &["--requirement", requirements])?;
    Ok(python)
}

/// Installs packages into an environment.
pub(crate) fn pip(python: &Path, args: &[&str]) -> Result<(), String> {
    run(Command::new(python)
        .args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"])
        .args(args))
}

/// Builds the wheel with the maturin of an environment.
pub(crate) fn wheel(python: &Path) -> Result<PathBuf, String> {
    let wheels = root().join("target/wheels");
    if wheels.exists() {
        std::fs::remove_dir_all(&wheels).map_err(|why| why.to_string())?;
    }
    run(Command::new(python)
        .args(["-m", "maturin", "build", "--release", "--out"])
        .arg(&wheels)
        .arg("--manifest-path")
        .arg(root().join("python/Cargo.toml"))
        .env("VIRTUAL_ENV", root().join("target/venv")))?;
    std::fs::read_dir(&wheels)
        .map_err(|why| why.to_string())?
        .flatten()
        .map(|entry| entry.path())
        .find(|path| path.extension().is_some_and(|ending| ending == "whl"))
        .ok_or_else(|| "maturin left no wheel".to_owned())
}

/// Installs the wheel, replacing any other build of it.
pub(crate) fn install_wheel(python: &Path, wheel: &Path) -> Result<(), String> {
    pip(python, &["--force-reinstall", "--no-deps", &wheel.to_string_lossy()])
}

/// Runs the tests from their folder, so that the installed wheel is tested and not the source tree.
fn pytest(python: &Path) -> Result<(), String> {
    let args = ["-m", "pytest", "--quiet", "-c", "../pyproject.toml", "--rootdir", ".", "."];
    run(Command::new(python).args(args).current_dir(root().join("python/tests")))
}

fn cargo(args: &[&str]) -> Result<(), String> {
    run(Command::new("cargo").args(args))
}

/// Builds the lab with every optimisation and runs it.
pub(crate) fn lab(command: &str, args: &[String]) -> Result<(), String> {
    run(Command::new("cargo")
        .args(["run", "--release", "--package", "setpiece-lab", "--", command])
        .args(args))
}
