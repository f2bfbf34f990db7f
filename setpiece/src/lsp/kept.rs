//! What starts have shown of a text, while the text is changed and not looked at again.

use crate::editor::{FilePlace, StartFindings, StartNote, TextReport};
use std::path::Path;

/// What an editor shows of a text beside the compiler's reports.
#[derive(Debug)]
pub(super) struct KeptFindings {
    /// The text of which it was found.
    text: String,
    findings: StartFindings,
}

impl KeptFindings {
    /// What was found of a text.
    pub(super) fn of(text: String, findings: StartFindings) -> KeptFindings {
        KeptFindings { text, findings }
    }

    /// What is still shown of the text as it is now, until it has been looked at again: what stands
    /// before and behind the change.
    pub(super) fn within(&self, path: &Path, text: &str) -> StartFindings {
        let (was, is) = (self.text.as_bytes(), text.as_bytes());
        let before = was.iter().zip(is).take_while(|(was, is)| was == is).count();
        let rest = was.len().min(is.len()) - before;
        let behind =
            was.iter().rev().zip(is.iter().rev()).take(rest).take_while(|(was, is)| was == is);
        let changed = before..was.len() - behind.count();
        let moved = |place: &FilePlace| {
            let range = &place.range;
            if place.path != path || range.end <= changed.start {
                return Some(place.clone());
            }
            let shift = |at: usize| at + is.len() - was.len();
            let is_behind = range.start >= changed.end;
            is_behind.then(|| FilePlace {
                path: place.path.clone(),
                range: shift(range.start)..shift(range.end),
            })
        };
        let related = |all: &[(FilePlace, String)]| {
            all.iter().filter_map(|(place, words)| Some((moved(place)?, words.clone()))).collect()
        };
        let reports = self.findings.reports.iter().filter_map(|it| {
            let (place, related) = (moved(&it.place)?, related(&it.related));
            Some(TextReport { place, related, ..it.clone() })
        });
        let notes = self.findings.notes.iter().filter_map(|it| {
            let (place, related) = (moved(&it.place)?, related(&it.related));
            Some(StartNote { place, related, ..it.clone() })
        });
        StartFindings { reports: reports.collect(), notes: notes.collect() }
    }
}
