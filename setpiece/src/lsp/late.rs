//! What takes longer than an editor waits for the reports of a text: the starts of its scenarios
//! are drawn beside the conversation, and what they show is sent when it is found.

use super::LanguageServer;
use super::convert::range_of;
use super::kept::KeptFindings;
use crate::editor::{StartFindings, StartNote, Workspace};
use lsp_server::{Message, Notification};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// How long nobody has said anything when the starts are drawn.
pub const QUIET: Duration = Duration::from_millis(400);

/// Draws the starts of the open texts as they are. It needs nothing of the server, so it may run on
/// a thread of its own.
#[derive(Debug)]
pub struct LateWork {
    workspace: Workspace,
    /// The age of the texts.
    age: u64,
    /// The age of the server's texts.
    now: Arc<AtomicU64>,
}

/// What was found.
#[derive(Debug)]
pub struct LateFindings {
    age: u64,
    found: BTreeMap<PathBuf, StartFindings>,
}

impl LateWork {
    /// Draws them; stops soon after a text has changed.
    pub fn run(mut self) -> LateFindings {
        let (age, now) = (self.age, self.now);
        let goes_on = || now.load(Ordering::Relaxed) == age;
        let paths: Vec<PathBuf> = self.workspace.paths().map(Path::to_owned).collect();
        let mut found = BTreeMap::new();
        for path in paths {
            let Some(findings) = self.workspace.probed(&path, &goes_on) else { break };
            if findings != StartFindings::default() {
                found.insert(path, findings);
            }
        }
        LateFindings { age, found }
    }
}

impl LanguageServer {
    /// The work that is to be done when nobody has said anything for a while; none if it was handed
    /// out for these texts already.
    pub fn later(&mut self) -> Option<LateWork> {
        if self.is_stale || !std::mem::take(&mut self.is_unprobed) {
            return None;
        }
        let workspace = self.workspace.clone();
        let age = self.age.load(Ordering::Relaxed);
        Some(LateWork { workspace, age, now: self.age.clone() })
    }

    /// Whether [`Self::later`] has something to do.
    pub fn has_later(&self) -> bool {
        self.is_unprobed && !self.is_stale
    }

    /// The problems of the texts of which something was or had been found, together with that;
    /// nothing if a text has changed since.
    pub fn settle(&mut self, late: &LateFindings) -> Vec<Message> {
        let mut messages = Vec::new();
        if late.age != self.age.load(Ordering::Relaxed) {
            return messages;
        }
        let was = std::mem::take(&mut self.late);
        let paths: BTreeSet<&PathBuf> = late.found.keys().chain(was.keys()).collect();
        let nothing = StartFindings::default();
        for path in paths {
            let (Some(said), Some(uri)) = (self.said.get(path), self.uri(path)) else { continue };
            let text = self.workspace.file_text(path).unwrap_or_default();
            let findings = late.found.get(path).unwrap_or(&nothing);
            let mut params = said.clone();
            self.add_late(&mut params, findings, &text);
            self.shown.insert(path.clone(), uri);
            let method = "textDocument/publishDiagnostics".to_owned();
            messages.push(Notification { method, params }.into());
        }
        for (path, findings) in &late.found {
            let text = self.workspace.file_text(path).unwrap_or_default().to_string();
            self.late.insert(path.clone(), KeptFindings::of(text, findings.clone()));
        }
        messages
    }

    /// Adds what starts have shown to the problems of a text.
    pub(super) fn add_late(&self, params: &mut Value, findings: &StartFindings, text: &str) {
        if let Some(all) = params.get_mut("diagnostics").and_then(Value::as_array_mut) {
            for report in &findings.reports {
                let report = self.diagnostic(report, text);
                // What the compiler has found meanwhile is said once.
                let is_same =
                    |it: &Value| (&it["code"], &it["range"]) == (&report["code"], &report["range"]);
                if !all.iter().any(is_same) {
                    all.push(report);
                }
            }
            all.extend(findings.notes.iter().map(|it| self.information(it, text)));
        }
    }

    /// Something worth knowing as the protocol has it.
    fn information(&self, note: &StartNote, text: &str) -> Value {
        json!({
            "range": range_of(text, &note.place.range),
            "severity": 3,
            "source": "setpiece",
            "message": note.message,
            "relatedInformation": self.related(&note.related),
        })
    }
}
