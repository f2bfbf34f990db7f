//! The bench that measures the game.
//!
//! - `lab calibrate [--check] [--write] [--only SECTION] [--count N]` compares our figures with
//!   those measured of Google Research Football. With `--write` it writes them to
//!   `docs/calibration.md`; with sections named, only these.
//! - `lab recorded FILE TRACES [--write | --add]` computes figures from `lab/record`'s traces of
//!   that game, to compare with those in `lab/data/FILE`, or to replace them.
//! - `lab soak [--steps N] [--seed S] [--from SCENARIO]` plays random scenarios and checks what
//!   must be true of any match. A long run without a breach adds a line to `lab/soak.csv`.
//!
//! `cargo xtask calibrate` and `cargo xtask soak` build and call it.
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

/// Number of threads; no figure depends on it.
pub(crate) fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
