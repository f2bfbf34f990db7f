//! Watching: says when a scenario's files have changed.
//!
//! The folders are watched, not the files: a watch on a file dies with the first editor that saves by renaming.
//! Content is compared, so that a save without a change, or an editor's temporary file, says nothing.

use crate::error::{Error, FileFault};
use notify_debouncer_mini::notify::{RecommendedWatcher, RecursiveMode};
use notify_debouncer_mini::{DebounceEventResult, Debouncer, new_debouncer};
use setpiece_scenario::file::fnv1a;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// How long a burst of events is gathered.
const DEBOUNCE: Duration = Duration::from_millis(50);

/// Watches some files.
pub struct Watcher {
    /// Keeps the folders' watches alive; replaced when other files are watched.
    debouncer: Debouncer<RecommendedWatcher>,
    events: Receiver<DebounceEventResult>,
    folders: Vec<PathBuf>,
    files: Vec<(PathBuf, Option<u64>)>,
}

impl Watcher {
    /// Begins to watch `files`.
    ///
    /// # Errors
    /// [`Error::File`] where a folder can't be watched.
    pub fn new(files: &[PathBuf]) -> Result<Watcher, Error> {
        let (sender, events) = channel();
        let debouncer = new_debouncer(DEBOUNCE, sender).map_err(|why| fault(Path::new("."), &why.to_string()))?;
        let mut watcher = Watcher { debouncer, events, folders: Vec::new(), files: Vec::new() };
        watcher.watch(files)?;
        Ok(watcher)
    }

    /// Watches other files from now on: what a recompilation read.
    ///
    /// # Errors
    /// As [`Watcher::new`].
    pub fn watch(&mut self, files: &[PathBuf]) -> Result<(), Error> {
        for file in files {
            let folder = match file.parent() {
                Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
                _ => PathBuf::from("."),
            };
            if !self.folders.contains(&folder) {
                self.debouncer
                    .watcher()
                    .watch(&folder, RecursiveMode::NonRecursive)
                    .map_err(|why| fault(&folder, &why.to_string()))?;
                self.folders.push(folder);
            }
        }
        self.files = files.iter().map(|file| (file.clone(), hash(file))).collect();
        Ok(())
    }

    /// Whether a watched file's content has changed since the last call; waits for at most `timeout`.
    ///
    /// A file that is gone for a moment (a save by renaming) is no change until it is back.
    pub fn changed(&mut self, timeout: Duration) -> bool {
        let mut woken = self.events.recv_timeout(timeout).is_ok();
        while self.events.try_recv().is_ok() {
            woken = true;
        }
        woken && self.content_changed()
    }

    fn content_changed(&mut self) -> bool {
        let mut changed = false;
        for (file, known) in &mut self.files {
            let now = hash(file);
            if now.is_some() && now != *known {
                *known = now;
                changed = true;
            }
        }
        changed
    }
}

fn hash(file: &Path) -> Option<u64> {
    std::fs::read(file).ok().map(|bytes| fnv1a(&bytes))
}

fn fault(path: &Path, why: &str) -> Error {
    Error::File { path: path.to_owned(), why: FileFault::Io(format!("it can't be watched: {why}")) }
}
