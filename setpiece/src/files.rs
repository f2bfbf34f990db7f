//! Files: reads them with located, helpful errors, and finds what a `.pitch` file imports.

use crate::error::{Error, FileFault};
use crate::stdlib;
use setpiece_dsl::CAST_NAME;
use setpiece_dsl::source::{LoadError, Source, SourceLoader};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, OpenOptions};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// Largest source file, bytes; a typical scenario has a few kilobytes.
pub const SOURCE_MAX_BYTES: u64 = 1 << 20;
/// Largest compiled scenario, bytes.
pub use setpiece_scenario::file::FILE_MAX_BYTES as COMPILED_MAX_BYTES;
/// Largest snapshot, bytes. Most have some kilobytes; records of long episodes need more.
pub const SNAPSHOT_MAX_BYTES: u64 = 64 << 20;

/// The size limit of a scenario's file, by its name.
pub fn most_bytes(path: &Path) -> u64 {
    if is_compiled(path) { COMPILED_MAX_BYTES } else { SOURCE_MAX_BYTES }
}

/// Whether a file has the name of a compiled scenario.
pub fn is_compiled(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "pitchc")
}

/// Reads a text file of at most `max` bytes.
///
/// # Errors
/// [`Error::File`] if it is missing, a directory, too large, not UTF-8, or can't be read.
pub fn read_text(path: &Path, max: u64) -> Result<String, Error> {
    into_text(read_file(path, max)?, path)
}

/// Reads a regular file of at most `max` bytes. All files of users are read through this function.
///
/// # Errors
/// [`Error::File`] if it is missing, not a regular file, too large, or can't be read.
pub fn read_file(path: &Path, max: u64) -> Result<Vec<u8>, Error> {
    read_bytes(open_regular(path)?, path, max)
}

/// Opens a file that can't block: pipes, sockets and devices are rejected.
fn open_regular(path: &Path) -> Result<File, Error> {
    let fault = |why| Error::File { path: path.to_owned(), why };
    let io = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound => fault(FileFault::Missing { similar: similar_file(path) }),
        std::io::ErrorKind::IsADirectory => fault(FileFault::Directory),
        _ => fault(FileFault::Io(error.to_string())),
    };
    let regular = |meta: &std::fs::Metadata| match (meta.is_dir(), meta.is_file()) {
        (true, _) => Err(fault(FileFault::Directory)),
        (_, false) => Err(fault(FileFault::NotRegular)),
        _ => Ok(()),
    };
    // Checked before opening, because opening a device may already have an effect.
    regular(&std::fs::metadata(path).map_err(io)?)?;
    let mut options = OpenOptions::new();
    options.read(true);
    // A pipe that replaces the file in between would wait for a writer.
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, libc::O_NONBLOCK);
    let file = options.open(path).map_err(io)?;
    regular(&file.metadata().map_err(io)?)?;
    Ok(file)
}

/// Reads a text of at most `max` bytes; `path` is its name in reports.
///
/// # Errors
/// [`Error::File`] if it is too large, not UTF-8, or can't be read.
pub fn read(from: impl Read, path: &Path, max: u64) -> Result<String, Error> {
    into_text(read_bytes(from, path, max)?, path)
}

fn read_bytes(from: impl Read, path: &Path, max: u64) -> Result<Vec<u8>, Error> {
    let fault = |why| Error::File { path: path.to_owned(), why };
    let mut bytes = Vec::new();
    // One byte more than allowed, because a pipe has no length.
    from.take(max + 1)
        .read_to_end(&mut bytes)
        .map_err(|why| fault(FileFault::Io(why.to_string())))?;
    if bytes.len() as u64 > max {
        return Err(fault(FileFault::TooLarge { max }));
    }
    Ok(bytes)
}

/// Converts the bytes of a file to text.
///
/// # Errors
/// [`Error::File`] if they aren't UTF-8.
pub fn into_text(bytes: Vec<u8>, path: &Path) -> Result<String, Error> {
    let fault = |why| Error::File { path: path.to_owned(), why };
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].split(|&byte| byte == b'\n').count();
        fault(FileFault::NotUtf8 { line })
    })
}

/// A neighbour with a name similar to the missing one.
fn similar_file(path: &Path) -> Option<String> {
    let folder =
        path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .ok()?
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let wanted = path.file_name()?.to_string_lossy().into_owned();
    // A dangling link is its own neighbour.
    names.retain(|name| *name != wanted);
    setpiece_dsl::problem::nearest(&wanted, names.iter().map(String::as_str)).map(str::to_owned)
}

/// Encodes bytes of a path that aren't UTF-8 as private characters, one per byte.
#[cfg(unix)]
const FOREIGN: u32 = 0xF_8000;

/// The name of a source on disk: its path, with bytes that aren't UTF-8 as private characters.
pub fn name_of(path: &Path) -> String {
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        let mut name = String::new();
        let foreign = |byte: &u8| char::from_u32(FOREIGN + u32::from(*byte));
        for chunk in path.as_os_str().as_bytes().utf8_chunks() {
            for letter in chunk.valid().chars() {
                match u32::from(letter).checked_sub(FOREIGN) {
                    // Otherwise it would be decoded as a byte.
                    Some(0x80..=0xFF) => {
                        name.extend(letter.to_string().as_bytes().iter().filter_map(foreign));
                    }
                    _ => name.push(letter),
                }
            }
            name.extend(chunk.invalid().iter().filter_map(foreign));
        }
        name
    }
    #[cfg(not(unix))]
    path.to_string_lossy().into_owned()
}

/// The path of a name from [`name_of`].
pub fn path_of(name: &str) -> PathBuf {
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStringExt;
        let mut bytes = Vec::with_capacity(name.len());
        for letter in name.chars() {
            // Only bytes above 0x7F are ever encoded.
            match u32::from(letter).checked_sub(FOREIGN) {
                Some(byte @ 0x80..=0xFF) => bytes.push(byte as u8),
                _ => bytes.extend_from_slice(letter.encode_utf8(&mut [0; 4]).as_bytes()),
            }
        }
        std::ffi::OsString::from_vec(bytes).into()
    }
    #[cfg(not(unix))]
    name.into()
}

/// Loads imports and scripts: `std/…` from the library, everything else relative to the importing
/// file.
#[derive(Clone, Debug, Default)]
pub struct FileLoader {
    /// The folder that files must be in, except the library's; none if any file may be read.
    within: Option<PathBuf>,
    /// Texts that stand for files, by the path an import of them resolves to.
    texts: BTreeMap<PathBuf, Arc<str>>,
}

impl FileLoader {
    /// Reads any file.
    pub fn anywhere() -> FileLoader {
        FileLoader::default()
    }

    /// The files of the library that can be imported: their names and texts.
    #[cfg(feature = "editor")]
    pub(crate) fn library_texts() -> impl Iterator<Item = (String, Arc<str>)> {
        let sources = stdlib::paths().filter_map(stdlib::file);
        sources.map(|source| (source.name, source.text))
    }

    /// Takes these texts for the files of their paths: an editor's, which may not be saved.
    #[must_use]
    pub fn with_texts(mut self, texts: BTreeMap<PathBuf, Arc<str>>) -> FileLoader {
        self.texts = texts;
        self
    }

    /// Reads only files in a root file's folder and below. A text from memory uses the working
    /// directory.
    pub fn beside(root: &str) -> FileLoader {
        let root_path = path_of(root);
        let folder = root_path.parent().filter(|_| !root.starts_with('<')).unwrap_or(Path::new(""));
        FileLoader { within: Some(folder.to_owned()), ..FileLoader::default() }
    }

    /// Whether a file may be read, by its written path and by the target of its links.
    fn may_read(&self, full: &Path) -> bool {
        let Some(within) = &self.within else { return true };
        let written = match (plain(full), plain(within)) {
            (Some(full), Some(within)) => full.starts_with(within),
            _ => false,
        };
        let folder = if within.as_os_str().is_empty() { Path::new(".") } else { within };
        // A missing file has no links to follow.
        let linked =
            |full: PathBuf| folder.canonicalize().is_ok_and(|within| full.starts_with(within));
        written && full.canonicalize().map_or(true, linked)
    }
}

/// An absolute path without `.` and `..`.
fn plain(path: &Path) -> Option<PathBuf> {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    let absolute = std::path::absolute(path).ok()?;
    Some(beside(Path::new(""), &absolute))
}

impl SourceLoader for FileLoader {
    fn load(&self, path: &str, from: &str) -> Result<Source, LoadError> {
        // A file of the library also names its neighbours by `std/…`.
        if let Some(inner) = path.strip_prefix("std/") {
            return stdlib::file(inner).ok_or_else(|| {
                let known: Vec<String> =
                    stdlib::paths().map(|name| format!("std/{name}")).collect();
                let near = setpiece_dsl::problem::nearest(path, known.iter().map(String::as_str))
                    .map(str::to_owned);
                let message = format!("the standard library has no `{inner}`");
                LoadError { message, similar: near.into_iter().collect(), awaited: None }
            });
        }
        let full = beside(&path_of(from), &path_of(path));
        // A cast's own files may be anywhere.
        if from != CAST_NAME && !self.may_read(&full) {
            let message = format!(
                "`{path}` lies outside of the scenario's folder, and `--allow-outside` isn't given"
            );
            return Err(LoadError { message, similar: Vec::new(), awaited: None });
        }
        if let Some(text) = self.texts.get(&full) {
            return Ok(Source { name: name_of(&full), text: text.clone() });
        }
        match read_text(&full, SOURCE_MAX_BYTES) {
            Ok(text) => Ok(Source { name: name_of(&full), text: text.into() }),
            Err(error) => {
                // For an existing file there is no better suggestion.
                let similar = match &error {
                    Error::File { why: FileFault::Missing { similar }, .. } => {
                        similar.iter().cloned().collect()
                    }
                    _ => Vec::new(),
                };
                let awaited = Some(name_of(&full));
                Err(LoadError { message: error.to_string(), similar, awaited })
            }
        }
    }

    fn scenarios(&self) -> Vec<(String, String)> {
        stdlib::scenarios().map(|(name, source)| (name.to_owned(), source.name)).collect()
    }
}

/// Resolves `path` relative to the file `from`.
pub(crate) fn beside(from: &Path, path: &Path) -> PathBuf {
    let folder = from.parent().unwrap_or(Path::new(""));
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

/// Rejects an output that is one of its inputs, has the name of a source, or can't be written.
/// It is called before anything is played, and leaves no file behind.
///
/// # Errors
/// [`Error::File`] if it is.
pub fn refuse_overwriting(output: &Path, inputs: &[PathBuf]) -> Result<(), Error> {
    if output.extension().is_some_and(|ending| ending == "pitch" || ending == "rhai") {
        let why = FileFault::Write(
            "that is how a source ends; a compiled scenario ends in .pitchc, a snapshot in .pitchs"
                .to_owned(),
        );
        return Err(Error::File { path: output.to_owned(), why });
    }
    let same = |input: &PathBuf| match (input.canonicalize(), output.canonicalize()) {
        (Ok(input), Ok(output)) => input == output,
        _ => false,
    };
    if inputs.iter().any(same) {
        let why = FileFault::Write("it is what the scenario is made of".to_owned());
        return Err(Error::File { path: output.to_owned(), why });
    }
    refuse_unwritable(output)
}

/// Rejects an output that can't be written, by writing a temporary neighbour.
///
/// # Errors
/// [`Error::File`] if it can't.
fn refuse_unwritable(output: &Path) -> Result<(), Error> {
    check_target(output)?;
    // What a device or pipe takes shows when it is written.
    if output.exists() && !output.is_file() {
        return Ok(());
    }
    Temporary::write(output, b"").map(drop).map_err(|error| write_fault(output, &error))
}

/// Rejects a folder of outputs that can't be one, or that can't be made.
///
/// # Errors
/// [`Error::File`] if a file has its name, or nothing can be written in the nearest folder.
pub fn refuse_folder(output: &Path) -> Result<(), Error> {
    let mut folders =
        output.ancestors().map(|at| if at == Path::new("") { Path::new(".") } else { at });
    let Some(nearest) = folders.find(|at| at.exists()) else { return Ok(()) };
    if !nearest.is_dir() {
        let why = FileFault::Write(format!("`{}` is no folder", nearest.display()));
        return Err(Error::File { path: output.to_owned(), why });
    }
    let probe = nearest.join("setpiece");
    Temporary::write(&probe, b"").map(drop).map_err(|error| write_fault(output, &error))
}

/// Writes a file completely or not at all: a temporary neighbour is renamed over it. All files are
/// written through this function.
///
/// # Errors
/// [`Error::File`] if it can't be written.
pub fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Error> {
    let content = content.as_ref();
    check_target(path)?;
    let fault = |error| write_fault(path, &error);
    // A device or pipe can't be replaced by renaming.
    if path.exists() && !path.is_file() {
        return std::fs::write(path, content).map_err(fault);
    }
    let temporary = Temporary::write(path, content).map_err(fault)?;
    // Keeps the file's permissions.
    if let Ok(meta) = std::fs::metadata(path) {
        std::fs::set_permissions(&temporary.path, meta.permissions()).map_err(fault)?;
    }
    std::fs::rename(&temporary.path, path).map_err(fault)
}

/// Writes a file completely or not at all, if its name is free. Returns whether it did.
///
/// Of several threads and processes that request one name, only one gets it.
///
/// # Errors
/// [`Error::File`] if it can't be written.
pub fn write_new(path: &Path, content: impl AsRef<[u8]>) -> Result<bool, Error> {
    if path.symlink_metadata().is_ok() {
        return Ok(false);
    }
    check_target(path)?;
    let fault = |error| write_fault(path, &error);
    let temporary = Temporary::write(path, content.as_ref()).map_err(fault)?;
    match std::fs::hard_link(&temporary.path, path) {
        Ok(()) => return Ok(true),
        Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => return Ok(false),
        // The file system has no links, so the name is reserved first.
        Err(_) => {}
    }
    match OpenOptions::new().write(true).create_new(true).open(path) {
        Ok(_) => {}
        Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => return Ok(false),
        Err(error) => return Err(fault(error)),
    }
    std::fs::rename(&temporary.path, path).map_err(|error| {
        let _ = std::fs::remove_file(path);
        fault(error)
    })?;
    Ok(true)
}

fn write_fault(path: &Path, error: &std::io::Error) -> Error {
    Error::File { path: path.to_owned(), why: FileFault::Write(error.to_string()) }
}

fn check_target(path: &Path) -> Result<(), Error> {
    let why = match path.file_name() {
        _ if path.is_dir() => "it is a directory",
        None => "it has no file name",
        Some(_) => return Ok(()),
    };
    Err(Error::File { path: path.to_owned(), why: FileFault::Write(why.to_owned()) })
}

/// A complete file next to the one to be written; removed unless it was renamed.
struct Temporary {
    path: PathBuf,
}

/// How temporary files begin and end; between stand the process and a count.
const TEMPORARY: (&str, &str) = (".setpiece.", ".tmp");
/// Age at which a temporary file has no writer any more: no write takes so long.
const STALE: Duration = Duration::from_secs(60 * 60);

impl Temporary {
    fn write(beside: &Path, content: &[u8]) -> std::io::Result<Temporary> {
        /// Makes the names within one process differ.
        static COUNT: AtomicU32 = AtomicU32::new(0);
        remove_stale(beside.parent().unwrap_or(Path::new("")));
        loop {
            let count = COUNT.fetch_add(1, Ordering::Relaxed);
            // A short name of its own: together with the other's it could be too long.
            let (head, tail) = TEMPORARY;
            let path = beside.with_file_name(format!("{head}{}.{count}{tail}", std::process::id()));
            match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(mut file) => {
                    let temporary = Temporary { path };
                    file.write_all(content)?;
                    return Ok(temporary);
                }
                // Left over by a killed process with the same id.
                Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
    }
}

/// Removes what killed processes have left in a folder; once per process and folder, since a folder
/// of recorded episodes may be long.
fn remove_stale(folder: &Path) {
    static SEEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let Ok(absolute) = std::path::absolute(folder) else { return };
    // Where another thread has panicked, nothing is removed.
    if !SEEN.lock().is_ok_and(|mut seen| seen.insert(absolute)) {
        return;
    }
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let between = name
            .to_str()
            .and_then(|name| name.strip_prefix(TEMPORARY.0)?.strip_suffix(TEMPORARY.1));
        let ours = between.is_some_and(|between| {
            between.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.')
        });
        let age = || entry.metadata().ok()?.modified().ok()?.elapsed().ok();
        if ours && age().is_some_and(|age| age > STALE) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.path);
    }
}

/// Every `.pitch` file below a folder, except in hidden folders, sorted.
///
/// # Errors
/// [`Error::File`] if a folder can't be read.
pub fn pitch_files(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let fault = |why: std::io::Error| Error::File {
        path: folder.to_owned(),
        why: FileFault::Io(why.to_string()),
    };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(fault)? {
        let entry = entry.map_err(fault)?;
        let (path, kind) = (entry.path(), entry.file_type().map_err(fault)?);
        let hidden = entry.file_name().to_string_lossy().starts_with('.');
        if kind.is_dir() && !hidden {
            files.append(&mut pitch_files(&path)?);
        } else if !kind.is_dir() && path.extension().is_some_and(|ending| ending == "pitch") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;
    use std::time::SystemTime;

    #[test]
    fn what_killed_writers_have_left_is_removed() {
        let folder = tempfile::tempdir().unwrap();
        let left = |name: &str, age: Duration| {
            let file = File::create(folder.path().join(name)).unwrap();
            file.set_modified(SystemTime::now() - age).unwrap();
        };
        left(".setpiece.17.3.tmp", 2 * STALE);
        left(".setpiece.18.0.tmp", STALE / 2);
        left(".setpiece.notes.tmp", 2 * STALE);
        write(&folder.path().join("a.pitchc"), "a").unwrap();
        let mut names: Vec<_> = std::fs::read_dir(folder.path())
            .unwrap()
            .map(|entry| entry.unwrap().file_name())
            .collect();
        names.sort();
        assert_eq!(names, [".setpiece.18.0.tmp", ".setpiece.notes.tmp", "a.pitchc"]);
    }
}
