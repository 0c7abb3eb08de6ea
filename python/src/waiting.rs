//! Waiting for the thread of a session.

use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

use pyo3::prelude::*;

use crate::messages::Message;

/// Time between two checks for Ctrl-C.
const BETWEEN_SIGNAL_CHECKS: Duration = Duration::from_millis(50);

/// Waits for a message without the global interpreter lock, and returns the receiver with the message.
/// The receiver is passed by value, because threads cannot share it.
pub fn wait(
    py: Python<'_>,
    messages: Receiver<Message>,
) -> (Receiver<Message>, Result<Message, RecvTimeoutError>) {
    py.detach(move || {
        let received = messages.recv_timeout(BETWEEN_SIGNAL_CHECKS);
        (messages, received)
    })
}
