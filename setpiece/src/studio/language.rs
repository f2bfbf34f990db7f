//! The language server over a page's socket: a message of the protocol in each frame.

use crate::lsp::{LanguageServer, capabilities};
use axum::extract::ws::{Message as Frame, WebSocket};
use lsp_server::{Message, Request, Response};

/// Serves a page until it leaves.
///
/// `allow_outside`: whether imports and scripts may be outside the text's folder.
pub(super) async fn converse(mut socket: WebSocket, allow_outside: bool) {
    let mut server = None;
    while let Some(Ok(frame)) = socket.recv().await {
        let text = match frame {
            Frame::Text(text) => text,
            Frame::Ping(_) | Frame::Pong(_) => continue,
            Frame::Binary(_) | Frame::Close(_) => return,
        };
        let known = std::mem::take(&mut server);
        // A text may take a while; the other tabs don't wait for it.
        let answered =
            tokio::task::spawn_blocking(move || answer(known, &text, allow_outside)).await;
        let Ok((next, answers)) = answered else { return };
        server = next;
        for answer in answers {
            if socket.send(Frame::Text(answer.into())).await.is_err() {
                return;
            }
        }
    }
}

/// What is to be sent for a message, and the server after it.
fn answer(
    server: Option<LanguageServer>,
    text: &str,
    allow_outside: bool,
) -> (Option<LanguageServer>, Vec<String>) {
    // What is no message of the protocol can't be answered.
    let Ok(message) = serde_json::from_str::<Message>(text) else { return (server, Vec::new()) };
    match (server, message) {
        (_, Message::Request(Request { id, method, params })) if method == "initialize" => {
            let answer = Response::new_ok(id, capabilities());
            (Some(LanguageServer::new(&params, allow_outside)), vec![json(&answer.into())])
        }
        (Some(mut server), message) => {
            let mut answers = server.receive(message);
            answers.extend(server.publish());
            let answers = answers.iter().map(json).collect();
            (Some(server), answers)
        }
        (None, _) => (None, Vec::new()),
    }
}

/// A message as its frame has it.
fn json(message: &Message) -> String {
    let mut value = serde_json::to_value(message).unwrap_or_default();
    if let Some(fields) = value.as_object_mut() {
        fields.insert("jsonrpc".to_owned(), "2.0".into());
    }
    value.to_string()
}
