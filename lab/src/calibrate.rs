//! The report: every figure with its limits and verdict.

use crate::figure::Section;
use crate::pitch::Failure;
use crate::{agents, ball, hands, matches, movement};
use std::fmt::Write as _;
use std::path::PathBuf;

/// Figures that lie outside and why that is right.
const EXPLAINED: &[(u32, &str)] = &[
    (234, "their runner breaks stride at his second touch of the ball; ours runs on"),
    (257, "he follows the ball round the turn, and the ball comes round at its own next touch"),
    (421, "our teams build up a little longer; the thirds beside it are inside"),
    (447, "as C-421"),
];

/// What is asked for.
#[derive(Default)]
struct Options {
    check: bool,
    only: Option<u16>,
    count: Option<u64>,
}

/// Runs `calibrate [--check] [--only SECTION] [--count N]`.
pub(crate) fn calibrate(args: &[String]) -> Result<(), Failure> {
    let options = options(args)?;
    let wanted = |number: u16| options.only.is_none_or(|only| only == number);
    let mut sections = Vec::new();
    for number in [2, 3, 4, 5, 6, 7] {
        if !wanted(number) {
            continue;
        }
        let section = match number {
            2 => movement::measure(),
            3 => ball::measure(),
            4 => matches::measure(options.count),
            5 => agents::measure(options.count),
            6 => hands::measure(options.count),
            _ => matches::ladder(options.count),
        }?;
        print!("{}", section.markdown(explanation));
        println!();
        sections.push(section);
    }
    if options.only.is_none() && options.count.is_none() {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/calibration.md");
        std::fs::write(&path, report(&sections)).map_err(|why| format!("{}: {why}", path.display()))?;
    }
    verdict(&sections, options.check)
}

fn options(args: &[String]) -> Result<Options, Failure> {
    let mut options = Options::default();
    let mut args = args.iter();
    while let Some(arg) = args.next() {
        let mut number = || args.next().and_then(|n| n.parse::<u64>().ok()).ok_or(format!("`{arg}` wants a number"));
        match arg.as_str() {
            "--check" => options.check = true,
            "--only" => options.only = Some(number()? as u16),
            "--count" => options.count = Some(number()?.max(2)),
            other => return Err(format!("no option `{other}`; there is --check, --only SECTION, --count N")),
        }
    }
    Ok(options)
}

/// Why a figure may lie outside.
fn explanation(id: u32) -> Option<&'static str> {
    EXPLAINED.iter().find(|(known, _)| *known == id).map(|(_, why)| *why)
}

/// The whole report as Markdown.
fn report(sections: &[Section]) -> String {
    let mut text = String::from(
        "# Calibration\n\nSetpiece's game beside Google Research Football's, as measured of version 2.10.3. `cargo xtask \
         calibrate` writes this page; with `--check` it fails on a figure that is outside and not explained below.\n\n\
         | section | figures | inside |\n|---|---|---|\n",
    );
    for section in sections {
        let all = section.figures.len();
        let _ =
            writeln!(text, "| {}. {} | {all} | {} |", section.number, section.title, all - section.outside().count());
    }
    for section in sections {
        let _ = write!(text, "\n{}", section.markdown(explanation));
    }
    text.push_str("\n## Explained\n\n");
    for (id, why) in EXPLAINED {
        let _ = writeln!(text, "- C-{id}: {why}");
    }
    text
}

/// Tells what is outside; fails on it if that is asked for.
fn verdict(sections: &[Section], check: bool) -> Result<(), Failure> {
    let mut bad = Vec::new();
    for section in sections {
        let (all, outside) = (section.figures.len(), section.outside().count());
        println!("section {}: {outside} of {all} outside", section.number);
        if outside * 5 > all {
            bad.push(format!("section {} has more than a fifth outside", section.number));
        }
        for (id, figure) in section.outside().filter(|(id, _)| explanation(*id).is_none()) {
            bad.push(format!("C-{id} {}: {}, wanted {}", figure.what, figure.ours(), figure.wanted()));
        }
    }
    for line in &bad {
        println!("  {line}");
    }
    if check && !bad.is_empty() { Err(format!("{} figures to mend", bad.len())) } else { Ok(()) }
}
