//! The command as an archive, for releases and `cargo binstall`.

use crate::release::VERSION;
use crate::shell::{root, run};
use clap::Args;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What stands in an archive beside the command: a file of the repository, and its name there.
const FILES: &[(&str, &str)] = &[
    ("README.md", "README.md"),
    ("CHANGELOG.md", "CHANGELOG.md"),
    ("LICENSE", "LICENSE"),
    ("setpiece/fonts/LICENSE", "LICENSE-fonts"),
];

/// Which build is packed.
#[derive(Debug, Args)]
pub(crate) struct ArchiveArgs {
    /// The target of the build, as Rust names it: target/TARGET/release has the command
    #[arg(long)]
    target: String,
    /// Unpack it into another folder, and play with the command there
    #[arg(long = "try")]
    tried: bool,
}

/// Packs the command of a target into `target/archives`.
///
/// The names are those that `[package.metadata.binstall]` of `setpiece/Cargo.toml` promises.
pub(crate) fn archive(args: &ArchiveArgs) -> Result<(), String> {
    let windows = args.target.contains("windows");
    let name = format!("setpiece-{}-v{VERSION}", args.target);
    let command = if windows { "setpiece.exe" } else { "setpiece" };
    let stage = empty("target/archive-stage")?;
    let folder = stage.join(&name);
    fs::create_dir_all(&folder).map_err(|why| format!("{}: {why}", folder.display()))?;
    let build = root().join("target").join(&args.target).join("release").join(command);
    copy(&build, &folder.join(command))?;
    for (file, packed) in FILES {
        copy(&root().join(file), &folder.join(packed))?;
    }
    let archives = empty("target/archives")?;
    let archive = archives.join(name.clone() + if windows { ".zip" } else { ".tgz" });
    let pack = if windows { "-acf" } else { "-czf" };
    run(Command::new(tar()).arg(pack).arg(&archive).arg("-C").arg(&stage).arg(&name))?;
    if args.tried {
        let unpacked = empty("target/archive-try")?;
        run(Command::new(tar()).arg("-xf").arg(&archive).arg("-C").arg(&unpacked))?;
        let command = unpacked.join(&name).join(command);
        run(Command::new(&command).arg("--version"))?;
        run(Command::new(&command)
            .args(["run", "academy_empty_goal_close", "--agent", "bot", "--episodes", "3"])
            .current_dir(&unpacked))?;
    }
    println!("archive: {}", archive.display());
    Ok(())
}

/// The system's tar. That of Windows packs zip files; another one may stand before it in the path.
fn tar() -> PathBuf {
    match std::env::var_os("SystemRoot") {
        Some(system) if cfg!(windows) => Path::new(&system).join("System32").join("tar.exe"),
        _ => PathBuf::from("tar"),
    }
}

/// An empty folder.
fn empty(folder: &str) -> Result<PathBuf, String> {
    let path = root().join(folder);
    if path.exists() {
        fs::remove_dir_all(&path).map_err(|why| format!("{folder}: {why}"))?;
    }
    fs::create_dir_all(&path).map_err(|why| format!("{folder}: {why}"))?;
    Ok(path)
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    fs::copy(from, to).map(drop).map_err(|why| format!("{}: {why}", from.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn archives_have_the_names_that_binstall_looks_for() {
        let manifest = fs::read_to_string(root().join("setpiece/Cargo.toml")).unwrap();
        for promise in [
            "{ repo }/releases/download/v{ version }/{ name }-{ target }-v{ version }{ archive-suffix }",
            "{ name }-{ target }-v{ version }/{ bin }{ binary-ext }",
        ] {
            assert!(manifest.contains(promise), "{promise}");
        }
    }

    #[test]
    fn the_files_of_an_archive_are_there() {
        for (file, _) in FILES {
            assert!(root().join(file).is_file(), "{file}");
        }
    }
}
