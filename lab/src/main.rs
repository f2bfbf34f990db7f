//! The bench on which the game is measured.
//!
//! `lab calibrate [--check] [--only SECTION] [--count N]` sets our figures beside those measured of Google Research
//! Football and writes them to `docs/calibration.md`; `cargo xtask calibrate` builds and calls it.
#![allow(clippy::print_stdout, reason = "a command talks to its user")]

mod agents;
mod ball;
mod calibrate;
mod figure;
mod matches;
mod movement;
mod pitch;

use std::process::ExitCode;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let result = match args.first().map(String::as_str) {
        Some("calibrate") => calibrate::calibrate(&args[1..]),
        _ => Err("lab calibrate [--check] [--only SECTION] [--count N]".to_owned()),
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
