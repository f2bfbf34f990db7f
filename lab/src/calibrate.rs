//! The report: every figure with its limits and verdict.

use crate::figure::{Figure, Section};
use crate::pitch::LabError;
use crate::{agents, ball, explained, hands, matches, movement, page};

/// Options of `lab calibrate`.
#[derive(Debug, clap::Args)]
pub(crate) struct CalibrateArgs {
    /// Fail on a figure that is outside its limits and not explained
    #[arg(long)]
    check: bool,
    /// Write the measured sections into docs/calibration.md
    #[arg(long)]
    write: bool,
    /// Measure one section: movement, ball, matches, agents, keys, the ladder
    #[arg(long, value_name = "SECTION", value_parser = clap::value_parser!(u16).range(2..=7))]
    only: Option<u16>,
    /// Play this many episodes or matches for each figure
    #[arg(long, value_name = "N")]
    count: Option<u64>,
}

/// Measures, prints the sections and writes the page.
pub(crate) fn calibrate(args: &CalibrateArgs) -> Result<(), LabError> {
    let wanted = |number: u16| args.only.is_none_or(|only| only == number);
    // One has no spread.
    let count = args.count.map(|count| count.max(2));
    let whole = args.only.is_none() && args.count.is_none();
    let mut sections = Vec::new();
    for number in [2, 3, 4, 5, 6, 7] {
        if !wanted(number) {
            continue;
        }
        let section = match number {
            2 => movement::measure(),
            3 => ball::measure(),
            4 => matches::measure(count),
            5 => agents::measure(count),
            6 => hands::measure(count),
            _ => matches::ladder(count),
        }?;
        print!("{}", section.markdown());
        println!();
        sections.push(section);
    }
    if args.write || whole {
        page::write(&sections)?;
    }
    verdict(&sections, whole, args.check)
}

/// Rows outside, of all sections.
fn outside(sections: &[Section]) -> impl Iterator<Item = &Figure> + Clone {
    sections.iter().flat_map(|section| section.figures.iter().filter(|figure| !figure.is_inside()))
}

/// Prints the figures that are outside without a reason, and with `whole` the reasons that explain
/// nothing. With `check` such figures are a failure.
fn verdict(sections: &[Section], whole: bool, check: bool) -> Result<(), LabError> {
    let mut bad = Vec::new();
    for section in sections {
        let (all, outside) = (section.figures.len(), section.outside().count());
        let open: Vec<_> = section
            .outside()
            .filter(|(_, figure)| explained::explanation(figure).is_none())
            .collect();
        println!(
            "section {}: {outside} of {all} outside, {} of them explained",
            section.number,
            outside - open.len()
        );
        for (id, figure) in open {
            bad.push(format!(
                "C-{id} {}: {}, wanted {}",
                figure.what,
                figure.ours(),
                figure.wanted()
            ));
        }
    }
    if whole {
        bad.extend(explained::idle(outside(sections)));
    }
    for line in &bad {
        println!("  {line}");
    }
    if check && !bad.is_empty() {
        Err(format!("{} figures outside without a reason", bad.len()))
    } else {
        Ok(())
    }
}
