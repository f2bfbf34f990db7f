//! `setpiece fmt`: formats files.

use super::common::{FAULT, FINE};
use super::out::Out;
use crate::Error;
use crate::dsl::format::format;
use crate::dsl::source::{Source, Sources};
use crate::error::Failure;
use crate::files::{SOURCE_MAX_BYTES, pitch_files, read, read_text, write};
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
pub(crate) struct FmtArgs {
    /// .pitch files, folders of them, or `-` for standard input
    #[arg(value_name = "FILE", default_value = ".")]
    files: Vec<PathBuf>,
    /// Write nothing; list the files that would change, and exit with 1 if there are any
    #[arg(long)]
    check: bool,
}

/// Formats the files. A file that can't be read is reported and left alone.
pub(crate) fn fmt(args: &FmtArgs, out: &Out) -> u8 {
    let (mut changed, mut same, mut failed) = (0, 0, 0);
    for file in &args.files {
        let files = if file.is_dir() { pitch_files(file) } else { Ok(vec![file.clone()]) };
        for file in files.unwrap_or_else(|error| {
            out.error(&error);
            failed += 1;
            Vec::new()
        }) {
            match one(&file, args.check, out) {
                Ok(true) => changed += 1,
                Ok(false) => same += 1,
                Err(error) => {
                    out.error(&error);
                    failed += 1;
                }
            }
        }
    }
    if args.files.iter().all(|file| file.as_os_str() != "-") {
        let files = |n: usize| format!("{n} {}", if n == 1 { "file" } else { "files" });
        let verb = if args.check { "to be formatted" } else { "formatted" };
        let left = if failed == 0 { String::new() } else { format!(", {failed} left alone") };
        out.note(format!("{} {verb}, {same} unchanged{left}", files(changed)));
    }
    if failed > 0 || (args.check && changed > 0) { FAULT } else { FINE }
}

/// Formats one file. Returns whether that changes it.
fn one(path: &Path, check: bool, out: &Out) -> Result<bool, Error> {
    let piped = path.as_os_str() == "-";
    let name = if piped { PathBuf::from("<stdin>") } else { path.to_owned() };
    let text = if piped {
        read(std::io::stdin(), &name, SOURCE_MAX_BYTES)?
    } else {
        read_text(path, SOURCE_MAX_BYTES)?
    };
    let source = Source { name: name.to_string_lossy().into_owned(), text: text.into() };
    let formatted = format(&source).map_err(|problems| {
        let mut sources = Sources::default();
        sources.add(source.clone());
        Error::Compile(Box::new(Failure { problems, sources, inputs: Vec::new() }))
    })?;
    let changes = *formatted != *source.text;
    match (check, piped) {
        (true, _) if changes => out.line(&source.name),
        (false, true) => out.text(&formatted),
        (false, false) if changes => {
            // Writes through a link, so that it stays a link.
            write(&path.canonicalize().unwrap_or(name), &formatted)?;
            out.line(&source.name);
        }
        _ => {}
    }
    Ok(changes)
}
