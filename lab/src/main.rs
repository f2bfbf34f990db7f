//! The bench on which the game is measured: `cargo xtask calibrate` and `cargo xtask soak` build
//! and call it.
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
mod threads;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Measures the game.
#[derive(Debug, Parser)]
#[command(name = "lab")]
struct Lab {
    #[command(subcommand)]
    command: Command,
}

/// What is measured.
#[derive(Debug, Subcommand)]
enum Command {
    /// Compare figures with those measured in Google Research Football; without SECTION or N, write
    /// docs/calibration.md
    Calibrate(calibrate::CalibrateArgs),
    /// Compare what lab/record saw of that game with a file of lab/data, or write it there
    Recorded(hands::RecordedArgs),
    /// Write what happens in our game in the rows of a file of lab/data, in lab/record's form
    Play(hands::PlayArgs),
    /// Play random scenarios and check properties of every step; a long run adds a line to
    /// lab/soak.csv
    Soak(soak::SoakArgs),
}

fn main() -> ExitCode {
    let result = match Lab::parse().command {
        Command::Calibrate(args) => calibrate::calibrate(&args),
        Command::Recorded(args) => hands::recorded(&args),
        Command::Play(args) => hands::play(&args),
        Command::Soak(args) => soak::soak(&args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            println!("lab: {why}");
            ExitCode::FAILURE
        }
    }
}
