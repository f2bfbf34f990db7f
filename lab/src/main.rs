//! The bench on which the game is measured.
//!
//! `lab calibrate [--check] [--write] [--only SECTION] [--count N]` sets our figures beside those measured of Google
//! Research Football and writes them to `docs/calibration.md`, the sections named only with `--write`. `lab recorded FILE TRACES [--write | --add]` makes figures of what
//! `lab/record` saw of that game: beside those in `lab/data/FILE`, or in their place. `lab soak [--steps N] [--seed S] [--from SCENARIO]` holds scenarios made up at random
//! to what must be true of any match; a long run that held is a line of `lab/soak.csv`. `cargo xtask calibrate` and
//! `cargo xtask soak` build and call it.
#![allow(clippy::print_stdout, reason = "a command talks to its user")]

mod agents;
mod ball;
mod calibrate;
mod explained;
mod figure;
mod hands;
mod matches;
mod movement;
mod page;
mod pitch;
mod soak;

use std::process::ExitCode;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let result = match args.first().map(String::as_str) {
        Some("calibrate") => calibrate::calibrate(&args[1..]),
        Some("recorded") => hands::recorded(&args[1..]),
        Some("soak") => soak::soak(&args[1..]),
        _ => {
            Err("lab calibrate [--check] [--write] [--only SECTION] [--count N] | lab recorded FILE TRACES [--write | --add] | \
                  lab soak [--steps N] [--seed S] [--from SCENARIO]"
                .to_owned())
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            println!("lab: {why}");
            ExitCode::FAILURE
        }
    }
}

/// Threads to play on; no figure depends on them.
pub(crate) fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
