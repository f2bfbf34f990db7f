//! Watching: says when a scenario's files have changed.
//!
//! Every look asks the system for each file's stamp (size, times, identity) through all links, so
//! that it doesn't matter how a file came to change: saved in place or by renaming, behind a link,
//! in a folder that was made again. A look costs about a microsecond per file. Where a stamp differs
//! the content is compared: a save without a change is no change.
//!
//! The system's events (`events.rs`) only end a wait early. They cost a thread and a few descriptors,
//! from the first wait until the watcher is dropped: a watcher that is never waited for has neither.

mod events;

use self::events::Events;
use crate::error::{Error, FileFault};
use crate::files::{most_bytes, read_file};
use setpiece_scenario::file::fnv1a;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

/// How long a file has been left alone before it is read: a save may take several writes.
const DEBOUNCE: Duration = Duration::from_millis(50);
/// How often the files are looked at where events don't cover them all.
const LOOK_EVERY: Duration = Duration::from_millis(10);
/// How often the files are looked at where events cover them: the system may drop an event, and a
/// folder on the way may have been replaced.
const LOOK_ANYWAY: Duration = Duration::from_millis(100);
/// How long a second save may leave the stamp as it was: the coarsest clock of a file system in use (FAT's).
const COARSE: Duration = Duration::from_secs(2);

/// Watches some files.
#[derive(Debug, Default)]
pub struct Watcher {
    files: Vec<Watched>,
    looked: Option<Instant>,
    /// What ends a wait early; none before the first wait.
    events: Option<Events>,
}

/// A file and what is known of it.
#[derive(Debug)]
struct Watched {
    path: PathBuf,
    stamp: Option<Stamp>,
    /// When the stamp was first seen.
    since: Instant,
    /// Whether the content may be another one under the same stamp.
    young: bool,
    content: Content,
}

/// What tells one state of a file from another without reading it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Stamp {
    length: u64,
    modified: Option<SystemTime>,
    /// Device, file, and when anything of it last changed: seconds, nanoseconds.
    identity: (u64, u64, i64, i64),
}

/// What a file holds.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Content {
    /// Nothing: it is not there.
    Gone,
    /// What has this fingerprint.
    Bytes(u64),
    /// What can't be read.
    Fault(FileFault),
}

impl Watcher {
    /// Begins to watch `files`; those that aren't there are waited for.
    pub fn new(files: &[PathBuf]) -> Watcher {
        let mut watcher = Watcher::default();
        watcher.watch(files);
        watcher
    }

    /// Watches other files from now on: what a recompilation read.
    pub fn watch(&mut self, files: &[PathBuf]) {
        self.files = files.iter().map(|file| Watched::new(file)).collect();
    }

    /// Whether a watched file's content has changed since the last call; waits for at most `timeout`.
    ///
    /// A file that is gone for a moment (a save by renaming) is no change until it is back. A change that is younger
    /// than 50 ms may wait for the next call.
    pub fn changed(&mut self, timeout: Duration) -> bool {
        let begun = Instant::now();
        // Environments ask in every step, without waiting.
        let mut due = !timeout.is_zero() || self.looked.is_none_or(|looked| looked.elapsed() >= LOOK_EVERY);
        loop {
            let left = timeout.saturating_sub(begun.elapsed());
            // Before the look: what changes in between is then heard.
            let every = if left.is_zero() { Duration::ZERO } else { self.listen() };
            if due {
                self.looked = Some(Instant::now());
                // Every file is looked at, whichever has changed.
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

    /// Listens to the events of the files' folders. Returns how long a wait without an event may be.
    fn listen(&mut self) -> Duration {
        let events = self.events.get_or_insert_with(Events::new);
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

    /// Whether the content is another one than at the last look.
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

    /// How long a changed file has still to be left alone before it is read; none where there is no change.
    fn ready_in(&self) -> Option<Duration> {
        let stamp = self.stamp.filter(|_| self.young)?;
        DEBOUNCE.checked_sub(self.left_alone(stamp)).filter(|left| !left.is_zero())
    }

    /// How long nobody has written to the file.
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

    /// How long ago the file was last written, by the system's clock; zero where that is unknown.
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
