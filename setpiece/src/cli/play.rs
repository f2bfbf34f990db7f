//! `setpiece run`: plays episodes of a scenario, once or whenever its file changes.

use super::agent::AgentParser;
use super::common::{FAULT, FINE, TICK};
use super::live::live;
use super::out::{Out, StyledText};
use super::suite::run_suite;
use super::{
    playing::{Playing, ThreadsArg},
    summary,
};
use crate::agent::ChosenAgent;
#[cfg(feature = "render")]
use crate::curves::curves;
use crate::dsl::problem::{Code, nearest};
use crate::engine::environment::{Environment, EnvironmentOptions};
#[cfg(feature = "render")]
use crate::error::FileFault;
#[cfg(feature = "render")]
use crate::files::{refuse_overwriting, write};
use crate::live::Live;
use crate::plans::{LoadedPlans, library_plans, load_plans};
#[cfg(feature = "render")]
use crate::plot;
use crate::run::faults::faulty_terms;
use crate::run::{RunOptions, Summary, first_error, run, summarise};
use crate::scenario::plan::{PlannedEpisodes, Plans, Played, Suite};
use crate::scenario::{Bindings, Scenario};
use crate::suite::refuse_unplayable;
use crate::{Error, Loaded};
use clap::{Args, ValueEnum, builder::RangedU64ValueParser};
use std::ffi::OsStr;
use std::path::Path;
#[cfg(feature = "render")]
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// Episodes, unless others are asked for.
const EPISODES: u64 = 20;
/// Time that a reload may spend on the dry run.
const PROBE: Duration = Duration::from_millis(10);

#[derive(Args, Debug)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    playing: Playing,
    /// The number of episodes [default: 20]
    #[arg(short = 'n', long, value_name = "N", conflicts_with = "level", value_parser = RangedU64ValueParser::<u64>::new().range(1..=1_000_000))]
    episodes: Option<u64>,
    /// Pay this reward instead of the scenario's own; may be repeated or separated by commas
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    reward: Vec<String>,
    #[command(flatten)]
    threads: ThreadsArg,
    /// The output format
    #[arg(long, value_enum, default_value_t = RunFormat::Text)]
    pub(crate) format: RunFormat,
    /// A second agent that plays the same episodes, for a table of both
    #[arg(long, value_parser = AgentParser, value_name = "AGENT", conflicts_with_all = ["watch", "live", "level"])]
    beside: Option<ChosenAgent>,
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
    /// A table: comma-separated values, one line per entry and agent
    Csv,
    /// A table in Markdown
    Md,
}

impl RunArgs {
    /// The agents of a table.
    pub(crate) fn agents(&self) -> Vec<ChosenAgent> {
        [Some(self.playing.agent()), self.beside.clone()].into_iter().flatten().collect()
    }

    /// How many threads play.
    pub(crate) fn threads(&self) -> usize {
        self.threads.count()
    }

    /// The rewards that are paid instead of the scenarios' own.
    pub(crate) fn rewards(&self) -> Option<Vec<String>> {
        (!self.reward.is_empty()).then(|| self.reward.clone())
    }

    fn episodes(&self) -> u64 {
        self.episodes.unwrap_or(EPISODES)
    }

    /// The option that a suite has no use for, if one is given.
    fn foreign_to_suites(&self) -> Option<&'static str> {
        let is_plotted = {
            #[cfg(feature = "render")]
            {
                self.plot.is_some()
            }
            #[cfg(not(feature = "render"))]
            {
                false
            }
        };
        let given = [
            (self.episodes.is_some(), "--episodes"),
            (self.watch, "--watch"),
            (self.live, "--live"),
            (is_plotted, "--plot"),
        ];
        let own = given.into_iter().find(|(given, _)| *given).map(|(_, name)| name);
        own.or_else(|| self.playing.foreign_to_suites())
    }
}

/// Runs the command.
pub(crate) fn run_command(args: &RunArgs, out: &Out) -> Result<u8, Error> {
    if args.watch {
        return watch(args, out);
    }
    let loaded = match args.playing.load(out.loading()) {
        Ok(loaded) => loaded,
        Err(error) if args.playing.level.is_some() => return Err(error),
        Err(error) => {
            let (source, wanted) = (args.playing.source(), args.playing.wanted());
            return run_plans(&plans_of(source, wanted, error, out)?, args, out);
        }
    };
    out.warnings(&loaded);
    let options = options(args, &loaded)?;
    if args.beside.is_some() || matches!(args.format, RunFormat::Csv | RunFormat::Md) {
        if args.playing.level.is_some() {
            let help = "write `--format json` or `--format text`";
            out.fault(
                &Code::NoPlans.to_string(),
                "a level is one episode, not a table",
                Some(help),
            );
            return Ok(FAULT);
        }
        return table(&loaded, &options, args, out);
    }
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
    if args.format == RunFormat::Json {
        out.line(summary::json(&loaded.scenario, &options, &summary));
    } else {
        summary::print(&loaded.scenario, &options, &summary, out)?;
        other_plans(args, out);
    }
    if let Some(error) = first_error(&summary) {
        out.error(&error);
        return Ok(FAULT);
    }
    Ok(FINE)
}

/// Says which suites stand in the file of a scenario that was played without being named.
fn other_plans(args: &RunArgs, out: &Out) {
    if args.playing.wanted().is_some() || args.playing.level.is_some() {
        return;
    }
    let Ok(loaded) = load_plans(Path::new(args.playing.source()), &out.loading()) else { return };
    let names: Vec<_> = loaded.plans.suites.iter().map(|it| it.name.as_str()).collect();
    if let [name, ..] = names[..] {
        let (s, it) = if names.len() == 1 { ("", "it") } else { ("s", "one") };
        let all = names.join("`, `");
        out.note(format!("the file has the suite{s} `{all}` too: `--scenario {name}` plays {it}"));
    }
}

/// The plans that a name stands for; the error is why it stands for no scenario. `wanted`: which
/// plan of a file, if not all.
pub(super) fn plans_of(
    name: &OsStr,
    wanted: Option<&str>,
    error: Error,
    out: &Out,
) -> Result<Plans, Error> {
    let mut library = library_plans()?.suites;
    if let Some(at) = library.iter().position(|suite| name == suite.name.as_str()) {
        return Ok(Plans { suites: vec![library.swap_remove(at)], ..Plans::default() });
    }
    match error {
        Error::Unknown { name, similar: None } => {
            let similar = nearest(&name, library.iter().map(|suite| suite.name.as_str()));
            Err(Error::Unknown { similar: similar.map(str::to_owned), name })
        }
        Error::Compile(failure) if failure.lacks_scenario() => {
            match load_plans(Path::new(name), &out.loading()) {
                Ok(LoadedPlans { mut plans, .. }) => {
                    plans.suites.retain(|it| wanted.is_none_or(|name| it.name == name));
                    plans.curricula.retain(|it| wanted.is_none_or(|name| it.name == name));
                    let has_some = !plans.suites.is_empty() || !plans.curricula.is_empty();
                    if has_some { Ok(plans) } else { Err(Error::Compile(failure)) }
                }
                // With suites no scenario is needed: what is wrong is something else.
                Err(Error::Compile(wrong)) if !wrong.lacks_scenario() => Err(Error::Compile(wrong)),
                _ => Err(Error::Compile(failure)),
            }
        }
        error => Err(error),
    }
}

/// Whether suites can be played: false, with a report, for a curriculum alone, which a training
/// plays, and with an option that suites have no use for.
pub(super) fn has_suites(plans: &Plans, foreign: Option<&str>, out: &Out) -> bool {
    if let ([], Some(curriculum)) = (&plans.suites[..], plans.curricula.first()) {
        let name = &curriculum.name;
        let message = format!("`{name}` is a curriculum, which a training plays");
        let help = format!("in Python: `setpiece.make_vec(SCENARIO, 64, levels=\"{name}\")`");
        out.fault(&Code::NoPlans.to_string(), &message, Some(&help));
        return false;
    }
    if let Some(option) = foreign {
        let message =
            format!("`{option}` has no effect on a suite: its entries say what is played");
        out.fault(&Code::NoPlans.to_string(), &message, Some("leave it out, or run a scenario"));
        return false;
    }
    true
}

/// Plays all suites.
fn run_plans(plans: &Plans, args: &RunArgs, out: &Out) -> Result<u8, Error> {
    if !has_suites(plans, args.foreign_to_suites(), out) {
        return Ok(FAULT);
    }
    let environment = EnvironmentOptions {
        rewards: args.rewards(),
        physics: args.playing.physics(),
        ..EnvironmentOptions::default()
    };
    let entries: Vec<_> = plans.suites.iter().flat_map(|suite| suite.entries.clone()).collect();
    refuse_unplayable(&entries, &environment, &args.agents())?;
    for suite in &plans.suites {
        run_suite(suite, &environment, args, out)?;
    }
    Ok(FINE)
}

/// Plays a scenario as the one entry of a table.
fn table(loaded: &Loaded, options: &RunOptions, args: &RunArgs, out: &Out) -> Result<u8, Error> {
    let scenario = loaded.scenario.clone();
    let bindings = options.environment.bindings.clone();
    let bindings = bindings.unwrap_or_else(|| Bindings::defaults(&scenario.params));
    let suite = Suite {
        name: scenario.name.clone(),
        doc: scenario.doc.clone(),
        entries: vec![PlannedEpisodes {
            played: Played { scenario, bindings },
            count: args.episodes(),
            seed: options.seed,
        }],
    };
    run_suite(&suite, &options.environment, args, out)
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
    let first = args.playing.episode(0);
    let last = if args.playing.level.is_some() { first + 1 } else { args.episodes() };
    Ok(RunOptions {
        episodes: first..last,
        seed: args.playing.seed(),
        agent: args.playing.agent(),
        threads: args.threads(),
        environment: EnvironmentOptions {
            rewards: args.rewards(),
            ..args.playing.environment(loaded)?
        },
    })
}

fn with_progress(loaded: &Loaded, options: &RunOptions) -> Result<Summary, Error> {
    let episodes = options.episodes.end - options.episodes.start;
    let bar =
        super::common::bar(episodes, "{bar:40} {pos}/{len} episodes  {msg} steps  {eta} left");
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
    let source = args.playing.source();
    let mut live = match Live::open_scenario(source, args.playing.wanted(), out.allow_outside) {
        Ok(live) => live,
        Err(error) if args.playing.level.is_some() => return Err(args.playing.explained(error)),
        Err(error) => {
            return run_plans(&plans_of(source, args.playing.wanted(), error, out)?, args, out);
        }
    };
    out.warnings(live.loaded());
    if !live.is_watching() {
        let name = source.to_string_lossy();
        out.fault("SP0001", &format!("`{name}` is no file: there is nothing to watch"), None);
        return Ok(FAULT);
    }
    let mut options = options(args, live.loaded())?;
    let mut scenario = live.loaded().scenario.clone();
    out.line(StyledText::default().bold(&scenario.name));
    'changed: loop {
        // Those since the last change, and whether a fault among them was reported.
        let (mut played, mut is_reported) = (Vec::new(), false);
        for index in options.episodes.clone() {
            let one = RunOptions { episodes: index..index + 1, threads: 1, ..options.clone() };
            let summary = run(&scenario, &one, |_| {})?;
            for episode in summary.episodes.iter().flatten() {
                out.line(summary::episode_line(episode));
            }
            if let Some(error) = first_error(&summary)
                && !std::mem::replace(&mut is_reported, true)
            {
                out.error(&error);
            }
            played.extend(summary.episodes);
            if let Some(fresh) = reload(args, &mut live, Duration::ZERO, out) {
                (scenario, options) = fresh;
                continue 'changed;
            }
        }
        if played.iter().any(Result::is_ok) {
            let environment = Environment::new(scenario.clone(), options.environment.clone())
                .map_err(Error::Environment)?;
            let summary = summarise(played, &environment, 0.0);
            let faulty = faulty_terms(&scenario, &options, &summary)?;
            let width = summary::outcomes(&scenario, &summary, out);
            summary::means(&summary, &faulty, width, out);
            summary::unclear(&scenario, &options, width, out)?;
        }
        out.line(StyledText::default().dim("waiting for a change; Ctrl-C ends"));
        let mut is_missing = false;
        (scenario, options) = loop {
            if let Some(fresh) = reload(args, &mut live, TICK, out) {
                break fresh;
            }
            let missing = live.missing();
            if let Some(path) = missing.filter(|_| !is_missing) {
                out.note(format!("`{}` is gone: waiting for it to come back", path.display()));
            }
            is_missing = missing.is_some();
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
            let name = StyledText::default().bold(&fresh.scenario.name);
            out.line(name.dim("  changed; played from here on"));
            Some((fresh.scenario.clone(), options))
        }
        Err(error) => {
            out.error(&error);
            out.note("the last good scenario goes on");
            None
        }
    }
}
