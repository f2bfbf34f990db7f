//! Embeds every file of the standard library, every page of the error codes, every policy in the
//! box and the studio's page: adding one is adding a file.
//!
//! They lie outside of this crate in the repository, and inside of it in a published package: cargo
//! follows the links in `embedded/` when it packs. A system without links has files there.
//!
//! Not by the macro `include_dir`: without a build script it doesn't see that a file was added, and
//! its files are bytes that are checked to be text at run time.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    embed(&folder("stdlib-scenarios", "../stdlib-scenarios")?, &["pitch", "rhai"], "stdlib.rs")?;
    embed(&folder("errors", "../docs/errors")?, &["md"], "pages.rs")?;
    let policies = folder("policies", "../baselines/policies")?;
    embed_bytes(&policies, "onnx", "policies.rs")?;
    embed(&policies, &["json"], "cards.rs")?;
    let page = folder("studio", "../studio/dist")?;
    println!("cargo:rerun-if-changed={}", page.display());
    println!("cargo:rustc-env=SETPIECE_STUDIO_PAGE={}", page.display());
    Ok(())
}

/// A folder of `embedded/`, or the one in the repository that it stands for.
fn folder(name: &str, in_repository: &str) -> io::Result<PathBuf> {
    let package = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let packed = package.join("embedded").join(name);
    let chosen = if packed.is_dir() { packed } else { package.join(in_repository) };
    chosen.canonicalize().map_err(|why| {
        io::Error::new(why.kind(), ["can't embed ", &chosen.display().to_string()].concat())
    })
}

/// Writes a table of paths and texts, sorted by path.
fn embed(root: &Path, endings: &[&str], table_name: &str) -> io::Result<()> {
    table(root, endings, "include_str!", table_name)
}

/// Writes a table of paths and bytes, sorted by path.
fn embed_bytes(root: &Path, ending: &str, table_name: &str) -> io::Result<()> {
    table(root, &[ending], "include_bytes!", table_name)
}

fn table(root: &Path, endings: &[&str], include: &str, table_name: &str) -> io::Result<()> {
    println!("cargo:rerun-if-changed={}", root.display());
    let mut files = Vec::new();
    collect(root, endings, &mut files)?;
    files.sort();
    let mut table = String::from("&[\n");
    for file in files {
        let name = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        let path = file.display().to_string();
        table.push_str(&["    (\"", &name, "\", ", include, "(r\"", &path, "\")),\n"].concat());
    }
    table += "]\n";
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    fs::write(out.join(table_name), table)
}

fn collect(folder: &Path, endings: &[&str], files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            println!("cargo:rerun-if-changed={}", path.display());
            collect(&path, endings, files)?;
        } else if path
            .extension()
            .is_some_and(|ending| endings.iter().any(|wanted| ending == *wanted))
        {
            files.push(path);
        }
    }
    Ok(())
}
