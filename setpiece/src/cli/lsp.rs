//! `setpiece lsp`: answers an editor over the Language Server Protocol, on standard input and output.

use super::common::{FAULT, FINE};
use crate::dsl::format::format;
use crate::dsl::problem::Severity;
use crate::dsl::report::diagnostics;
use crate::dsl::source::{FileId, Source};
use crate::editor::text::{Lines, Position};
use crate::editor::{self, Analysis, CompletionKind, FilePlace, Symbol, Workspace};
use gen_lsp_types as lsp;
use lsp::{Notification as _, Request as _};
use lsp_server::{Connection, ErrorCode, Message, Notification, Request, Response, ResponseError};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Serves one editor until it leaves; gives the exit code.
pub(super) fn serve() -> u8 {
    let (connection, threads) = Connection::stdio();
    let fine = talk(&connection).is_some();
    drop(connection);
    if threads.join().is_ok() && fine { FINE } else { FAULT }
}

/// The conversation; `None` if the editor breaks it off.
fn talk(connection: &Connection) -> Option<()> {
    let result = lsp::InitializeResult {
        capabilities: capabilities(),
        server_info: Some(lsp::ServerInfo {
            name: "setpiece".to_owned(),
            version: Some(env!("CARGO_PKG_VERSION").to_owned()),
        }),
    };
    let (id, _) = connection.initialize_start().ok()?;
    connection.initialize_finish(id, serde_json::to_value(result).ok()?).ok()?;
    let mut server = Server {
        connection,
        workspace: Workspace::default(),
        uris: BTreeMap::new(),
        shown: BTreeSet::new(),
    };
    for message in &connection.receiver {
        match message {
            Message::Request(request) => {
                if connection.handle_shutdown(&request).ok()? {
                    return Some(());
                }
                server.answer(request);
            }
            Message::Notification(note) => server.hear(&note),
            Message::Response(_) => {}
        }
    }
    None
}

fn capabilities() -> lsp::ServerCapabilities {
    let triggers = [".", "\"", " ", ":"].map(str::to_owned).to_vec();
    lsp::ServerCapabilities {
        text_document_sync: Some(lsp::TextDocumentSyncKind::Full.into()),
        hover_provider: Some(true.into()),
        definition_provider: Some(true.into()),
        references_provider: Some(true.into()),
        rename_provider: Some(true.into()),
        document_symbol_provider: Some(true.into()),
        document_formatting_provider: Some(true.into()),
        code_action_provider: Some(true.into()),
        completion_provider: Some(lsp::CompletionOptions {
            trigger_characters: Some(triggers),
            ..lsp::CompletionOptions::default()
        }),
        ..lsp::ServerCapabilities::default()
    }
}

struct Server<'a> {
    connection: &'a Connection,
    workspace: Workspace,
    /// How the editor calls the open texts.
    uris: BTreeMap<PathBuf, lsp::Uri>,
    /// The files whose problems the editor shows.
    shown: BTreeSet<PathBuf>,
}

/// The path of a text: that of its file, or the whole address if it has none.
fn path_of(uri: &lsp::Uri) -> PathBuf {
    uri.to_file_path().unwrap_or_else(|()| PathBuf::from(uri.as_str()))
}

fn range_of(lines: &Lines, text: &str, range: &Range<usize>) -> lsp::Range {
    let at = |offset| {
        let Position { line, column } = lines.position(text, offset);
        lsp::Position { line, character: column }
    };
    lsp::Range { start: at(range.start), end: at(range.end) }
}

/// Reads the parameters of a message.
fn read<T: DeserializeOwned>(params: serde_json::Value) -> Result<T, ResponseError> {
    serde_json::from_value(params).map_err(|why| fault(ErrorCode::InvalidParams, why.to_string()))
}

fn fault(code: ErrorCode, message: String) -> ResponseError {
    ResponseError { code: code as i32, message, data: None }
}

fn json(value: impl Serialize) -> Result<serde_json::Value, ResponseError> {
    serde_json::to_value(value).map_err(|why| fault(ErrorCode::InternalError, why.to_string()))
}

impl Server<'_> {
    fn hear(&mut self, note: &Notification) {
        let params = note.params.clone();
        match note.method.as_str() {
            "textDocument/didOpen" => {
                let Ok(opened) = read::<lsp::DidOpenTextDocumentParams>(params) else { return };
                let document = opened.text_document;
                let path = path_of(&document.uri);
                self.uris.insert(path.clone(), document.uri);
                self.workspace.set(&path, &document.text);
            }
            "textDocument/didChange" => {
                let Ok(changed) = read::<lsp::DidChangeTextDocumentParams>(params) else { return };
                let path = path_of(&changed.text_document.text_document_identifier.uri);
                for change in changed.content_changes {
                    if let lsp::TextDocumentContentChangeEvent::TextDocumentContentChangeWholeDocument(
                        whole,
                    ) = change
                    {
                        self.workspace.set(&path, &whole.text);
                    }
                }
            }
            "textDocument/didClose" => {
                let Ok(closed) = read::<lsp::DidCloseTextDocumentParams>(params) else { return };
                let path = path_of(&closed.text_document.uri);
                self.workspace.close(&path);
            }
            "textDocument/didSave" | "workspace/didChangeWatchedFiles" => self.workspace.refresh(),
            _ => return,
        }
        self.publish();
    }

    /// Sends the problems of all open texts; a file that has none any more is told so.
    fn publish(&mut self) {
        let paths: Vec<PathBuf> = self.workspace.paths().map(Path::to_owned).collect();
        let mut found: BTreeMap<PathBuf, Vec<lsp::Diagnostic>> = BTreeMap::new();
        for path in &paths {
            let list = found.entry(path.clone()).or_default();
            if let Some(analysis) = self.workspace.analysis(path) {
                *list = own_diagnostics(&analysis);
            }
        }
        for gone in std::mem::take(&mut self.shown) {
            found.entry(gone).or_default();
        }
        for (path, diagnostics) in found {
            let Some(uri) = self.uri(&path) else { continue };
            if !diagnostics.is_empty() {
                self.shown.insert(path);
            }
            let params = lsp::PublishDiagnosticsParams { uri, version: None, diagnostics };
            let method = "textDocument/publishDiagnostics".to_owned();
            let Ok(params) = json(params) else { continue };
            // An editor that has gone hears nothing more.
            let _ = self.connection.sender.send(Notification { method, params }.into());
        }
    }

    fn uri(&self, path: &Path) -> Option<lsp::Uri> {
        self.uris.get(path).cloned().or_else(|| lsp::Uri::from_file_path(path).ok())
    }

    fn answer(&mut self, request: Request) {
        let id = request.id.clone();
        let answer = match self.result_of(request) {
            Ok(result) => Response::new_ok(id, result),
            Err(error) => Response::new_err(id, error.code, error.message),
        };
        let _ = self.connection.sender.send(answer.into());
    }

    fn result_of(
        &mut self,
        Request { method, params, .. }: Request,
    ) -> Result<serde_json::Value, ResponseError> {
        match method.as_str() {
            "textDocument/hover" => {
                let asked = read::<lsp::HoverParams>(params)?;
                json(self.hover(&asked.text_document_position_params))
            }
            "textDocument/definition" => {
                let asked = read::<lsp::DefinitionParams>(params)?;
                json(self.definition(&asked.text_document_position_params))
            }
            "textDocument/references" => {
                let asked = read::<lsp::ReferenceParams>(params)?;
                json(self.references(&asked.text_document_position_params))
            }
            "textDocument/rename" => {
                let asked = read::<lsp::RenameParams>(params)?;
                json(self.rename(&asked)?)
            }
            "textDocument/completion" => {
                let asked = read::<lsp::CompletionParams>(params)?;
                json(self.complete(&asked.text_document_position_params))
            }
            "textDocument/documentSymbol" => {
                let asked = read::<lsp::DocumentSymbolParams>(params)?;
                json(self.symbols(&asked.text_document.uri))
            }
            "textDocument/formatting" => {
                let asked = read::<lsp::DocumentFormattingParams>(params)?;
                json(self.formatted(&asked.text_document.uri))
            }
            "textDocument/codeAction" => {
                let asked = read::<lsp::CodeActionParams>(params)?;
                json(self.actions(&asked))
            }
            other => Err(fault(ErrorCode::MethodNotFound, format!("`{other}` is not supported"))),
        }
    }

    /// The text that is asked about, and the byte.
    fn place(&mut self, at: &lsp::TextDocumentPositionParams) -> Option<(PathBuf, usize)> {
        let path = path_of(&at.text_document.uri);
        let analysis = self.workspace.analysis(&path)?;
        let lsp::Position { line, character } = at.position;
        let position = Position { line, column: character };
        Some((path, analysis.lines.offset(&analysis.text, position)))
    }

    fn hover(&mut self, at: &lsp::TextDocumentPositionParams) -> Option<lsp::Hover> {
        let (path, offset) = self.place(at)?;
        let hover = self.workspace.hover(&path, offset)?;
        let analysis = self.workspace.analysis(&path)?;
        Some(lsp::Hover {
            contents: lsp::Contents::MarkupContent(lsp::MarkupContent {
                kind: lsp::MarkupKind::Markdown,
                value: hover.text,
            }),
            range: Some(range_of(&analysis.lines, &analysis.text, &hover.range)),
        })
    }

    /// A place as the editor knows it; none for a file of the library, which isn't on disk.
    fn location(&self, place: &FilePlace) -> Option<lsp::Location> {
        if place.is_in_library() {
            return None;
        }
        let text = match self.workspace.text(&place.path) {
            Some(text) => text.to_string(),
            None => std::fs::read_to_string(&place.path).ok()?,
        };
        let range = range_of(&Lines::of(&text), &text, &place.range);
        Some(lsp::Location { uri: self.uri(&place.path)?, range })
    }

    fn definition(&mut self, at: &lsp::TextDocumentPositionParams) -> Option<lsp::Location> {
        let (path, offset) = self.place(at)?;
        let place = self.workspace.declaration(&path, offset)?;
        self.location(&place)
    }

    fn references(&mut self, at: &lsp::TextDocumentPositionParams) -> Vec<lsp::Location> {
        let Some((path, offset)) = self.place(at) else { return Vec::new() };
        let places = self.workspace.references(&path, offset);
        places.iter().filter_map(|place| self.location(place)).collect()
    }

    fn rename(&mut self, asked: &lsp::RenameParams) -> Result<serde_json::Value, ResponseError> {
        let refuse = |why: String| fault(ErrorCode::RequestFailed, why);
        let (path, offset) = self
            .place(&asked.text_document_position_params)
            .ok_or_else(|| refuse("the text is not open".to_owned()))?;
        let edits = self
            .workspace
            .rename(&path, offset, &asked.new_name)
            .map_err(|why| refuse(why.to_string()))?;
        // As an object by address, whose order is that of the edits.
        let mut changes: BTreeMap<String, Vec<lsp::TextEdit>> = BTreeMap::new();
        for edit in edits {
            let Some(location) = self.location(&edit.place) else { continue };
            let edit = lsp::TextEdit { range: location.range, new_text: edit.text };
            changes.entry(location.uri.to_string()).or_default().push(edit);
        }
        json(serde_json::json!({ "changes": changes }))
    }

    fn complete(&mut self, at: &lsp::TextDocumentPositionParams) -> Vec<lsp::CompletionItem> {
        let Some((path, offset)) = self.place(at) else { return Vec::new() };
        let found = self.workspace.complete(&path, offset);
        let item = |completion: editor::Completion| lsp::CompletionItem {
            label: completion.text,
            kind: Some(match completion.kind {
                CompletionKind::Keyword => lsp::CompletionItemKind::Keyword,
                CompletionKind::Name => lsp::CompletionItemKind::Variable,
                CompletionKind::Word => lsp::CompletionItemKind::Constant,
                CompletionKind::Key => lsp::CompletionItemKind::Field,
                CompletionKind::File => lsp::CompletionItemKind::File,
            }),
            detail: Some(completion.detail),
            documentation: (!completion.doc.is_empty()).then(|| completion.doc.into()),
            ..lsp::CompletionItem::default()
        };
        found.into_iter().map(item).collect()
    }

    fn symbols(&mut self, uri: &lsp::Uri) -> Vec<lsp::DocumentSymbol> {
        let Some(analysis) = self.workspace.analysis(&path_of(uri)) else { return Vec::new() };
        analysis.symbols().iter().map(|symbol| shown_symbol(&analysis, symbol)).collect()
    }

    /// The edit that formats a text; none if it can't be read, or is formatted.
    fn formatted(&mut self, uri: &lsp::Uri) -> Option<Vec<lsp::TextEdit>> {
        let analysis = self.workspace.analysis(&path_of(uri))?;
        let source = Source { name: String::new(), text: analysis.text.clone() };
        let formatted = format(&source).ok()?;
        if formatted == *analysis.text {
            return Some(Vec::new());
        }
        let range = range_of(&analysis.lines, &analysis.text, &(0..analysis.text.len()));
        Some(vec![lsp::TextEdit { range, new_text: formatted }])
    }

    fn actions(&mut self, asked: &lsp::CodeActionParams) -> Vec<serde_json::Value> {
        let uri = &asked.text_document.uri;
        let Some(analysis) = self.workspace.analysis(&path_of(uri)) else { return Vec::new() };
        let offset = |at: lsp::Position| {
            let position = Position { line: at.line, column: at.character };
            analysis.lines.offset(&analysis.text, position)
        };
        let fixes = analysis.fixes(offset(asked.range.start)..offset(asked.range.end));
        fixes
            .into_iter()
            .map(|fix| {
                let range = range_of(&analysis.lines, &analysis.text, &fix.range);
                serde_json::json!({
                    "title": fix.title,
                    "kind": "quickfix",
                    "isPreferred": true,
                    "edit": { "changes": { uri.as_str(): [{ "range": range, "newText": fix.text }] } },
                })
            })
            .collect()
    }
}

/// The problems of a text that stand in it. What is wrong in a file that it imports stands at the
/// beginning, unless that file is open itself.
fn own_diagnostics(analysis: &Analysis) -> Vec<lsp::Diagnostic> {
    let shown = diagnostics(&analysis.problems, &analysis.sources);
    let mut problems: Vec<&crate::dsl::problem::Problem> = analysis.problems.iter().collect();
    problems.sort_by_key(|problem| (problem.place().file, problem.place().start, problem.code()));
    problems
        .into_iter()
        .zip(shown)
        .map(|(problem, diagnostic)| {
            let place = problem.place();
            let own = place.file == FileId(0);
            let bytes = if own { place.start as usize..place.end as usize } else { 0..0 };
            let mut message = diagnostic.message;
            if !own && let Some(source) = analysis.sources.get(place.file) {
                let (line, column) = source.line_column(place.start);
                message = format!("{}:{line}:{column}: {message}", source.name);
            }
            if let Some(help) = diagnostic.help {
                message = format!("{message}\nhelp: {help}");
            }
            lsp::Diagnostic {
                range: range_of(&analysis.lines, &analysis.text, &bytes),
                severity: Some(match problem.severity() {
                    Severity::Error => lsp::DiagnosticSeverity::Error,
                    Severity::Warning => lsp::DiagnosticSeverity::Warning,
                }),
                code: Some(diagnostic.code.into()),
                source: Some("setpiece".to_owned()),
                message: message.into(),
                ..lsp::Diagnostic::default()
            }
        })
        .collect()
}

fn shown_symbol(analysis: &Analysis, symbol: &Symbol) -> lsp::DocumentSymbol {
    use editor::SymbolKind as Kind;
    let range = |bytes: &Range<usize>| range_of(&analysis.lines, &analysis.text, bytes);
    let inside: Vec<_> = symbol.inside.iter().map(|it| shown_symbol(analysis, it)).collect();
    lsp::DocumentSymbol {
        name: symbol.name.clone(),
        detail: None,
        tags: None,
        deprecated: None,
        kind: match symbol.kind {
            Kind::Scenario => lsp::SymbolKind::Class,
            Kind::Reward | Kind::Ending => lsp::SymbolKind::Event,
            Kind::Formation | Kind::Team => lsp::SymbolKind::Struct,
            Kind::Function | Kind::Behavior => lsp::SymbolKind::Function,
            Kind::Value => lsp::SymbolKind::Constant,
            Kind::Parameter => lsp::SymbolKind::Property,
            Kind::Plan => lsp::SymbolKind::Module,
            Kind::Player => lsp::SymbolKind::Object,
        },
        range: range(&symbol.whole),
        selection_range: range(&symbol.range),
        children: (!inside.is_empty()).then_some(inside),
    }
}
