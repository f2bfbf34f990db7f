//! Messages on standard input and output. What can't be read is answered, and the next message is
//! read.

use lsp_server::{Connection, ErrorCode, Message};
use serde_json::json;
use std::io::{self, BufRead, Read, Write};
use std::thread::{JoinHandle, spawn};

/// What carries the messages of a conversation.
pub(super) struct Wire {
    reader: JoinHandle<io::Result<()>>,
    writer: JoinHandle<io::Result<()>>,
}

impl Wire {
    /// The server's end of a conversation on standard input and output.
    pub(super) fn stdio() -> (Connection, Wire) {
        let (connection, other) = Connection::memory();
        let Connection { sender, receiver } = other;
        let reader = spawn(move || {
            let mut input = io::stdin().lock();
            while let Some(text) = next_text(&mut input)? {
                let message = match serde_json::from_slice::<Message>(&text) {
                    Ok(message) => message,
                    Err(why) => {
                        refuse(&why)?;
                        continue;
                    }
                };
                let is_last =
                    matches!(&message, Message::Notification(note) if note.method == "exit");
                if sender.send(message).is_err() || is_last {
                    break;
                }
            }
            Ok(())
        });
        let writer = spawn(move || {
            receiver.into_iter().try_for_each(|message| message.write(&mut io::stdout().lock()))
        });
        (connection, Wire { reader, writer })
    }

    /// Waits until everything is read and written; whether it was.
    pub(super) fn join(self) -> bool {
        let is_fine = |thread: JoinHandle<io::Result<()>>| matches!(thread.join(), Ok(Ok(())));
        // Both are waited for, whatever became of the first.
        let ends = [is_fine(self.reader), is_fine(self.writer)];
        ends.iter().all(|end| *end)
    }
}

/// The text of the next message; none at the end.
fn next_text(input: &mut impl BufRead) -> io::Result<Option<Vec<u8>>> {
    let mut length = None;
    loop {
        let mut line = String::new();
        if input.read_line(&mut line)? == 0 {
            return Ok(None);
        }
        let line = line.trim_end();
        if line.is_empty() {
            break;
        }
        if let Some((name, value)) = line.split_once(':')
            && name.eq_ignore_ascii_case("Content-Length")
        {
            length = value.trim().parse::<u64>().ok();
        }
    }
    // Where the next message begins isn't known.
    let length = length.ok_or_else(|| io::Error::other("a message without Content-Length"))?;
    let mut text = Vec::new();
    input.take(length).read_to_end(&mut text)?;
    Ok(Some(text))
}

/// Answers a message that can't be read: nobody knows whose it is, so the answer has no number.
fn refuse(why: &serde_json::Error) -> io::Result<()> {
    let code = if why.is_data() { ErrorCode::InvalidRequest } else { ErrorCode::ParseError };
    let error = json!({ "code": code as i32, "message": why.to_string() });
    let text = json!({ "jsonrpc": "2.0", "id": null, "error": error }).to_string();
    let mut output = io::stdout().lock();
    write!(output, "Content-Length: {}\r\n\r\n{text}", text.len())?;
    output.flush()
}
