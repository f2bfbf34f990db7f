//! `setpiece run`: plays episodes of a scenario, once or whenever its file changes.

use super::out::{Out, StyledText};
use super::{FAULT, FINE, playing::Playing, summary};
use crate::engine::environment::EnvironmentOptions;
use crate::live::Live;
use crate::run::{RunOptions, Summary, first_error, run};
use crate::scenario::Scenario;
use crate::{Error, Loaded};
use clap::{Args, ValueEnum, builder::RangedU64ValueParser};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
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
