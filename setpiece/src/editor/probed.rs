//! What drawn starts show of a text: found a little later than what the compiler reports.

use super::analysis::scenario_of;
use super::place::{FilePlace, is_in_library, is_scenario};
use super::refused::Refusals;
use super::{Analysis, TextReport, Workspace};
use crate::Loaded;
use crate::dsl::ast::{ItemKind, Span};
use crate::probe::probe;
use std::path::Path;
use std::time::Duration;

/// How long one scenario is tried.
const BUDGET: Duration = Duration::from_secs(2);

/// What drawn starts show of a text's scenarios.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StartFindings {
    /// What `setpiece check` reports of them beside the compiler's reports.
    pub reports: Vec<TextReport>,
    /// What is worth knowing, and may be meant.
    pub notes: Vec<StartNote>,
}

/// Something worth knowing at a place of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StartNote {
    /// Where.
    pub place: FilePlace,
    /// A sentence or two.
    pub message: String,
    /// Further places, and what is to be said about them.
    pub related: Vec<(FilePlace, String)>,
}

impl Workspace {
    /// What drawn starts show of every scenario of a text; nothing of a text with errors. None if
    /// nobody wants to know any more.
    ///
    /// `goes_on`: whether somebody does; asked before each scenario.
    pub fn probed(&mut self, path: &Path, goes_on: &dyn Fn() -> bool) -> Option<StartFindings> {
        let mut findings = StartFindings::default();
        let is_ours = is_scenario(path) && !is_in_library(path);
        if !goes_on() {
            return None;
        }
        let analysis = if is_ours { self.analysis(path) } else { None };
        let Some(analysis) = analysis.filter(|it| it.errors() == 0) else { return Some(findings) };
        for item in &analysis.tree.items {
            let ItemKind::Scenario(scenario) = &item.kind else { continue };
            if scenario.is_abstract {
                continue;
            }
            if !goes_on() {
                return None;
            }
            let name = scenario.name.node.as_str();
            let known = analysis.loaded.as_ref().filter(|it| it.scenario.name == name).cloned();
            let loaded =
                known.or_else(|| scenario_of(path, &analysis.text, &self.loader(path), name));
            let Some(loaded) = loaded else { continue };
            let problems = probe(&loaded, Some(BUDGET));
            let reports = TextReport::all(&problems, &loaded.sources);
            let is_new = |report: &TextReport| {
                let said =
                    |known: &TextReport| known.code == report.code && known.place == report.place;
                report.place.path == path && !analysis.reports.iter().any(said)
            };
            // Who hears that no start is found needn't hear how many are refused.
            if problems.is_empty() {
                findings.notes.extend(refusal(&analysis, &loaded, item.span));
            }
            let fresh: Vec<TextReport> = reports.into_iter().filter(is_new).collect();
            // A check stands in the file of several scenarios.
            let is_known = |report: &TextReport| findings.reports.contains(report);
            let fresh: Vec<_> = fresh.into_iter().filter(|report| !is_known(report)).collect();
            findings.reports.extend(fresh);
        }
        Some(findings)
    }
}

/// How many starts are refused, if it is many: at the requirement that refuses them, or at the
/// scenario's name if it stands elsewhere or several do.
///
/// `whole`: the scenario's statement.
fn refusal(analysis: &Analysis, loaded: &Loaded, whole: Span) -> Option<StartNote> {
    let found = Refusals::of(loaded)?;
    if !found.is_worth_saying(found.all()) {
        return None;
    }
    let percent = |count: u32| format!("{:.0}%", 100.0 * found.share(count));
    let draws =
        format!("A reset draws {} on average until it finds one that is accepted.", found.draws());
    let requires = loaded.origins.requires.iter().zip(&loaded.scenario.start.requires);
    let parts = requires.zip(&found.by).filter(|(_, count)| **count > 0);
    let mut written: Vec<(Span, u32, String)> = parts
        .filter_map(|((origin, require), count)| {
            let share = percent(*count);
            // What nobody wrote has a place, too: what makes it fail.
            let words = match origin.help {
                None => format!("refuses {share} of the starts that are drawn"),
                Some(_) => format!("{share} of the starts fail here: `{}`", require.label),
            };
            Some((origin.span?, *count, words))
        })
        .collect();
    written.sort_by_key(|(_, count, _)| std::cmp::Reverse(*count));
    if let Some((span, count, words)) = written.first()
        && found.is_worth_saying(*count)
        && whole.holds(*span)
    {
        return Some(StartNote {
            place: analysis.place(*span)?,
            message: format!("{words}. {draws}"),
            related: Vec::new(),
        });
    }
    let name = &loaded.scenario.name;
    let part = |(span, _, words): &(Span, u32, String)| {
        Some((FilePlace::of(*span, &loaded.sources)?, words.clone()))
    };
    Some(StartNote {
        place: analysis.place(loaded.origin?)?,
        message: format!(
            "{} of the starts that are drawn for `{name}` are refused, most often because `{}` \
             fails. {draws}",
            percent(found.all()),
            found.hardest.as_deref()?
        ),
        related: written.iter().filter_map(part).collect(),
    })
}
