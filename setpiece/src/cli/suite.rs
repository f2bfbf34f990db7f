//! `setpiece run SUITE`: a table of a suite's entries.

use super::common::FINE;
use super::measured;
use super::out::{Out, StyledText};
use super::play::{RunArgs, RunFormat};
use crate::Error;
use crate::engine::environment::EnvironmentOptions;
use crate::measure::Estimate;
use crate::scenario::plan::{Measure, Quantity, Suite};
use crate::suite::{SuiteRow, row};

/// Plays a suite and prints its table.
pub(crate) fn run_suite(
    suite: &Suite,
    environment: &EnvironmentOptions,
    args: &RunArgs,
    out: &Out,
) -> Result<u8, Error> {
    let agents = args.agents();
    let total: u64 = suite.entries.iter().map(|entry| entry.count).sum::<u64>();
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

/// The columns: their heads, and their cells of a row.
fn cells(rows: &[SuiteRow]) -> (Vec<String>, Vec<Vec<String>>) {
    let share = |it: &Estimate| measured::shown(&Measure::SuccessRate, it);
    let number = |it: &Estimate| measured::shown(&Measure::Mean(Quantity::Return), it);
    let steps = |it: &Estimate| measured::shown(&Measure::Mean(Quantity::Length), it);
    let mut heads = vec!["entry".to_owned(), "episodes".to_owned()];
    let several = rows.first().is_some_and(|row| row.agents.len() > 1);
    for agent in rows.first().map_or(&[][..], |row| &row.agents) {
        if several {
            heads.extend(["success", "return"].map(|head| format!("{} {head}", agent.agent)));
        } else {
            heads.extend(["success", "return", "score", "length"].map(str::to_owned));
        }
    }
    if several {
        heads.extend(["success difference", "return difference"].map(str::to_owned));
    }
    let lines = rows.iter().map(|row| {
        let mut cells = vec![row.entry.clone(), row.episodes.to_string()];
        for agent in &row.agents {
            cells.extend([share(&agent.success_rate), number(&agent.mean_return)]);
            if !several {
                cells.extend([number(&agent.score), steps(&agent.length)]);
            }
        }
        if let Some(difference) = &row.difference {
            cells.extend([share(&difference.success_rate), number(&difference.mean_return)]);
        }
        cells
    });
    (heads, lines.collect())
}

fn text(suite: &Suite, rows: &[SuiteRow], out: &Out) {
    let title = suite.doc.lines().next().unwrap_or_default();
    out.line(StyledText::default().bold(&suite.name).text("  ").text(title));
    out.line("");
    let (heads, lines) = cells(rows);
    let width = |column: usize| {
        let cells = lines.iter().chain([&heads]).filter_map(|cells| cells.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or_default()
    };
    let joined = |cells: &[String]| {
        let padded = cells.iter().enumerate();
        let padded: Vec<String> =
            padded.map(|(column, cell)| format!("{cell:0$}", width(column))).collect();
        format!("  {}", padded.join("  ").trim_end())
    };
    out.line(StyledText::default().dim(&joined(&heads)));
    for line in &lines {
        out.line(joined(line));
    }
    let seeds: Vec<u64> = rows.iter().map(|row| row.seed).collect();
    if seeds.iter().any(|seed| Some(seed) != seeds.first()) {
        return;
    }
    out.line("");
    let agents = rows
        .first()
        .map_or(Vec::new(), |row| row.agents.iter().map(|agent| agent.agent.as_str()).collect());
    let seed = seeds.first().copied().unwrap_or_default();
    let note = format!("  agent {} · seed {seed} · 95 % intervals in brackets", agents.join(", "));
    out.line(StyledText::default().dim(&note));
}

fn markdown(rows: &[SuiteRow]) -> String {
    let (heads, lines) = cells(rows);
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
