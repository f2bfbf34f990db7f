//! The extension for Visual Studio Code: checked, tested and packed by npm.

use crate::ci::system_python;
use crate::npm;
use crate::shell::{root, run};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// What the package holds.
const HOLDS: &[&str] = &[
    "[Content_Types].xml",
    "extension.vsixmanifest",
    "extension/LICENSE.txt",
    "extension/dist/NOTICES.txt",
    "extension/dist/extension.js",
    "extension/dist/setpiece.tmLanguage.json",
    "extension/language-configuration.json",
    "extension/package.json",
    "extension/readme.md",
    "extension/snippets/pitch.json",
];

/// Checks, tests and packs the extension where npm is; elsewhere says that it doesn't.
pub(crate) fn vscode_if_there(command: &Path) -> Result<(), String> {
    if npm::is_there() {
        return vscode(command);
    }
    println!("vscode: left out, no npm here: the extension is neither tested nor packed");
    Ok(())
}

/// Checks, tests and packs the extension to `target/setpiece.vsix`.
pub(crate) fn vscode(command: &Path) -> Result<(), String> {
    let folder = root().join("editors/vscode");
    npm::install(&folder)?;
    run(npm::npm().args(["run", "--silent", "check"]).current_dir(&folder))?;
    run(npm::npm().args(["test", "--silent"]).env("SETPIECE", command).current_dir(&folder))?;
    run(npm::npm().args(["run", "--silent", "build"]).current_dir(&folder))?;
    let package = root().join("target/setpiece.vsix");
    run(npm::npm()
        .args(["exec", "--offline", "--", "vsce", "package", "--no-dependencies", "--out"])
        .arg(&package)
        .current_dir(&folder))?;
    let script = "import sys, zipfile; print(*zipfile.ZipFile(sys.argv[1]).namelist(), sep='\\n')";
    let listed = Command::new(system_python())
        .args(["-c", script])
        .arg(&package)
        .output()
        .map_err(|why| format!("Python can't be run: {why}"))?;
    let listed = String::from_utf8_lossy(&listed.stdout);
    let (held, wanted): (BTreeSet<&str>, BTreeSet<&str>) =
        (listed.lines().map(str::trim).collect(), HOLDS.iter().copied().collect());
    if held != wanted {
        let missing: Vec<_> = wanted.difference(&held).collect();
        let strange: Vec<_> = held.difference(&wanted).collect();
        return Err(format!("the package lacks {missing:?} and shouldn't hold {strange:?}"));
    }
    println!("vscode: {} holds its {} files", package.display(), held.len());
    Ok(())
}
