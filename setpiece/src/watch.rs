//! Detects changes of a scenario's files.
//!
//! Every check asks the system for each file's stamp (size, times, identity) through all links. So
//! it doesn't matter how a file was changed: saved in place or by renaming, behind a link, or in a
//! folder that was created again. A check costs about a microsecond per file. If a stamp differs,
//! the content is compared, so that a save without a change doesn't count.
//!
//! The system's events (`events.rs`) only end a wait early. They cost a thread and a few
//! descriptors, from the first wait until the watcher is dropped. A watcher that is never waited
//! for has neither.

mod events;

use self::events::FileEvents;
use crate::error::{Error, FileFault};
use crate::files::{most_bytes, read_file};
use setpiece_scenario::file::fnv1a;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

/// How long a file must be left alone before it is read, because a save may take several writes.
const DEBOUNCE: Duration = Duration::from_millis(50);
/// How often the files are checked if events don't cover them all.
const LOOK_EVERY: Duration = Duration::from_millis(10);
/// How often the files are checked if events cover them. The system may drop an event, and a parent
/// folder may have been replaced.
const LOOK_ANYWAY: Duration = Duration::from_millis(100);
/// How long a second save may leave the stamp unchanged: the coarsest clock of a file system in use
/// (FAT's).
const COARSE: Duration = Duration::from_secs(2);

/// How long a file must be missing to count as deleted.
const GONE: Duration = Duration::from_millis(500);

/// Watches some files.
#[derive(Debug, Default)]
pub struct Watcher {
    files: Vec<Watched>,
    looked: Option<Instant>,
    /// Ends a wait early; none before the first wait.
    events: Option<FileEvents>,
}

/// A file and its known state.
#[derive(Debug)]
struct Watched {
    path: PathBuf,
    stamp: Option<Stamp>,
    /// When the stamp was first seen.
    since: Instant,
    /// Whether the content may have changed under the same stamp.
    young: bool,
    content: Content,
}

/// Distinguishes states of a file without reading it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Stamp {
    length: u64,
    modified: Option<SystemTime>,
    /// Device, file, and time of its last change: seconds, nanoseconds.
    identity: (u64, u64, i64, i64),
}

/// The content of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Content {
    /// The file doesn't exist.
    Gone,
    /// Content with this fingerprint.
    Bytes(u64),
    /// Content that can't be read.
    Fault(FileFault),
}

impl Watcher {
    /// Starts watching `files`. Missing files are waited for.
    pub fn new(files: &[PathBuf]) -> Watcher {
        let mut watcher = Watcher::default();
        watcher.watch(files);
        watcher
    }

    /// Watches other files from now on, those that a recompilation read. What has happened since
    /// the last check to a file that was watched before is still noticed.
    pub fn watch(&mut self, files: &[PathBuf]) {
        let mut known = std::mem::take(&mut self.files);
        let watched = |file: &PathBuf| match known.iter().position(|known| known.path == *file) {
            Some(at) => known.swap_remove(at),
            None => Watched::new(file),
        };
        self.files = files.iter().map(watched).collect();
    }

    /// Whether a watched file's content has changed since the last call; waits for at most
    /// `timeout`.
    ///
    /// A file that is missing for a moment (a save by renaming) counts as unchanged until it is
    /// back. A change younger than 50 ms may be left to the next call.
    pub fn changed(&mut self, timeout: Duration) -> bool {
        let begun = Instant::now();
        // Environments ask in every step, without waiting.
        let mut due =
            !timeout.is_zero() || self.looked.is_none_or(|looked| looked.elapsed() >= LOOK_EVERY);
        loop {
            let left = timeout.saturating_sub(begun.elapsed());
            // Before the check, so that changes in between cause an event.
            let every = if left.is_zero() { Duration::ZERO } else { self.listen() };
            if due {
                self.looked = Some(Instant::now());
                // Every file is checked, whichever has changed.
                if self.files.iter_mut().fold(false, |changed, file| file.look() | changed) {
                    return true;
                }
            }
            if left.is_zero() {
                return false;
            }
            let ready = self.files.iter().filter_map(Watched::ready_in).min().unwrap_or(every);
            if let Some(events) = &self.events {
                events.wait(left.min(every).min(ready));
            }
            due = true;
        }
    }

    /// A file that was there and has been missing for longer than a save by renaming takes.
    pub fn missing(&self) -> Option<&Path> {
        let is_missing = |file: &&Watched| {
            let was_there = file.content != Content::Gone;
            was_there && file.stamp.is_none() && file.since.elapsed() >= GONE
        };
        self.files.iter().find(is_missing).map(|file| file.path.as_path())
    }

    /// Listens to the events of the files' folders. Returns how long a wait without an event may
    /// be.
    fn listen(&mut self) -> Duration {
        let events = self.events.get_or_insert_with(FileEvents::new);
        let is_complete = events.follow(self.files.iter().map(|file| file.path.as_path()));
        if is_complete { LOOK_ANYWAY } else { LOOK_EVERY }
    }
}

impl Watched {
    fn new(path: &Path) -> Watched {
        let stamp = Stamp::of(path);
        let (since, young) = (Instant::now(), stamp.is_some_and(|stamp| stamp.age() < COARSE));
        Watched { path: path.to_owned(), stamp, since, young, content: Content::of(path) }
    }

    /// Whether the content differs from the last check.
    fn look(&mut self) -> bool {
        let stamp = Stamp::of(&self.path);
        if stamp != self.stamp {
            (self.stamp, self.since, self.young) = (stamp, Instant::now(), true);
        }
        let Some(stamp) = stamp.filter(|_| self.young) else { return false };
        let left_alone = self.left_alone(stamp);
        if left_alone < DEBOUNCE {
            return false;
        }
        self.young = left_alone < COARSE;
        let content = Content::of(&self.path);
        let changed = content != Content::Gone && content != self.content;
        if changed {
            self.content = content;
        }
        changed
    }

    /// How long a changed file must still be left alone before it is read; none without a change.
    fn ready_in(&self) -> Option<Duration> {
        let stamp = self.stamp.filter(|_| self.young)?;
        DEBOUNCE.checked_sub(self.left_alone(stamp)).filter(|left| !left.is_zero())
    }

    /// How long the file hasn't been written to.
    fn left_alone(&self, stamp: Stamp) -> Duration {
        self.since.elapsed().max(stamp.age())
    }
}

impl Stamp {
    fn of(path: &Path) -> Option<Stamp> {
        let meta = std::fs::metadata(path).ok()?;
        #[cfg(unix)]
        let identity = {
            use std::os::unix::fs::MetadataExt;
            (meta.dev(), meta.ino(), meta.ctime(), meta.ctime_nsec())
        };
        #[cfg(not(unix))]
        let identity = (0, 0, 0, 0);
        Some(Stamp { length: meta.len(), modified: meta.modified().ok(), identity })
    }

    /// Time since the file was last written, by the system's clock; zero if unknown.
    fn age(self) -> Duration {
        self.modified.and_then(|modified| modified.elapsed().ok()).unwrap_or_default()
    }
}

impl Content {
    fn of(path: &Path) -> Content {
        match read_file(path, most_bytes(path)) {
            Ok(bytes) => Content::Bytes(fnv1a(&bytes)),
            Err(Error::File { why: FileFault::Missing { .. }, .. }) => Content::Gone,
            Err(Error::File { why, .. }) => Content::Fault(why),
            Err(other) => Content::Fault(FileFault::Io(other.to_string())),
        }
    }
}
