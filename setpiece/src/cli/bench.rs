//! `setpiece bench`: how fast scenarios are played on this machine.

use super::agent::AgentParser;
use super::common::FINE;
use super::out::{Out, StyledText};
use crate::Error;
use crate::agent::ChosenAgent;
use crate::bench::{
    BenchObservation, BenchOptions, Measured, ONCE_NAMES, measure, once, phases, scaling,
};
use crate::engine::environment::EnvironmentOptions;
use crate::files::{SOURCE_MAX_BYTES, into_text, read_file};
use clap::{Args, ValueEnum, builder::RangedU64ValueParser};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The default scenarios: the game of eleven, a small one, an empty one.
const SCENARIOS: [&str; 3] =
    ["11_vs_11_stochastic", "academy_3_vs_1_with_keeper", "academy_empty_goal_close"];

#[derive(Args, Debug)]
pub(crate) struct BenchArgs {
    /// Scenarios of the library, .pitch or .pitchc files [default: three of the library, of 22, 6
    /// and 3 players]
    #[arg(value_name = "SCENARIO")]
    scenarios: Vec<OsString>,
    /// Numbers of threads, separated by commas [default: 1 and one per core]
    #[arg(short, long, value_name = "N", value_delimiter = ',', value_parser = RangedU64ValueParser::<u16>::new().range(1..=1024))]
    threads: Vec<u16>,
    /// How many matches are stepped together; several numbers separated by commas
    #[arg(short, long, value_name = "N", default_value = "64", value_delimiter = ',', value_parser = RangedU64ValueParser::<u32>::new().range(1..=100_000))]
    matches: Vec<u32>,
    /// How long each line is measured; with warm-up, phases and scaling it takes five to thirteen
    /// times as long
    #[arg(long, value_name = "S", default_value_t = 3.0, value_parser = seconds)]
    seconds: f64,
    /// Who controls the agents
    #[arg(short, long, value_parser = AgentParser, default_value = "random")]
    agent: ChosenAgent,
    /// The observation of the agents after every step
    #[arg(short, long, value_enum, default_value_t = ObservationName::Simple115v2)]
    observation: ObservationName,
    /// The output format
    #[arg(long, value_enum, default_value_t = BenchFormat::Text)]
    format: BenchFormat,
    /// Compare with an earlier output of `--format jsonl` on this machine: the ratio of steps per
    /// CPU-second
    #[arg(long, value_name = "FILE")]
    against: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
enum ObservationName {
    /// GRF's 115 floats
    Simple115v2,
    /// GRF's super mini map, 72 by 96 by 4 bytes
    Smm,
    /// A picture from the stand, 72 by 96 by 3 bytes
    Pixels,
    /// The same in gray, 72 by 96 bytes
    PixelsGray,
    /// Nothing
    None,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum BenchFormat {
    /// A table
    Text,
    /// One JSON object per line, for `--against`
    Jsonl,
}

/// A line of the table.
#[derive(Serialize, Deserialize, Clone, Debug)]
struct BenchRow {
    scenario: String,
    threads: usize,
    matches: usize,
    observation: String,
    agent: String,
    steps_per_second: f64,
    steps_per_cpu_second: f64,
    resets_per_step: f64,
    /// Ratio of steps per CPU-second to those of `--against`, if it has such a row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    ratio: Option<f64>,
    /// The gain over one thread as a share of the gain of bare arithmetic; only with several
    /// threads.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    scaling: Option<f64>,
    /// By phase; only with one thread.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    microseconds: BTreeMap<String, f64>,
    /// The results of [`once`]; only with one thread.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    once_microseconds: BTreeMap<String, f64>,
}

impl BenchRow {
    fn compares_with(&self, other: &BenchRow) -> bool {
        let key = |row: &BenchRow| {
            (
                row.scenario.clone(),
                row.threads,
                row.matches,
                row.observation.clone(),
                row.agent.clone(),
            )
        };
        key(self) == key(other)
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if (0.01..=3600.0).contains(&seconds) => Ok(seconds),
        _ => Err("write a number of seconds, 0.01 to 3600".to_owned()),
    }
}

/// Runs the command.
pub(crate) fn bench(args: &BenchArgs, out: &Out) -> Result<u8, Error> {
    let before = args.against.as_deref().map(read).transpose()?.unwrap_or_default();
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut threads: Vec<usize> = args.threads.iter().copied().map(usize::from).collect();
    if threads.is_empty() {
        threads = if cores == 1 { vec![1] } else { vec![1, cores] };
    }
    let names: Vec<OsString> = if args.scenarios.is_empty() {
        SCENARIOS.map(OsString::from).to_vec()
    } else {
        args.scenarios.clone()
    };
    let loaded = names
        .iter()
        .map(|name| crate::load_with(name, &out.loading()))
        .collect::<Result<Vec<_>, _>>()?;
    let observation = args
        .observation
        .to_possible_value()
        .map_or_else(String::new, |value| value.get_name().to_owned());
    let agent = args.agent.name().to_owned();
    let mut rows = Vec::new();
    for loaded in &loaded {
        out.warnings(loaded);
        for (&threads, &matches) in
            threads.iter().flat_map(|threads| args.matches.iter().map(move |m| (threads, m)))
        {
            let options = BenchOptions {
                matches: matches as usize,
                threads,
                duration: Duration::from_secs_f64(args.seconds),
                agent: args.agent.clone(),
                observation: match args.observation {
                    ObservationName::None => BenchObservation::None,
                    ObservationName::Simple115v2 => BenchObservation::Simple115v2,
                    ObservationName::Smm => BenchObservation::Smm,
                    ObservationName::Pixels => BenchObservation::Pixels,
                    ObservationName::PixelsGray => BenchObservation::PixelsGray,
                },
                seed: 0,
                environment: EnvironmentOptions::default(),
            };
            let measured = measure(&loaded.scenario, &options)?;
            let mut row = row(&loaded.scenario.name, &options, &measured, (&observation, &agent));
            if threads == 1 {
                let phases = phases(&loaded.scenario, &options)?;
                let named = crate::engine::laps::Phase::NAMED.iter().zip(phases);
                row.microseconds = named
                    .map(|((_, name), (_, microseconds))| ((*name).to_owned(), microseconds))
                    .collect();
                let once = ONCE_NAMES.iter().zip(once(&loaded.scenario, &options)?);
                row.once_microseconds =
                    once.map(|(name, took)| ((*name).to_owned(), took)).collect();
            } else {
                row.scaling = Some(scaling(&loaded.scenario, &options)?);
            }
            let earlier = before.iter().find(|earlier| row.compares_with(earlier));
            row.ratio =
                earlier.map(|earlier| row.steps_per_cpu_second / earlier.steps_per_cpu_second);
            if args.format == BenchFormat::Jsonl {
                out.line(serde_json::to_string(&row).unwrap_or_default());
            }
            rows.push(row);
        }
    }
    if args.format == BenchFormat::Text {
        print(&rows, args.against.is_some(), (&observation, &agent), out);
    }
    if let Some(path) = &args.against
        && rows.iter().all(|row| row.ratio.is_none())
    {
        let path = path.display();
        out.note(format!(
            "no row of {path} has the scenario, threads, matches, observation and agent of one measured here"
        ));
    }
    Ok(FINE)
}

fn row(
    scenario: &str,
    options: &BenchOptions,
    measured: &Measured,
    words: (&str, &str),
) -> BenchRow {
    BenchRow {
        scenario: scenario.to_owned(),
        threads: options.threads,
        matches: options.matches,
        observation: words.0.to_owned(),
        agent: words.1.to_owned(),
        steps_per_second: measured.per_second(),
        steps_per_cpu_second: measured.per_cpu_second(),
        resets_per_step: measured.resets as f64 / measured.steps.max(1) as f64,
        ratio: None,
        scaling: None,
        microseconds: BTreeMap::new(),
        once_microseconds: BTreeMap::new(),
    }
}

fn print(rows: &[BenchRow], compared: bool, words: (&str, &str), out: &Out) {
    let (observation, agent) = words;
    out.line(format!("agent {agent} · observation {observation} · resets included"));
    out.line("");
    let width = rows.iter().map(|row| row.scenario.len()).max().unwrap_or(0).max(12);
    let scales = rows.iter().any(|row| row.scaling.is_some());
    let scaling = if scales { "       scaling" } else { "" };
    let against = if compared { "   ratio" } else { "" };
    let head =
        format!("{:width$}  threads  matches  steps/s  steps/CPU-s{scaling}{against}", "scenario");
    out.line(StyledText::default().dim(&head));
    for row in rows {
        let ratio = match row.ratio {
            Some(ratio) => format!("{ratio:>8.2}"),
            None if compared => format!("{:>8}", "–"),
            None => String::new(),
        };
        let scaling = match row.scaling {
            Some(share) => format!("{share:>14.2}"),
            None if scales => " ".repeat(14),
            None => String::new(),
        };
        out.line(format!(
            "{:width$}  {:>7}  {:>7}  {:>7.0}  {:>11.0}{scaling}{ratio}",
            row.scenario, row.threads, row.matches, row.steps_per_second, row.steps_per_cpu_second
        ));
    }
    let alone: Vec<&BenchRow> = rows.iter().filter(|row| row.threads == 1).collect();
    times(
        &alone,
        "µs a step",
        &crate::engine::laps::Phase::NAMED.map(|(_, name)| name),
        |row| &row.microseconds,
        out,
    );
    times(&alone, "µs each time", &ONCE_NAMES, |row| &row.once_microseconds, out);
}

/// A table of microseconds by name.
fn times(
    rows: &[&BenchRow],
    title: &str,
    names: &[&str],
    of: impl Fn(&BenchRow) -> &BTreeMap<String, f64>,
    out: &Out,
) {
    if rows.is_empty() {
        return;
    }
    let width = rows.iter().map(|row| row.scenario.len()).max().unwrap_or(0).max(12);
    out.line("");
    let head: String = names.iter().map(|name| format!("{name:>12}")).collect();
    out.line(StyledText::default().dim(&format!("{title:width$}{head}")));
    for row in rows {
        let time = |name: &&str| format!("{:>12.2}", of(row).get(*name).copied().unwrap_or(0.0));
        out.line(format!("{:width$}{}", row.scenario, names.iter().map(time).collect::<String>()));
    }
}

/// The rows of an earlier run.
fn read(path: &Path) -> Result<Vec<BenchRow>, Error> {
    let text = into_text(read_file(path, SOURCE_MAX_BYTES)?, path)?;
    let row = |line: &str| {
        serde_json::from_str(line).map_err(|why| Error::File {
            path: path.to_owned(),
            why: crate::error::FileFault::Io(format!(
                "it is no table of `setpiece bench --format jsonl`: {why}"
            )),
        })
    };
    text.lines().filter(|line| !line.trim().is_empty()).map(row).collect()
}
