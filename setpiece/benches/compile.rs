//! How long each file of the library and each example takes to compile: `cargo bench --bench
//! compile`.
//!
//! A compilation reads everything that a file imports from disk, except the prelude, which is read
//! once. Times are the thread's CPU time: the median of many compilations of a file, then the
//! median and the worst of the files.
#![allow(
    clippy::panic,
    clippy::print_stdout,
    reason = "a benchmark talks to its user, and fails by panicking"
)]

use cpu_time::ThreadTime;
use setpiece::dsl::problem::Code;
use setpiece::error::Failure;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::Duration;

const COMPILATIONS: usize = 101;
/// The limit for every file, and the limit for the median.
const BARS: [Duration; 2] = [Duration::from_millis(5), Duration::from_millis(1)];

/// The `.pitch` files below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_some_and(|ending| ending == "pitch") {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort();
    times[times.len() / 2]
}

fn main() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let mut all = Vec::new();
    for path in ["stdlib-scenarios", "examples"].iter().flat_map(|folder| files(&root.join(folder)))
    {
        let name = path.to_string_lossy().into_owned();
        let time = || {
            let begin = ThreadTime::now();
            let loaded = setpiece::load(black_box(&name));
            let taken = begin.elapsed();
            // A file of rewards or formations is read to its end, and has nothing to run.
            let only_parts =
                |failure: &Failure| failure.problems.iter().all(|it| it.code() == Code::NoScenario);
            match loaded {
                Ok(_) => {}
                Err(setpiece::Error::Compile(failure)) if only_parts(&failure) => {}
                Err(error) => panic!("{error}"),
            }
            taken
        };
        let shown = path.strip_prefix(root).unwrap_or(&path).display().to_string();
        let taken = median((0..COMPILATIONS).map(|_| time()).collect());
        println!("{shown:<60} {taken:>10.1?}");
        all.push(taken);
    }
    let worst = all.iter().copied().max().unwrap_or_default();
    let [most, half] = BARS;
    println!("worst {worst:.1?} (at most {most:?}), median {:.1?} (at most {half:?})", median(all));
}
