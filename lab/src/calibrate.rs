//! The report: every figure with its limits and verdict.

use crate::figure::{Figure, Section};
use crate::pitch::Failure;
use crate::{agents, ball, explained, hands, matches, movement, page};

/// The command's options.
#[derive(Default)]
struct Options {
    check: bool,
    only: Option<u16>,
    count: Option<u64>,
    write: bool,
}

/// Runs `calibrate [--check] [--write] [--only SECTION] [--count N]`.
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
        print!("{}", section.markdown());
        println!();
        sections.push(section);
    }
    if options.write {
        page::write(&sections)?;
    }
    let whole = options.only.is_none() && options.count.is_none();
    verdict(&sections, whole, options.check)
}

fn options(args: &[String]) -> Result<Options, Failure> {
    let mut options = Options::default();
    let mut args = args.iter();
    while let Some(arg) = args.next() {
        let mut number = || args.next().and_then(|n| n.parse::<u64>().ok()).ok_or(format!("`{arg}` wants a number"));
        match arg.as_str() {
            "--check" => options.check = true,
            "--write" => options.write = true,
            "--only" => options.only = Some(number()? as u16),
            "--count" => options.count = Some(number()?.max(2)),
            other => return Err(format!("no option `{other}`; there is --check, --write, --only SECTION, --count N")),
        }
    }
    options.write |= options.only.is_none() && options.count.is_none();
    Ok(options)
}

/// Rows outside, of all sections.
fn outside(sections: &[Section]) -> impl Iterator<Item = &Figure> + Clone {
    sections.iter().flat_map(|section| section.figures.iter().filter(|figure| !figure.is_inside()))
}

/// Prints the figures that are outside without a reason, and with `whole` the reasons that explain
/// nothing. With `check` such figures are a failure.
fn verdict(sections: &[Section], whole: bool, check: bool) -> Result<(), Failure> {
    let mut bad = Vec::new();
    for section in sections {
        let (all, outside) = (section.figures.len(), section.outside().count());
        let open: Vec<_> = section.outside().filter(|(_, figure)| explained::explanation(figure).is_none()).collect();
        println!("section {}: {outside} of {all} outside, {} of them explained", section.number, outside - open.len());
        for (id, figure) in open {
            bad.push(format!("C-{id} {}: {}, wanted {}", figure.what, figure.ours(), figure.wanted()));
        }
    }
    if whole {
        bad.extend(explained::idle(outside(sections)));
    }
    for line in &bad {
        println!("  {line}");
    }
    if check && !bad.is_empty() { Err(format!("{} figures outside without a reason", bad.len())) } else { Ok(()) }
}
