//! `withy`, `withy repl` and `withy -e`: a session with a terminal, with a pipe, or with inputs of the command line.

use super::Exit;
use super::args::{ReplOptions, SessionOptions};

/// Opens a session in which a file may have been evaluated first.
pub fn open(options: &ReplOptions) -> Exit {
    let _ = options;
    Exit::Good
}

/// A session without a file.
pub fn start(options: SessionOptions) -> Exit {
    open(&ReplOptions { file: None, session: options })
}
