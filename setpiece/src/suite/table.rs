//! A suite's results as a table of text.

use super::SuiteRow;
use crate::measure::{Estimate, shown};
use setpiece_scenario::plan::{Measure, Quantity};

/// The heads of the columns, and the cells of every row.
#[derive(Clone, Debug)]
pub struct SuiteTable {
    /// The heads.
    pub heads: Vec<String>,
    /// The cells, row by row.
    pub lines: Vec<Vec<String>>,
    /// Who played, and the seed, if all rows have the same.
    pub note: Option<String>,
}

impl SuiteTable {
    /// The table of some rows.
    pub fn of(rows: &[SuiteRow]) -> SuiteTable {
        let (heads, lines) = cells(rows);
        SuiteTable { heads, lines, note: note(rows) }
    }

    /// The head and the lines, with the cells of a column below each other.
    pub fn aligned(&self) -> (String, Vec<String>) {
        let width = |column: usize| {
            let cells =
                self.lines.iter().chain([&self.heads]).filter_map(|cells| cells.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or_default()
        };
        let widths: Vec<usize> = (0..self.heads.len()).map(width).collect();
        let joined = |cells: &[String]| {
            let padded = cells.iter().zip(&widths);
            let padded: Vec<String> =
                padded.map(|(cell, &width)| format!("{cell:width$}")).collect();
            format!("  {}", padded.join("  ").trim_end())
        };
        (joined(&self.heads), self.lines.iter().map(|line| joined(line)).collect())
    }
}

fn note(rows: &[SuiteRow]) -> Option<String> {
    let first = rows.first()?;
    if rows.iter().any(|row| row.seed != first.seed) {
        return None;
    }
    let agents: Vec<&str> = first.agents.iter().map(|agent| agent.agent.as_str()).collect();
    let (agents, seed) = (agents.join(", "), first.seed);
    Some(format!("agent {agents} · seed {seed} · 95 % intervals in brackets"))
}

/// The heads, and the cells of every row.
fn cells(rows: &[SuiteRow]) -> (Vec<String>, Vec<Vec<String>>) {
    let share = |it: &Estimate| shown(&Measure::SuccessRate, it);
    let number = |it: &Estimate| shown(&Measure::Mean(Quantity::Return), it);
    let steps = |it: &Estimate| shown(&Measure::Mean(Quantity::Length), it);
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
