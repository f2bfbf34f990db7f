//! Runs commands of the system.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Prints and runs a command, in the repository's root unless it names another folder.
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
    let xtask = Path::new(env!("CARGO_MANIFEST_DIR"));
    xtask.parent().unwrap_or(xtask).to_owned()
}

/// The `setpiece` command for tests: the one that `SETPIECE` names, else a new build.
pub(crate) fn built_command() -> Result<PathBuf, String> {
    if let Some(named) = std::env::var_os("SETPIECE") {
        let named = PathBuf::from(named);
        return named.canonicalize().map_err(|why| format!("{}: {why}", named.display()));
    }
    run(Command::new("cargo").args(["build", "--workspace", "--bin", "setpiece"]))?;
    Ok(command_of_tests())
}

/// The command where the Rust tests leave it. A build for itself would compile its dependencies
/// again, because the tests want other features of them.
pub(crate) fn command_of_tests() -> PathBuf {
    root().join("target/debug").join(if cfg!(windows) { "setpiece.exe" } else { "setpiece" })
}

/// Whether a program is there: whether it says its version.
pub(crate) fn is_there(program: &mut Command) -> bool {
    program.arg("--version").output().is_ok_and(|output| output.status.success())
}

/// Replaces a folder by a copy of another one.
pub(crate) fn copy_folder(from: &Path, to: &Path) -> Result<(), String> {
    let fault = |path: &Path, why: std::io::Error| format!("{}: {why}", path.display());
    if to.exists() {
        std::fs::remove_dir_all(to).map_err(|why| fault(to, why))?;
    }
    std::fs::create_dir_all(to).map_err(|why| fault(to, why))?;
    for entry in std::fs::read_dir(from).map_err(|why| fault(from, why))? {
        let path = entry.map_err(|why| fault(from, why))?.path();
        let Some(name) = path.file_name() else { continue };
        if path.is_dir() {
            copy_folder(&path, &to.join(name))?;
        } else {
            std::fs::copy(&path, to.join(name)).map_err(|why| fault(&path, why))?;
        }
    }
    Ok(())
}

/// Reads a text.
pub(crate) fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|why| format!("{}: {why}", path.display()))
}

/// Writes a text, and the folders that it stands in.
pub(crate) fn write(path: &Path, text: &str) -> Result<(), String> {
    let parent = path.parent().unwrap_or(path);
    std::fs::create_dir_all(parent)
        .and_then(|()| std::fs::write(path, text))
        .map_err(|why| format!("{}: {why}", path.display()))
}
