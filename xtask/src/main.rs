//! Development tasks: `cargo xtask ci` runs everything that must pass, `cargo xtask help` lists the
//! others.
#![allow(clippy::print_stdout, reason = "a command talks to its user")]

mod ci;
mod fuzz;
mod tidy;
mod transfer;

use std::process::ExitCode;

fn main() -> ExitCode {
    let command = std::env::args().nth(1).unwrap_or_default();
    let result = match command.as_str() {
        "ci" => ci::ci(),
        "test" => ci::rust_tests(),
        "python" => match std::env::args().nth(2).as_deref() {
            None => ci::python(),
            Some("--full") => ci::python_full(),
            Some(other) => Err(format!("no option `{other}`; there is `--full`")),
        },
        "schema" => schema(),
        "tidy" => tidy::tidy(),
        "calibrate" | "soak" => ci::lab(&std::env::args().skip(1).collect::<Vec<_>>()),
        "transfer" => transfer::transfer(&std::env::args().skip(2).collect::<Vec<_>>()),
        "fuzz" => fuzz::fuzz(&std::env::args().skip(2).collect::<Vec<_>>()),
        _ => {
            println!("cargo xtask ci      everything that must pass: format, lints, tests, docs, wheel, Python tests");
            println!("cargo xtask test    the Rust tests");
            println!(
                "cargo xtask python  [--full]: build the wheel and run the Python tests; --full adds heavy packages"
            );
            println!("cargo xtask calibrate  [--check] [--only SECTION] [--count N]: compare our figures with GRF's");
            println!("cargo xtask soak    [--steps N] [--seed S]: long runs of random scenarios; see lab/soak.csv");
            println!(
                "cargo xtask transfer  [--scenario NAME]… [--steps N] [--episodes N] [--recorded] [--seed S]: agents in both games"
            );
            println!("cargo xtask schema  write docs/pitchc.schema.json");
            println!("cargo xtask tidy    the project's rules: which room may use which, file lengths, words");
            println!(
                "cargo xtask fuzz    [TARGET…] [--seconds N] [--seed S] [--keep]: random inputs; see fuzz/README.md"
            );
            return if command.is_empty() || command == "help" { ExitCode::SUCCESS } else { ExitCode::from(2) };
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            println!("xtask {command}: {why}");
            ExitCode::FAILURE
        }
    }
}

/// Writes the JSON schema of a compiled scenario.
fn schema() -> Result<(), String> {
    let path = ci::root().join("docs/pitchc.schema.json");
    std::fs::write(&path, setpiece_scenario::schema::text()).map_err(|why| format!("{}: {why}", path.display()))
}
