//! The picture of a start, and who is moved in it: the server's own requests.

use super::LanguageServer;
use super::answers::Answer;
use super::convert::{offset_of, text_edits};
use crate::editor::text::Lines;
use crate::render::scene::Id;
use gen_lsp_types as lsp;
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct PreviewOf {
    text_document: lsp::TextDocumentIdentifier,
    position: Option<lsp::Position>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct MoveTo {
    text_document: VersionOf,
    /// The scenario that is drawn.
    scenario: String,
    /// Who; none for the ball.
    player: Option<Id>,
    /// Metres, in the world's frame.
    to: [f64; 2],
}

/// A text, and the version of it that was drawn.
#[derive(Deserialize)]
struct VersionOf {
    uri: lsp::Uri,
    version: Option<i32>,
}

impl LanguageServer {
    /// The picture of a start: `{ scenario, version, svg, view, things, requires }`, with `message`
    /// if no episode has this start; `{ scenario, version, message }` if nothing can be drawn; null
    /// without a scenario.
    pub(super) fn preview(&mut self, asked: PreviewOf) -> Answer {
        let (path, text) = self.text(&asked.text_document.uri)?;
        let at = asked.position.map_or(text.len(), |at| offset_of(&Lines::of(&text), &text, at));
        let version = self.open.get(&path).and_then(|(_, version)| *version);
        Ok(self.workspace.preview(&path, at).map_or(Value::Null, |it| match it.picture {
            Ok(start) => {
                let things = start
                    .things
                    .iter()
                    .map(|it| json!({ "player": it.player, "name": it.name, "at": it.at }));
                let requires = start
                    .requires
                    .iter()
                    .map(|it| json!({ "label": it.label, "share": it.share, "fails": it.fails }));
                let mut shown = json!({
                    "scenario": it.scenario,
                    "version": version,
                    "svg": start.svg,
                    "view": start.view,
                    "things": things.collect::<Vec<Value>>(),
                    "requires": requires.collect::<Vec<Value>>(),
                });
                if let (Some(why), Some(shown)) = (start.refused, shown.as_object_mut()) {
                    shown.insert("message".to_owned(), why.into());
                }
                shown
            }
            Err(why) => json!({ "scenario": it.scenario, "version": version, "message": why }),
        }))
    }

    /// The edits that put a player or the ball elsewhere: `{ version, edits }`, or `{ message }` if
    /// the text has no numbers for it, or is another one than was drawn.
    pub(super) fn move_to(&mut self, asked: &MoveTo) -> Answer {
        let (path, text) = self.text(&asked.text_document.uri)?;
        let version = self.open.get(&path).and_then(|(_, version)| *version);
        if asked.text_document.version != version {
            let why = "the text has changed since this picture of it: drag again";
            return Ok(json!({ "message": why }));
        }
        let edits = self.workspace.move_to(&path, &asked.scenario, asked.player, asked.to);
        Ok(match edits {
            Ok(edits) => json!({ "version": version, "edits": text_edits(&text, &edits) }),
            Err(message) => json!({ "message": message }),
        })
    }
}
