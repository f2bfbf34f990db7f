//! Traces of our game in the form of those that `lab/record` writes, to be laid beside them.

use super::again::RecordedStep;
use super::topic_of;
use super::trace::TraceMoment;
use crate::pitch::LabError;
use std::io::Write as _;

/// Options of `lab play`.
#[derive(Debug, clap::Args)]
pub(crate) struct PlayArgs {
    /// A file of lab/data
    file: String,
    /// Where the traces go: an episode per line
    #[arg(long)]
    into: String,
    /// The rows to play, from 0: all of them if absent
    #[arg(long)]
    row: Vec<usize>,
    /// Episodes of each row
    #[arg(long, default_value_t = 8)]
    count: u64,
}

/// Plays rows of a file in our game and writes every step of their episodes.
pub(crate) fn play(args: &PlayArgs) -> Result<(), LabError> {
    let topic = topic_of(&args.file)?;
    let file = topic.recorded()?;
    let named = |why: std::io::Error| format!("{}: {why}", args.into);
    let mut into = std::fs::File::create(&args.into).map_err(named)?;
    let rows = if args.row.is_empty() { (0..file.rows.len()).collect() } else { args.row.clone() };
    for number in rows {
        let row = file.rows.get(number).ok_or_else(|| topic.named(format!("no row {number}")))?;
        for episode in 0..args.count {
            let trace = file.play(row, episode).map_err(|why| topic.named(why))?;
            let steps: Vec<RecordedStep> = trace.into_iter().map(step).collect();
            let line = serde_json::to_string(&(number, steps)).map_err(|why| why.to_string())?;
            writeln!(into, "{line}").map_err(named)?;
        }
    }
    Ok(())
}

/// A moment as `lab/record` writes it, rounded as there.
fn step(view: TraceMoment) -> RecordedStep {
    let round = |value: f64| (value * 1000.0).round() / 1000.0;
    let [x, y, z] = view.ball.map(round);
    let [vx, vy] = view.vel.map(round);
    (
        [x, y, z, vx, vy],
        (view.owner, i64::try_from(view.who).unwrap_or(-1), view.mode),
        view.teams.map(|places| places.into_iter().flatten().map(round).collect()),
        view.pressed.iter().map(|key| key.name().to_owned()).collect(),
        view.active.into_iter().map(|player| player as i64).collect(),
        view.score,
    )
}
