//! The resources that a watcher holds while it is waited for, and afterwards. This is a separate
//! process, because it counts all threads and descriptors of the process.
#![cfg(target_os = "linux")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::watch::Watcher;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// The longest wait for the system to remove an ended thread from its list.
const GRACE: Duration = Duration::from_millis(500);

/// Threads and open descriptors of this process.
fn held() -> (usize, usize) {
    let count = |folder: &str| std::fs::read_dir(folder).unwrap().count();
    (count("/proc/self/task"), count("/proc/self/fd"))
}

#[test]
fn a_watcher_holds_a_thread_from_its_first_wait_until_it_is_dropped() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.pitch");
    std::fs::write(&path, "one").unwrap();
    let before = held();
    let files: [PathBuf; 1] = [path];
    for round in 0..20 {
        let mut watcher = Watcher::new(&files);
        assert!(!watcher.changed(Duration::ZERO));
        assert_eq!(held(), before, "round {round}: a look needs nothing");
        assert!(!watcher.changed(Duration::from_millis(20)));
        let during = held();
        assert!(during.0 > before.0 && during.1 > before.1, "round {round}: {during:?}, no events");
        watcher.watch(&[]);
        assert!(!watcher.changed(Duration::from_millis(5)));
        drop(watcher);
        assert_eq!(held().1, before.1, "round {round}: open descriptors");
        let begun = Instant::now();
        while held().0 != before.0 {
            assert!(begun.elapsed() < GRACE, "round {round}: a thread is left");
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}
