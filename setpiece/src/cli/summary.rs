//! Prints the results of a run: a table, one JSON object, or one line per episode.

use super::out::{Out, StyledText};
use crate::Error;
use crate::drawing::{Paint, drawn};
use crate::engine::batch::EpisodeSummary;
use crate::engine::environment::Environment;
use crate::engine::statistics::MatchMeans;
use crate::level::Level;
use crate::run::faults::{FaultyTerm, faulty_numbers, faulty_terms};
use crate::run::{RecordMean, RunOptions, Summary};
use crate::scenario::{Scenario, Verdict};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Width of the first column.
const WIDTH: usize = 11;
/// Width of the bars.
const BAR: usize = 30;

/// The documented JSON object, its keys in this order.
#[derive(serde::Serialize)]
struct Report<'a> {
    scenario: &'a str,
    episodes: usize,
    seed: u64,
    outcomes: BTreeMap<&'a str, u32>,
    score: BySide,
    mean_return: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    mean_returns: Option<BySide>,
    mean_length: f64,
    success_rate: f64,
    terms: BTreeMap<&'a str, f64>,
    records: BTreeMap<&'a str, f64>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    record_units: BTreeMap<&'a str, String>,
    faults: u64,
    steps_per_second: f64,
    match_stats: &'a MatchMeans,
    digest: String,
}

/// Means of both sides.
#[derive(serde::Serialize)]
struct BySide {
    left: f64,
    right: f64,
}

/// The results of a run as one JSON object.
pub(crate) fn json(scenario: &Scenario, options: &RunOptions, summary: &Summary) -> String {
    let mut outcomes = BTreeMap::new();
    for (label, _, count) in outcomes_of(scenario, summary) {
        *outcomes.entry(label).or_default() += count;
    }
    let [left, right] = summary.score;
    let report = Report {
        scenario: &scenario.name,
        episodes: summary.episodes.len(),
        seed: options.seed,
        outcomes,
        score: BySide { left, right },
        mean_return: summary.mean_return,
        mean_returns: summary
            .by_side
            .as_ref()
            .map(|[left, right]| BySide { left: left.mean_return, right: right.mean_return }),
        mean_length: summary.mean_length,
        success_rate: summary.success_rate,
        terms: summary.terms.iter().map(|(name, mean)| (name.as_str(), *mean)).collect(),
        records: summary.records.iter().map(|it| (it.name.as_str(), it.mean)).collect(),
        record_units: summary
            .records
            .iter()
            .filter(|record| !record.unit.is_none())
            .map(|record| (record.name.as_str(), record.unit.to_string()))
            .collect(),
        faults: summary.faults,
        steps_per_second: summary.steps_per_second,
        match_stats: &summary.match_stats,
        digest: format!("{:016x}", summary.digest),
    };
    serde_json::to_string(&report).unwrap_or_default()
}

/// How often each ending came, the most frequent first, and then those that never came.
fn outcomes_of<'a>(
    scenario: &'a Scenario,
    summary: &'a Summary,
) -> Vec<(&'a str, Option<Verdict>, u32)> {
    let came = summary.outcomes.iter().map(|(label, verdict, n)| (label.as_str(), *verdict, *n));
    let mut outcomes: Vec<_> = came.collect();
    for ending in &scenario.endings.list {
        // What a script calls its ending is not known before it comes.
        if ending.script.is_none() && !outcomes.iter().any(|(label, ..)| *label == ending.label) {
            outcomes.push((&ending.label, ending.verdict, 0));
        }
    }
    outcomes
}

/// Prints the table, below a drawing of the first episode's start.
pub(crate) fn print(
    scenario: &Arc<Scenario>,
    options: &RunOptions,
    summary: &Summary,
    out: &Out,
) -> Result<(), Error> {
    out.line(StyledText::default().bold(&scenario.name).text("  ").text(scenario.title()));
    let mut environment = Environment::new(scenario.clone(), options.environment.clone())
        .map_err(Error::Environment)?;
    let first = options.episodes.start;
    if environment.reset(Some(options.seed), Some(first)).is_ok() {
        let signs = drawn(environment.state()).into_iter();
        out.line(signs.fold(StyledText::default(), |text, (sign, paint)| {
            text.paint(&sign.to_string(), paint)
        }));
    }
    out.line(StyledText::default().dim("  left team 0-9 attacks →, right team a-k ←, ball o"));
    out.line("");
    let agent = options.agent.name();
    out.line(match summary.episodes.len() {
        1 => {
            let level = Level::of(scenario, environment.bindings(), options.seed, first);
            format!("  1 episode · agent {agent} · {level}")
        }
        n => format!("  {n} episodes · agent {agent} · seed {}", options.seed),
    });
    out.line("");
    let width = outcomes(scenario, summary, out);
    out.line("");
    means(summary, &faulty_terms(scenario, options, summary)?, width, out);
    unclear(scenario, options, width, out)?;
    if scenario.endings.list.is_empty() {
        let m = &summary.match_stats;
        out.line(format!(
            "  {:width$}  {:.0} passes, {:.0} % completed · {:.1} shots · {:.1} goals · spells of {:.0} steps",
            "per match",
            m.passes,
            100.0 * m.pass_completion,
            m.shots,
            m.goals,
            m.possession_spell
        ));
    }
    out.line(format!("  {:width$}  {:.0} steps per second", "speed", summary.steps_per_second));
    Ok(())
}

/// Prints how often each ending came, and returns the width of the first column.
pub(crate) fn outcomes(scenario: &Scenario, summary: &Summary, out: &Out) -> usize {
    let outcomes = outcomes_of(scenario, summary);
    let width =
        outcomes.iter().map(|(label, ..)| label.chars().count()).max().unwrap_or(0).max(WIDTH);
    for (label, verdict, count) in outcomes {
        let share = f64::from(count) / summary.episodes.len() as f64;
        let bar = "█".repeat((share * BAR as f64).round() as usize);
        let (word, paint) = match verdict {
            Some(Verdict::Success) => ("success", Paint::Success),
            Some(Verdict::Failure) => ("failure", Paint::Failure),
            None => ("", Paint::Plain),
        };
        let head = format!("  {label:width$}  {word:7}  {count:>5}  {:>5.1} %  ", 100.0 * share);
        out.line(StyledText::from(head).paint(&bar, paint));
    }
    width
}

/// Prints which numbers of the scenario's own observation could not be computed.
pub(crate) fn unclear(
    scenario: &Arc<Scenario>,
    options: &RunOptions,
    width: usize,
    out: &Out,
) -> Result<(), Error> {
    for (name, times) in faulty_numbers(scenario, options)? {
        let report = format!(
            "observed `{name}` could not be computed {times} times and was 0: a division by zero, or a player who isn't there?"
        );
        out.line(StyledText::from(format!("  {:width$}    ", "")).paint(&report, Paint::Failure));
    }
    Ok(())
}

/// Prints the means over the episodes: score, return by term, length, records.
///
/// - `faulty`: the parts of rewards whose values weren't finite.
pub(crate) fn means(summary: &Summary, faulty: &[FaultyTerm], width: usize, out: &Out) {
    let [left, right] = summary.score;
    out.line(format!("  {:width$}  {left:.2} : {right:.2}", "mean score"));
    // Of two sides that play each other the mean says little.
    if let Some([left, right]) = &summary.by_side {
        let both = |left: f64, right: f64| format!("{left:+.3} : {right:+.3}");
        let paid = both(left.mean_return, right.mean_return);
        out.line(format!("  {:width$}  {paid}", "mean return"));
        let terms = summary.terms.iter().zip(left.terms.iter().zip(&right.terms));
        for ((name, _), (left, right)) in terms {
            out.line(format!("  {:width$}    {}  {name}", "", both(*left, *right)));
        }
    } else {
        out.line(format!("  {:width$}  {:+.3}", "mean return", summary.mean_return));
        for (name, mean) in &summary.terms {
            out.line(format!("  {:width$}    {mean:+.3}  {name}", ""));
        }
    }
    if summary.faults > 0 {
        let values = summary.faults;
        let mut report = format!(
            "{values} values were not finite and were not paid: a division by zero, or a player who isn't there?"
        );
        for FaultyTerm { reward, term, episode, step } in faulty {
            let part = match term {
                Some(term) => format!("`{term}` of the reward `{reward}`"),
                None => format!("a `state` of the reward `{reward}`"),
            };
            report += &format!(
                "\n  {:width$}      {part}: first in step {step} of episode {episode}",
                ""
            );
        }
        out.line(StyledText::from(format!("  {:width$}    ", "")).paint(&report, Paint::Failure));
    }
    out.line(format!("  {:width$}  {:.1} steps", "mean length", summary.mean_length));
    for (index, RecordMean { name, mean, unit }) in summary.records.iter().enumerate() {
        let unit = if unit.is_none() { String::new() } else { format!(" {unit}") };
        out.line(format!(
            "  {:width$}  {mean:.3}{unit}  {name}",
            if index == 0 { "records" } else { "" }
        ));
    }
}

/// One line about an episode, for watching.
pub(crate) fn episode_line(episode: &EpisodeSummary) -> StyledText {
    let paint = match episode.verdict {
        Some(Verdict::Success) => Paint::Success,
        Some(Verdict::Failure) => Paint::Failure,
        None => Paint::Plain,
    };
    let [left, right] = episode.score;
    let paid: f64 = episode.returns.iter().sum();
    StyledText::from(format!("  episode {:>3}  ", episode.index))
        .paint(&format!("{:14}", episode.outcome), paint)
        .text(&format!("  {left}:{right}  return {paid:+.3}  {} steps", episode.length))
}
