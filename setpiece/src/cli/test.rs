//! `setpiece test`: plays the checks of files and says which hold.

use super::agent::AgentParser;
use super::common::{FAULT, FINE};
use super::out::{Out, StyledText};
use super::playing::ThreadsArg;
use crate::Error;
use crate::agent::ChosenAgent;
use crate::drawing::Paint;
use crate::dsl::problem::Code;
use crate::engine::control::agents::Agent;
use crate::engine::environment::EnvironmentOptions;
use crate::evaluate::{JudgedExpectation, bindings, judge, play, record};
use crate::files::{pitch_files, refuse_folder};
use crate::level::Level;
use crate::measure::shown;
use crate::plans::load_plans;
use crate::scenario::plan::Check;
use clap::{Args, ValueEnum};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Where the worst episodes are written, unless another folder is named.
const FAILED: &str = "failed-checks";

#[derive(Args, Debug)]
pub(crate) struct TestArgs {
    /// .pitch files, or folders of them
    #[arg(value_name = "FILE", default_value = ".")]
    files: Vec<PathBuf>,
    /// Only the checks whose words contain this
    #[arg(long, value_name = "TEXT")]
    filter: Option<String>,
    /// Who plays, instead of the agent that a check names
    #[arg(short, long, value_parser = AgentParser)]
    agent: Option<ChosenAgent>,
    #[command(flatten)]
    threads: ThreadsArg,
    /// The output format
    #[arg(long, value_enum, default_value_t = TestFormat::Text)]
    format: TestFormat,
    /// Where the worst episodes of failed checks are written [default: failed-checks]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum TestFormat {
    /// A list
    Text,
    /// One JSON object per check and line
    Json,
    /// XML as CI systems read it
    Junit,
}

/// A check that was played.
#[derive(serde::Serialize)]
struct PlayedCheck {
    file: String,
    check: String,
    agent: String,
    episodes: u64,
    seed: u64,
    seconds: f64,
    holds: bool,
    expectations: Vec<PlayedExpectation>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

/// An expectation, and what was measured.
#[derive(serde::Serialize)]
struct PlayedExpectation {
    expectation: String,
    holds: bool,
    /// Whether the bound lies inside the interval.
    unsure: bool,
    #[serde(flatten)]
    measured: Option<crate::measure::Estimate>,
    #[serde(skip)]
    shown: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    worst: Option<Worst>,
}

/// The episode that speaks most against an expectation.
#[derive(serde::Serialize)]
struct Worst {
    level: String,
    replay: PathBuf,
}

/// Runs the command.
pub(crate) fn test(args: &TestArgs, out: &Out) -> Result<u8, Error> {
    if let Some(agent) = &args.agent {
        agent.check()?;
    }
    // Checks that hold write nothing: the usual folder needn't be writable.
    if let Some(folder) = &args.output {
        refuse_folder(folder)?;
    }
    let (mut played, mut broken) = (Vec::new(), false);
    let mut taken = BTreeSet::new();
    for path in texts(&args.files)? {
        let loaded = match load_plans(&path, &out.loading()) {
            Ok(loaded) => loaded,
            // Rewards and formations alone are no scenario, and have no checks.
            Err(Error::Compile(failure)) if failure.is_without_scenario() => continue,
            Err(error) => {
                out.error(&error);
                broken = true;
                continue;
            }
        };
        for check in &loaded.plans.checks {
            let wanted = args.filter.as_ref().is_none_or(|filter| check.name.contains(filter));
            if wanted {
                let result = one(args, &path, check, &free_name(&path, check, &mut taken))?;
                if args.format != TestFormat::Junit {
                    print(&result, args.format, out);
                }
                played.push(result);
            }
        }
    }
    let failed = played.iter().filter(|check| !check.holds).count();
    match args.format {
        TestFormat::Junit => out.text(&*junit(&played)),
        TestFormat::Text if !played.is_empty() => {
            let noun = if played.len() == 1 { "check" } else { "checks" };
            let seconds: f64 = played.iter().map(|check| check.seconds).sum();
            out.line(format!("{} {noun}, {failed} failed, {seconds:.1} s", played.len()));
        }
        _ => {}
    }
    if played.is_empty() && !broken {
        let message = match &args.filter {
            Some(filter) => format!("no check here has `{filter}` in its words"),
            None => "no check is here".to_owned(),
        };
        let help = "write one: `check \"it can be scored\" { play my_drill for 50 episodes  expect success_rate > 50% }`";
        out.fault(&Code::NoPlans.to_string(), &message, Some(help));
        return Ok(FAULT);
    }
    Ok(if failed > 0 || broken { FAULT } else { FINE })
}

/// The files, with those of folders.
fn texts(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Error> {
    let lists = paths
        .iter()
        .map(|path| if path.is_dir() { pitch_files(path) } else { Ok(vec![path.clone()]) });
    Ok(lists.collect::<Result<Vec<_>, _>>()?.concat())
}

/// What the replays of a check are called: by its file and words, and a number if that is taken.
fn free_name(path: &Path, check: &Check, taken: &mut BTreeSet<String>) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let first = format!("{}-{}", slug(&stem), slug(&check.name));
    let more = (2..).map(|nth: u32| format!("{first}-{nth}"));
    let mut names = std::iter::once(first.clone()).chain(more);
    names.find(|name| taken.insert(name.clone())).unwrap_or(first)
}

/// Plays a check.
///
/// - `name`: what its replays are called.
fn one(args: &TestArgs, path: &Path, check: &Check, name: &str) -> Result<PlayedCheck, Error> {
    let named = ChosenAgent::from_name(&check.agent).unwrap_or(Agent::Bot.into());
    let agent = args.agent.clone().unwrap_or(named);
    let begin = Instant::now();
    let bar =
        super::common::bar(check.episodes.count, "{msg} {bar:40} {pos}/{len} episodes  {eta} left");
    bar.set_message(check.name.clone());
    let results = play(
        &check.episodes,
        &EnvironmentOptions::default(),
        &agent,
        check.over_params,
        args.threads.count(),
        || bar.inc(1),
    );
    bar.finish_and_clear();
    let mut played = PlayedCheck {
        file: path.display().to_string(),
        check: check.name.clone(),
        agent: args
            .agent
            .as_ref()
            .map_or_else(|| check.agent.clone(), |agent| agent.name().to_owned()),
        episodes: check.episodes.count,
        seed: check.episodes.seed,
        seconds: begin.elapsed().as_secs_f64(),
        holds: false,
        expectations: Vec::new(),
        error: None,
    };
    let results = match results {
        Ok(results) => results,
        Err(error) => {
            played.error = Some(error.to_string());
            return Ok(played);
        }
    };
    let judged = judge(check, &results);
    played.holds = judged.iter().all(|judged| judged.holds);
    for judged in judged {
        played.expectations.push(expectation(args, (check, name), &agent, judged)?);
    }
    Ok(played)
}

fn expectation(
    args: &TestArgs,
    (check, name): (&Check, &str),
    agent: &ChosenAgent,
    judged: JudgedExpectation<'_>,
) -> Result<PlayedExpectation, Error> {
    let goal = &judged.expectation.goal;
    let worst = match judged.worst {
        Some(index) if !judged.holds => Some(keep(args, (check, name), agent, index)?),
        _ => None,
    };
    let measured = judged.measured;
    Ok(PlayedExpectation {
        expectation: judged.expectation.text.clone(),
        holds: judged.holds,
        unsure: measured.is_some_and(|measured| measured.is_unsure_of(goal.bound)),
        shown: measured.map_or_else(
            || "no episode has this number".to_owned(),
            |it| shown(&goal.measure, &it),
        ),
        measured,
        worst,
    })
}

/// Writes an episode of a check beside its level.
fn keep(
    args: &TestArgs,
    (check, name): (&Check, &str),
    agent: &ChosenAgent,
    index: u64,
) -> Result<Worst, Error> {
    let episodes = &check.episodes;
    let replay = record(episodes, &EnvironmentOptions::default(), agent, check.over_params, index)?;
    let folder = args.output.as_deref().unwrap_or(Path::new(FAILED));
    let path = folder.join(format!("{name}-{index}.pitchr"));
    std::fs::create_dir_all(folder).map_err(|why| Error::File {
        path: folder.to_owned(),
        why: crate::error::FileFault::Write(why.to_string()),
    })?;
    crate::files::write(&path, replay.to_bytes()?)?;
    let bindings = bindings(episodes, check.over_params, index);
    let level = Level::of(&episodes.played.scenario, &bindings, episodes.seed, index);
    Ok(Worst { level: level.to_string(), replay: path })
}

/// A file's name from a sentence.
fn slug(words: &str) -> String {
    let kept = words.chars().map(|c| if c.is_alphanumeric() { c } else { '-' });
    let joined: String = kept.collect::<String>().to_lowercase();
    let parts: Vec<&str> = joined.split('-').filter(|part| !part.is_empty()).collect();
    parts.join("-").chars().take(80).collect()
}

fn print(check: &PlayedCheck, format: TestFormat, out: &Out) {
    if format == TestFormat::Json {
        out.line(serde_json::to_string(check).unwrap_or_default());
        return;
    }
    let (sign, paint) = if check.holds { ("✓", Paint::Success) } else { ("✗", Paint::Failure) };
    let about = format!(
        "  {}  {} episodes, {}, {:.1} s",
        check.file, check.episodes, check.agent, check.seconds
    );
    out.line(StyledText::default().paint(sign, paint).text(" ").bold(&check.check).dim(&about));
    if let Some(error) = &check.error {
        out.line(StyledText::from("    ").paint(error, Paint::Failure));
    }
    for expectation in &check.expectations {
        let paint = if expectation.holds { Paint::Plain } else { Paint::Failure };
        let mut line = StyledText::from("    ")
            .paint(&format!("{:40}", expectation.expectation), paint)
            .text("  ")
            .text(&expectation.shown);
        if expectation.unsure {
            line = line.dim("  the bound lies inside the interval: play more episodes");
        }
        out.line(line);
        if let Some(worst) = &expectation.worst {
            out.line(format!("      worst: {}", worst.level));
            out.line(format!("      see it: setpiece studio {}", worst.replay.display()));
        }
    }
}

/// The checks as test cases in XML.
fn junit(checks: &[PlayedCheck]) -> String {
    let failed = checks.iter().filter(|check| !check.holds).count();
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"setpiece\" tests=\"{}\" failures=\"{failed}\">\n",
        checks.len()
    );
    for check in checks {
        xml += &format!(
            "  <testcase classname=\"{}\" name=\"{}\" time=\"{:.3}\"",
            escaped(&check.file),
            escaped(&check.check),
            check.seconds
        );
        if check.holds {
            xml += "/>\n";
            continue;
        }
        let lines = check.expectations.iter().filter(|it| !it.holds).map(|it| {
            let worst = it.worst.as_ref().map_or(String::new(), |worst| {
                format!("; worst: {}, {}", worst.level, worst.replay.display())
            });
            format!("expected {}, measured {}{worst}", it.expectation, it.shown)
        });
        let lines: Vec<String> = check.error.iter().cloned().chain(lines).collect();
        xml +=
            &format!(">\n    <failure>{}</failure>\n  </testcase>\n", escaped(&lines.join("\n")));
    }
    xml + "</testsuite>\n"
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    // XML has no other control characters.
    text.replace('"', "&quot;").replace(|c: char| c.is_control() && c != '\n', "\u{FFFD}")
}
