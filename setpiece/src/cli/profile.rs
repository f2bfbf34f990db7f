//! `setpiece profile`: what an agent has learned, as a page.

use super::agent::AgentParser;
use super::common::{FAULT, FINE};
use super::out::Out;
use crate::Error;
use crate::agent::ChosenAgent;
use crate::dsl::problem::Code;
use crate::engine::environment::EnvironmentOptions;
use crate::files::{refuse_overwriting, write};
use crate::profile::{ProfileOptions, page, profile};
use clap::{Args, builder::RangedU64ValueParser};
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct ProfileArgs {
    /// Who plays
    #[arg(value_name = "AGENT", value_parser = AgentParser)]
    agent: ChosenAgent,
    /// A scenario of the library, a .pitch file or a compiled .pitchc file
    #[arg(value_name = "SCENARIO")]
    scenario: OsString,
    /// Where to write the page
    #[arg(short, long, value_name = "OUT.html")]
    output: PathBuf,
    /// The number of episodes
    #[arg(short = 'n', long, value_name = "N", default_value_t = 200, value_parser = RangedU64ValueParser::<u64>::new().range(1..=100_000))]
    episodes: u64,
    /// The seed; the same seed gives the same episodes
    #[arg(short, long, value_name = "S", default_value_t = 0, allow_negative_numbers = true)]
    seed: u64,
}

/// Plays the episodes and writes the page.
pub(crate) fn profile_command(args: &ProfileArgs, out: &Out) -> Result<u8, Error> {
    let path = &args.output;
    if path.extension().is_none_or(|ending| ending != "html") {
        let message = format!("a profile is written as HTML, not as `{}`", path.display());
        let help = format!("name it `{}`", path.with_extension("html").display());
        out.fault(&Code::NoPicture.to_string(), &message, Some(&help));
        return Ok(FAULT);
    }
    let loaded = crate::load_with(&args.scenario, &out.loading())?;
    out.warnings(&loaded);
    refuse_overwriting(path, &loaded.inputs)?;
    let options = ProfileOptions {
        agent: args.agent.clone(),
        episodes: args.episodes,
        seed: args.seed,
        environment: EnvironmentOptions::default(),
    };
    let bar = super::common::bar(args.episodes, "{bar:40} {pos}/{len} episodes  {eta} left");
    let found = profile(&loaded.scenario, &options, || bar.inc(1));
    bar.finish_and_clear();
    let found = found?;
    write(path, page(&found))?;
    let (touches, passes, shots) = (found.touches.len(), found.passes.len(), found.shots.len());
    out.line(format!(
        "{} in {}: {} episodes, {touches} touches, {passes} passes, {shots} shots → {}",
        found.agent,
        found.scenario,
        found.episodes,
        path.display()
    ));
    Ok(FINE)
}
