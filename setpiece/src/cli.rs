//! The command line: arguments, and what each command prints.
//!
//! Exit codes: 0 fine, 1 the input has errors, 2 the command line has.

mod agent;
mod bench;
mod check;
mod common;
mod doc;
mod explain;
mod fmt;
mod leaderboard;
mod live;
mod log;
mod lsp;
mod out;
mod play;
mod playing;
mod profile;
mod reference;
#[cfg(feature = "render")]
mod render;
mod replay;
mod snapshot;
#[cfg(feature = "studio")]
mod studio;
mod suite;
mod summary;
mod test;

use crate::Error;
use crate::dsl::problem::Code;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Parser, Subcommand, ValueEnum};
use common::{ColourChoice, FAULT, FINE, MessageFormat};
use out::{Out, StyledText};
use std::ffi::{OsStr, OsString};
use std::path::PathBuf;

pub use reference::reference;

/// Football scenarios from text files, and the engine that runs them.
#[derive(Parser, Debug)]
#[command(name = "setpiece", version, about, max_term_width = 100, arg_required_else_help = true)]
#[command(
    after_help = "With the Python package: `setpiece import grf FILE.py` turns a GRF scenario into a .pitch file"
)]
pub(crate) struct Args {
    /// When to colour the output
    #[arg(long, global = true, value_enum, default_value_t = ColourChoice::Auto, value_name = "WHEN")]
    color: ColourChoice,
    /// Let imports and scripts lie outside of the scenario's folder
    #[arg(long, global = true)]
    allow_outside: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// List the scenarios of the standard library: name, players per side, title
    List,
    /// Compile files and report every problem; exit code 1 if one is an error
    Check {
        /// .pitch files, or names of the library
        #[arg(required = true, value_name = "FILE")]
        files: Vec<OsString>,
        /// How to print the problems
        #[arg(long, value_enum, default_value_t = MessageFormat::Human)]
        message_format: MessageFormat,
        /// Check again whenever a file changes
        #[arg(long)]
        watch: bool,
    },
    /// Compile a scenario into one self-contained file (.pitchc)
    Build {
        /// A .pitch file, or a scenario of the library
        #[arg(value_name = "FILE")]
        source: OsString,
        /// Where to write it
        #[arg(short, long, value_name = "OUT")]
        output: PathBuf,
        /// The format; both are read in the same way
        #[arg(long, value_enum, default_value_t = BuildFormat::Json)]
        format: BuildFormat,
    },
    /// Format files: comments and meaning are kept, broken files are left alone
    #[command(after_help = "Examples:
  setpiece fmt                      every .pitch file here and below
  setpiece fmt corner.pitch drills/
  setpiece fmt --check              exit code 1 and the names where something would change
  setpiece fmt - < corner.pitch     to standard output")]
    Fmt(fmt::FmtArgs),
    /// Explain an error code, with an example and its correction
    #[command(after_help = "Examples:
  setpiece explain SP0203
  setpiece explain          every code")]
    Explain {
        /// A code: SP0203, sp0203 or 203; lists the codes if omitted
        #[arg(value_name = "CODE")]
        code: Option<String>,
    },
    /// Answer an editor over the Language Server Protocol, on standard input and output
    Lsp,
    /// Describe a scenario in Markdown: parameters, players, rewards, endings, rules, and a picture
    /// of a start
    #[command(after_help = "Examples:
  setpiece doc academy_corner
  setpiece doc corner.pitch -o corner.md --picture corner.svg")]
    Doc(doc::DocArgs),
    /// Play episodes of a scenario and show the results
    #[command(after_help = "Examples:
  setpiece run academy_3_vs_1_with_keeper
  setpiece run corner.pitch --agent run_and_shoot --episodes 100 --seed 1
  setpiece run 11_vs_11_stochastic --set difficulty=0.95 --reward scoring --reward checkpoints
  setpiece run corner.pitch --watch
  setpiece run corner.pitch --live
  setpiece run corner.pitch --episodes 100 --plot curves.svg
  setpiece run 11_vs_11_stochastic --from half_time.pitchs
  setpiece run --level 'academy_corner{difficulty=0.8}#12:3'
  setpiece run drill.pitch --level 'drill{gap=5m}#12:3'")]
    Run(play::RunArgs),
    /// Play the checks of files and say which hold; exit code 1 if one doesn't
    #[command(after_help = "Examples:
  setpiece test                     every check here and below
  setpiece test corner.pitch --filter keeper
  setpiece test --format junit > checks.xml

The worst episode of a failed check is written to `failed-checks/`.")]
    Test(test::TestArgs),
    /// Let agents play all against all on both sides, and rate them
    #[command(after_help = "Examples:
  setpiece leaderboard bot random idle
  setpiece leaderboard old.onnx new.onnx bot --matches 50
  setpiece leaderboard old.onnx new.onnx --scenario 5_vs_5 --format json

A rating is that of Bradley and Terry on Elo's scale: an agent with 400 points more wins ten times as
often as it loses. A draw is half a win, and each pair counts one more. Intervals have 95 %: between
percentiles of ratings for results drawn from their posterior distribution (Jeffreys' prior).")]
    Leaderboard(leaderboard::LeaderboardArgs),
    /// Show what an agent does in a scenario: touches, passes, shots, actions, ends and rewards
    #[command(after_help = "Examples:
  setpiece profile policy.onnx academy_3_vs_1_with_keeper -o report.html
  setpiece profile baseline academy_run_to_score -o report.html --episodes 500

The page has its pictures inside and needs no network.")]
    Profile(profile::ProfileArgs),
    /// Draw an episode: a video, a sheet of frames seen from above, or one moment
    #[cfg(feature = "render")]
    #[command(after_help = "Examples:
  setpiece render academy_corner -o corner.mp4
  setpiece render academy_corner -o corner.gif --steps 0..60 --speed 0.5
  setpiece render academy_corner -o corner.png
  setpiece render corner.pitch --agent random --seed 7 -o sheet.png
  setpiece render 11_vs_11_stochastic --step 120 -o frame.png
  setpiece render 11_vs_11_stochastic --step 120 --camera broadcast -o frame.png
  setpiece render drill.pitch --level 'drill{gap=5m}#12:3' -o worst.mp4
  setpiece render runs/academy_corner_7_0.pitchr -o episode.mp4

A recorded episode (.pitchr) is drawn as it was played: who played, seed and parameters are its own.")]
    Render(render::RenderArgs),
    /// Draw an episode: not part of this build
    #[cfg(not(feature = "render"))]
    #[command(disable_help_flag = true)]
    Render {
        /// The arguments of the full command
        #[arg(value_name = "…", trailing_var_arg = true, allow_hyphen_values = true)]
        _arguments: Vec<OsString>,
    },
    /// Open a scenario in the browser: its text and its football, side by side
    #[cfg(feature = "studio")]
    #[command(after_help = "Examples:
  setpiece studio corner.pitch
  setpiece studio academy_corner --port 8000")]
    Studio(studio::StudioArgs),
    /// Play into an episode and save its state, for `run --from`
    #[command(after_help = "Examples:
  setpiece snapshot 11_vs_11_stochastic --step 1500 -o half_time.pitchs
  setpiece snapshot corner.pitch --agent run_and_shoot --seed 3 --step 12 -o shot.pitchs")]
    Snapshot(snapshot::SnapshotArgs),
    /// Play a recorded episode again, bit for bit, and describe or convert it
    #[command(after_help = "Examples:
  setpiece replay runs/academy_corner_7_0.pitchr
  setpiece replay goal.pitchr --format jsonl | head -1
  setpiece replay goal.pitchr --format cdf -o goal/

The Python package's command also writes Google Research Football's dumps: `--format grf -o goal.dump`;
`setpiece.Replay` reads the file in Python.")]
    Replay(replay::ReplayArgs),
    /// Measure how fast scenarios run here: steps per second and CPU-second, and the time of each
    /// phase
    #[command(after_help = "Examples:
  setpiece bench
  setpiece bench 5_vs_5 corner.pitch --threads 1,2,4 --observation smm
  setpiece bench --format jsonl > before.jsonl
  setpiece bench --against before.jsonl")]
    Bench(bench::BenchArgs),
}

/// The format of a compiled scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BuildFormat {
    /// As text
    Json,
    /// Compact, for machines
    Bin,
}

/// Runs the command with its arguments, the program's name first, and returns the exit code.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    match Args::try_parse_from(arguments) {
        Ok(args) => run(args),
        Err(mut error) => {
            // What an argument names may have a code of its own.
            let fault =
                std::error::Error::source(&error).and_then(<dyn std::error::Error>::downcast_ref);
            if let Some(fault) = fault {
                Out::new(ColourChoice::Auto, false).error(fault);
                return FAULT;
            }
            add_beside_tip(&mut error);
            // Help and version also come this way; if they can't be printed, nothing can.
            let _ = error.print();
            error.exit_code() as u8
        }
    }
}

/// Adds how two agents are compared to the report that one was given already.
fn add_beside_tip(error: &mut clap::Error) {
    let is_agent = |value: &ContextValue| matches!(value, ContextValue::String(name) if name.starts_with("--agent"));
    let is_twice = error.kind() == ErrorKind::ArgumentConflict
        && [ContextKind::InvalidArg, ContextKind::PriorArg]
            .iter()
            .all(|kind| error.get(*kind).is_some_and(is_agent));
    if is_twice {
        let tip = "`setpiece run --agent A --beside B` plays the same episodes with both";
        let tip = ContextValue::StyledStrs(vec![tip.into()]);
        error.insert(ContextKind::Suggested, tip);
    }
}

/// Runs a command.
fn run(args: Args) -> u8 {
    log::install();
    let out = Out::new(args.color, args.allow_outside);
    let result = match args.command {
        Command::List => list(&out),
        Command::Check { files, message_format, watch: true } => {
            check::watch(&files, message_format, &out)
        }
        Command::Check { files, message_format, watch: false } => {
            Ok(check::check(&files, message_format, &out, &mut Vec::new()))
        }
        Command::Build { source, output, format } => build(&source, &output, format, &out),
        Command::Fmt(args) => Ok(fmt::fmt(&args, &out)),
        Command::Explain { code } => Ok(explain::explain(code.as_deref(), &out)),
        Command::Lsp => Ok(lsp::serve(args.allow_outside)),
        Command::Doc(args) => doc::doc(&args, &out),
        Command::Run(args) => play::run_command(&args, &out),
        Command::Test(args) => test::test(&args, &out),
        Command::Profile(args) => profile::profile_command(&args, &out),
        Command::Leaderboard(args) => leaderboard::leaderboard_command(&args, &out),
        #[cfg(feature = "render")]
        Command::Render(args) => render::render(&args, &out),
        #[cfg(not(feature = "render"))]
        Command::Render { .. } => {
            let help =
                "the whole command has it: `cargo install --path setpiece` in Setpiece's sources";
            out.fault(
                &Code::NoPicture.to_string(),
                "the Python package's `setpiece` draws no pictures",
                Some(help),
            );
            Ok(FAULT)
        }
        #[cfg(feature = "studio")]
        Command::Studio(args) => studio::studio(&args, &out),
        Command::Snapshot(args) => snapshot::snapshot(&args, &out),
        Command::Replay(args) => replay::replay(&args, &out),
        Command::Bench(args) => bench::bench(&args, &out),
    };
    match result {
        Ok(_) if out.failed() => {
            out.fault(&Code::FileMissing.to_string(), "the output can't be written", None);
            FAULT
        }
        Ok(code) => code,
        Err(error) => {
            out.error(&error);
            FAULT
        }
    }
}

fn list(out: &Out) -> Result<u8, Error> {
    let entries = crate::list();
    let width = entries.iter().map(|entry| entry.name.len()).max().unwrap_or_default();
    for entry in entries {
        let [left, right] = entry.players;
        let line = StyledText::default().bold(&format!("{:width$}", entry.name));
        out.line(line.text(&format!("  {left:>2} v {right:<2}  {}", entry.title)));
    }
    out.line("");
    for suite in crate::plans::library_plans()?.suites {
        let line = StyledText::default().bold(&format!("{:width$}", suite.name));
        let (title, episodes) = (suite.title(), suite.episodes());
        out.line(line.text(&format!("  suite    {title} {episodes} episodes.")));
    }
    Ok(FINE)
}

fn build(
    source: &OsStr,
    output: &std::path::Path,
    format: BuildFormat,
    out: &Out,
) -> Result<u8, Error> {
    let loaded = crate::load_with(source, &out.loading())?;
    out.warnings(&loaded);
    crate::files::refuse_overwriting(output, &loaded.inputs)?;
    let written = match format {
        BuildFormat::Json => {
            crate::scenario::file::to_json(&loaded.scenario).map(String::into_bytes)
        }
        BuildFormat::Bin => crate::scenario::file::binary::to_bytes(&loaded.scenario),
    };
    let bytes = written.map_err(|why| Error::Format { path: output.to_owned(), why })?;
    crate::files::write(output, &bytes)?;
    out.line(format!("{} → {} ({} bytes)", loaded.scenario.name, output.display(), bytes.len()));
    Ok(FINE)
}
