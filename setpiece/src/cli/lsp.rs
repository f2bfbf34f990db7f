//! `setpiece lsp`: answers an editor over the Language Server Protocol, on standard input and
//! output.

mod wire;

use super::common::{FAULT, FINE};
use crate::lsp::{LanguageServer, LateFindings, QUIET, capabilities};
use lsp_server::{Connection, ErrorCode, Message, Response};
use std::thread::{JoinHandle, spawn};
use std::time::{Duration, Instant};
use wire::Wire;

/// How often work beside the conversation is looked at.
const LOOK: Duration = Duration::from_millis(10);
/// Longer than an editor is silent.
const NEVER: Duration = Duration::from_secs(86_400);

/// Serves one editor until it leaves; gives the exit code.
///
/// `allow_outside`: whether imports and scripts may be outside a text's folder.
pub(super) fn serve(allow_outside: bool) -> u8 {
    let (connection, wire) = Wire::stdio();
    let fine = talk(&connection, allow_outside).is_some();
    drop(connection);
    if wire.join() && fine { FINE } else { FAULT }
}

/// The conversation; `None` if the editor breaks it off.
fn talk(connection: &Connection, allow_outside: bool) -> Option<()> {
    let (id, params) = connection.initialize_start().ok()?;
    connection.initialize_finish(id, capabilities()).ok()?;
    let mut server = LanguageServer::new(&params, allow_outside);
    let mut late = LateThread { running: None, since: Instant::now() };
    loop {
        let message = match connection.receiver.recv_timeout(late.patience(&server)) {
            Ok(message) => message,
            Err(why) if why.is_timeout() => {
                for answer in late.turn(&mut server) {
                    connection.sender.send(answer).ok()?;
                }
                continue;
            }
            Err(_) => return None,
        };
        // Whoever asks doesn't type: hover and hints go on while starts are drawn.
        if matches!(message, Message::Notification(_)) {
            late.since = Instant::now();
        }
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
}

/// Work that goes on beside the conversation, one at a time.
struct LateThread {
    running: Option<JoinHandle<LateFindings>>,
    /// When the editor said something last.
    since: Instant,
}

impl LateThread {
    /// How long the next message is waited for before it is this one's turn.
    fn patience(&self, server: &LanguageServer) -> Duration {
        if self.running.is_some() {
            LOOK
        } else if server.has_later() {
            QUIET.saturating_sub(self.since.elapsed())
        } else {
            NEVER
        }
    }

    /// What is to be sent of what was found; begins what is to be done.
    fn turn(&mut self, server: &mut LanguageServer) -> Vec<Message> {
        if let Some(thread) = self.running.take_if(|thread| thread.is_finished()) {
            // Work that panics has found nothing.
            return thread.join().map(|found| server.settle(&found)).unwrap_or_default();
        }
        if self.running.is_none() {
            self.running = server.later().map(|work| spawn(|| work.run()));
        }
        Vec::new()
    }
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
