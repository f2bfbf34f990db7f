//! `setpiece run SUITE`: a table of a suite's entries.

use super::common::FINE;
use super::out::{Out, StyledText};
use super::play::{RunArgs, RunFormat};
use crate::Error;
use crate::engine::environment::EnvironmentOptions;
use crate::scenario::plan::Suite;
use crate::suite::{SuiteRow, SuiteTable, row};

/// Plays a suite and prints its table.
pub(crate) fn run_suite(
    suite: &Suite,
    environment: &EnvironmentOptions,
    args: &RunArgs,
    out: &Out,
) -> Result<u8, Error> {
    let agents = args.agents();
    let total = suite.episodes();
    let bar = super::common::bar(
        total * agents.len() as u64,
        "{msg} {bar:40} {pos}/{len} episodes  {eta} left",
    );
    let mut rows = Vec::new();
    for entry in &suite.entries {
        bar.set_message(entry.played.label());
        rows.push(row(entry, environment, &agents, args.threads(), || bar.inc(1))?);
    }
    bar.finish_and_clear();
    match args.format {
        RunFormat::Json => {
            let table = serde_json::json!({ "suite": suite.name, "entries": rows });
            out.line(table.to_string());
        }
        RunFormat::Csv => out.text(&*csv(&rows)),
        RunFormat::Md => out.text(&*markdown(&rows)),
        RunFormat::Text => text(suite, &rows, out),
    }
    Ok(FINE)
}

fn text(suite: &Suite, rows: &[SuiteRow], out: &Out) {
    let title = suite.title();
    out.line(StyledText::default().bold(&suite.name).text("  ").text(title));
    out.line("");
    let table = SuiteTable::of(rows);
    let (head, lines) = table.aligned();
    out.line(StyledText::default().dim(&head));
    for line in lines {
        out.line(line);
    }
    if let Some(note) = table.note {
        out.line("");
        out.line(StyledText::default().dim(&format!("  {note}")));
    }
}

fn markdown(rows: &[SuiteRow]) -> String {
    let SuiteTable { heads, lines, .. } = SuiteTable::of(rows);
    let joined = |cells: &[String]| format!("| {} |\n", cells.join(" | ").replace('\n', " "));
    let rule = format!("|{}\n", "---|".repeat(heads.len()));
    let body: String = lines.iter().map(|line| joined(line)).collect();
    [joined(&heads), rule, body].concat()
}

/// One line per entry and agent, with every end of every interval.
fn csv(rows: &[SuiteRow]) -> String {
    let measures = ["success_rate", "mean_return", "score", "length"];
    let heads = measures.map(|name| format!("{name},{name}_low,{name}_high"));
    let mut csv = format!("entry,seed,agent,episodes,{},digest\n", heads.join(","));
    for row in rows {
        for agent in &row.agents {
            let measured = [&agent.success_rate, &agent.mean_return, &agent.score, &agent.length];
            let numbers = measured.map(|it| format!("{},{},{}", it.value, it.low, it.high));
            csv += &format!(
                "\"{}\",{},{},{},{},{}\n",
                row.entry.replace('"', "\"\""),
                row.seed,
                agent.agent,
                row.episodes,
                numbers.join(","),
                agent.digest
            );
        }
    }
    csv
}
