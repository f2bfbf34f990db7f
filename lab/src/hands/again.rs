//! Figures of traces recorded of Google Research Football: compared with the stored ones, or
//! replacing them.

use super::keys::action;
use super::limits::RecordedFigure;
use super::recorded::{RecordedFile, RecordedRow, Topic, Values};
use super::topic_of;
use super::trace::TraceMoment;
use crate::figure::{Figure, Section};
use crate::pitch::LabError;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::BufRead;

/// A step as `lab/record` writes it: ball and its velocity; owning team, owner and `game_mode`;
/// places of both teams; keys; the agents' players; score.
pub(super) type RecordedStep =
    ([f64; 5], (i8, i64, usize), [Vec<f64>; 2], Vec<String>, Vec<i64>, [u16; 2]);

/// Options of `lab recorded`.
#[derive(Debug, clap::Args)]
pub(crate) struct RecordedArgs {
    /// A file of lab/data
    file: String,
    /// What lab/record has written
    traces: String,
    /// Write the figures in place of the file's
    #[arg(long)]
    write: bool,
    /// Write the figures together with the file's
    #[arg(long, conflicts_with = "write")]
    add: bool,
}

/// Sets figures of traces beside the file's, writes them in their place, or makes one of both.
pub(crate) fn recorded(args: &RecordedArgs) -> Result<(), LabError> {
    let RecordedArgs { file, traces, .. } = args;
    let topic = topic_of(file)?;
    let recorded = topic.recorded()?;
    let values = read(topic, &recorded, traces)?;
    if args.write {
        write(topic, &values, |_| None)
    } else if args.add {
        write(topic, &values, |number| recorded.rows.get(number))
    } else {
        print!("{}", compared(topic, &recorded, &values));
        Ok(())
    }
}

/// The figures of every row that has traces.
fn read(
    topic: &Topic,
    file: &RecordedFile,
    traces: &str,
) -> Result<BTreeMap<usize, Values>, LabError> {
    let text = std::fs::File::open(traces).map_err(|why| format!("{traces}: {why}"))?;
    let mut values: BTreeMap<usize, Values> = BTreeMap::new();
    for line in std::io::BufReader::new(text).lines() {
        let line = line.map_err(|why| format!("{traces}: {why}"))?;
        let (number, steps): (usize, Vec<RecordedStep>) =
            serde_json::from_str(&line).map_err(|why| format!("{traces}: {why}"))?;
        let row = file.rows.get(number).ok_or_else(|| topic.named(format!("no row {number}")))?;
        let trace = views(file, row, steps).map_err(|why| topic.named(why))?;
        topic.add(values.entry(number).or_default(), &trace, row);
    }
    Ok(values)
}

/// The views of an episode.
fn views(
    file: &RecordedFile,
    row: &RecordedRow,
    steps: Vec<RecordedStep>,
) -> Result<Vec<TraceMoment>, LabError> {
    let roles = file.scene(row)?.roles()?;
    let mut trace: Vec<TraceMoment> = Vec::new();
    for (ball, (owner, who, mode), teams, pressed, active, score) in steps {
        let [x, y, z, vx, vy] = ball;
        let before = trace.last().map(|view| view.ball);
        trace.push(TraceMoment {
            ball: [x, y, z],
            vel: [vx, vy],
            speed: before.map_or(0.0, |[fx, fy, _]| (x - fx).hypot(y - fy) * 10.0),
            owner,
            who: usize::try_from(who).unwrap_or(usize::MAX),
            mode,
            teams: teams.map(|places| places.chunks_exact(2).map(|at| [at[0], at[1]]).collect()),
            roles: roles.clone(),
            pressed: pressed.iter().map(|key| action(key)).collect::<Result<_, _>>()?,
            active: active.into_iter().map(|player| usize::try_from(player).unwrap_or(0)).collect(),
            score,
        });
    }
    Ok(trace)
}

/// The figures of the traces that are outside the limits of the stored ones.
fn compared(topic: &Topic, file: &RecordedFile, values: &BTreeMap<usize, Values>) -> String {
    let mut section = Section::new(6, topic.name, topic.file);
    for (number, values) in values {
        for (what, parts) in topic.compare(&file.rows[*number], values) {
            section.row(what, parts);
        }
    }
    let outside: Vec<&Figure> = section.outside().map(|(_, figure)| figure).collect();
    let mut text = String::new();
    for figure in &outside {
        let _ = writeln!(text, "{}: {}, on file {}", figure.what, figure.ours(), figure.wanted());
    }
    let _ =
        writeln!(text, "{}: {} of {} outside", topic.file, outside.len(), section.figures.len());
    text
}

/// Writes the figures of the rows with traces into the file, merged with those of `before` if
/// given.
fn write<'a>(
    topic: &Topic,
    values: &BTreeMap<usize, Values>,
    before: impl Fn(usize) -> Option<&'a RecordedRow>,
) -> Result<(), LabError> {
    let text = std::fs::read_to_string(topic.path()).map_err(|why| topic.named(why))?;
    let (head, rows) =
        text.split_once("\"rows\": [\n").ok_or_else(|| topic.named("no rows, one a line"))?;
    let mut written = format!("{head}\"rows\": [\n");
    for (number, line) in rows.lines().enumerate() {
        match (values.get(&number), line.split_once("\"figures\": ")) {
            (Some(values), Some((row, _))) => {
                let comma = if line.ends_with(',') { "," } else { "" };
                let figures = figures(topic, values, before(number));
                let _ = writeln!(written, "{row}\"figures\": {figures}}}{comma}");
            }
            _ => written = written + line + "\n",
        }
    }
    std::fs::write(topic.path(), written).map_err(|why| topic.named(why))
}

/// The figures of a row in the file's format.
fn figures(topic: &Topic, values: &Values, before: Option<&RecordedRow>) -> String {
    let mut parts = Vec::new();
    for ((name, kind), of) in topic.columns.iter().zip(values) {
        let mut all = RecordedFigure::of(*kind, of);
        if let Some(before) = before {
            all = match before.figures.get(*name) {
                Some(before) => all.with(*kind, before),
                // A figure that a row omits on purpose stays omitted.
                None => continue,
            };
        }
        if let (Some(mean), Some(sd)) = (all.mean, all.sd) {
            parts.push(format!(
                "\"{name}\": {{\"mean\": {mean:.3}, \"sd\": {sd:.3}, \"n\": {}}}",
                all.n
            ));
        }
    }
    format!("{{{}}}", parts.join(", "))
}
