//! `setpiece lsp`: answers an editor over the Language Server Protocol, on standard input and
//! output.

use super::common::{FAULT, FINE};
use crate::lsp::{LanguageServer, capabilities};
use lsp_server::{Connection, ErrorCode, Message, Response};

/// Serves one editor until it leaves; gives the exit code.
///
/// `allow_outside`: whether imports and scripts may be outside a text's folder.
pub(super) fn serve(allow_outside: bool) -> u8 {
    let (connection, threads) = Connection::stdio();
    let fine = talk(&connection, allow_outside).is_some();
    drop(connection);
    if threads.join().is_ok() && fine { FINE } else { FAULT }
}

/// The conversation; `None` if the editor breaks it off.
fn talk(connection: &Connection, allow_outside: bool) -> Option<()> {
    let (id, params) = connection.initialize_start().ok()?;
    connection.initialize_finish(id, capabilities()).ok()?;
    let mut server = LanguageServer::new(&params, allow_outside);
    while let Ok(message) = connection.receiver.recv() {
        if let Message::Request(request) = &message
            && request.method == "shutdown"
        {
            connection.sender.send(Response::new_ok(request.id.clone(), ()).into()).ok()?;
            return leave(connection);
        }
        let mut answers = server.receive(message);
        // Only what is said last is checked: an editor that types on doesn't wait.
        if connection.receiver.is_empty() {
            answers.extend(server.publish());
        }
        for answer in answers {
            connection.sender.send(answer).ok()?;
        }
    }
    None
}

/// Waits for the editor's `exit`; what it still asks for is refused.
fn leave(connection: &Connection) -> Option<()> {
    while let Ok(message) = connection.receiver.recv() {
        match message {
            Message::Notification(note) if note.method == "exit" => return Some(()),
            Message::Request(request) => {
                let code = ErrorCode::InvalidRequest as i32;
                let why = "the server was shut down".to_owned();
                connection.sender.send(Response::new_err(request.id, code, why).into()).ok()?;
            }
            _ => {}
        }
    }
    None
}
