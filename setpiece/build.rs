//! Embeds every file of the standard library and every page of the error codes: adding one is
//! adding a file.
//!
//! Not by the macro `include_dir`: without a build script it doesn't see that a file was added, and
//! its files are bytes that are checked to be text at run time.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    embed("../stdlib-scenarios", &["pitch", "rhai"], "stdlib.rs")?;
    embed("../docs/errors", &["md"], "pages.rs")
}

/// Writes a table of paths and texts, sorted by path.
fn embed(folder: &str, endings: &[&str], table_name: &str) -> io::Result<()> {
    let package = env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    let root = Path::new(&package).join(folder).canonicalize()?;
    println!("cargo:rerun-if-changed={}", root.display());
    let mut files = Vec::new();
    collect(&root, endings, &mut files)?;
    files.sort();
    let mut table = String::from("&[\n");
    for file in files {
        let name = file.strip_prefix(&root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        let path = file.display().to_string();
        table.push_str(&["    (\"", &name, "\", include_str!(r\"", &path, "\")),\n"].concat());
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
