//! How soon a saved file is played, and whether any save is missed: `cargo bench --bench reload`.
//!
//! First, 100 saves of a scenario of 400 steps: the time from the write to the compiled scenario,
//! and to the end of the first episode with it. Then 1,000 saves of a good and a broken text in
//! turn, each by renaming or in place. Every save must be noticed correctly, and neither memory nor
//! open files may grow.
#![allow(
    clippy::panic,
    clippy::print_stdout,
    reason = "a benchmark talks to its user, and fails by panicking"
)]

use setpiece::Live;
use setpiece::engine::control::agents::Agent;
use setpiece::engine::environment::EnvironmentOptions;
use setpiece::run::{RunOptions, run};
use std::path::Path;
use std::time::{Duration, Instant};

const SAVES: usize = 100;
const ALTERNATING: usize = 1000;
/// Longest wait for a change to be noticed.
const PATIENCE: Duration = Duration::from_secs(10);

/// A scenario of 400 steps; its title has the index.
fn text(index: usize, role: &str) -> String {
    format!(
        "/// {index}\nscenario saved extends academy {{\n    ball at (0, 0)\n    team left {{\n        {role} at \
         (-0.1, 0)\n    }}\n    end limit 400 steps\n}}\n"
    )
}

/// Saves in place, or like editors do: a new file replaces the old one.
fn save(path: &Path, text: &str, rename: bool) {
    let target = if rename { path.with_extension("swp") } else { path.to_owned() };
    std::fs::write(&target, text).unwrap_or_else(|error| panic!("{error}"));
    if rename {
        std::fs::rename(&target, path).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Waits for the next reload. Returns whether it compiled.
fn wait(live: &mut Live) -> bool {
    let begin = Instant::now();
    while begin.elapsed() < PATIENCE {
        if let Some(result) = live.poll(Duration::from_millis(200)) {
            return result.is_ok();
        }
    }
    panic!("a save was never noticed");
}

fn percentile(times: &mut [Duration], share: f64) -> Duration {
    times.sort();
    times[((times.len() - 1) as f64 * share) as usize]
}

fn latency(path: &Path, live: &mut Live) {
    let (mut ready, mut played) = (Vec::new(), Vec::new());
    for index in 0..SAVES {
        let text = text(index, "CM");
        let begin = Instant::now();
        save(path, &text, index % 2 == 0);
        assert!(wait(live), "a good file was refused");
        assert_eq!(live.loaded().scenario.title(), index.to_string(), "another save was taken");
        ready.push(begin.elapsed());
        let environment = EnvironmentOptions::default();
        let options = RunOptions {
            episodes: 0..1,
            seed: 0,
            agent: Agent::Idle.into(),
            threads: 1,
            environment,
        };
        let summary = run(&live.loaded().scenario, &options, |_| {})
            .unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(summary.episodes.len(), 1);
        played.push(begin.elapsed());
    }
    for (what, times) in [("scenario ready", &mut ready), ("first episode over", &mut played)] {
        let (half, most) = (percentile(times, 0.5), percentile(times, 0.95));
        println!("{what:<20} median {half:>8.1?}  95th percentile {most:>8.1?}  ({SAVES} saves)");
    }
}

/// Resident memory in KiB, and open files.
fn held() -> (usize, usize) {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap_or_default();
    let memory = line.split_whitespace().next().and_then(|n| n.parse().ok()).unwrap_or_default();
    (memory, std::fs::read_dir("/proc/self/fd").map_or(0, Iterator::count))
}

fn alternating(path: &Path, live: &mut Live) {
    let mut before = held();
    for index in 0..ALTERNATING {
        let good = index % 2 == 1;
        save(path, &text(SAVES + index, if good { "CM" } else { "CMM" }), index % 3 == 0);
        assert_eq!(wait(live), good, "save {index} was taken for another");
        let last_good = SAVES + index - usize::from(!good);
        assert_eq!(
            live.loaded().scenario.title(),
            last_good.to_string(),
            "the last good scenario was lost"
        );
        if index == ALTERNATING / 5 {
            before = held();
        }
    }
    let after = held();
    println!(
        "{ALTERNATING} saves in turn good and broken: all noticed; {} -> {} KiB, {} -> {} open files",
        before.0, after.0, before.1, after.1
    );
    assert!(after.0 < before.0 + 8 * 1024, "memory grew");
    assert_eq!(before.1, after.1, "files stay open");
}

fn main() {
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    let path = folder.path().join("saved.pitch");
    save(&path, &text(SAVES, "CM"), false);
    let mut live = Live::open(&path, false).unwrap_or_else(|error| panic!("{error}"));
    latency(&path, &mut live);
    alternating(&path, &mut live);
}
