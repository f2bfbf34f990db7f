//! The studio's page: built by npm from `studio/`, kept in `studio/dist`, embedded in the command.

use crate::npm;
use crate::shell::{built_command, root, run};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The built files.
const FILES: &[&str] = &["index.html", "studio.css", "studio.js"];

/// Builds the page into `studio/dist`.
pub(crate) fn build() -> Result<(), String> {
    build_into("dist")
}

/// Builds the page, and runs its tests in a browser; `shots`: they also take the pictures of the
/// documentation.
pub(crate) fn drive(shots: bool) -> Result<(), String> {
    build()?;
    tests(&built_command()?, shots)
}

/// Runs the page's tests where npm and the browser are; elsewhere says that it doesn't.
pub(crate) fn drive_if_there(command: &Path) -> Result<(), String> {
    if !npm::is_there() || !Path::new(&browser()).exists() {
        println!(
            "studio: left out, its tests need npm and Chromium: `apt-get install chromium`, or set CHROMIUM"
        );
        return Ok(());
    }
    tests(command, false)
}

/// Runs the page's tests; the page's packages are installed.
fn tests(command: &Path, shots: bool) -> Result<(), String> {
    let mut tests = npm::npm();
    tests
        .args(["test", "--silent"])
        .env("SETPIECE", command)
        .env("CHROMIUM", browser())
        .current_dir(root().join("studio"));
    if shots {
        tests.env("SHOTS", root().join("docs"));
    }
    if let Some(python) = python_with_package() {
        tests.env("SETPIECE_PYTHON", python);
    } else {
        println!("studio: no Python with the wheel: `cargo xtask python` makes one");
        tests.env_remove("SETPIECE_PYTHON");
    }
    run(&mut tests)
}

/// The Python of the tests' environment, if the wheel is installed there.
fn python_with_package() -> Option<PathBuf> {
    let python = root().join("target/venv/bin/python");
    let known = Command::new(&python).args(["-c", "import setpiece"]).output().ok()?;
    known.status.success().then_some(python)
}

/// Checks that the committed page is what the sources give. Without npm it can't, and says so.
pub(crate) fn check() -> Result<(), String> {
    if !npm::is_there() {
        println!("studio: left out, no npm here: the page is not compared with its sources");
        return Ok(());
    }
    let fresh = root().join("target/studio");
    build_into("../target/studio")?;
    for file in FILES {
        let read = |path: &Path| std::fs::read(path).map_err(|why| format!("{file}: {why}"));
        if read(&root().join("studio/dist").join(file))? != read(&fresh.join(file))? {
            return Err(format!(
                "studio/dist/{file} isn't what the sources give: run `cargo xtask studio`"
            ));
        }
    }
    Ok(())
}

fn build_into(folder: &str) -> Result<(), String> {
    let studio = root().join("studio");
    npm::install(&studio)?;
    let build = ["run", "--silent", "build", "--", "--logLevel=warn", "--outDir", folder];
    run(npm::npm().args(build).current_dir(&studio))
}

/// Where Chromium is: Debian's, unless `CHROMIUM` says otherwise.
fn browser() -> String {
    std::env::var("CHROMIUM").unwrap_or_else(|_| "/usr/bin/chromium".to_owned())
}
