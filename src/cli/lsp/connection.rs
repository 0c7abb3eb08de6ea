//! Messages on stdin and stdout.

use std::io::{ErrorKind, Write, stdin, stdout};
use std::sync::mpsc::{Receiver, channel};
use std::thread;

use lsp_server::{ErrorCode, Message};
use serde_json::json;

/// Messages from stdin, until it is closed, read by a separate thread so that the client can always write.
/// An invalid message is answered with an error.
pub fn messages() -> Receiver<Message> {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        loop {
            let read = Message::read(&mut stdin().lock());
            let goes_on = match read {
                Ok(Some(message)) => sender.send(message).is_ok(),
                Ok(None) => false,
                Err(error) => {
                    refuse(&error.to_string());
                    error.kind() == ErrorKind::InvalidData
                }
            };
            if !goes_on {
                return;
            }
        }
    });
    receiver
}

/// Sends a message to the client. Write errors are ignored, because a client that stops reading also closes stdin.
pub fn send(message: impl Into<Message>) {
    let _ = message.into().write(&mut stdout().lock());
}

fn refuse(why: &str) {
    let error = json!({ "code": ErrorCode::ParseError as i32, "message": why });
    let text = json!({ "jsonrpc": "2.0", "id": null, "error": error }).to_string();
    let mut out = stdout().lock();
    let _ = write!(out, "Content-Length: {}\r\n\r\n{text}", text.len()).and_then(|()| out.flush());
}
