//! Files that users may pass: irregular files are rejected at once, watched files are never lost,
//! and files are written completely.
#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::error::FileFault;
use setpiece::files::{read_file, write, write_new};
use setpiece::watch::Watcher;
use setpiece::{Error, Live};
use std::io::Read;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The longest time that a rejection may take.
const AT_ONCE: Duration = Duration::from_secs(20);
/// Longest wait for a change to be noticed.
const PATIENCE: Duration = Duration::from_secs(10);

const CLOSE: &str =
    "scenario close extends academy { ball at (0.77, 0) team left { CB at (0.75, 0) } }\n";

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

fn pipe(path: &Path) -> PathBuf {
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
    path.to_owned()
}

/// Runs the command in a folder and returns its exit code and output. A hang fails.
fn run(folder: &Path, args: &[&str]) -> (Option<i32>, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_setpiece"))
        .args(args)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begun.elapsed() > AT_ONCE {
            child.kill().unwrap();
            panic!("{args:?} hangs");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    let output = child.wait_with_output().unwrap();
    let printed = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8(printed).unwrap())
}

#[test]
fn pipes_and_devices_are_refused_wherever_a_file_is_read() {
    let dir = folder();
    pipe(&dir.path().join("pipe.pitch"));
    symlink("/dev/zero", dir.path().join("endless.pitch")).unwrap();
    std::fs::write(dir.path().join("import.pitch"), format!("import \"pipe.pitch\"\n{CLOSE}"))
        .unwrap();
    let scripted = CLOSE.replace("} }", "} reward script \"pipe.pitch\" }");
    std::fs::write(dir.path().join("script.pitch"), scripted).unwrap();
    for args in [
        &["check", "pipe.pitch"][..],
        &["check", "endless.pitch"],
        &["check", "import.pitch"],
        &["check", "script.pitch"],
        &["build", "pipe.pitch", "-o", "out.pitchc"],
        &["run", "academy_corner", "--from", "pipe.pitch"],
        &["replay", "pipe.pitch"],
        &["fmt", "--check", "."],
        &["doc", "pipe.pitch"],
    ] {
        let (code, printed) = run(dir.path(), args);
        assert_eq!(code, Some(1), "{args:?}: {printed}");
        assert!(printed.contains("is not a regular file"), "{args:?}: {printed}");
    }
}

#[test]
fn a_file_is_read_up_to_its_bound() {
    let dir = folder();
    let path = dir.path().join("large");
    std::fs::write(&path, vec![b'x'; 100]).unwrap();
    assert_eq!(read_file(&path, 100).unwrap().len(), 100);
    assert!(matches!(
        read_file(&path, 99),
        Err(Error::File { why: FileFault::TooLarge { max: 99 }, .. })
    ));
}

/// Waits until a change is noticed.
fn noticed(watcher: &mut Watcher) -> bool {
    watcher.changed(PATIENCE)
}

#[test]
fn a_change_is_noticed_behind_links_and_in_a_folder_made_again() {
    let dir = folder();
    let (real, shown) = (dir.path().join("real"), dir.path().join("shown"));
    std::fs::create_dir_all(&real).unwrap();
    std::fs::create_dir_all(&shown).unwrap();
    let (file, link) = (real.join("a.pitch"), shown.join("a.pitch"));
    std::fs::write(&file, "one").unwrap();
    symlink(&file, &link).unwrap();
    let mut watcher = Watcher::new(std::slice::from_ref(&link));
    assert!(!watcher.changed(Duration::from_millis(200)));
    std::fs::write(&file, "two").unwrap();
    assert!(noticed(&mut watcher), "the link's target was changed");
    std::fs::write(&file, "two").unwrap();
    assert!(!watcher.changed(Duration::from_millis(300)), "a save without a change");
    std::fs::remove_dir_all(&real).unwrap();
    assert!(!watcher.changed(Duration::from_millis(200)), "what is gone is waited for");
    std::fs::create_dir_all(&real).unwrap();
    std::fs::write(&file, "three").unwrap();
    assert!(noticed(&mut watcher), "the folder was made again");
    std::fs::write(&file, "seven").unwrap();
    assert!(noticed(&mut watcher), "and is still watched");
    let other = dir.path().join("other.pitch");
    std::fs::write(&other, "eight").unwrap();
    std::fs::remove_file(&link).unwrap();
    symlink(&other, &link).unwrap();
    assert!(noticed(&mut watcher), "the link leads elsewhere");
}

#[test]
fn a_second_save_of_the_same_length_is_noticed() {
    let dir = folder();
    let path = dir.path().join("a.pitch");
    std::fs::write(&path, "0000").unwrap();
    let mut watcher = Watcher::new(std::slice::from_ref(&path));
    for round in 1..20 {
        std::fs::write(&path, format!("{round:04}")).unwrap();
        assert!(noticed(&mut watcher), "save {round}");
    }
}

/// A compilation takes its time, and a save may fall into it.
#[test]
fn a_save_between_a_check_and_the_next_list_of_files_is_noticed() {
    let dir = folder();
    let (path, other) = (dir.path().join("a.pitch"), dir.path().join("b.pitch"));
    std::fs::write(&path, "one").unwrap();
    let mut watcher = Watcher::new(std::slice::from_ref(&path));
    std::fs::write(&path, "second").unwrap();
    assert!(noticed(&mut watcher));
    std::fs::write(&path, "third one").unwrap();
    watcher.watch(&[other, path]);
    assert!(noticed(&mut watcher), "the third save");
    assert!(!watcher.changed(Duration::from_millis(200)), "and only once");
}

#[test]
fn a_watched_file_that_becomes_a_pipe_is_reported_and_the_watch_goes_on() {
    let dir = folder();
    let path = dir.path().join("a.pitch");
    std::fs::write(&path, CLOSE).unwrap();
    let mut live = Live::open(path.to_str().unwrap(), false).unwrap();
    std::fs::remove_file(&path).unwrap();
    pipe(&path);
    let error = live.poll(PATIENCE).expect("no change was noticed").unwrap_err();
    assert!(error.to_string().contains("is not a regular file"), "{error}");
    std::fs::remove_file(&path).unwrap();
    symlink("/dev/zero", &path).unwrap();
    assert!(live.poll(Duration::from_millis(300)).is_none_or(|polled| polled.is_err()));
    std::fs::remove_file(&path).unwrap();
    std::fs::write(&path, CLOSE.replace("scenario close", "scenario closer")).unwrap();
    assert_eq!(
        live.poll(PATIENCE).expect("no change was noticed").unwrap().scenario.name,
        "closer"
    );
}

#[test]
fn a_file_is_written_whole_or_not_at_all() {
    let dir = folder();
    let path = dir.path().join("a.pitchr");
    write(&path, "first").unwrap();
    let mut open = std::fs::File::open(&path).unwrap();
    write(&path, "second").unwrap();
    let mut before = String::new();
    open.read_to_string(&mut before).unwrap();
    assert_eq!(before, "first", "another file has taken its place");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "second");
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1, "no temporary file stays");
    assert!(write(&dir.path().join("absent/a.pitchr"), "x").is_err());
    assert!(write(dir.path(), "x").is_err());
}

#[test]
fn one_of_many_writers_gets_a_new_name() {
    let dir = folder();
    let path = dir.path().join("a.pitchr");
    let path = &path;
    let got: usize = std::thread::scope(|scope| {
        let writer =
            |n: u32| scope.spawn(move || usize::from(write_new(path, n.to_string()).unwrap()));
        let writers: Vec<_> = (0..8).map(writer).collect();
        writers.into_iter().map(|writer| writer.join().unwrap()).sum()
    });
    assert_eq!(got, 1);
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1, "no temporary file stays");
    assert!(!write_new(path, "again").unwrap());
}
