//! One scenario of a text, whatever is wrong with the others.

use super::analysis::scenario_of;
use super::parents::{scenario_named, with_parents};
use super::{Analysis, Workspace};
use crate::Loaded;
use crate::dsl::ast::{ScenarioItem, ScenarioStmtKind, Span};
use crate::dsl::problem::Severity;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// A scenario that compiles, and what of it was left out for that.
pub(super) struct SoundScenario {
    /// The scenario. Of its text, what is left out is as long as before.
    pub(super) loaded: Loaded,
    /// Requirements that have errors.
    pub(super) broken: Vec<BrokenRequire>,
}

/// A requirement that has an error: it can't be read, or never holds.
pub(super) struct BrokenRequire {
    /// The author's words or label.
    pub(super) label: String,
    /// What is wrong.
    pub(super) why: String,
}

impl Workspace {
    /// A scenario of a text, if nothing is wrong with it and what it uses but with requirements.
    /// These and other items with errors are left out: blanks stand for them, so that every place
    /// stays.
    ///
    /// # Errors
    /// How many errors there are.
    pub(super) fn sound(
        &self,
        path: &Path,
        analysis: &Analysis,
        name: &str,
    ) -> Result<SoundScenario, String> {
        let compiled = |text: &Arc<str>| scenario_of(path, text, &self.loader(path), name);
        let errors = analysis.errors();
        if errors == 0 {
            let known = analysis.loaded.as_ref().filter(|it| it.scenario.name == name).cloned();
            let loaded =
                known.or_else(|| compiled(&analysis.text)).ok_or("it can't be compiled")?;
            return Ok(SoundScenario { loaded, broken: Vec::new() });
        }
        let broken = || match errors {
            1 => "1 error in the text".to_owned(),
            errors => format!("{errors} errors in the text"),
        };
        let (text, requires) = analysis.without_broken(path, name).ok_or_else(broken)?;
        let loaded = compiled(&text).ok_or_else(broken)?;
        Ok(SoundScenario { loaded, broken: requires })
    }
}

impl Analysis {
    /// The text without the items and requirements that have errors; none if an error stands
    /// elsewhere in a scenario, its parents or another file.
    fn without_broken(&self, path: &Path, name: &str) -> Option<(Arc<str>, Vec<BrokenRequire>)> {
        let needed = self.with_parents(name);
        let mut text = self.text.as_bytes().to_vec();
        let mut broken = Vec::new();
        for report in self.reports.iter().filter(|it| it.severity == Severity::Error) {
            let at = report.place.range.start;
            let is_around = |span: Span| (span.start as usize..span.end as usize).contains(&at);
            if report.place.path != path {
                return None;
            }
            let item = self.tree.items.iter().find(|item| is_around(item.span))?;
            let span = match needed.iter().find(|it| item.span.holds(it.name.span)) {
                None => item.span,
                Some(scenario) => {
                    let stmt = scenario.body.iter().find(|stmt| is_around(stmt.span))?;
                    let ScenarioStmtKind::Require { condition, label, .. } = &stmt.kind else {
                        return None;
                    };
                    let written = label.as_ref().map(|label| label.node.clone());
                    let label = written.unwrap_or_else(|| self.sources.text(condition.span).into());
                    broken.push(BrokenRequire { label, why: report.message.clone() });
                    stmt.span
                }
            };
            blank(&mut text, span.start as usize..span.end as usize);
        }
        Some((String::from_utf8(text).ok()?.into(), broken))
    }

    /// A scenario of the text and those that it extends.
    fn with_parents(&self, name: &str) -> Vec<&ScenarioItem> {
        let scenario = |name: &str| scenario_named(&self.tree.items, name);
        let parent = |of: &&ScenarioItem| scenario(&of.extends.as_ref()?.name.node);
        scenario(name).map_or_else(Vec::new, |own| with_parents(own, parent).collect())
    }
}

/// Puts blanks in the place of some bytes; lines stay.
fn blank(text: &mut [u8], range: Range<usize>) {
    for byte in text.get_mut(range).into_iter().flatten() {
        if !matches!(*byte, b'\n' | b'\r') {
            *byte = b' ';
        }
    }
}
