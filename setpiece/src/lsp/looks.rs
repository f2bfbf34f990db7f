//! How a text looks in an editor: problems, outline, folds, colours, hints, lenses.

use super::LanguageServer;
use super::answers::{Answer, symbol_kind};
use super::convert::{OfText, WithinText, bytes_of, offset_of, range_by, range_of};
use crate::dsl::problem::Severity;
use crate::editor::{Analysis, FilePlace, FoldedKind, LensKind, Symbol, TextReport, TokenKind};
use gen_lsp_types as lsp;
use serde::Deserialize;
use serde_json::{Value, json};
use std::ops::Range;

/// What the protocol calls the kinds of names.
pub(super) const TOKEN_KINDS: [(TokenKind, &str); 7] = [
    (TokenKind::Scenario, "class"),
    (TokenKind::Reward, "event"),
    (TokenKind::Formation, "struct"),
    (TokenKind::Function, "function"),
    (TokenKind::Parameter, "parameter"),
    (TokenKind::Value, "variable"),
    (TokenKind::Player, "property"),
];

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Positions {
    text_document: lsp::TextDocumentIdentifier,
    positions: Vec<lsp::Position>,
}

impl LanguageServer {
    /// A report as the protocol has it; `text`: the text of its file.
    pub(super) fn diagnostic(&self, report: &TextReport, text: &str) -> Value {
        let message = match &report.help {
            Some(help) => format!("{}\nhelp: {help}", report.message),
            None => report.message.clone(),
        };
        let code = report.code.to_string();
        // A name or statement that does nothing is shown faint.
        let is_unused = report.message.contains("never used");
        json!({
            "range": range_of(text, &report.place.range),
            "severity": match report.severity {
                Severity::Error => 1,
                Severity::Warning => 2,
            },
            "code": code,
            "codeDescription": { "href": format!("{}/errors/{code}/", crate::DOCS) },
            "source": "setpiece",
            "message": message,
            "relatedInformation": self.related(&report.related),
            "tags": if is_unused { vec![1] } else { Vec::new() },
        })
    }

    /// Further places as the protocol has them.
    pub(super) fn related(&self, places: &[(FilePlace, String)]) -> Value {
        let shown = |(place, words): &(FilePlace, String)| {
            Some(json!({ "location": self.location(place)?, "message": words }))
        };
        places.iter().filter_map(shown).collect()
    }

    pub(super) fn symbols(&mut self, asked: OfText) -> Answer {
        let (_, analysis) = self.analysis(&asked.text_document.uri)?;
        Ok(analysis.symbols().iter().map(|symbol| shown_symbol(&analysis, symbol)).collect())
    }

    pub(super) fn links(&mut self, asked: OfText) -> Answer {
        let (path, analysis) = self.analysis(&asked.text_document.uri)?;
        Ok(analysis
            .links(&path)
            .iter()
            .filter_map(|link| {
                let range = range_by(&analysis.lines, &analysis.text, &link.range);
                Some(json!({ "range": range, "target": self.uri(&link.path)? }))
            })
            .collect())
    }

    pub(super) fn folds(&mut self, asked: OfText) -> Answer {
        let (_, analysis) = self.analysis(&asked.text_document.uri)?;
        let line = |at: usize| analysis.lines.position(&analysis.text, at).line;
        Ok(analysis
            .folds()
            .iter()
            .map(|fold| {
                let (start, end) = (line(fold.range.start), line(fold.range.end.saturating_sub(1)));
                let (kind, end) = match fold.kind {
                    // The line of the closing bracket stays.
                    FoldedKind::Block => ("region", end.saturating_sub(1).max(start)),
                    FoldedKind::Comment => ("comment", end),
                    FoldedKind::Imports => ("imports", end),
                };
                json!({ "startLine": start, "endLine": end, "kind": kind })
            })
            .collect())
    }

    pub(super) fn selections(&mut self, asked: Positions) -> Answer {
        let (_, analysis) = self.analysis(&asked.text_document.uri)?;
        let of = |at: lsp::Position| {
            let at = offset_of(&analysis.lines, &analysis.text, at);
            analysis.selections(at).iter().rev().fold(Value::Null, |parent, range| {
                let range = range_by(&analysis.lines, &analysis.text, range);
                if parent.is_null() {
                    json!({ "range": range })
                } else {
                    json!({ "range": range, "parent": parent })
                }
            })
        };
        Ok(asked.positions.into_iter().map(of).collect())
    }

    pub(super) fn tokens(&mut self, asked: OfText) -> Answer {
        let (_, analysis) = self.analysis(&asked.text_document.uri)?;
        let (mut line, mut column) = (0, 0);
        let mut data: Vec<usize> = Vec::new();
        for token in analysis.tokens() {
            let at = analysis.lines.position(&analysis.text, token.range.start);
            let text = analysis.text.get(token.range).unwrap_or_default();
            let kind = TOKEN_KINDS.iter().position(|(kind, _)| *kind == token.kind);
            let lines = at.line - line;
            let columns = if lines == 0 { at.column - column } else { at.column };
            data.extend([
                lines as usize,
                columns as usize,
                text.encode_utf16().count(),
                kind.unwrap_or_default(),
                usize::from(token.is_declaration) | (usize::from(token.is_of_library) << 1),
            ]);
            (line, column) = (at.line, at.column);
        }
        Ok(json!({ "data": data }))
    }

    pub(super) fn hints(&mut self, asked: WithinText) -> Answer {
        let (_, analysis) = self.analysis(&asked.text_document.uri)?;
        let within = bytes_of(&analysis.text, asked.range);
        Ok(analysis
            .hints(&within)
            .iter()
            .map(|hint| {
                let range = range_by(&analysis.lines, &analysis.text, &(hint.at..hint.at));
                let mut shown = json!({
                    "position": range.get("start"),
                    "label": hint.text,
                    "paddingLeft": !hint.is_before,
                    "paddingRight": hint.is_before,
                });
                if let Some(shown) = shown.as_object_mut() {
                    if hint.is_before {
                        shown.insert("kind".to_owned(), 2.into());
                    }
                    if !hint.doc.is_empty() {
                        shown.insert("tooltip".to_owned(), hint.doc.clone().into());
                    }
                }
                shown
            })
            .collect())
    }

    pub(super) fn lenses(&mut self, asked: OfText) -> Answer {
        let uri = &asked.text_document.uri;
        let (path, text) = self.text(uri)?;
        let lenses = self.workspace.lenses(&path);
        Ok(lenses
            .iter()
            .map(|lens| {
                let range = range_of(&text, &lens.range);
                let shown = path.display().to_string();
                let (command, arguments) = match &lens.kind {
                    LensKind::Run(name) => ("setpiece.run", json!([shown, name])),
                    LensKind::Draw(name) => ("setpiece.draw", json!([shown, name])),
                    LensKind::Check(name) => ("setpiece.check", json!([shown, name])),
                    LensKind::Uses(places) => {
                        let places: Vec<Value> =
                            places.iter().filter_map(|place| self.location(place)).collect();
                        let at = range.get("start").cloned();
                        ("setpiece.uses", json!([uri, at, places]))
                    }
                };
                let command =
                    json!({ "title": lens.title, "command": command, "arguments": arguments });
                json!({ "range": range, "command": command })
            })
            .collect())
    }
}

fn shown_symbol(analysis: &Analysis, symbol: &Symbol) -> Value {
    let range = |bytes: &Range<usize>| range_by(&analysis.lines, &analysis.text, bytes);
    let inside: Vec<Value> = symbol.inside.iter().map(|it| shown_symbol(analysis, it)).collect();
    json!({
        "name": symbol.name,
        "kind": symbol_kind(symbol.kind),
        "range": range(&symbol.whole),
        "selectionRange": range(&symbol.range),
        "children": inside,
    })
}
