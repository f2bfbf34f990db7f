//! Files: reading them with located, helpful errors, and finding what a `.pitch` file imports.

use crate::error::{Error, FileFault};
use crate::stdlib;
use setpiece_dsl::CAST_NAME;
use setpiece_dsl::source::{LoadError, Source, SourceLoader};
use std::io::Read;
use std::path::{Path, PathBuf};

/// Largest source file, bytes; a scenario is a few kilobytes.
pub const SOURCE_MAX_BYTES: u64 = 1 << 20;
/// Largest compiled scenario, bytes.
pub const COMPILED_MAX_BYTES: u64 = 64 << 20;
/// Largest snapshot, bytes; most take some kilobytes, records of long episodes more.
pub const SNAPSHOT_MAX_BYTES: u64 = 64 << 20;

/// Reads a text file of at most `max` bytes.
///
/// # Errors
/// [`Error::File`] where it is missing, a directory, too large, not UTF-8, or can't be read.
pub fn read_text(path: &Path, max: u64) -> Result<String, Error> {
    into_text(read_file(path, max)?, path)
}

/// Reads a file of at most `max` bytes.
///
/// # Errors
/// [`Error::File`] where it is missing, too large, or can't be read.
pub fn read_file(path: &Path, max: u64) -> Result<Vec<u8>, Error> {
    let fault = |why| Error::File { path: path.to_owned(), why };
    let io = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound => fault(FileFault::Missing { similar: similar_file(path) }),
        std::io::ErrorKind::IsADirectory => fault(FileFault::Directory),
        _ => fault(FileFault::Io(error.to_string())),
    };
    let meta = std::fs::metadata(path).map_err(io)?;
    if meta.is_dir() {
        return Err(fault(FileFault::Directory));
    }
    read_bytes(std::fs::File::open(path).map_err(io)?, path, max)
}

/// Reads a text of at most `max` bytes; `path` is how reports call it.
///
/// # Errors
/// [`Error::File`] where it is too large, not UTF-8, or can't be read.
pub fn read(from: impl Read, path: &Path, max: u64) -> Result<String, Error> {
    into_text(read_bytes(from, path, max)?, path)
}

fn read_bytes(from: impl Read, path: &Path, max: u64) -> Result<Vec<u8>, Error> {
    let fault = |why| Error::File { path: path.to_owned(), why };
    let mut bytes = Vec::new();
    // One byte more than allowed: a pipe has no length to look at.
    from.take(max + 1).read_to_end(&mut bytes).map_err(|why| fault(FileFault::Io(why.to_string())))?;
    if bytes.len() as u64 > max {
        return Err(fault(FileFault::TooLarge { max }));
    }
    Ok(bytes)
}

/// The bytes of a file as text.
///
/// # Errors
/// [`Error::File`] where they are not UTF-8.
pub fn into_text(bytes: Vec<u8>, path: &Path) -> Result<String, Error> {
    let fault = |why| Error::File { path: path.to_owned(), why };
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].split(|&byte| byte == b'\n').count();
        fault(FileFault::NotUtf8 { line })
    })
}

/// A neighbour whose name is like the one that is missing.
fn similar_file(path: &Path) -> Option<String> {
    let folder = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .ok()?
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let wanted = path.file_name()?.to_string_lossy().into_owned();
    // A link that leads nowhere is its own neighbour.
    names.retain(|name| *name != wanted);
    setpiece_dsl::problem::nearest(&wanted, names.iter().map(String::as_str)).map(str::to_owned)
}

/// Loads imports and scripts: `std/…` from the library, everything else beside the file that names it.
#[derive(Clone, Debug, Default)]
pub struct FileLoader {
    /// The folder that nothing but the library may lie outside of; none where anything may be read.
    within: Option<PathBuf>,
}

impl FileLoader {
    /// Reads any file.
    pub fn anywhere() -> FileLoader {
        FileLoader { within: None }
    }

    /// Reads files in the folder of a root file and below; a text from memory has the working directory.
    pub fn beside(root: &str) -> FileLoader {
        let folder = Path::new(root).parent().filter(|_| !root.starts_with('<')).unwrap_or(Path::new(""));
        FileLoader { within: Some(folder.to_owned()) }
    }

    /// Whether a file may be read, as it is written and where its links lead.
    fn may_read(&self, full: &Path) -> bool {
        let Some(within) = &self.within else { return true };
        let written = match (plain(full), plain(within)) {
            (Some(full), Some(within)) => full.starts_with(within),
            _ => false,
        };
        let folder = if within.as_os_str().is_empty() { Path::new(".") } else { within };
        // What is not there has no links to follow.
        let linked = |full: PathBuf| folder.canonicalize().is_ok_and(|within| full.starts_with(within));
        written && full.canonicalize().map_or(true, linked)
    }
}

/// An absolute path without `.` and `..`.
fn plain(path: &Path) -> Option<PathBuf> {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    let absolute = std::path::absolute(path).ok()?;
    Some(beside("", &absolute.to_string_lossy()))
}

impl SourceLoader for FileLoader {
    fn load(&self, path: &str, from: &str) -> Result<Source, LoadError> {
        // A file of the library names its neighbours by `std/…` too.
        if let Some(inner) = path.strip_prefix("std/") {
            return stdlib::file(inner).ok_or_else(|| {
                let known: Vec<String> = stdlib::paths().map(|name| format!("std/{name}")).collect();
                let near = setpiece_dsl::problem::nearest(path, known.iter().map(String::as_str)).map(str::to_owned);
                let message = format!("the standard library has no `{inner}`");
                LoadError { message, similar: near.into_iter().collect(), awaited: None }
            });
        }
        let full = beside(from, path);
        // Whoever plays from outside names his own files.
        if from != CAST_NAME && !self.may_read(&full) {
            let message = format!("`{path}` lies outside of the scenario's folder, and `--allow-outside` isn't given");
            return Err(LoadError { message, similar: Vec::new(), awaited: None });
        }
        match read_text(&full, SOURCE_MAX_BYTES) {
            Ok(text) => Ok(Source { name: full.to_string_lossy().into_owned(), text: text.into() }),
            Err(error) => {
                let similar = similar_file(&full).into_iter().collect();
                let awaited = Some(full.to_string_lossy().into_owned());
                Err(LoadError { message: error.to_string(), similar, awaited })
            }
        }
    }

    fn scenarios(&self) -> Vec<(String, String)> {
        stdlib::scenarios().map(|(name, source)| (name.to_owned(), source.name)).collect()
    }
}

/// The path of `path` as seen from the file `from`.
fn beside(from: &str, path: &str) -> PathBuf {
    let folder = Path::new(from).parent().unwrap_or(Path::new(""));
    let mut full = PathBuf::new();
    for part in folder.join(path).components() {
        match part {
            std::path::Component::CurDir => {}
            std::path::Component::ParentDir if full.file_name().is_some() => {
                full.pop();
            }
            part => full.push(part),
        }
    }
    full
}

/// Refuses an output that is one of its inputs, or would pass for a source.
///
/// # Errors
/// [`Error::File`] where it is.
pub fn refuse_overwriting(output: &Path, inputs: &[PathBuf]) -> Result<(), Error> {
    if output.extension().is_some_and(|ending| ending == "pitch" || ending == "rhai") {
        let why = FileFault::Write(
            "that is how a source ends; a compiled scenario ends in .pitchc, a snapshot in .pitchs".to_owned(),
        );
        return Err(Error::File { path: output.to_owned(), why });
    }
    let same = |input: &PathBuf| matches!((input.canonicalize(), output.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if inputs.iter().any(same) {
        let why = FileFault::Write("it is what the scenario is made of".to_owned());
        return Err(Error::File { path: output.to_owned(), why });
    }
    Ok(())
}

/// Writes a file whole or not at all: a temporary neighbour is renamed over it.
///
/// # Errors
/// [`Error::File`] where it can't be written.
pub fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Error> {
    let content = content.as_ref();
    let fault = |error: std::io::Error| Error::File { path: path.to_owned(), why: FileFault::Write(error.to_string()) };
    if path.is_dir() {
        let why = FileFault::Write("it is a directory".to_owned());
        return Err(Error::File { path: path.to_owned(), why });
    }
    let Some(name) = path.file_name() else {
        return Err(fault(std::io::Error::other("it has no file name")));
    };
    // A device or pipe can't be renamed over.
    if path.exists() && !path.is_file() {
        return std::fs::write(path, content).map_err(fault);
    }
    let mut temporary = name.to_owned();
    temporary.push(format!(".{}.tmp", std::process::id()));
    let temporary = path.with_file_name(temporary);
    let replace = || {
        std::fs::write(&temporary, content)?;
        // Who may read and write it stays as it was.
        if let Ok(meta) = std::fs::metadata(path) {
            std::fs::set_permissions(&temporary, meta.permissions())?;
        }
        std::fs::rename(&temporary, path)
    };
    replace().map_err(|error| {
        let _ = std::fs::remove_file(&temporary);
        fault(error)
    })
}
