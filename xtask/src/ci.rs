//! Everything that must pass, in the order of what fails fastest.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Format, house rules, lints, tests, docs, the wheel and its tests.
pub(crate) fn ci() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"])?;
    crate::tidy::tidy()?;
    cargo(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"])?;
    rust_tests()?;
    run(Command::new("cargo").args(["doc", "--workspace", "--no-deps", "--quiet"]).env("RUSTDOCFLAGS", "-D warnings"))?;
    python()
}

/// The Rust tests, by nextest where it is installed.
pub(crate) fn rust_tests() -> Result<(), String> {
    let nextest =
        Command::new("cargo").args(["nextest", "--version"]).output().is_ok_and(|output| output.status.success());
    if nextest {
        cargo(&["nextest", "run", "--workspace", "--no-fail-fast"])?;
        cargo(&["test", "--workspace", "--doc", "--quiet"])
    } else {
        cargo(&["test", "--workspace", "--no-fail-fast"])
    }
}

/// Builds the wheel once and tests it in an environment of its own.
pub(crate) fn python() -> Result<(), String> {
    let root = root();
    let venv = root.join("target/venv");
    let python = venv.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if !python.exists() {
        let system = if cfg!(windows) { "python" } else { "python3" };
        run(Command::new(system).args(["-m", "venv"]).arg(&venv))?;
    }
    let pip = |args: &[&str]| {
        run(Command::new(&python)
            .args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"])
            .args(args)
            .current_dir(&root))
    };
    pip(&["--requirement", "python/requirements-dev.txt"])?;
    let wheels = root.join("target/wheels");
    if wheels.exists() {
        std::fs::remove_dir_all(&wheels).map_err(|why| why.to_string())?;
    }
    run(Command::new(&python)
        .args(["-m", "maturin", "build", "--release", "--out"])
        .arg(&wheels)
        .arg("--manifest-path")
        .arg(root.join("python/Cargo.toml"))
        .env("VIRTUAL_ENV", &venv))?;
    let wheel = std::fs::read_dir(&wheels)
        .map_err(|why| why.to_string())?
        .flatten()
        .map(|entry| entry.path())
        .find(|path| path.extension().is_some_and(|ending| ending == "whl"))
        .ok_or("maturin left no wheel")?;
    pip(&["--force-reinstall", "--no-deps", &wheel.to_string_lossy()])?;
    // Run from the tests' folder, so that the installed wheel is tested and not the source tree.
    let tests = root.join("python/tests");
    let tool = |args: &[&str]| run(Command::new(&python).args(args).current_dir(&tests));
    for task in [["ruff", "check"].as_slice(), &["ruff", "format", "--check"]] {
        run(Command::new(&python).arg("-m").args(task).current_dir(root.join("python")))?;
    }
    tool(&["-m", "mypy", "--strict", "--config-file", "../pyproject.toml", "-p", "setpiece"])?;
    tool(&["-m", "mypy.stubtest", "setpiece._native"])?;
    tool(&["-m", "pytest", "--quiet", "-c", "../pyproject.toml", "--rootdir", ".", "."])
}

fn cargo(args: &[&str]) -> Result<(), String> {
    run(Command::new("cargo").args(args))
}

/// Builds the lab with every optimisation and runs it.
pub(crate) fn lab(args: &[String]) -> Result<(), String> {
    run(Command::new("cargo").args(["run", "--release", "--package", "setpiece-lab", "--"]).args(args))
}

/// Says and runs a command, in the repository's root unless it names another folder.
pub(crate) fn run(command: &mut Command) -> Result<(), String> {
    let words: Vec<String> = std::iter::once(command.get_program())
        .chain(command.get_args())
        .map(|word| word.to_string_lossy().into_owned())
        .collect();
    println!("$ {}", words.join(" "));
    if command.get_current_dir().is_none() {
        command.current_dir(root());
    }
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{}` ended with {status}", words.join(" "))),
        Err(why) => Err(format!("`{}` can't be run: {why}", words.join(" "))),
    }
}

/// The repository's root.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}
