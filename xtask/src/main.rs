//! Development tasks: `cargo xtask ci` runs everything that must pass, `cargo xtask help` lists the
//! others.
#![allow(clippy::print_stdout, reason = "a command talks to its user")]

mod archive;
mod ci;
mod docs;
mod editors;
mod fuzz;
mod grammar;
mod npm;
mod pictures;
mod release;
mod shell;
mod studio;
mod tidy;
mod transfer;
mod vscode;
mod workflows;

use clap::{CommandFactory as _, Parser, Subcommand};
use shell::built_command;
use std::process::ExitCode;

/// The chores of this repository.
#[derive(Debug, Parser)]
#[command(name = "xtask", bin_name = "cargo xtask")]
struct Xtask {
    #[command(subcommand)]
    command: Option<Command>,
}

/// A chore.
#[derive(Debug, Subcommand)]
enum Command {
    /// Run everything that must pass, from the format to the wheel's own tests
    Ci,
    /// Run the Rust tests
    Test,
    /// Build the wheel and run the Python tests
    Python {
        /// Run all of them, beside the heavy packages of python/requirements-full.txt
        #[arg(long)]
        full: bool,
    },
    /// Check the house rules: which room may use which, file lengths, words, names
    Tidy,
    /// Build the studio's page with npm
    Studio {
        /// Also drive it in Chromium (`CHROMIUM`, else /usr/bin/chromium)
        #[arg(long)]
        drive: bool,
        /// Drive it, and take the pictures of the documentation
        #[arg(long)]
        shots: bool,
    },
    /// Check licences, sources and advisories of the dependencies with cargo-deny
    Deny,
    /// Generate the parser of grammar/tree-sitter, have it read the repository's files, and test
    /// its queries
    Grammar,
    /// Check the workflows of .github with actionlint
    Workflows,
    /// Check that everything names one version, and what else a release needs
    Release(release::ReleaseArgs),
    /// Pack the command of a target into target/archives
    Archive(archive::ArchiveArgs),
    /// Put the plugins for Neovim, Helix and Zed together in target/editors
    Editors {
        /// Drive the server from Node and Neovim instead
        #[arg(long)]
        drive: bool,
    },
    /// Test the extension for Visual Studio Code and pack it to target/setpiece.vsix
    Vscode,
    /// Write docs/pitchc.schema.json
    Schema,
    /// Compare the game's figures with those measured in Google Research Football
    #[command(disable_help_flag = true)]
    Calibrate {
        /// Options of `lab calibrate`: --check, --write, --only SECTION, --count N
        #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "OPTIONS")]
        args: Vec<String>,
    },
    /// Play random scenarios and check properties of every step
    #[command(disable_help_flag = true)]
    Soak {
        /// Options of `lab soak`: --steps N, --seed S, --from SCENARIO
        #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "OPTIONS")]
        args: Vec<String>,
    },
    /// Train policies and play them in both games
    #[command(disable_help_flag = true)]
    Transfer {
        /// Options of lab/transfer/transfer.py: --scenario NAME, --steps N, --episodes N,
        /// --recorded, --seed S
        #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "OPTIONS")]
        args: Vec<String>,
    },
    /// Build the docs site into target/site, and check its links, its search and its start page
    Docs,
    /// Draw the pictures of docs/examples.md
    Pictures,
    /// Try random inputs; see fuzz/README.md
    Fuzz(fuzz::FuzzArgs),
}

fn main() -> ExitCode {
    let Some(command) = Xtask::parse().command else {
        // A list that can't be written has no reader.
        let _ = Xtask::command().print_help();
        return ExitCode::SUCCESS;
    };
    let (name, result) = match command {
        Command::Ci => ("ci", ci::ci()),
        Command::Test => ("test", ci::rust_tests()),
        Command::Python { full: false } => ("python", ci::python().map(drop)),
        Command::Python { full: true } => ("python", ci::python_full()),
        Command::Tidy => ("tidy", tidy::tidy()),
        Command::Studio { drive: false, shots: false } => ("studio", studio::build()),
        Command::Studio { shots, .. } => ("studio", studio::drive(shots)),
        Command::Deny => ("deny", ci::deny()),
        Command::Grammar => ("grammar", grammar::grammar()),
        Command::Workflows => ("workflows", workflows::workflows()),
        Command::Release(args) => ("release", release::release(&args)),
        Command::Archive(args) => ("archive", archive::archive(&args)),
        Command::Editors { drive: false } => ("editors", editors::assemble()),
        Command::Editors { drive: true } => {
            ("editors", built_command().and_then(|command| editors::drive(&command)))
        }
        Command::Vscode => ("vscode", built_command().and_then(|command| vscode::vscode(&command))),
        Command::Schema => ("schema", schema()),
        Command::Calibrate { args } => ("calibrate", ci::lab("calibrate", &args)),
        Command::Soak { args } => ("soak", ci::lab("soak", &args)),
        Command::Transfer { args } => ("transfer", transfer::transfer(&args)),
        Command::Docs => ("docs", docs::docs()),
        Command::Pictures => ("pictures", pictures::pictures()),
        Command::Fuzz(args) => ("fuzz", fuzz::fuzz(&args)),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            println!("xtask {name}: {why}");
            ExitCode::FAILURE
        }
    }
}

/// Writes the JSON schema of a compiled scenario.
fn schema() -> Result<(), String> {
    let path = shell::root().join("docs/pitchc.schema.json");
    std::fs::write(&path, setpiece_scenario::schema::text())
        .map_err(|why| format!("{}: {why}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_well_formed_and_has_one_line_of_help() {
        let command = Xtask::command();
        command.clone().debug_assert();
        for chore in command.get_subcommands() {
            let about = chore.get_about().map(ToString::to_string).unwrap_or_default();
            assert!(!about.is_empty() && !about.contains('\n'), "{}: {about}", chore.get_name());
        }
    }

    #[test]
    fn options_of_other_programs_are_handed_on() {
        let parsed = Xtask::parse_from(["xtask", "calibrate", "--only", "5", "--help"]);
        let Some(Command::Calibrate { args }) = parsed.command else {
            panic!("{:?}", parsed.command)
        };
        assert_eq!(args, ["--only", "5", "--help"]);
    }
}
