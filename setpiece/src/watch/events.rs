//! The system's events on the folders of watched files: they end a wait early.
//!
//! An event only means that it is time to check. For a folder that can't be watched (it is missing,
//! or a limit of the system is reached), waits just don't end early.

use notify::event::{AccessKind, AccessMode, EventKind};
use notify::{Event, RecommendedWatcher, RecursiveMode, Watcher};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError, sync_channel};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

/// The longest chain of links that is followed from a file; Linux has the same limit.
const LINKS_MAX: usize = 40;
/// The longest wait for the events' thread to end. It only closes its descriptors.
const END_MAX: Duration = Duration::from_secs(1);

/// Listens to the events of some folders.
#[derive(Debug)]
pub(super) struct FileEvents {
    /// The source of events; none if the system grants none.
    watcher: Option<RecommendedWatcher>,
    /// Receives at most one message for any number of events; disconnected once the thread has
    /// ended.
    heard: Receiver<()>,
    folders: BTreeMap<PathBuf, Folder>,
    /// The process that has the thread. A forked process has only a copy of this value.
    process: u32,
}

/// A folder with its watch.
#[derive(Debug)]
struct Folder {
    identity: Identity,
    is_watched: bool,
}

/// Distinguishes a folder from another one of the same name: device, file, and creation time.
type Identity = (u64, u64, Option<SystemTime>);

impl FileEvents {
    pub(super) fn new() -> FileEvents {
        let (sender, heard) = sync_channel(1);
        let watcher = notify::recommended_watcher(move |event: notify::Result<Event>| {
            if event.map_or(true, |event| is_change(event.kind)) {
                // A full channel already has the message.
                let _ = sender.try_send(());
            }
        });
        let process = std::process::id();
        FileEvents { watcher: watcher.ok(), heard, folders: BTreeMap::new(), process }
    }

    /// Watches exactly the folders of these files and of their links' targets. Returns whether all
    /// of them are watched.
    pub(super) fn follow<'a>(&mut self, files: impl Iterator<Item = &'a Path>) -> bool {
        if !self.is_alive() {
            return false;
        }
        let Some(watcher) = &mut self.watcher else { return false };
        let mut complete = true;
        let mut wanted = BTreeMap::new();
        for folder in files.flat_map(folders_of) {
            match folder.canonicalize().and_then(|folder| Ok((identity_of(&folder)?, folder))) {
                Ok((identity, folder)) => drop(wanted.insert(folder, identity)),
                Err(_) => complete = false,
            }
        }
        self.folders.retain(|path, folder| {
            let keep = wanted.get(path) == Some(&folder.identity);
            if !keep && folder.is_watched {
                // A deleted folder has already lost its watch.
                let _ = watcher.unwatch(path);
            }
            keep
        });
        for (path, identity) in wanted {
            let folder = self.folders.entry(path).or_insert_with_key(|path| {
                let is_watched = watcher.watch(path, RecursiveMode::NonRecursive).is_ok();
                Folder { identity, is_watched }
            });
            complete &= folder.is_watched;
        }
        complete
    }

    /// Waits for an event, for at most `timeout`.
    pub(super) fn wait(&self, timeout: Duration) {
        if self.heard.recv_timeout(timeout) == Err(RecvTimeoutError::Disconnected) {
            sleep(timeout);
        }
    }

    /// Whether the thread that `notify` needs is running; it panics otherwise.
    fn is_alive(&self) -> bool {
        // Receiving a message here loses nothing, because a check follows.
        self.process == std::process::id()
            && self.heard.try_recv() != Err(TryRecvError::Disconnected)
    }
}

/// Waits for the thread; afterwards its descriptors are closed.
impl Drop for FileEvents {
    fn drop(&mut self) {
        let is_alive = self.is_alive();
        let Some(watcher) = self.watcher.take() else { return };
        if !is_alive {
            std::mem::forget(watcher);
            return;
        }
        drop(watcher);
        // At most one message comes before the end.
        while self.heard.recv_timeout(END_MAX).is_ok() {}
    }
}

/// Whether an event may have changed a file; reading causes events too.
fn is_change(kind: EventKind) -> bool {
    match kind {
        EventKind::Access(access) => access == AccessKind::Close(AccessMode::Write),
        _ => true,
    }
}

/// The folders of a file and of all links on its path.
fn folders_of(file: &Path) -> Vec<PathBuf> {
    let mut folders = Vec::new();
    let mut at = file.to_owned();
    for _ in 0..LINKS_MAX {
        let folder = match at.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
            _ => PathBuf::from("."),
        };
        let target = std::fs::read_link(&at);
        folders.push(folder.clone());
        let Ok(target) = target else { break };
        at = folder.join(target);
    }
    folders
}

fn identity_of(folder: &Path) -> std::io::Result<Identity> {
    let meta = std::fs::metadata(folder)?;
    #[cfg(unix)]
    let (device, file) = {
        use std::os::unix::fs::MetadataExt;
        (meta.dev(), meta.ino())
    };
    #[cfg(not(unix))]
    let (device, file) = (0, 0);
    Ok((device, file, meta.created().ok()))
}

#[cfg(all(test, target_os = "linux"))]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use std::time::Instant;

    /// Longest wait for an event that must come.
    const PATIENCE: Duration = Duration::from_secs(10);
    /// Wait for an event that must not come.
    const QUIET: Duration = Duration::from_millis(100);

    /// Whether a wait ends before its time.
    fn ends_early(events: &FileEvents, timeout: Duration) -> bool {
        let begun = Instant::now();
        events.wait(timeout);
        begun.elapsed() < timeout
    }

    /// Drops pending events.
    fn settle(events: &FileEvents) {
        while ends_early(events, QUIET) {}
    }

    #[test]
    fn a_change_ends_a_wait_and_reading_does_not() {
        let dir = tempfile::tempdir().unwrap();
        let (real, shown) = (dir.path().join("real"), dir.path().join("shown"));
        std::fs::create_dir_all(&real).unwrap();
        std::fs::create_dir_all(&shown).unwrap();
        let (file, link) = (real.join("a.pitch"), shown.join("a.pitch"));
        std::fs::write(&file, "one").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        let mut events = FileEvents::new();
        assert!(events.follow([link.as_path()].into_iter()));
        std::fs::read(&file).unwrap();
        assert!(!ends_early(&events, QUIET), "reading");
        std::fs::write(&file, "two").unwrap();
        assert!(ends_early(&events, PATIENCE), "behind the link");
        settle(&events);
        std::fs::remove_dir_all(&real).unwrap();
        assert!(!events.follow([link.as_path()].into_iter()), "a folder is missing");
        std::fs::create_dir_all(&real).unwrap();
        assert!(events.follow([link.as_path()].into_iter()), "it is there again");
        settle(&events);
        std::fs::write(&file, "three").unwrap();
        assert!(ends_early(&events, PATIENCE), "in the folder made again");
        assert!(events.follow(std::iter::empty()));
        settle(&events);
        std::fs::write(&file, "four").unwrap();
        assert!(!ends_early(&events, QUIET), "in a folder that is watched no more");
    }

    #[test]
    fn without_events_a_wait_takes_its_time() {
        let (sender, heard) = sync_channel(1);
        drop(sender);
        let (folders, process) = (BTreeMap::new(), std::process::id());
        let mut events = FileEvents { watcher: None, heard, folders, process };
        assert!(!events.follow([Path::new("a.pitch")].into_iter()));
        assert!(!ends_early(&events, QUIET));
    }
}
