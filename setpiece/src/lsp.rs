//! The Language Server Protocol over the [`editor`](mod@crate::editor)'s questions: messages in,
//! messages out, whatever carries them. `setpiece lsp` carries them over standard input and output,
//! the studio over its page's connection.

mod answers;
mod convert;
mod kept;
mod late;
mod library;
mod looks;
mod start;

pub use late::{LateFindings, LateWork, QUIET};

use crate::editor::Workspace;
use convert::{path_of, range_of, read};
use gen_lsp_types as lsp;
use kept::KeptFindings;
use lsp_server::{ErrorCode, Message, Notification, Response, ResponseError};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// What the server can do, as the answer to `initialize` says it.
pub fn capabilities() -> Value {
    let kinds: Vec<&str> = looks::TOKEN_KINDS.iter().map(|(_, name)| *name).collect();
    json!({
        "capabilities": {
            "positionEncoding": "utf-16",
            "textDocumentSync": { "openClose": true, "change": 1, "save": true },
            "hoverProvider": true,
            "definitionProvider": true,
            "typeDefinitionProvider": true,
            "referencesProvider": true,
            "documentHighlightProvider": true,
            "renameProvider": { "prepareProvider": true },
            "linkedEditingRangeProvider": true,
            "documentSymbolProvider": true,
            "workspaceSymbolProvider": true,
            "typeHierarchyProvider": true,
            "callHierarchyProvider": true,
            "documentLinkProvider": {},
            "foldingRangeProvider": true,
            "selectionRangeProvider": true,
            "semanticTokensProvider": {
                "legend": { "tokenTypes": kinds, "tokenModifiers": ["declaration", "defaultLibrary"] },
                "full": true,
            },
            "inlayHintProvider": true,
            "codeLensProvider": {},
            "signatureHelpProvider": { "triggerCharacters": ["(", ","] },
            "completionProvider": { "triggerCharacters": [".", "\"", "/"] },
            "codeActionProvider": {
                "codeActionKinds": ["quickfix", "source.fixAll", "refactor.extract", "refactor.rewrite"],
            },
            "documentFormattingProvider": true,
            "documentRangeFormattingProvider": true,
            "documentOnTypeFormattingProvider": { "firstTriggerCharacter": "}" },
        },
        "serverInfo": { "name": "setpiece", "version": env!("CARGO_PKG_VERSION") },
    })
}

/// The server's side of a conversation with one editor.
#[derive(Debug)]
pub struct LanguageServer {
    workspace: Workspace,
    /// How the editor calls the open texts, and the versions of them.
    open: BTreeMap<PathBuf, (lsp::Uri, Option<i32>)>,
    /// The files whose problems the editor shows, under its names for them.
    shown: BTreeMap<PathBuf, lsp::Uri>,
    /// Whether texts have changed since the last problems were sent.
    is_stale: bool,
    /// Whether the starts of the texts as they are now are still to be drawn.
    is_unprobed: bool,
    /// How often the texts have changed.
    age: Arc<AtomicU64>,
    /// The problems that were sent last, by file, without those that come later.
    said: BTreeMap<PathBuf, Value>,
    /// What was found later and is still shown, by file.
    late: BTreeMap<PathBuf, KeptFindings>,
    /// Whether the editor fills places in what it inserts.
    has_snippets: bool,
    /// Whether the editor shows an action that can't be done, with its reason.
    shows_refused: bool,
}

impl LanguageServer {
    /// A server for an editor.
    ///
    /// - `params`: what its `initialize` says of it.
    /// - `allow_outside`: whether imports and scripts may be outside a text's folder.
    pub fn new(params: &Value, allow_outside: bool) -> LanguageServer {
        let can = |what: &str| {
            let found = params.pointer(&format!("/capabilities/textDocument/{what}"));
            found.and_then(Value::as_bool).unwrap_or_default()
        };
        LanguageServer {
            workspace: Workspace::new(allow_outside).with_folders(convert::folders_of(params)),
            open: BTreeMap::new(),
            shown: BTreeMap::new(),
            is_stale: false,
            is_unprobed: false,
            age: Arc::default(),
            said: BTreeMap::new(),
            late: BTreeMap::new(),
            has_snippets: can("completion/completionItem/snippetSupport"),
            shows_refused: can("codeAction/disabledSupport"),
        }
    }

    /// Takes a message, and gives what is to be sent for it: the answer to a request, nothing
    /// otherwise. `initialize` and `shutdown` are the carrier's.
    pub fn receive(&mut self, message: Message) -> Vec<Message> {
        match message {
            Message::Request(request) => {
                let id = request.id.clone();
                let answer = match self.answer(&request.method, request.params) {
                    Ok(result) => Response::new_ok(id, result),
                    Err(why) => Response::new_err(id, why.code, why.message),
                };
                vec![answer.into()]
            }
            Message::Notification(note) => {
                // What can't be understood has no answer in the protocol.
                let _ = self.hear(&note.method, note.params);
                Vec::new()
            }
            Message::Response(_) => Vec::new(),
        }
    }

    fn hear(&mut self, method: &str, params: Value) -> Result<(), ResponseError> {
        match method {
            "textDocument/didOpen" => {
                let document = read::<lsp::DidOpenTextDocumentParams>(params)?.text_document;
                let path = path_of(&document.uri);
                self.workspace.set(&path, &document.text);
                self.open.insert(path, (document.uri, Some(document.version)));
            }
            "textDocument/didChange" => {
                let changed = read::<lsp::DidChangeTextDocumentParams>(params)?;
                let document = changed.text_document;
                let path = path_of(&document.text_document_identifier.uri);
                for change in changed.content_changes {
                    use lsp::TextDocumentContentChangeEvent as Change;
                    if let Change::TextDocumentContentChangeWholeDocument(whole) = change {
                        self.workspace.set(&path, &whole.text);
                    }
                }
                if let Some((_, version)) = self.open.get_mut(&path) {
                    *version = Some(document.version);
                }
            }
            "textDocument/didClose" => {
                let closed = read::<lsp::DidCloseTextDocumentParams>(params)?;
                let path = path_of(&closed.text_document.uri);
                self.workspace.close(&path);
                self.open.remove(&path);
            }
            "textDocument/didSave" | "workspace/didChangeWatchedFiles" => self.workspace.refresh(),
            _ => return Ok(()),
        }
        self.is_stale = true;
        self.age.fetch_add(1, Ordering::Relaxed);
        Ok(())
    }

    /// The problems of all open texts, if something has changed since they were sent last. Send
    /// them when no other message waits. A file that has none any more is sent without.
    pub fn publish(&mut self) -> Vec<Message> {
        if !std::mem::take(&mut self.is_stale) {
            return Vec::new();
        }
        let mut found = self.workspace.reports();
        let shown = std::mem::take(&mut self.shown);
        for gone in shown.keys() {
            found.entry(gone.clone()).or_default();
        }
        self.is_unprobed = true;
        self.said.clear();
        let mut messages = Vec::new();
        for (path, reports) in found {
            let Some(uri) = shown.get(&path).cloned().or_else(|| self.uri(&path)) else { continue };
            // A text that is gone has no problems any more.
            let text = self.workspace.file_text(&path).unwrap_or_default();
            if !reports.is_empty() || self.late.contains_key(&path) {
                self.shown.insert(path.clone(), uri.clone());
            }
            let diagnostics: Vec<Value> =
                reports.iter().map(|report| self.diagnostic(report, &text)).collect();
            let version = self.open.get(&path).and_then(|(_, version)| *version);
            let mut params = json!({ "uri": uri, "diagnostics": diagnostics });
            if let (Some(version), Some(params)) = (version, params.as_object_mut()) {
                params.insert("version".to_owned(), version.into());
            }
            self.said.insert(path.clone(), params.clone());
            if let Some(kept) = self.late.get(&path).filter(|_| version.is_some()) {
                self.add_late(&mut params, &kept.within(&path, &text), &text);
            }
            let method = "textDocument/publishDiagnostics".to_owned();
            messages.push(Notification { method, params }.into());
        }
        messages
    }

    /// How an editor calls a file; one of the library is written to disk for it.
    fn uri(&self, path: &Path) -> Option<lsp::Uri> {
        if let Some((uri, _)) = self.open.get(path) {
            return Some(uri.clone());
        }
        let on_disk = library::on_disk(path);
        lsp::Uri::from_file_path(on_disk.as_deref().unwrap_or(path)).ok()
    }

    /// A place as an editor knows it.
    fn location(&self, place: &crate::editor::FilePlace) -> Option<Value> {
        let text = self.workspace.file_text(&place.path)?;
        let range = range_of(&text, &place.range);
        Some(json!({ "uri": self.uri(&place.path)?, "range": range }))
    }
}

fn fault(code: ErrorCode, message: impl Into<String>) -> ResponseError {
    ResponseError { code: code as i32, message: message.into(), data: None }
}
