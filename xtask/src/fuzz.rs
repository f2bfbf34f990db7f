//! Fuzzing: builds the targets of `fuzz/` with nightly's coverage counters, runs them, and logs the
//! runs.

use crate::shell::{root, run};
use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Options of the compiler: count edges. Comparisons are not traced: the dictionaries know the
/// words, and tracing takes two thirds of the time.
const FLAGS: &str = "-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
                     -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
                     --cfg fuzzing -Ccodegen-units=1";
/// The total size of a target's kept inputs, bytes, and their number.
const KEPT_MAX: (u64, usize) = (240_000, 400);

/// A target of `fuzz/targets`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Target {
    Compile,
    Script,
    Load,
    Play,
}

impl Target {
    /// The name of its program.
    fn name(self) -> &'static str {
        match self {
            Target::Compile => "compile",
            Target::Script => "script",
            Target::Load => "load",
            Target::Play => "play",
        }
    }

    /// Its longest input, bytes.
    fn max_len(self) -> usize {
        match self {
            Target::Compile => 4096,
            Target::Script => 2048,
            Target::Load => 12_288,
            Target::Play => 512,
        }
    }
}

/// Inputs are picked evenly, and edges are not counted. Most of `compile`'s inputs reach thousands
/// of edges: counting them and weighing how rare they are takes more than half of its time.
const PLAINLY: &[&str] = &["-entropic=0", "-use_counters=0"];

/// Options of `cargo xtask fuzz`.
#[derive(Debug, clap::Args)]
pub(crate) struct FuzzArgs {
    /// Targets; all of them by default
    #[arg(value_enum, value_name = "TARGET")]
    targets: Vec<Target>,
    /// Run each target for this many seconds
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..))]
    seconds: u32,
    /// The seed of the fuzzer
    // 0 would mean another one every time.
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    seed: u32,
    /// Keep the smallest inputs that reach what the seeds don't
    #[arg(long)]
    keep: bool,
}

/// Builds the targets and runs them.
pub(crate) fn fuzz(args: &FuzzArgs) -> Result<(), String> {
    use clap::ValueEnum as _;
    let bins = build()?;
    let commit =
        first_line(Command::new("git").args(["rev-parse", "--short", "HEAD"]).current_dir(root()))?;
    let mut failed = Vec::new();
    let targets = if args.targets.is_empty() { Target::value_variants() } else { &args.targets };
    for target in targets {
        let (target, max_len) = (target.name(), target.max_len());
        let (executions, result) = fuzz_target(&bins.join(target), target, max_len, args)?;
        println!("{target}: {executions} executions in {} s, {result}", args.seconds);
        let line = format!("{},{commit},{target},{},{executions},{result}\n", today(), args.seed);
        let log = File::options().append(true).create(true).open(root().join("fuzz/log.csv"));
        log.and_then(|mut log| log.write_all(line.as_bytes()))
            .map_err(|why| format!("fuzz/log.csv: {why}"))?;
        if ["crash-", "timeout-", "oom-", "leak-", "ended"].iter().any(|sign| result.contains(sign))
        {
            failed.push(format!("{target}: {result}"));
        } else if args.keep {
            keep(&bins.join(target), target, max_len)?;
        }
    }
    if failed.is_empty() {
        Ok(())
    } else {
        Err(format!("{}; see fuzz/artifacts", failed.join("; ")))
    }
}

/// Builds every target; returns the folder of their programs.
fn build() -> Result<PathBuf, String> {
    let version = first_line_with("host: ", Command::new("rustc").args(["+nightly", "-vV"]));
    let host = version.map_err(|why| {
        format!("no nightly ({why}); `rustup toolchain install nightly` brings it")
    })?;
    run(Command::new("cargo")
        .args([
            "+nightly",
            "build",
            "--release",
            "--manifest-path",
            "fuzz/Cargo.toml",
            "--target-dir",
            "fuzz/target",
        ])
        // Named explicitly, so that build scripts and macros are built without the counters.
        .args(["--target", &host])
        .env("RUSTFLAGS", FLAGS)
        .env_remove("CARGO_ENCODED_RUSTFLAGS"))?;
    Ok(root().join("fuzz/target").join(host).join("release"))
}

/// Runs a target; returns how many inputs it tried and what came of it.
fn fuzz_target(
    bin: &Path,
    target: &str,
    max_len: usize,
    args: &FuzzArgs,
) -> Result<(u64, String), String> {
    let (found, seeds) = (folder("target/found", target)?, fresh("target/seeds", target)?);
    let (kept, artifacts) = (folder("corpus", target)?, folder("artifacts", "")?);
    let log = root().join(format!("fuzz/target/{target}.log"));
    println!("{target}: {} s, seed {}; {}", args.seconds, args.seed, log.display());
    let status = fuzzer(bin, target, max_len)?
        .args([&found, &kept, &seeds])
        .arg(format!("-artifact_prefix={}/{target}-", artifacts.display()))
        .arg(format!("-max_total_time={}", args.seconds))
        .arg(format!("-seed={}", args.seed))
        .args(["-report_slow_units=1", "-print_final_stats=1"])
        .env("SETPIECE_FUZZ_SEEDS", &seeds)
        .stderr(File::create(&log).map_err(|why| format!("{}: {why}", log.display()))?)
        .status()
        .map_err(|why| format!("{} can't be run: {why}", bin.display()))?;
    let said =
        String::from_utf8_lossy(&fs::read(&log).map_err(|why| why.to_string())?).into_owned();
    let after = |sign: &'static str| {
        said.lines().filter_map(move |line| Some(line.split_once(sign)?.1.trim()))
    };
    let executions =
        after("stat::number_of_executed_units:").next().and_then(|number| number.parse().ok());
    let written =
        after("Test unit written to ").filter_map(|path| Path::new(path).file_name()?.to_str());
    let written: Vec<&str> = written.collect();
    let result = match (status.success(), written.join(" ")) {
        (true, none) if none.is_empty() => "ok".to_owned(),
        (false, none) if none.is_empty() => format!("ended with {status}"),
        (_, inputs) => inputs,
    };
    Ok((executions.unwrap_or_default(), result))
}

/// Keeps the smallest inputs that reach code which the seeds don't.
fn keep(bin: &Path, target: &str, max_len: usize) -> Result<(), String> {
    let (found, seeds) = (folder("target/found", target)?, folder("target/seeds", target)?);
    let (kept, merged) = (folder("corpus", target)?, fresh("target/merged", target)?);
    let io = |why: std::io::Error| format!("{target}: {why}");
    let mut names = Vec::new();
    for entry in fs::read_dir(&seeds).map_err(io)?.flatten() {
        fs::copy(entry.path(), merged.join(entry.file_name())).map_err(io)?;
        names.push(entry.file_name());
    }
    let log = File::create(root().join(format!("fuzz/target/{target}-merge.log"))).map_err(io)?;
    run(fuzzer(bin, target, max_len)?.arg("-merge=1").args([&merged, &kept, &found]).stderr(log))?;
    let mut inputs: Vec<(u64, PathBuf)> = fs::read_dir(&merged)
        .map_err(io)?
        .flatten()
        .filter(|entry| !names.contains(&entry.file_name()))
        .filter_map(|entry| Some((entry.metadata().ok()?.len(), entry.path())))
        .collect();
    inputs.sort();
    fs::remove_dir_all(&kept).and_then(|()| fs::create_dir(&kept)).map_err(io)?;
    let (mut bytes, mut n) = (0, 0);
    for (len, path) in &inputs {
        bytes += len;
        if bytes > KEPT_MAX.0 || n == KEPT_MAX.1 {
            break;
        }
        if let Some(name) = path.file_name() {
            fs::copy(path, kept.join(name)).map_err(io)?;
            n += 1;
        }
    }
    println!("{target}: {n} of {} inputs kept", inputs.len());
    Ok(())
}

/// A target's program with the arguments of every run.
fn fuzzer(bin: &Path, target: &str, max_len: usize) -> Result<Command, String> {
    let mut command = Command::new(bin);
    command.arg(format!("-max_len={max_len}"));
    command.args(["-timeout=5", "-rss_limit_mb=4096"]).args(PLAINLY);
    let dictionary = root().join(format!("fuzz/dict/{target}.dict"));
    if dictionary.exists() {
        command.arg(format!("-dict={}", dictionary.display()));
    }
    // An empty folder, so that imports find nothing.
    command.current_dir(fresh("target/empty", "")?).stdin(Stdio::null());
    Ok(command)
}

/// A folder of `fuzz/`, created if necessary.
fn folder(kind: &str, target: &str) -> Result<PathBuf, String> {
    let path = root().join("fuzz").join(kind).join(target);
    fs::create_dir_all(&path)
        .and_then(|()| path.canonicalize())
        .map_err(|why| format!("{}: {why}", path.display()))
}

/// The same, emptied.
fn fresh(kind: &str, target: &str) -> Result<PathBuf, String> {
    let path = folder(kind, target)?;
    fs::remove_dir_all(&path).map_err(|why| format!("{}: {why}", path.display()))?;
    folder(kind, target)
}

fn first_line(command: &mut Command) -> Result<String, String> {
    first_line_with("", command)
}

/// The rest of the first line that begins with a sign.
fn first_line_with(sign: &str, command: &mut Command) -> Result<String, String> {
    let output = command.output().map_err(|why| why.to_string())?;
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    match said.lines().find_map(|line| line.strip_prefix(sign)) {
        Some(line) if output.status.success() => Ok(line.trim().to_owned()),
        _ => Err(String::from_utf8_lossy(&output.stderr).trim().to_owned()),
    }
}

/// The date, `2026-01-31`, by the proleptic Gregorian calendar in UTC.
fn today() -> String {
    let since =
        std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default();
    // Days since 1 March of year 0; the leap day is then the last day of a year.
    let days = since.as_secs() / 86_400 + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let (date, month) =
        (day - (153 * month + 2) / 5 + 1, if month < 10 { month + 3 } else { month - 9 });
    format!("{:04}-{month:02}-{date:02}", era * 400 + year + u64::from(month < 3))
}
