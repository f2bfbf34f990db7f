//! `setpiece run`: plays episodes of a scenario, once or whenever its file changes.

use super::live::live;
use super::out::{Out, StyledText};
use super::{FAULT, FINE, playing::Playing, summary};
#[cfg(feature = "render")]
use crate::curves::curves;
#[cfg(feature = "render")]
use crate::dsl::problem::Code;
use crate::engine::environment::EnvironmentOptions;
#[cfg(feature = "render")]
use crate::error::FileFault;
#[cfg(feature = "render")]
use crate::files::{refuse_overwriting, write};
use crate::live::Live;
#[cfg(feature = "render")]
use crate::plot;
use crate::run::{RunOptions, Summary, first_error, run};
use crate::scenario::Scenario;
use crate::{Error, Loaded};
use clap::{Args, ValueEnum, builder::RangedU64ValueParser};
use indicatif::{ProgressBar, ProgressStyle};
#[cfg(feature = "render")]
use std::ffi::OsStr;
use std::io::IsTerminal;
#[cfg(feature = "render")]
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// Time that a reload may spend on the dry run.
const PROBE: Duration = Duration::from_millis(10);
/// How often a progress bar and a watcher update.
const TICK: Duration = Duration::from_millis(200);

#[derive(Args, Debug)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    playing: Playing,
    /// The number of episodes
    #[arg(short = 'n', long, value_name = "N", default_value_t = 20, value_parser = RangedU64ValueParser::<u64>::new().range(1..=1_000_000_000))]
    episodes: u64,
    /// Pay this reward instead of the scenario's own; may be repeated or separated by commas
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    reward: Vec<String>,
    /// Threads; the results don't depend on them [default: one per core]
    #[arg(short, long, value_name = "N", value_parser = RangedU64ValueParser::<u16>::new().range(1..=1024))]
    threads: Option<u16>,
    /// The output format
    #[arg(long, value_enum, default_value_t = RunFormat::Text)]
    format: RunFormat,
    /// Show the episodes in the terminal, ten steps a second, instead of a summary
    #[arg(long, conflicts_with_all = ["format", "watch", "threads"])]
    live: bool,
    /// Also draw the mean return of every term over the time of an episode, as .svg or .png
    #[cfg(feature = "render")]
    #[arg(long, value_name = "OUT", conflicts_with_all = ["watch", "live"])]
    plot: Option<PathBuf>,
    /// Run again whenever the file, or one it imports, changes
    #[arg(short, long, conflicts_with = "format")]
    watch: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RunFormat {
    /// A table
    Text,
    /// One JSON object
    Json,
}

/// Runs the command.
pub(crate) fn run_command(args: &RunArgs, out: &Out) -> Result<u8, Error> {
    if args.watch {
        return watch(args, out);
    }
    let loaded = crate::load_with(&args.playing.scenario, &out.loading())?;
    out.warnings(&loaded);
    let options = options(args, &loaded)?;
    if args.live {
        return live(&loaded, &options, out);
    }
    #[cfg(feature = "render")]
    if let Some(path) = &args.plot
        && !plot(path, &loaded, &options, out)?
    {
        return Ok(FAULT);
    }
    let summary = with_progress(&loaded, &options)?;
    if let Some(error) =
        first_error(&summary).filter(|_| summary.episodes.iter().all(Result::is_err))
    {
        return Err(error);
    }
    match args.format {
        RunFormat::Json => out.line(summary::json(&loaded.scenario, &options, &summary)),
        RunFormat::Text => summary::print(&loaded.scenario, &options, &summary, out)?,
    }
    if let Some(error) = first_error(&summary) {
        out.error(&error);
        return Ok(FAULT);
    }
    Ok(FINE)
}

/// Writes the curves; false, with a report, if the file's name asks for something else.
#[cfg(feature = "render")]
fn plot(path: &Path, loaded: &Loaded, options: &RunOptions, out: &Out) -> Result<bool, Error> {
    refuse_overwriting(path, &loaded.inputs)?;
    let name = &loaded.scenario.name;
    let ending = path.extension().map(OsStr::to_ascii_lowercase);
    let picture = match ending.as_deref().and_then(OsStr::to_str) {
        Some("svg") => plot::svg(name, &curves(&loaded.scenario, options)?).into_bytes(),
        Some("png") => {
            let curves = curves(&loaded.scenario, options)?;
            let too_large = || FileFault::Write("the picture is too large".to_owned());
            plot::png(name, &curves)
                .ok_or_else(|| Error::File { path: path.to_owned(), why: too_large() })?
        }
        _ => {
            let message = format!("curves can't be drawn as `{}`", path.display());
            let help = format!("name it `{}`", path.with_extension("svg").display());
            out.fault(&Code::NoPicture.to_string(), &message, Some(&help));
            return Ok(false);
        }
    };
    write(path, picture)?;
    Ok(true)
}

fn options(args: &RunArgs, loaded: &Loaded) -> Result<RunOptions, Error> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    Ok(RunOptions {
        episodes: 0..args.episodes,
        seed: args.playing.seed,
        agent: args.playing.agent(),
        threads: args.threads.map_or(cores, usize::from),
        environment: EnvironmentOptions {
            rewards: (!args.reward.is_empty()).then(|| args.reward.clone()),
            ..args.playing.environment(loaded)?
        },
    })
}

fn with_progress(loaded: &Loaded, options: &RunOptions) -> Result<Summary, Error> {
    if !std::io::stderr().is_terminal() {
        return run(&loaded.scenario, options, |_| {});
    }
    let style =
        ProgressStyle::with_template("{bar:40} {pos}/{len} episodes  {msg} steps  {eta} left");
    let bar = ProgressBar::new(options.episodes.end - options.episodes.start);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.enable_steady_tick(TICK);
    let steps = std::sync::atomic::AtomicU64::new(0);
    let summary = run(&loaded.scenario, options, |length| {
        let total = steps.fetch_add(length.into(), std::sync::atomic::Ordering::Relaxed)
            + u64::from(length);
        bar.set_message(total.to_string());
        bar.inc(1);
    });
    bar.finish_and_clear();
    summary
}

/// Runs episode by episode. A changed file takes effect at the next one; a broken one leaves the
/// last good one running.
fn watch(args: &RunArgs, out: &Out) -> Result<u8, Error> {
    let mut live = Live::open(&args.playing.scenario, out.allow_outside)?;
    out.warnings(live.loaded());
    if !live.is_watching() {
        let name = args.playing.scenario.to_string_lossy();
        out.fault("SP0001", &format!("`{name}` is no file: there is nothing to watch"), None);
        return Ok(FAULT);
    }
    let mut options = options(args, live.loaded())?;
    let mut scenario = live.loaded().scenario.clone();
    loop {
        out.line(StyledText::default().bold(&scenario.name));
        for index in 0..args.episodes {
            let one = RunOptions { episodes: index..index + 1, threads: 1, ..options.clone() };
            let summary = run(&scenario, &one, |_| {})?;
            for episode in summary.episodes.iter().flatten() {
                out.line(summary::episode_line(episode));
            }
            if let Some(error) = first_error(&summary) {
                out.error(&error);
            }
            if let Some(fresh) = reload(args, &mut live, Duration::ZERO, out) {
                (scenario, options) = fresh;
                out.line(StyledText::default().bold(&scenario.name));
            }
        }
        out.line(StyledText::default().dim("waiting for a change; Ctrl-C ends"));
        (scenario, options) = loop {
            if let Some(fresh) = reload(args, &mut live, TICK, out) {
                break fresh;
            }
        };
    }
}

/// Loads a changed file. If it is broken, reports why and keeps the last good scenario.
fn reload(
    args: &RunArgs,
    live: &mut Live,
    timeout: Duration,
    out: &Out,
) -> Option<(Arc<Scenario>, RunOptions)> {
    let fresh = live.poll(timeout)?.and_then(|fresh| Ok((fresh, options(args, fresh)?)));
    match fresh {
        Ok((fresh, options)) => {
            let problems = crate::probe::probe(fresh, Some(PROBE));
            if !problems.is_empty() {
                out.problems(&problems, &fresh.sources);
            }
            Some((fresh.scenario.clone(), options))
        }
        Err(error) => {
            out.error(&error);
            out.note("the last good scenario goes on");
            None
        }
    }
}
