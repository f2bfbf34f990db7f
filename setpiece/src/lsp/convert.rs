//! Places, addresses and parameters as the protocol has them.

use super::{fault, library};
use crate::editor::text::{Lines, Position};
use crate::editor::{Edit, Workspace};
use gen_lsp_types as lsp;
use lsp_server::{ErrorCode, ResponseError};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::PathBuf;

/// What most requests ask about: a text.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct OfText {
    pub(super) text_document: lsp::TextDocumentIdentifier,
}

/// A place of a text.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct AtPlace {
    pub(super) text_document: lsp::TextDocumentIdentifier,
    pub(super) position: lsp::Position,
}

/// A part of a text.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct WithinText {
    pub(super) text_document: lsp::TextDocumentIdentifier,
    pub(super) range: lsp::Range,
}

/// Reads the parameters of a message.
pub(super) fn read<T: DeserializeOwned>(params: Value) -> Result<T, ResponseError> {
    serde_json::from_value(params).map_err(|why| fault(ErrorCode::InvalidParams, why.to_string()))
}

/// The path of a text: that of its file, or the whole address if it has none.
pub(super) fn path_of(uri: &lsp::Uri) -> PathBuf {
    let path = uri.to_file_path().unwrap_or_else(|()| PathBuf::from(uri.as_str()));
    library::name_of(&path).unwrap_or(path)
}

/// A range of bytes of a text as the protocol has it.
pub(super) fn range_of(text: &str, range: &Range<usize>) -> Value {
    range_by(&Lines::of(text), text, range)
}

/// The same, where the lines of the text are known.
pub(super) fn range_by(lines: &Lines, text: &str, range: &Range<usize>) -> Value {
    let at = |offset| {
        let Position { line, column } = lines.position(text, offset);
        json!({ "line": line, "character": column })
    };
    json!({ "start": at(range.start), "end": at(range.end) })
}

/// The byte of a place.
pub(super) fn offset_of(lines: &Lines, text: &str, at: lsp::Position) -> usize {
    lines.offset(text, Position { line: at.line, column: at.character })
}

/// The bytes of a range.
pub(super) fn bytes_of(text: &str, range: lsp::Range) -> Range<usize> {
    let lines = Lines::of(text);
    let start = offset_of(&lines, text, range.start);
    start..offset_of(&lines, text, range.end).max(start)
}

/// The edits of one text.
pub(super) fn text_edits(text: &str, edits: &[Edit]) -> Value {
    let lines = Lines::of(text);
    edits
        .iter()
        .map(|edit| {
            json!({ "range": range_by(&lines, text, &edit.place.range), "newText": edit.text })
        })
        .collect()
}

/// Edits of texts, by their addresses.
pub(super) fn workspace_edit(
    workspace: &Workspace,
    edits: &[Edit],
    uri: impl Fn(&std::path::Path) -> Option<lsp::Uri>,
) -> Value {
    let mut files: BTreeMap<&PathBuf, Vec<Edit>> = BTreeMap::new();
    for edit in edits {
        files.entry(&edit.place.path).or_default().push(edit.clone());
    }
    let mut changes = serde_json::Map::new();
    for (path, edits) in files {
        if let (Some(uri), Some(text)) = (uri(path), workspace.file_text(path)) {
            changes.insert(uri.to_string(), text_edits(&text, &edits));
        }
    }
    json!({ "changes": changes })
}

/// The folders that an editor has open, as its `initialize` says.
pub(super) fn folders_of(params: &Value) -> Vec<PathBuf> {
    let listed = params.get("workspaceFolders").and_then(Value::as_array);
    let listed: Vec<&Value> = listed.into_iter().flatten().filter_map(|it| it.get("uri")).collect();
    let uris = if listed.is_empty() { params.get("rootUri").into_iter().collect() } else { listed };
    let uri = |uri: &Value| serde_json::from_value::<lsp::Uri>(uri.clone()).ok();
    uris.into_iter().filter_map(uri).map(|uri| path_of(&uri)).collect()
}
