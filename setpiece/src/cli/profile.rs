//! `setpiece profile`: what an agent has learned, as a page.

use super::agent::AgentParser;
use super::common::{FAULT, FINE};
use super::out::Out;
use super::play::{has_suites, plans_of};
use super::playing::{PlayedArgs, ThreadsArg};
use crate::Error;
use crate::agent::ChosenAgent;
use crate::dsl::problem::Code;
use crate::engine::environment::EnvironmentOptions;
use crate::files::{refuse_overwriting, write};
use crate::profile::{Profile, ProfileOptions, figures, page, profile, suite_page};
use crate::scenario::plan::{PlannedEpisodes, Plans};
use crate::suite::refuse_unplayable;
use clap::{Args, builder::RangedU64ValueParser};
use indicatif::ProgressBar;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
pub(crate) struct ProfileArgs {
    /// Who plays
    #[arg(value_name = "AGENT", value_parser = AgentParser)]
    agent: ChosenAgent,
    #[command(flatten)]
    what: PlayedArgs,
    /// Where to write it: .html for a page, .json for its figures
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// The number of episodes [default: 200]
    #[arg(short = 'n', long, value_name = "N", conflicts_with = "level", value_parser = RangedU64ValueParser::<u64>::new().range(1..=100_000))]
    episodes: Option<u64>,
    #[command(flatten)]
    threads: ThreadsArg,
}

/// Episodes, unless others are asked for.
const EPISODES: u64 = 200;

/// Plays the episodes and writes the page.
pub(crate) fn profile_command(args: &ProfileArgs, out: &Out) -> Result<u8, Error> {
    let path = &args.output;
    let is_known = |ending: &OsStr| ending == "html" || ending == "json";
    if !path.extension().is_some_and(is_known) {
        let message = format!("a profile is written as HTML or JSON, not as `{}`", path.display());
        let help = format!("name it `{}`", path.with_extension("html").display());
        out.fault(&Code::NoPicture.to_string(), &message, Some(&help));
        return Ok(FAULT);
    }
    let what = &args.what;
    let loaded = match what.load(out.loading()) {
        Ok(loaded) => loaded,
        Err(error) if what.level.is_some() => return Err(error),
        Err(error) => {
            let plans = plans_of(what.source(), what.wanted(), error, out)?;
            return profile_suite(&plans, args, out);
        }
    };
    out.warnings(&loaded);
    refuse_overwriting(path, &loaded.inputs)?;
    let first = what.episode(0);
    let n = if what.level.is_some() { 1 } else { args.episodes.unwrap_or(EPISODES) };
    let options = ProfileOptions {
        agent: args.agent.clone(),
        episodes: first..first + n,
        seed: what.seed(),
        threads: args.threads.count(),
        environment: what.environment(&loaded)?,
    };
    let found = with_progress(n, |bar| profile(&loaded.scenario, &options, || bar.inc(1)))?;
    if is_json(path) {
        write(path, figures(&found).to_string())?;
    } else {
        write(path, page(&found))?;
    }
    out.line(format!("{} → {}", about(&found), path.display()));
    Ok(FINE)
}

/// Plays the entries of a suite and writes one page of all.
fn profile_suite(plans: &Plans, args: &ProfileArgs, out: &Out) -> Result<u8, Error> {
    let own = args.episodes.is_some().then_some("--episodes");
    if !has_suites(plans, own.or_else(|| args.what.foreign_to_suites()), out) {
        return Ok(FAULT);
    }
    let suites: Vec<&str> = plans.suites.iter().map(|suite| suite.name.as_str()).collect();
    let entries: Vec<_> = plans.suites.iter().flat_map(|suite| &suite.entries).cloned().collect();
    refuse_overwriting(&args.output, &[])?;
    let environment =
        EnvironmentOptions { physics: args.what.physics(), ..EnvironmentOptions::default() };
    refuse_unplayable(&entries, &environment, std::slice::from_ref(&args.agent))?;
    let total = entries.iter().map(|entry| entry.count).sum();
    let found = with_progress(total, |bar| {
        let one = |entry: &PlannedEpisodes| {
            let bindings = Some(entry.played.bindings.clone());
            let options = ProfileOptions {
                agent: args.agent.clone(),
                episodes: 0..entry.count,
                seed: entry.seed,
                threads: args.threads.count(),
                environment: EnvironmentOptions { bindings, ..environment.clone() },
            };
            let found = profile(&entry.played.scenario, &options, || bar.inc(1))?;
            Ok(Profile { scenario: entry.played.label(), ..found })
        };
        entries.iter().map(one).collect::<Result<Vec<_>, Error>>()
    })?;
    let name = suites.join(", ");
    if is_json(&args.output) {
        let entries: Vec<_> = found.iter().map(figures).collect();
        write(&args.output, serde_json::json!({ "suite": name, "entries": entries }).to_string())?;
    } else {
        write(&args.output, suite_page(&name, &found))?;
    }
    for found in &found {
        out.line(about(found));
    }
    out.line(format!("→ {}", args.output.display()));
    Ok(FINE)
}

fn is_json(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "json")
}

fn with_progress<T>(
    episodes: u64,
    play: impl FnOnce(&ProgressBar) -> Result<T, Error>,
) -> Result<T, Error> {
    let bar = super::common::bar(episodes, "{bar:40} {pos}/{len} episodes  {eta} left");
    let found = play(&bar);
    bar.finish_and_clear();
    found
}

/// What was counted, as a line.
fn about(found: &Profile) -> String {
    let (touches, passes, shots) = (found.touches.len(), found.passes.len(), found.shots.len());
    format!(
        "{} in {}: {} episodes, {touches} touches, {passes} passes, {shots} shots",
        found.agent, found.scenario, found.episodes,
    )
}
