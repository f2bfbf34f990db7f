//! Everything in a text whose report says how it is mended, mended at once.
//!
//! A text with hundreds of slips is compiled a few times, not once for each of them: the likeliest
//! change of every report is made, and the whole is kept if it mends as much as it promises.
//! Otherwise each half is tried, down to the single report, for which everything is tried that its
//! help may mean.

use super::actions::{Action, ActionKind};
use super::edits::Edit;
use super::fixes::{is_unread, names_unit};
use super::meant::meant;
use super::report::TextReport;
use super::{Analysis, Workspace};
use crate::dsl::problem::{Code, Severity};
use crate::grf::scripts;
use std::collections::BTreeMap;
use std::path::Path;

/// How often the fixes of a text are applied: they may uncover other reports.
const ROUNDS: usize = 50;
/// For how many reports of a round everything is tried that their help may mean.
const SINGLES: usize = 50;

/// A report and the change that likely mends it.
struct Slip<'a> {
    report: &'a TextReport,
    edits: Vec<Edit>,
}

/// What is mended of a text: by which changes, and how many reports of each code.
#[derive(Clone, Default)]
struct Mended {
    edits: Vec<Edit>,
    codes: BTreeMap<Code, usize>,
    warnings: usize,
}

impl Mended {
    /// Adds a change, and says whether it meets none that is made.
    fn add(&mut self, slip: &Slip<'_>) -> bool {
        let meets = |one: &Edit, other: &Edit| {
            let (one, other) = (&one.place.range, &other.place.range);
            one.start <= other.end && other.start <= one.end
        };
        if slip.edits.iter().any(|edit| self.edits.iter().any(|made| meets(edit, made))) {
            return false;
        }
        self.edits.extend(slip.edits.iter().cloned());
        *self.codes.entry(slip.report.code).or_default() += 1;
        self.warnings += usize::from(slip.report.severity != Severity::Error);
        true
    }
}

impl Workspace {
    /// What mends everything in a text whose report says how; none if nothing does.
    pub fn fix_all(&self, path: &Path) -> Option<Action> {
        let before = self.file_text(path)?;
        let mut after = self.clone();
        for _ in 0..ROUNDS {
            let edits = after.mendable(path);
            if edits.is_empty() {
                break;
            }
            after = after.after(&edits);
        }
        let text = after.text(path).filter(|text| ***text != *before)?;
        Some(Action {
            title: "apply every help that says what to write".to_owned(),
            kind: ActionKind::FixAll,
            edits: vec![Edit::replace(path, 0..before.len(), &**text)],
            code: None,
            refused: None,
        })
    }

    /// Changes of a text that together mend reports of it, and spoil nothing.
    fn mendable(&mut self, path: &Path) -> Vec<Edit> {
        let Some(analysis) = self.analysis(path) else { return Vec::new() };
        // A script of another engine is translated as a whole or not at all.
        let scripts = scripts(&analysis.text);
        let reports = analysis
            .own_reports(path)
            .filter(|report| !scripts.iter().any(|it| it.contains(&report.place.range.start)))
            .filter(|report| !is_open(report));
        let (mut slips, mut singles) = (Vec::new(), Vec::new());
        for report in reports {
            match likely(&analysis, path, report) {
                Some(edits) => slips.push(Slip { report, edits }),
                None => singles.push(report),
            }
        }
        let mut mended = Mended::default();
        singles.extend(self.mend(path, &analysis, &slips, &mut mended));
        for report in singles.into_iter().take(SINGLES) {
            let fixes = self.fixes_of(path, &analysis, report);
            // Which of several units is meant only the author knows.
            if names_unit(report) && fixes.len() > 1 {
                continue;
            }
            let Some(fix) = fixes.into_iter().find(|it| of_text(path, &it.edits)) else { continue };
            let mut with = mended.clone();
            if !with.add(&Slip { report, edits: fix.edits }) {
                continue;
            }
            // What can't be read hides what is wrong behind it: this is mended alone.
            if is_unread(report) {
                if mended.edits.is_empty() {
                    return with.edits;
                }
            } else if self.holds(path, &analysis, &with) {
                mended = with;
            }
        }
        mended.edits
    }

    /// Adds the changes of some reports that hold what they promise, and says whose don't.
    fn mend<'a>(
        &mut self,
        path: &Path,
        analysis: &Analysis,
        slips: &[Slip<'a>],
        mended: &mut Mended,
    ) -> Vec<&'a TextReport> {
        let mut with = mended.clone();
        for slip in slips {
            // What meets another change is made in the next round.
            with.add(slip);
        }
        if with.edits.len() == mended.edits.len() {
            return Vec::new();
        }
        if self.holds(path, analysis, &with) {
            *mended = with;
            return Vec::new();
        }
        if let [only] = slips {
            return vec![only.report];
        }
        let (one, other) = slips.split_at(slips.len() / 2);
        let mut left = self.mend(path, analysis, one, mended);
        left.extend(self.mend(path, analysis, other, mended));
        left
    }

    /// Whether some changes mend what they promise, and nothing else is wrong after them.
    fn holds(&self, path: &Path, was: &Analysis, mended: &Mended) -> bool {
        let Some(is) = self.after(&mended.edits).analysis(path) else { return false };
        let counts = |analysis: &Analysis| -> BTreeMap<Code, usize> {
            // Of some things the compiler warns only in a text without errors.
            let mut counts = BTreeMap::new();
            for report in &analysis.reports {
                if report.severity == Severity::Error || mended.codes.contains_key(&report.code) {
                    *counts.entry(report.code).or_default() += 1;
                }
            }
            counts
        };
        let (before, after) = (counts(was), counts(&is));
        let is_less = after.iter().all(|(code, count)| {
            let gone = mended.codes.get(code).copied().unwrap_or_default();
            before.get(code).is_some_and(|before| count + gone <= *before)
        });
        is_less && (mended.warnings == 0 || is.reports.len() < was.reports.len())
    }
}

/// Whether only the author knows which of several forms or values is meant.
fn is_open(report: &TextReport) -> bool {
    let says = |words: &str| report.help.as_ref().is_some_and(|it| it.contains(words));
    says(", or ") || says("a value in")
}

fn of_text(path: &Path, edits: &[Edit]) -> bool {
    !edits.is_empty() && edits.iter().all(|edit| edit.place.path == path)
}

/// The change that likely mends a report; none if that takes a closer look.
fn likely(analysis: &Analysis, path: &Path, report: &TextReport) -> Option<Vec<Edit>> {
    if is_unread(report) {
        return None;
    }
    let written = report.rewrites.iter().filter_map(|it| it.places.first());
    let mut changes: Vec<Vec<Edit>> = written.cloned().collect();
    if changes.is_empty() {
        changes = meant(analysis, path, report).into_iter().map(|it| it.edits).collect();
    }
    changes.dedup();
    if names_unit(report) && changes.len() > 1 {
        return None;
    }
    changes.into_iter().next().filter(|edits| of_text(path, edits))
}
