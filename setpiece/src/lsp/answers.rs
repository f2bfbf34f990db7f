//! The answers to requests.

use super::convert::{
    AtPlace, OfText, WithinText, bytes_of, offset_of, path_of, range_by, range_of, read,
    text_edits, workspace_edit,
};
use super::{LanguageServer, fault};
use crate::editor::text::Lines;
use crate::editor::{Action, ActionKind, Analysis, CompletionKind, ItemNode, ItemUses, SymbolKind};
use gen_lsp_types as lsp;
use lsp_server::{ErrorCode, ResponseError};
use serde::Deserialize;
use serde_json::{Value, json};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub(super) type Answer = Result<Value, ResponseError>;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct RenameTo {
    #[serde(flatten)]
    at: AtPlace,
    new_name: String,
}

#[derive(Deserialize)]
struct ReferencesOf {
    #[serde(flatten)]
    at: AtPlace,
    context: Option<ReferencesContext>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ReferencesContext {
    include_declaration: bool,
}

#[derive(Deserialize)]
struct ActionsOf {
    #[serde(flatten)]
    of: WithinText,
    context: ActionContext,
}

#[derive(Deserialize)]
struct ActionContext {
    /// The kinds that are wanted; every kind if absent.
    only: Option<Vec<String>>,
}

#[derive(Deserialize)]
struct OfItem {
    item: ItemPlace,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ItemPlace {
    uri: lsp::Uri,
    selection_range: lsp::Range,
}

#[derive(Deserialize)]
struct Query {
    query: String,
}

impl LanguageServer {
    /// The answer to a request.
    pub(super) fn answer(&mut self, method: &str, params: Value) -> Answer {
        match method {
            "textDocument/hover" => self.hover(read(params)?),
            "textDocument/definition" => self.definition(read(params)?),
            "textDocument/typeDefinition" => self.type_definition(read(params)?),
            "textDocument/references" => self.references(read(params)?),
            "textDocument/documentHighlight" => self.highlights(read(params)?),
            "textDocument/prepareRename" => self.prepare_rename(read(params)?),
            "textDocument/rename" => self.rename(read(params)?),
            "textDocument/linkedEditingRange" => self.linked(read(params)?),
            "textDocument/completion" => self.complete(read(params)?),
            "textDocument/signatureHelp" => self.signature(read(params)?),
            "textDocument/documentSymbol" => self.symbols(read(params)?),
            "workspace/symbol" => Ok(self.all_symbols(&read::<Query>(params)?.query)),
            "textDocument/documentLink" => self.links(read(params)?),
            "textDocument/foldingRange" => self.folds(read(params)?),
            "textDocument/selectionRange" => self.selections(read(params)?),
            "textDocument/semanticTokens/full" => self.tokens(read(params)?),
            "textDocument/inlayHint" => self.hints(read(params)?),
            "textDocument/codeLens" => self.lenses(read(params)?),
            "textDocument/codeAction" => self.actions(read(params)?),
            "textDocument/formatting" => {
                let (path, text) = self.text(&read::<OfText>(params)?.text_document.uri)?;
                Ok(text_edits(&text, &self.workspace.format(&path)))
            }
            "textDocument/rangeFormatting" => {
                let asked = read::<WithinText>(params)?;
                let (path, text) = self.text(&asked.text_document.uri)?;
                let within = bytes_of(&text, asked.range);
                Ok(text_edits(&text, &self.workspace.format_range(&path, &within)))
            }
            "textDocument/onTypeFormatting" => {
                let (path, text, at) = self.at(&read(params)?)?;
                Ok(text_edits(&text, &self.workspace.format_typed(&path, at)))
            }
            "textDocument/prepareTypeHierarchy" | "textDocument/prepareCallHierarchy" => {
                let (path, _, at) = self.at(&read(params)?)?;
                let node = self.workspace.node(&path, at);
                Ok(node.and_then(|node| self.node(&node)).map_or(Value::Null, |it| json!([it])))
            }
            "typeHierarchy/supertypes" | "typeHierarchy/subtypes" => {
                let Some(node) = self.item(&read::<OfItem>(params)?.item)? else {
                    return Ok(Value::Null);
                };
                let found = if method.ends_with("supertypes") {
                    self.workspace.parents(&node)
                } else {
                    self.workspace.children(&node)
                };
                Ok(found.iter().filter_map(|node| self.node(node)).collect())
            }
            "callHierarchy/incomingCalls" | "callHierarchy/outgoingCalls" => {
                let Some(node) = self.item(&read::<OfItem>(params)?.item)? else {
                    return Ok(Value::Null);
                };
                let (calls, end) = if method.ends_with("incomingCalls") {
                    (self.workspace.callers(&node), "from")
                } else {
                    (self.workspace.callees(&node), "to")
                };
                let of = |call: &ItemUses| {
                    if end == "from" {
                        call.node.place.path.clone()
                    } else {
                        node.place.path.clone()
                    }
                };
                Ok(calls
                    .iter()
                    .filter_map(|call| {
                        let text = self.workspace.file_text(&of(call))?;
                        let at: Vec<Value> = call.at.iter().map(|it| range_of(&text, it)).collect();
                        Some(json!({ end: self.node(&call.node)?, "fromRanges": at }))
                    })
                    .collect())
            }
            "setpiece/preview" => self.preview(read(params)?),
            "setpiece/move" => self.move_to(&read(params)?),
            other => Err(fault(ErrorCode::MethodNotFound, format!("`{other}` is not supported"))),
        }
    }

    /// A text that is asked about.
    pub(super) fn text(&self, uri: &lsp::Uri) -> Result<(PathBuf, Arc<str>), ResponseError> {
        let path = path_of(uri);
        let text = self.workspace.file_text(&path);
        let text = text.ok_or_else(|| {
            fault(ErrorCode::RequestFailed, format!("there is no text `{}`", uri.as_str()))
        })?;
        Ok((path, text))
    }

    /// A text that is asked about, and the byte.
    fn at(&self, asked: &AtPlace) -> Result<(PathBuf, Arc<str>, usize), ResponseError> {
        let (path, text) = self.text(&asked.text_document.uri)?;
        let at = offset_of(&Lines::of(&text), &text, asked.position);
        Ok((path, text, at))
    }

    /// What is known of a text that is asked about.
    pub(super) fn analysis(
        &mut self,
        uri: &lsp::Uri,
    ) -> Result<(PathBuf, Arc<Analysis>), ResponseError> {
        let (path, _) = self.text(uri)?;
        let analysis = self.workspace.analysis(&path);
        let analysis =
            analysis.ok_or_else(|| fault(ErrorCode::RequestFailed, "the text is gone"))?;
        Ok((path, analysis))
    }

    fn hover(&mut self, asked: AtPlace) -> Answer {
        let (path, text, at) = self.at(&asked)?;
        Ok(self.workspace.hover(&path, at).map_or(Value::Null, |hover| {
            json!({
                "contents": { "kind": "markdown", "value": hover.text },
                "range": range_of(&text, &hover.range),
            })
        }))
    }

    fn definition(&mut self, asked: AtPlace) -> Answer {
        let (path, _, at) = self.at(&asked)?;
        let place = self.workspace.declaration(&path, at).or_else(|| {
            let links = self.workspace.analysis(&path)?.links(&path);
            let link = links.into_iter().find(|it| it.range.start <= at && at <= it.range.end)?;
            Some(crate::editor::FilePlace { path: link.path, range: 0..0 })
        });
        Ok(place.and_then(|place| self.location(&place)).unwrap_or_default())
    }

    /// What the item whose name stands there extends.
    fn type_definition(&mut self, asked: AtPlace) -> Answer {
        let (path, _, at) = self.at(&asked)?;
        let node = self.workspace.node(&path, at);
        let parents = node.map(|node| self.workspace.parents(&node)).unwrap_or_default();
        Ok(parents.iter().filter_map(|parent| self.location(&parent.place)).collect())
    }

    fn references(&mut self, asked: ReferencesOf) -> Answer {
        let (path, _, at) = self.at(&asked.at)?;
        let found = self.workspace.places_of(&path, at);
        let is_wanted = asked.context.is_none_or(|it| it.include_declaration);
        let places = if is_wanted { found.all() } else { found.uses };
        Ok(places.iter().filter_map(|place| self.location(place)).collect())
    }

    fn highlights(&mut self, asked: AtPlace) -> Answer {
        let (path, text, at) = self.at(&asked)?;
        let mut places = self.workspace.references(&path, at);
        places.retain(|place| place.path == path);
        Ok(places.iter().map(|place| json!({ "range": range_of(&text, &place.range) })).collect())
    }

    fn prepare_rename(&mut self, asked: AtPlace) -> Answer {
        let (path, text, at) = self.at(&asked)?;
        let found = self.workspace.places_of(&path, at);
        let is_own = found.declarations.iter().all(|declaration| !declaration.is_in_library());
        let here = found
            .all()
            .into_iter()
            .find(|place| place.path == path && place.range.start <= at && at <= place.range.end);
        Ok(here.filter(|_| is_own).map_or(Value::Null, |it| range_of(&text, &it.range)))
    }

    fn rename(&mut self, asked: RenameTo) -> Answer {
        let (path, _, at) = self.at(&asked.at)?;
        let edits = self
            .workspace
            .rename(&path, at, &asked.new_name)
            .map_err(|why| fault(ErrorCode::RequestFailed, why.to_string()))?;
        Ok(workspace_edit(&self.workspace, &edits, |path| self.uri(path)))
    }

    /// The places of a name that are typed at once: all of them, if they are of one text.
    fn linked(&mut self, asked: AtPlace) -> Answer {
        let (path, text, at) = self.at(&asked)?;
        let places = self.workspace.linked(&path, at);
        if places.is_empty() {
            return Ok(Value::Null);
        }
        let ranges: Vec<Value> = places.iter().map(|it| range_of(&text, it)).collect();
        Ok(json!({ "ranges": ranges, "wordPattern": "[A-Za-z_][A-Za-z0-9_]*" }))
    }

    fn complete(&mut self, asked: AtPlace) -> Answer {
        let (path, _, at) = self.at(&asked)?;
        let found = self.workspace.complete(&path, at);
        Ok(found
            .into_iter()
            .map(|it| {
                let kind = match it.kind {
                    CompletionKind::Keyword => 14,
                    CompletionKind::Name => 6,
                    CompletionKind::Word => 21,
                    CompletionKind::Key => 5,
                    CompletionKind::File => 17,
                };
                let mut item = json!({ "label": it.text, "kind": kind, "detail": it.detail });
                if let Some(item) = item.as_object_mut() {
                    if !it.doc.is_empty() {
                        let doc = json!({ "kind": "markdown", "value": it.doc });
                        item.insert("documentation".to_owned(), doc);
                    }
                    if self.has_snippets && !it.snippet.is_empty() {
                        item.insert("insertText".to_owned(), it.snippet.into());
                        item.insert("insertTextFormat".to_owned(), 2.into());
                    }
                    // Names of the text stand before the words of the language.
                    let rank = if it.kind == CompletionKind::Name { "0" } else { "1" };
                    item.insert("sortText".to_owned(), format!("{rank}{}", it.text).into());
                }
                item
            })
            .collect())
    }

    fn signature(&mut self, asked: AtPlace) -> Answer {
        let (path, _, at) = self.at(&asked)?;
        Ok(self.workspace.signature(&path, at).map_or(Value::Null, |it| {
            let label = &it.label;
            let units = |at: usize| label.get(..at).unwrap_or_default().encode_utf16().count();
            let arguments: Vec<Value> = it
                .arguments
                .iter()
                .map(|range| json!({ "label": [units(range.start), units(range.end)] }))
                .collect();
            json!({
                "signatures": [{ "label": label, "documentation": it.doc, "parameters": arguments }],
                "activeSignature": 0,
                "activeParameter": it.active,
            })
        }))
    }

    fn all_symbols(&mut self, query: &str) -> Value {
        let query = query.to_lowercase();
        let paths: Vec<PathBuf> = self.workspace.paths().map(Path::to_owned).collect();
        let mut found = Vec::new();
        for path in paths {
            let Some(analysis) = self.workspace.analysis(&path) else { continue };
            let Some(uri) = self.uri(&path) else { continue };
            for symbol in analysis.symbols() {
                if symbol.name.to_lowercase().contains(&query) {
                    let range = range_by(&analysis.lines, &analysis.text, &symbol.range);
                    found.push(json!({
                        "name": symbol.name,
                        "kind": symbol_kind(symbol.kind),
                        "location": { "uri": uri, "range": range },
                    }));
                }
            }
        }
        found.into()
    }

    fn actions(&mut self, asked: ActionsOf) -> Answer {
        let (path, text) = self.text(&asked.of.text_document.uri)?;
        let within = bytes_of(&text, asked.of.range);
        // What mends a whole text is looked for when somebody wants it: it takes a while.
        let only = asked.context.only;
        let is_wanted = |kind: ActionKind| {
            let name = kind_of_action(kind);
            let covers = |asked: &String| {
                name.strip_prefix(asked.as_str())
                    .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
            };
            match &only {
                Some(only) => only.iter().any(covers),
                None => kind != ActionKind::FixAll,
            }
        };
        let mut actions = self.workspace.actions(&path, within);
        actions.retain(|action| is_wanted(action.kind));
        if is_wanted(ActionKind::FixAll) {
            actions.extend(self.workspace.fix_all(&path));
        }
        actions.retain(|action| action.refused.is_none() || self.shows_refused);
        let preferred = actions
            .iter()
            .position(|action| action.kind == ActionKind::Fix && action.refused.is_none());
        let shown = |(at, action): (usize, &Action)| {
            let mut shown = json!({
                "title": action.title,
                "kind": kind_of_action(action.kind),
                "isPreferred": preferred == Some(at),
            });
            if let Some(reason) = &action.refused {
                shown["disabled"] = json!({ "reason": reason });
            } else {
                let uri = |path: &Path| self.uri(path);
                shown["edit"] = workspace_edit(&self.workspace, &action.edits, uri);
            }
            shown
        };
        Ok(actions.iter().enumerate().map(shown).collect())
    }

    /// An item as the hierarchies have it.
    fn node(&self, node: &ItemNode) -> Option<Value> {
        let text = self.workspace.file_text(&node.place.path)?;
        Some(json!({
            "name": node.name,
            "kind": symbol_kind(node.kind),
            "uri": self.uri(&node.place.path)?,
            "range": range_of(&text, &node.whole),
            "selectionRange": range_of(&text, &node.place.range),
        }))
    }

    /// The item that a hierarchy goes on from.
    fn item(&mut self, item: &ItemPlace) -> Result<Option<ItemNode>, ResponseError> {
        let (path, text) = self.text(&item.uri)?;
        let at: Range<usize> = bytes_of(&text, item.selection_range);
        Ok(self.workspace.node(&path, at.start))
    }
}

/// The protocol's name of a kind of action.
fn kind_of_action(kind: ActionKind) -> &'static str {
    match kind {
        ActionKind::Fix => "quickfix",
        ActionKind::FixAll => "source.fixAll",
        ActionKind::Extract => "refactor.extract",
        ActionKind::Rewrite => "refactor.rewrite",
    }
}

pub(super) fn symbol_kind(kind: SymbolKind) -> u32 {
    match kind {
        SymbolKind::Scenario => 5,
        SymbolKind::Reward | SymbolKind::Ending => 24,
        SymbolKind::Formation | SymbolKind::Team => 23,
        SymbolKind::Function | SymbolKind::Behavior => 12,
        SymbolKind::Value => 14,
        SymbolKind::Parameter => 7,
        SymbolKind::Plan => 2,
        SymbolKind::Player => 19,
    }
}
